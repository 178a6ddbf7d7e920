# Measures of finished runs.
whipple_test(test_analysis SOURCES unit/analysis_test.cpp unit/analysis_instruments_test.cpp unit/analysis_paths_test.cpp DEPENDS whipple_analysis LABELS fast)
if(WHIPPLE_PYTHON)
  foreach(part expectations uncertainty provenance)
    add_test(NAME results_${part}
             COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/results_${part}.py ${PROJECT_SOURCE_DIR}
                     $<TARGET_FILE:whipple>)
    set_tests_properties(results_${part} PROPERTIES LABELS fast TIMEOUT 120)
  endforeach()
endif()
