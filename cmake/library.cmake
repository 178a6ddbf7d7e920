# Flags of every target of the project.
add_library(whipple_flags INTERFACE)
target_include_directories(whipple_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(whipple_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
                       $<$<BOOL:${WHIPPLE_WERROR}>:-Werror>)
# Contraction into fused multiply-adds is part of the speed; errno and traps of the mathematical functions are not needed.
target_compile_options(whipple_flags INTERFACE -fno-math-errno -fno-trapping-math -fopenmp)
target_link_options(whipple_flags INTERFACE -fopenmp)
# The C interface of MPI only: Open MPI's C++ bindings do not pass our warnings.
target_compile_definitions(whipple_flags INTERFACE OMPI_SKIP_MPICXX)
if(WHIPPLE_NATIVE)
  target_compile_options(whipple_flags INTERFACE -march=native)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(whipple_flags INTERFACE -march=x86-64-v3)
endif()
if(WHIPPLE_SANITIZE)
  # GCC 12 sees uninitialised values in the standard library where the sanitizers split it up.
  target_compile_options(whipple_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
    -fno-omit-frame-pointer -Wno-maybe-uninitialized)
  target_link_options(whipple_flags INTERFACE -fsanitize=address,undefined)
endif()

# whipple_library(NAME SOURCES a.cpp ... DEPENDS lib ...): one folder, one static library whipple_NAME.
function(whipple_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(whipple_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(whipple_${name} PUBLIC whipple_flags ${ARG_DEPENDS})
endfunction()

# whipple_test(NAME [STARTS_MPI] SOURCES ... DEPENDS ... LABELS ...): one GoogleTest executable, each of its tests a CTest
# test. STARTS_MPI: the process initialises MPI itself.
include(GoogleTest)
function(whipple_test name)
  cmake_parse_arguments(ARG "STARTS_MPI" "" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE whipple_flags ${ARG_DEPENDS} GTest::gtest_main)
  # The work is done in the libraries: what a test itself computes does not need the last optimisation.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(${name} PRIVATE WHIPPLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" WHIPPLE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60 PROPERTIES LABELS "${ARG_LABELS}")
  # gtest_discover_tests splits a list in a property, so the environment is set when ctest has found the tests.
  set(environment OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
    LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/leaks_of_libraries.txt:print_suppressions=0)
  if(ARG_STARTS_MPI)
    # Open MPI leaks in plug-ins that it has unloaded by the end: no name is left that could be suppressed.
    list(APPEND environment ASAN_OPTIONS=detect_leaks=0)
  endif()
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${name}_environment.cmake)
  file(WRITE ${script} "foreach(test IN LISTS ${name}_TESTS)\n  set_tests_properties(\"\${test}\" PROPERTIES ENVIRONMENT \"${environment}\")\nendforeach()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()
