# Tests of finite elements in the solver and of their conversion to particles.
whipple_test(test_afemp STARTS_MPI SOURCES property/afemp_conversion_test.cpp verification/solver_afemp_test.cpp verification/solver_element_range_test.cpp verification/solver_membrane_test.cpp verification/section_elements_test.cpp DEPENDS whipple_run GTest::gmock LABELS fast)
