# Tests of the Python module whipple.eos, where it is built: numbers, arrays, errors; type stubs beside the module.
if(TARGET whipple_python_eos AND WHIPPLE_PYTHON)
  foreach(part eos stubs)
    add_test(NAME python_${part} COMMAND ${WHIPPLE_PYTHON} -m unittest test_${part}
             WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/python/tests)
    set_tests_properties(python_${part} PROPERTIES LABELS fast TIMEOUT 300
      ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;OMP_NUM_THREADS=1")
  endforeach()
endif()
