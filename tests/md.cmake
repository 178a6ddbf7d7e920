# Tests of the molecular-dynamics side: md_fitting/data_set, plan, lammps, protocols and whipple-md.
whipple_test(md_data_set_test SOURCES unit/md_data_set_test.cpp DEPENDS whipple_md_data_set LABELS fast)
whipple_test(md_potential_test SOURCES unit/md_potential_test.cpp DEPENDS whipple_md_lammps LABELS fast)
whipple_test(md_plan_test SOURCES unit/md_plan_test.cpp DEPENDS whipple_md_plan LABELS fast)
whipple_test(md_lammps_test SOURCES unit/md_lammps_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_tasks_test SOURCES unit/md_tasks_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_statistics_test SOURCES unit/md_statistics_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_hugoniot_test SOURCES unit/md_hugoniot_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_campaign_test SOURCES unit/md_campaign_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_potential_fuzz SOURCES fuzz/md_potential_fuzz.cpp DEPENDS whipple_md_lammps LABELS fast)
whipple_test(md_copper_test SOURCES validation/md_copper_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_static_test SOURCES validation/md_static_test.cpp DEPENDS whipple_md_protocols LABELS fast)
# Programs under mpirun, started by the test itself.
add_executable(md_guard_abort parallel/md_guard_abort.cpp)
target_link_libraries(md_guard_abort PRIVATE whipple_md_lammps)
whipple_test(md_ranks_test SOURCES parallel/md_ranks_test.cpp DEPENDS whipple_md_data_set LABELS fast)
target_compile_definitions(md_ranks_test PRIVATE WHIPPLE_MD="$<TARGET_FILE:whipple-md>"
  WHIPPLE_MD_GUARD_ABORT="$<TARGET_FILE:md_guard_abort>" WHIPPLE_MPIEXEC="${MPIEXEC_EXECUTABLE}")
add_dependencies(md_ranks_test whipple-md md_guard_abort)
