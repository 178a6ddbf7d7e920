# Tests of grid, transfer, setup and solver.
whipple_test(test_planar_impact SOURCES verification/solver_planar_impact_test.cpp DEPENDS whipple_solver LABELS fast)
whipple_test(test_taylor_bar SOURCES verification/solver_taylor_bar_test.cpp DEPENDS whipple_solver LABELS fast)
whipple_test(test_elastic SOURCES verification/solver_elastic_test.cpp DEPENDS whipple_solver LABELS fast)
