# Measures of finished runs.
whipple_test(test_analysis OPTIMIZED SOURCES unit/analysis_test.cpp unit/analysis_fragments_test.cpp unit/analysis_instruments_test.cpp unit/analysis_paths_test.cpp unit/analysis_requests_test.cpp unit/analysis_outcome_test.cpp unit/view_test.cpp DEPENDS whipple_view whipple_analysis GTest::gmock LABELS fast)
if(WHIPPLE_PYTHON)
  add_test(NAME analysis_frames COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/analysis_frames.py $<TARGET_FILE:whipple>)
  set_tests_properties(analysis_frames PROPERTIES LABELS fast TIMEOUT 300)
  foreach(part expectations uncertainty provenance)
    add_test(NAME results_${part}
             COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/results_${part}.py ${PROJECT_SOURCE_DIR}
                     $<TARGET_FILE:whipple>)
    set_tests_properties(results_${part} PROPERTIES LABELS fast TIMEOUT 120)
  endforeach()
endif()

# The viewer: its modules with node, its shaders with the system's OpenGL ES, its page with both. What is absent is said.
set(viewer_tests ${PROJECT_SOURCE_DIR}/web/viewer/tests)
find_program(WHIPPLE_NODE node)
if(WHIPPLE_NODE)
  add_test(NAME viewer_modules COMMAND ${WHIPPLE_NODE} --test ${viewer_tests}/logic.test.js ${viewer_tests}/monitor.test.js ${viewer_tests}/editor.test.js)
else()
  add_test(NAME viewer_modules COMMAND ${CMAKE_COMMAND} -E echo "SKIPPED: node is absent: the viewer's modules were not tested")
endif()
add_test(NAME viewer_shaders COMMAND /usr/bin/python3 ${viewer_tests}/shaders.py ${PROJECT_SOURCE_DIR}/web/viewer/shaders.js)
set_tests_properties(viewer_modules PROPERTIES LABELS "fast;browser" TIMEOUT 300 SKIP_REGULAR_EXPRESSION "SKIPPED")
set_tests_properties(viewer_shaders PROPERTIES LABELS "fast;browser" TIMEOUT 300 SKIP_RETURN_CODE 77)
if(WHIPPLE_PYTHON)
  add_test(NAME viewer_page COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/view_page.py $<TARGET_FILE:whipple>
           ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml ${PROJECT_SOURCE_DIR})
  add_test(NAME viewer_million COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/view_million.py $<TARGET_FILE:whipple>
           $<TARGET_FILE:io_synthetic_cloud> ${CMAKE_CURRENT_BINARY_DIR}/viewer_million)
  add_test(NAME preview_cases COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/preview_cases.py $<TARGET_FILE:whipple>
           ${PROJECT_SOURCE_DIR}/cases ${CMAKE_CURRENT_BINARY_DIR}/preview_cases)
  set_tests_properties(preview_cases PROPERTIES LABELS "long;browser" TIMEOUT 1800 SKIP_RETURN_CODE 77)
  set_tests_properties(viewer_million PROPERTIES LABELS "long;browser" TIMEOUT 900 SKIP_RETURN_CODE 77)
  set_tests_properties(viewer_page PROPERTIES LABELS "fast;browser" TIMEOUT 600 SKIP_REGULAR_EXPRESSION "SKIPPED")
endif()
