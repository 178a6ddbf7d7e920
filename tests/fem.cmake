# Tests of the finite elements.
whipple_test(test_fem SOURCES unit/fem_mesh_test.cpp unit/fem_gmsh_test.cpp unit/fem_vtk_test.cpp property/fem_invariance_test.cpp property/fem_step_test.cpp property/fem_hourglass_test.cpp verification/fem_bars_test.cpp
             verification/fem_impact_test.cpp
             verification/fem_vibration_test.cpp DEPENDS whipple_fem whipple_material GTest::gmock LABELS fast)

# Measured, not asserted: benchmark_fem --benchmark_min_time=0.2
add_executable(benchmark_fem EXCLUDE_FROM_ALL benchmark/fem_benchmark.cpp)
target_link_libraries(benchmark_fem PRIVATE whipple_flags whipple_fem whipple_material benchmark::benchmark)
