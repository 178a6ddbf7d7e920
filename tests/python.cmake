# Tests of the Python module whipple.eos, where it is built: numbers, arrays, errors; type stubs beside the module.
if(TARGET whipple_python_eos AND WHIPPLE_PYTHON)
  set(python_environment "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;OMP_NUM_THREADS=1")
  foreach(part eos stubs)
    add_test(NAME python_${part} COMMAND ${WHIPPLE_PYTHON} -m unittest test_${part}
             WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/python/tests)
    set_tests_properties(python_${part} PROPERTIES LABELS fast TIMEOUT 300 ENVIRONMENT "${python_environment}")
  endforeach()

  # Cases, runs and results, and the example of them.
  foreach(part runs stopping_ball)
    add_test(NAME python_${part} COMMAND ${WHIPPLE_PYTHON} -m unittest test_${part}
             WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/python/tests)
    set_tests_properties(python_${part} PROPERTIES LABELS fast TIMEOUT 300
                         ENVIRONMENT "${python_environment};${mpi_environment};WHIPPLE_PROGRAM=$<TARGET_FILE:whipple>;MPLCONFIGDIR=${CMAKE_CURRENT_BINARY_DIR}")
  endforeach()

  # A million states beside C++, by processor times.
  add_executable(evaluate_states benchmark/evaluate_states.cpp)
  target_link_libraries(evaluate_states PRIVATE whipple_material)
  whipple_test_flags(evaluate_states OPTIMIZED)
  add_test(NAME python_speed COMMAND ${WHIPPLE_PYTHON} ${PROJECT_SOURCE_DIR}/python/tests/test_speed.py
           $<TARGET_FILE:evaluate_states>)
  set_tests_properties(python_speed PROPERTIES LABELS "fast;timing" TIMEOUT 300
                       ENVIRONMENT "${python_environment}")

  add_test(NAME python_example COMMAND ${WHIPPLE_PYTHON} ${PROJECT_SOURCE_DIR}/python/tests/test_example.py
           $<TARGET_FILE:whipple>)
  set_tests_properties(python_example PROPERTIES LABELS fast TIMEOUT 300
                       ENVIRONMENT "${python_environment};${mpi_environment};MPLCONFIGDIR=${CMAKE_CURRENT_BINARY_DIR}")
endif()
