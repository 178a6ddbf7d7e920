# Tests of grid, transfer, setup, solver and run.
whipple_test(test_transfer STARTS_MPI
  SOURCES unit/solver_grid_test.cpp unit/contact_first_touches_test.cpp property/transfer_shape_function_test.cpp property/solver_transfer_test.cpp property/transfer_kernels_test.cpp
          property/transfer_reference_test.cpp property/transfer_dissipation_test.cpp property/transfer_averages_test.cpp
          verification/transfer_conduction_test.cpp unit/transfer_sweep_test.cpp unit/transfer_formulas_test.cpp unit/grid_field_set_test.cpp
  DEPENDS whipple_contact LABELS fast)
whipple_test(test_solver STARTS_MPI
  SOURCES unit/case_in_code_test.cpp verification/solver_planar_test.cpp verification/solver_planar_impact_test.cpp verification/solver_taylor_bar_test.cpp verification/solver_elastic_test.cpp
          verification/solver_contact_test.cpp verification/solver_bars_test.cpp verification/solver_element_contact_test.cpp verification/solver_orders_test.cpp
          verification/solver_methods_test.cpp verification/solver_failure_test.cpp
          verification/solver_viscous_test.cpp verification/solver_wall_test.cpp validation/solver_debris_cloud_test.cpp
          validation/solver_table_test.cpp regression/solver_regression_test.cpp fuzz/case_fuzz.cpp property/device_of_tests.cpp
  DEPENDS whipple_run GTest::gmock LABELS fast)
whipple_test(test_run STARTS_MPI
  SOURCES parallel/run_restart_test.cpp unit/run_signal_control_test.cpp unit/run_history_columns_test.cpp property/run_forecast_test.cpp property/run_gauges_test.cpp property/solver_plausibility_test.cpp verification/run_steering_test.cpp
  DEPENDS whipple_run nlohmann_json::nlohmann_json GTest::gmock LABELS fast)
whipple_test(test_force_gauges STARTS_MPI SOURCES property/run_force_gauges_test.cpp DEPENDS whipple_run LABELS fast)
whipple_test(test_damping STARTS_MPI SOURCES verification/solver_damping_test.cpp verification/solver_plate_test.cpp DEPENDS whipple_solver LABELS fast)
whipple_test(test_contact STARTS_MPI SOURCES property/contact_pressing_test.cpp verification/solver_gap_test.cpp verification/solver_first_touch_test.cpp verification/solver_conduction_test.cpp property/device_of_tests.cpp
             DEPENDS whipple_run LABELS fast)
whipple_test(test_levels STARTS_MPI SOURCES verification/solver_levels_test.cpp DEPENDS whipple_run GTest::gmock LABELS fast)
whipple_test(test_cracks STARTS_MPI SOURCES verification/solver_cracks_test.cpp verification/solver_fragment_size_test.cpp DEPENDS whipple_run LABELS fast)
whipple_test(test_quasi_static STARTS_MPI SOURCES verification/solver_quasi_static_test.cpp verification/solver_load_step_laws_test.cpp verification/solver_load_step_rings_test.cpp unit/quasi_static_tangent_test.cpp DEPENDS whipple_solver whipple_quasi_static GTest::gmock LABELS fast)
# The steady flow of grains: half a minute.
whipple_test(test_granular_flow STARTS_MPI SOURCES verification/solver_granular_flow_test.cpp DEPENDS whipple_solver LABELS long)
whipple_test(test_driven STARTS_MPI SOURCES verification/solver_driven_test.cpp verification/solver_tool_test.cpp verification/solver_friction_wall_test.cpp verification/solver_averages_test.cpp verification/solver_loads_test.cpp verification/solver_water_test.cpp verification/solver_many_bodies_test.cpp verification/solver_tank_test.cpp verification/solver_cavitation_test.cpp property/device_of_tests.cpp DEPENDS whipple_solver LABELS fast)
whipple_test(test_burn STARTS_MPI SOURCES verification/burn_test.cpp verification/burn_contact_test.cpp verification/lighting_times_test.cpp verification/reaction_test.cpp DEPENDS whipple_run GTest::gmock LABELS fast)
add_test(NAME burn.fine_slab COMMAND test_burn --gtest_filter=PlanarDetonation.FollowsTheTaylorWaveOfTnt)
set_tests_properties(burn.fine_slab PROPERTIES ENVIRONMENT "WHIPPLE_FINE_BURN=1;OMP_NUM_THREADS=1" LABELS long)
whipple_test(test_contact_sweep STARTS_MPI SOURCES verification/solver_gap_sweep_test.cpp
             DEPENDS whipple_solver LABELS long)
# Files alone, for many trials with sanitizers (scripts/fuzz.py); other executables hold the same tests.
add_executable(fuzz EXCLUDE_FROM_ALL fuzz/case_fuzz.cpp fuzz/input_fuzz.cpp fuzz/io_checkpoint_damage.cpp fuzz/foreign_files.cpp
               fuzz/md_potential_fuzz.cpp)
target_link_libraries(fuzz PRIVATE whipple_flags whipple_test_folders whipple_app whipple_md_lammps GTest::gmock GTest::gtest_main)
whipple_test(test_rotation STARTS_MPI SOURCES verification/solver_rotation_test.cpp verification/solver_rubber_test.cpp verification/solver_finest_orders_test.cpp verification/solver_fine_plate_test.cpp DEPENDS whipple_solver LABELS long)
# Writes docs/generated/orders_of_convergence.md; a program of its own, as it takes minutes.
add_executable(orders_of_convergence EXCLUDE_FROM_ALL verification/solver_orders.cpp)
target_link_libraries(orders_of_convergence PRIVATE whipple_flags whipple_solver)
# Smoothed particles, and the program that measures them beside the step.
add_library(whipple_sph STATIC EXCLUDE_FROM_ALL benchmark/sph.cpp)
target_link_libraries(whipple_sph PUBLIC whipple_flags whipple_solver)
whipple_test_flags(whipple_sph OPTIMIZED)
add_executable(sph_beside_mpm EXCLUDE_FROM_ALL benchmark/sph_beside_mpm.cpp)
target_link_libraries(sph_beside_mpm PRIVATE whipple_sph)
target_compile_definitions(sph_beside_mpm PRIVATE WHIPPLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
whipple_test(test_case SOURCES unit/case_bodies_test.cpp unit/case_grains_test.cpp unit/case_lattice_test.cpp unit/case_case_test.cpp unit/case_check_test.cpp unit/case_loads_test.cpp unit/case_shape_test.cpp unit/case_remarks_test.cpp
             DEPENDS whipple_case LABELS fast)
# Bodies from files and generated ones.
whipple_test(test_paraview_points SOURCES unit/case_paraview_test.cpp DEPENDS whipple_case GTest::gmock LABELS fast)
whipple_test(test_solids SOURCES unit/case_surface_test.cpp unit/case_solids_test.cpp unit/case_image_test.cpp unit/case_points_test.cpp DEPENDS whipple_case GTest::gmock LABELS fast)

# Distributed: against one rank, restart on another number of ranks, errors and killed ranks.
add_executable(test_solver_ranks parallel/solver_ranks.cpp parallel/solver_wall_ranks.cpp parallel/sweep_ranks.cpp parallel/solver_element_ranks.cpp
               parallel/solver_burn_ranks.cpp parallel/solver_average_ranks.cpp parallel/solver_tool_ranks.cpp)
target_link_libraries(test_solver_ranks PRIVATE whipple_run whipple_analysis GTest::gtest)
whipple_test_flags(test_solver_ranks)
foreach(ranks 1 2 4 8)
  if(ranks EQUAL 1 OR ranks GREATER 4)  # one rank agrees with itself
    set(label long)
  else()
    set(label fast)
  endif()
  add_test(NAME test_solver_ranks.${ranks}
           COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:test_solver_ranks>)
  set_tests_properties(test_solver_ranks.${ranks} PROPERTIES LABELS ${label} TIMEOUT 900 RUN_SERIAL ON
    ENVIRONMENT "${mpi_environment}")
endforeach()
add_executable(test_crack_ranks parallel/solver_crack_ranks.cpp parallel/solver_level_ranks.cpp)
target_link_libraries(test_crack_ranks PRIVATE whipple_run GTest::gtest)
whipple_test_flags(test_crack_ranks)
foreach(ranks 2 4)
  add_test(NAME test_crack_ranks.${ranks}
           COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:test_crack_ranks>)
  set_tests_properties(test_crack_ranks.${ranks} PROPERTIES LABELS fast TIMEOUT 300 RUN_SERIAL ON
    ENVIRONMENT "${mpi_environment}")
endforeach()
if(WHIPPLE_PYTHON)
  add_test(NAME solver_rank_killed
           COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/parallel/solver_rank_killed.py $<TARGET_FILE:whipple>
                   ${PROJECT_SOURCE_DIR}/cases/copper_disk_on_aluminium/case.toml ${CMAKE_CURRENT_BINARY_DIR}/rank_killed)
  set_tests_properties(solver_rank_killed PROPERTIES LABELS fast TIMEOUT 300 COST 10)
  add_test(NAME run_processes COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/parallel/run_processes.py
           $<TARGET_FILE:whipple> ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml
           ${PROJECT_SOURCE_DIR}/cases/md/copper_mishin_short.toml ${CMAKE_CURRENT_BINARY_DIR}/run_processes)
  set_tests_properties(run_processes PROPERTIES LABELS fast TIMEOUT 300 COST 20)
  add_test(NAME run_replay COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/parallel/run_replay.py $<TARGET_FILE:whipple>
           ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml ${CMAKE_CURRENT_BINARY_DIR}/run_replay)
  add_test(NAME run_bodies_from_files COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/parallel/bodies_from_files.py
           $<TARGET_FILE:whipple> ${CMAKE_CURRENT_BINARY_DIR}/run_bodies_from_files)
  set_tests_properties(run_bodies_from_files PROPERTIES LABELS fast TIMEOUT 300)
  add_test(NAME run_stop COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/parallel/run_stop.py $<TARGET_FILE:whipple>
           ${CMAKE_CURRENT_SOURCE_DIR}/data ${CMAKE_CURRENT_BINARY_DIR}/run_stop)
  set_tests_properties(run_stop PROPERTIES LABELS fast TIMEOUT 300 COST 5)
  set_tests_properties(run_replay PROPERTIES LABELS fast TIMEOUT 300 COST 15)
  # Calls to the system that fail; sanitizers want to be loaded before all other libraries.
  if(NOT WHIPPLE_SANITIZE)
    add_library(failing_calls MODULE faults/failing_calls.cpp)
    target_link_libraries(failing_calls PRIVATE ${CMAKE_DL_LIBS})
    foreach(faults 4 500)
      set(only)
      if(faults EQUAL 4)
        set(only --only "run,run on ranks,analyse,md")
      endif()
      add_test(NAME injected_faults.${faults}
               COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/parallel/injected_faults.py $<TARGET_FILE:whipple>
                       $<TARGET_FILE:failing_calls> ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml
                       ${CMAKE_CURRENT_BINARY_DIR}/injected_faults_${faults} --faults ${faults} ${only})
    endforeach()
    add_test(NAME restart_read_errors
             COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/parallel/restart_read_errors.py $<TARGET_FILE:whipple>
                     $<TARGET_FILE:failing_calls> ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml
                     ${CMAKE_CURRENT_BINARY_DIR}/restart_read_errors)
    set_tests_properties(restart_read_errors PROPERTIES LABELS fast TIMEOUT 300)
    set_tests_properties(injected_faults.4 PROPERTIES LABELS fast TIMEOUT 300 COST 20)
    set_tests_properties(injected_faults.500 PROPERTIES LABELS long TIMEOUT 7200 PROCESSORS 2)
  endif()
  foreach(ranks 1 2)
    add_test(NAME torture.${ranks} COMMAND ${WHIPPLE_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/torture.py $<TARGET_FILE:whipple>
             ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml ${CMAKE_CURRENT_BINARY_DIR}/torture_${ranks} --runs 10 --ranks ${ranks})
    set_tests_properties(torture.${ranks} PROPERTIES LABELS long TIMEOUT 900 PROCESSORS 2)
  endforeach()
endif()

# Problems with exact solutions: sources shared by the tests and the program that writes docs/generated/exact_suite.md.
add_library(whipple_exact STATIC EXCLUDE_FROM_ALL
  verification/exact/result.cpp verification/exact/gas_solutions.cpp verification/exact/gas_problems.cpp
  verification/exact/planar_impact.cpp verification/exact/piston.cpp verification/exact/oblique_impact.cpp
  verification/exact/advected_block.cpp)
target_link_libraries(whipple_exact PUBLIC whipple_flags whipple_solver)
whipple_test_flags(whipple_exact OPTIMIZED)
add_executable(exact_suite EXCLUDE_FROM_ALL verification/exact_suite.cpp)
target_link_libraries(exact_suite PRIVATE whipple_exact)
whipple_test(test_exact STARTS_MPI
  SOURCES verification/exact_solutions_test.cpp verification/exact_gas_test.cpp verification/exact_impact_test.cpp
          verification/exact_solid_test.cpp property/device_of_tests.cpp
  DEPENDS whipple_exact LABELS fast)
# Finer resolutions are long.
whipple_test(test_expansion STARTS_MPI SOURCES verification/solver_expansion_test.cpp property/device_of_tests.cpp verification/solver_foam_test.cpp verification/sph_test.cpp DEPENDS whipple_solver whipple_sph LABELS fast)
set(expansion_labels ${CMAKE_CURRENT_BINARY_DIR}/test_expansion_labels.cmake)
file(WRITE ${expansion_labels} [=[
foreach(test IN LISTS test_expansion_TESTS)
  if(test MATCHES "Fine")
    set_tests_properties("${test}" PROPERTIES LABELS long)
  endif()
endforeach()
]=])
set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${expansion_labels})
# All of those with exact solutions have the label exact.
set(exact_labels ${CMAKE_CURRENT_BINARY_DIR}/test_exact_labels.cmake)
file(WRITE ${exact_labels} [=[
foreach(test IN LISTS test_exact_TESTS)
  if(test MATCHES "Fine")
    set_tests_properties("${test}" PROPERTIES LABELS "long;exact")
  else()
    set_tests_properties("${test}" PROPERTIES LABELS "fast;exact")
  endif()
endforeach()
]=])
set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${exact_labels})
# Kernels of devices, called on the host.
whipple_test(test_device_contact STARTS_MPI SOURCES property/device_contact_test.cpp DEPENDS whipple_contact LABELS fast)
