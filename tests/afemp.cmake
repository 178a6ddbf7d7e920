# Tests of finite elements in the solver and of their conversion to particles.
whipple_test(test_afemp STARTS_MPI SOURCES property/afemp_conversion_test.cpp verification/solver_afemp_test.cpp verification/solver_element_range_test.cpp verification/solver_membrane_test.cpp verification/section_elements_test.cpp verification/solver_element_pieces_test.cpp DEPENDS whipple_run GTest::gmock LABELS fast)
add_test(NAME afemp.fine_pieces COMMAND test_afemp --gtest_filter=PiecesOfABody.MeetAsTwoBodiesDo)
set_tests_properties(afemp.fine_pieces PROPERTIES ENVIRONMENT "WHIPPLE_FINE_PIECES=1;OMP_NUM_THREADS=1" LABELS long)
