# Tests of the fit of equations of state and of the comparison with experiments.
whipple_test(fit_least_squares_test SOURCES unit/fit_least_squares_test.cpp DEPENDS whipple_fit LABELS fast)
whipple_test(fit_recovery_test SOURCES property/fit_recovery_test.cpp DEPENDS whipple_fit LABELS fast)
whipple_test(fit_error_statistics_test SOURCES property/fit_error_statistics_test.cpp DEPENDS whipple_fit LABELS long)
