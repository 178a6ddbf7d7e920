# Tests of the molecular-dynamics side: md_fitting/data_set, plan, lammps, protocols and whipple-md.
whipple_test(md_test
  SOURCES unit/md_data_set_test.cpp unit/md_plan_test.cpp unit/md_potential_test.cpp fuzz/md_potential_fuzz.cpp
          unit/md_lammps_test.cpp unit/md_kim_test.cpp unit/md_tasks_test.cpp unit/md_campaign_test.cpp unit/md_statistics_test.cpp unit/md_bath_test.cpp
          unit/md_hugoniot_test.cpp unit/md_analysis_test.cpp unit/md_refinement_test.cpp unit/md_critical_point_test.cpp
          unit/md_vibrations_test.cpp unit/md_pair_style_test.cpp unit/md_budget_test.cpp
          validation/md_copper_test.cpp validation/md_static_test.cpp validation/md_fluid_test.cpp
  DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_shock_test TIMEOUT 7200 SOURCES validation/md_shock_test.cpp validation/md_honesty_test.cpp
  DEPENDS whipple_md_protocols LABELS long)
whipple_test(md_simulated_crystal_test SOURCES unit/md_worker_source_test.cpp DEPENDS whipple_md_simulated_crystal LABELS fast)
# Programs under mpirun, started by the test itself.
add_executable(md_guard_abort parallel/md_guard_abort.cpp)
target_link_libraries(md_guard_abort PRIVATE whipple_md_lammps)
whipple_test_flags(md_guard_abort)
whipple_test(md_ranks_test SOURCES parallel/md_ranks_test.cpp DEPENDS whipple_md_data_set LABELS fast)
if(WHIPPLE_PYTHON)
  foreach(part foreign_code damaged_potential)
    add_test(NAME md_${part} COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/md_${part}.py $<TARGET_FILE:whipple>)
    set_tests_properties(md_${part} PROPERTIES LABELS fast TIMEOUT 120)
  endforeach()
endif()
whipple_test(md_kill_test SOURCES parallel/md_kill_test.cpp DEPENDS whipple_md_data_set LABELS long)
target_compile_definitions(md_kill_test PRIVATE WHIPPLE_MPIEXEC="${MPIEXEC_EXECUTABLE}")
add_dependencies(md_kill_test whipple-md)
target_compile_definitions(md_ranks_test PRIVATE WHIPPLE_MPIEXEC="${MPIEXEC_EXECUTABLE}")
add_dependencies(md_ranks_test whipple-md md_guard_abort)
