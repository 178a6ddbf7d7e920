# Measures of finished runs.
whipple_test(test_analysis SOURCES unit/analysis_test.cpp DEPENDS whipple_analysis LABELS fast)
if(WHIPPLE_PYTHON)
  add_test(NAME results_expectations
           COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/results_expectations.py ${PROJECT_SOURCE_DIR})
  set_tests_properties(results_expectations PROPERTIES LABELS fast TIMEOUT 120)
endif()
