# Tests of src/core/base and src/core/input: quantities, parameter tables, error texts, TOML documents.
whipple_test(base_test SOURCES unit/base_units.cpp unit/base_text.cpp unit/base_catalogue.cpp unit/base_parameter_table.cpp unit/base_files.cpp unit/base_registers.cpp unit/base_pattern.cpp unit/base_linear_algebra.cpp property/base_gaps_test.cpp property/base_vectors_test.cpp
  DEPENDS whipple_base GTest::gmock LABELS fast)
whipple_test(input_test SOURCES unit/input_document.cpp unit/input_text_edit.cpp fuzz/input_fuzz.cpp unit/input_text_removal.cpp DEPENDS whipple_input GTest::gmock nlohmann_json::nlohmann_json LABELS fast)
