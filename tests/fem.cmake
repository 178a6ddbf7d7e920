# Tests of the finite elements.
whipple_test(test_fem SOURCES property/fem_step_test.cpp DEPENDS whipple_fem whipple_material LABELS fast)
