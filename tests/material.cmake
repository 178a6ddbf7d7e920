# Tests of this part: whipple_test(name SOURCES ... DEPENDS ... LABELS ...)
whipple_test(test_material_strength SOURCES unit/material_strength_test.cpp DEPENDS whipple_material GTest::gmock LABELS fast)
whipple_test(test_material_reference_step SOURCES unit/material_reference_step_test.cpp DEPENDS whipple_material LABELS fast)
whipple_test(test_material_update SOURCES property/material_update_test.cpp DEPENDS whipple_material LABELS fast)
whipple_test(test_material_failure SOURCES property/material_failure_test.cpp DEPENDS whipple_material LABELS fast)
whipple_test(test_material_damage SOURCES property/material_damage_test.cpp property/material_brittle_test.cpp property/material_concrete_test.cpp DEPENDS whipple_material GTest::gmock LABELS fast)
whipple_test(test_material_hardening SOURCES property/material_hardening_test.cpp DEPENDS whipple_material LABELS fast)
whipple_test(eos_library_test SOURCES validation/eos_library_test.cpp DEPENDS whipple_material LABELS fast)
whipple_test(test_material_modifiers SOURCES unit/material_modifiers_test.cpp DEPENDS whipple_material GTest::gmock LABELS fast)
whipple_test(test_material_file SOURCES unit/material_file_test.cpp DEPENDS whipple_material GTest::gmock LABELS fast)

# Measured, not asserted: benchmark_material --benchmark_min_time=0.2
add_executable(benchmark_material EXCLUDE_FROM_ALL benchmark/material_benchmark.cpp)
target_link_libraries(benchmark_material PRIVATE whipple_flags whipple_material benchmark::benchmark)
