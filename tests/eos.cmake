# Tests of the equations of state.
whipple_test(eos_gray_test SOURCES unit/eos_gray_test.cpp DEPENDS whipple_eos LABELS fast)
whipple_test(eos_mie_gruneisen_test SOURCES unit/eos_mie_gruneisen_test.cpp DEPENDS whipple_eos LABELS fast)
whipple_test(eos_identities_test SOURCES property/eos_identities_test.cpp DEPENDS whipple_eos LABELS fast)
whipple_test(eos_loci_test SOURCES verification/eos_loci_test.cpp DEPENDS whipple_eos LABELS fast)
whipple_test(eos_copper_test SOURCES validation/eos_copper_test.cpp DEPENDS whipple_eos LABELS fast)

add_executable(eos_benchmark benchmark/eos_benchmark.cpp)
target_link_libraries(eos_benchmark PRIVATE whipple_eos benchmark::benchmark)
