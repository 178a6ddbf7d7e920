# Tests of the step on a device, which the threads of the host emulate.
whipple_test(test_device STARTS_MPI SOURCES verification/solver_device_test.cpp DEPENDS whipple_run GTest::gmock LABELS fast)
# Suites of other subjects on the emulated device: those of their tests that it computes.
function(whipple_suite_on_device name executable filter)
  add_test(NAME device.${name} COMMAND ${executable} --gtest_filter=${filter})
  set_tests_properties(device.${name} PROPERTIES ENVIRONMENT "WHIPPLE_TEST_DEVICE=emulated;OMP_NUM_THREADS=2" LABELS long)
endfunction()
