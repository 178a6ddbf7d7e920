# Tests of src/material: strength, failure, damage, the update of a state, material files.
whipple_test(test_material
  SOURCES unit/material_strength_test.cpp unit/mechanical_threshold_test.cpp unit/material_reference_step_test.cpp unit/material_modifiers_test.cpp
          unit/material_formulas_test.cpp
          unit/material_file_test.cpp property/material_update_test.cpp property/material_limits_test.cpp
          property/material_failure_test.cpp property/material_spall_test.cpp
          property/material_damage_test.cpp property/material_brittle_test.cpp property/material_concrete_test.cpp property/material_soil_test.cpp property/material_mohr_coulomb_test.cpp property/material_dilation_test.cpp property/material_cam_clay_test.cpp property/material_foam_test.cpp
          validation/alloy_damage_test.cpp property/material_hardening_test.cpp property/material_burn_test.cpp property/material_dissipation_test.cpp property/material_hyperelastic_test.cpp property/material_fragment_size_test.cpp property/material_energy_test.cpp property/device_material_test.cpp property/material_crushable_foam_test.cpp
  DEPENDS whipple_device_material whipple_material GTest::gmock LABELS fast)

# Measured, not asserted: benchmark_material --benchmark_min_time=0.2
add_executable(benchmark_material EXCLUDE_FROM_ALL benchmark/material_benchmark.cpp)
target_link_libraries(benchmark_material PRIVATE whipple_flags whipple_material benchmark::benchmark)
target_compile_definitions(benchmark_material PRIVATE WHIPPLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
