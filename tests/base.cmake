# Tests of src/base and src/input: quantities, parameter tables, error texts, TOML documents.
whipple_test(base_units_test SOURCES unit/base_units.cpp DEPENDS whipple_base GTest::gmock LABELS fast)
