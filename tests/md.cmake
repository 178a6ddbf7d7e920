# Tests of the molecular-dynamics side: md_fitting/data_set, lammps, protocols and whipple-md.
whipple_test(md_data_set_test SOURCES unit/md_data_set_test.cpp DEPENDS whipple_md_data_set LABELS fast)
whipple_test(md_potential_test SOURCES unit/md_potential_test.cpp DEPENDS whipple_md_lammps LABELS fast)
