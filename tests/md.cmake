# Tests of the molecular-dynamics side: md_fitting/data_set, plan, lammps, protocols and whipple-md.
whipple_test(md_data_set_test SOURCES unit/md_data_set_test.cpp DEPENDS whipple_md_data_set LABELS fast)
whipple_test(md_potential_test SOURCES unit/md_potential_test.cpp DEPENDS whipple_md_lammps LABELS fast)
whipple_test(md_plan_test SOURCES unit/md_plan_test.cpp DEPENDS whipple_md_plan LABELS fast)
whipple_test(md_lammps_test SOURCES unit/md_lammps_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_statistics_test SOURCES unit/md_statistics_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_hugoniot_test SOURCES unit/md_hugoniot_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_campaign_test SOURCES unit/md_campaign_test.cpp DEPENDS whipple_md_protocols LABELS fast)
whipple_test(md_copper_test SOURCES validation/md_copper_test.cpp DEPENDS whipple_md_protocols LABELS fast)
