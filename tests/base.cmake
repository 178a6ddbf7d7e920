# Tests of src/base and src/input: quantities, parameter tables, error texts, TOML documents.
whipple_test(base_units_test SOURCES unit/base_units.cpp DEPENDS whipple_base GTest::gmock LABELS fast)
whipple_test(base_test SOURCES unit/base_text.cpp unit/base_parameter_table.cpp DEPENDS whipple_base GTest::gmock LABELS fast)
whipple_test(input_test SOURCES unit/input_document.cpp DEPENDS whipple_input GTest::gmock LABELS fast)
whipple_test(input_fuzz_test SOURCES fuzz/input_fuzz.cpp DEPENDS whipple_input LABELS fast)
