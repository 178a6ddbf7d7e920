# Measures of finished runs.
whipple_test(test_analysis SOURCES unit/analysis_test.cpp DEPENDS whipple_analysis LABELS fast)
