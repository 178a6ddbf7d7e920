# Tests of grid, transfer, setup and solver.
whipple_test(test_grid SOURCES unit/solver_grid_test.cpp DEPENDS whipple_grid LABELS fast)
whipple_test(test_transfer SOURCES property/solver_transfer_test.cpp DEPENDS whipple_transfer LABELS fast)
whipple_test(test_run SOURCES parallel/solver_restart_test.cpp DEPENDS whipple_solver LABELS fast)
whipple_test(test_planar_impact SOURCES verification/solver_planar_impact_test.cpp DEPENDS whipple_solver LABELS fast)
whipple_test(test_taylor_bar SOURCES verification/solver_taylor_bar_test.cpp DEPENDS whipple_solver LABELS fast)
whipple_test(test_elastic SOURCES verification/solver_elastic_test.cpp DEPENDS whipple_solver LABELS fast)
whipple_test(test_setup SOURCES unit/setup_case_test.cpp DEPENDS whipple_setup LABELS fast)
whipple_test(test_debris_cloud SOURCES validation/solver_debris_cloud_test.cpp DEPENDS whipple_solver LABELS fast)
