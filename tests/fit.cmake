# Tests of the fit of equations of state and of the comparison with experiments.
whipple_test(fit_test OPTIMIZED
  SOURCES unit/fit_least_squares_test.cpp unit/fit_methods_test.cpp property/fit_adaptive_test.cpp
          property/fit_recovery_test.cpp property/fit_models_test.cpp property/fit_discrepancy_test.cpp
          property/fit_joint_test.cpp property/fit_correction_test.cpp property/fit_left_out_test.cpp
  DEPENDS whipple_fit GTest::gmock LABELS fast)
whipple_test(fit_error_statistics_test SOURCES property/fit_error_statistics_test.cpp property/fit_correction_samples_test.cpp DEPENDS whipple_fit LABELS long)
whipple_test(fit_material_test SOURCES unit/fit_material_test.cpp unit/fit_measured_test.cpp unit/fit_needs_test.cpp unit/fit_tiers_test.cpp DEPENDS whipple_fit whipple_material GTest::gmock LABELS fast)
add_dependencies(fit_material_test whipple-fit)
whipple_test(fit_compare_test SOURCES validation/fit_compare_test.cpp property/fit_calibration_test.cpp
             DEPENDS whipple_material whipple_eos_experiments GTest::gmock LABELS fast)
whipple_test(fit_compare_command_test SOURCES unit/fit_compare_command_test.cpp unit/eos_md_command_test.cpp DEPENDS whipple_base GTest::gmock fmt::fmt LABELS fast)
add_dependencies(fit_compare_command_test whipple whipple-md whipple-fit)
