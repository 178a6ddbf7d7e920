# Tests of this part: whipple_test(name SOURCES ... DEPENDS ... LABELS ...)
