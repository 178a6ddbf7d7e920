# Flags of every target of the project.
# Headers are read and their templates instantiated once for several files. Off: each file stands by itself (preset dev).
option(WHIPPLE_UNITY_BUILD "Compile several files of a target together" ON)

add_library(whipple_flags INTERFACE)
target_include_directories(whipple_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(whipple_flags INTERFACE -Wall -Wextra -Wconversion -Wno-sign-conversion
                       $<$<BOOL:${WHIPPLE_WERROR}>:-Werror>
                       # of two files that are compiled together neither shadows the other
                       $<$<NOT:$<BOOL:${WHIPPLE_UNITY_BUILD}>>:-Wshadow>)
# The compiler collects no garbage below 1 GB: no file needs more, and collecting takes a tenth of its time.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(whipple_flags INTERFACE "SHELL:--param ggc-min-heapsize=1000000")
  # Templates on registers of 64 bytes are inlined into functions for AVX-512: no such register is ever passed.
  target_compile_options(whipple_flags INTERFACE -Wno-psabi)
endif()
# Contraction into fused multiply-adds is part of the speed; errno and traps of the mathematical functions are not needed.
target_compile_options(whipple_flags INTERFACE -fno-math-errno -fno-trapping-math -fopenmp)
# Position-independent code that calls and inlines as other code: nobody replaces a function of ours at load time.
target_compile_options(whipple_flags INTERFACE -fno-semantic-interposition)
target_link_options(whipple_flags INTERFACE -fopenmp)
# The C interface of MPI only: Open MPI's C++ bindings do not pass our warnings.
target_compile_definitions(whipple_flags INTERFACE OMPI_SKIP_MPICXX)
if(WHIPPLE_NATIVE)
  set(whipple_processor -march=native)
  # GCC 12 warns of its own AVX-512 header where Eigen uses it (GCC bug 105593).
  target_compile_options(whipple_flags INTERFACE -Wno-maybe-uninitialized)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT WHIPPLE_PORTABLE)
  set(whipple_processor -march=x86-64-v3)
endif()
target_compile_options(whipple_flags INTERFACE ${whipple_processor})
if(WHIPPLE_SANITIZE)
  # GCC 12 sees uninitialised values in the standard library where the sanitizers split it up.
  target_compile_options(whipple_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
    -fno-omit-frame-pointer -fno-var-tracking-assignments -Wno-maybe-uninitialized)
  target_compile_definitions(whipple_flags INTERFACE _GLIBCXX_ASSERTIONS)  # empty optionals, indices out of range
  target_link_options(whipple_flags INTERFACE -fsanitize=address,undefined)
endif()

# The same heavy headers are read by every file. Off: every file must name all that it uses (preset dev).
option(WHIPPLE_PRECOMPILED_HEADERS "Read the headers of the standard library, fmt, Eigen and GoogleTest once" ON)
if(WHIPPLE_PRECOMPILED_HEADERS AND CCACHE)
  # What ccache needs to keep objects that were made with precompiled headers; DEPEND: no second preprocessing; BASEDIR:
  # paths by where they lie in the tree, so that a clone in another folder finds them.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_PCH_EXTSUM=1
      CCACHE_DEPEND=1 CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${CCACHE})
  target_compile_options(whipple_flags INTERFACE -fpch-preprocess)
endif()
if(WHIPPLE_PRECOMPILED_HEADERS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 forgets which lines of a precompiled header are the system's, and sees overlong copies in std::string there.
  target_compile_options(whipple_flags INTERFACE -Wno-stringop-overflow -Wno-array-bounds -Wno-restrict)
endif()
target_link_libraries(whipple_flags INTERFACE fmt::fmt)

# What programs that use the installed libraries need: the processor decides how Eigen aligns its vectors.
add_library(whipple_consumer INTERFACE)
target_include_directories(whipple_consumer INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(whipple_consumer INTERFACE cxx_std_20)
target_compile_definitions(whipple_consumer INTERFACE OMPI_SKIP_MPICXX)
target_compile_options(whipple_consumer INTERFACE ${whipple_processor})
target_link_options(whipple_consumer INTERFACE -fopenmp)
target_link_libraries(whipple_consumer INTERFACE fmt::fmt)

# whipple_precompiled_headers(NAME HEADERS ... DEPENDS ...): what targets with the same flags reuse.
function(whipple_precompiled_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;DEPENDS;OPTIONS" ${ARGN})
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE whipple_flags ${ARG_DEPENDS})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
  # GCC writes the path of the build into its file; ccache shall know it by what it was made of.
  get_target_property(flags whipple_flags INTERFACE_COMPILE_OPTIONS)
  string(SHA256 contents "${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_BUILD_TYPE} ${flags} ${ARG_OPTIONS} ${ARG_HEADERS}
    ${fmt_VERSION} ${Eigen3_VERSION} ${GTest_VERSION}")
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/CMakeFiles/${name}.dir/cmake_pch.hxx.gch.sum CONTENT ${contents})
endfunction()
set(whipple_heavy_headers <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <random>
    <span> <sstream> <string> <string_view> <vector> <fmt/format.h> <fmt/ranges.h> <Eigen/Core> <Eigen/Geometry>)
if(WHIPPLE_PRECOMPILED_HEADERS)
  whipple_precompiled_headers(whipple_precompiled HEADERS ${whipple_heavy_headers} DEPENDS Eigen3::Eigen)
endif()

# Files, sections of cases, plans: nothing that a step waits for.
set(whipple_cold_options $<$<CONFIG:Release>:-O1>)
if(WHIPPLE_PRECOMPILED_HEADERS)
  whipple_precompiled_headers(whipple_precompiled_cold HEADERS ${whipple_heavy_headers} DEPENDS Eigen3::Eigen
    OPTIONS ${whipple_cold_options})
endif()

# whipple_compile_together(TARGET [BATCH]): several of its files, six unless it is said, as one. So does CMake's UNITY_BUILD,
# but names them by absolute paths: the compiler's cache would know none of them in another folder.
function(whipple_compile_together target)
  if(WHIPPLE_UNITY_BUILD)
    set(batch 6)
    if(ARGN)
      set(batch ${ARGN})
    endif()
    # At the end of the folder's file, when the properties of its sources are known.
    cmake_language(EVAL CODE "cmake_language(DEFER CALL whipple_write_together [[${target}]] [[${batch}]])")
  endif()
endfunction()
function(whipple_write_together target batch)
  get_target_property(sources ${target} SOURCES)
  set(apart)
  set(together)
  foreach(source IN LISTS sources)
    get_source_file_property(is_apart ${source} SKIP_UNITY_BUILD_INCLUSION)
    if(is_apart)
      list(APPEND apart ${source})
    else()
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
      list(APPEND together "#include \"${source}\"\n")
    endif()
  endforeach()
  list(LENGTH together count)
  set(first 0)
  while(first LESS count)
    list(SUBLIST together ${first} ${batch} part)
    list(JOIN part "" text)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/together/${target}_${first}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    list(APPEND apart ${file})
    math(EXPR first "${first} + ${batch}")
  endwhile()
  set_property(TARGET ${target} PROPERTY SOURCES ${apart})
endfunction()

# whipple_library(NAME [UNITY [BATCH files]] [COLD] [COMMAND_LINE] SOURCES a.cpp ... DEPENDS lib ...): one folder, one static
# library whipple_NAME. UNITY where no kernel is: GCC's limits of inlining count by what is compiled together. COLD where a
# run spends no time: less optimisation, which takes a quarter of the compiler's time.
function(whipple_library name)
  cmake_parse_arguments(ARG "UNITY;COLD;COMMAND_LINE" "BATCH" "SOURCES;DEPENDS" ${ARGN})
  add_library(whipple_${name} STATIC ${ARG_SOURCES})
  if(ARG_UNITY)
    whipple_compile_together(whipple_${name} ${ARG_BATCH})
  endif()
  target_link_libraries(whipple_${name} PUBLIC $<BUILD_INTERFACE:whipple_flags> $<INSTALL_INTERFACE:whipple::consumer> ${ARG_DEPENDS})
  if(ARG_COMMAND_LINE)
    whipple_command_line(whipple_${name})
  elseif(ARG_COLD)
    target_compile_options(whipple_${name} PRIVATE ${whipple_cold_options})
    if(WHIPPLE_PRECOMPILED_HEADERS)
      target_precompile_headers(whipple_${name} REUSE_FROM whipple_precompiled_cold)
    endif()
  elseif(WHIPPLE_PRECOMPILED_HEADERS)
    target_precompile_headers(whipple_${name} REUSE_FROM whipple_precompiled)
  endif()
endfunction()

# Command lines need no optimisation, and CLI11 is slow to compile.
set(whipple_command_line_options $<$<CONFIG:Release>:-O0>)
if(WHIPPLE_PRECOMPILED_HEADERS)
  whipple_precompiled_headers(whipple_precompiled_command_line
    HEADERS ${whipple_heavy_headers} <nlohmann/json.hpp> <CLI/CLI.hpp>
    DEPENDS Eigen3::Eigen nlohmann_json::nlohmann_json CLI11::CLI11 OPTIONS ${whipple_command_line_options})
endif()
function(whipple_command_line target)
  target_link_libraries(${target} PRIVATE whipple_flags CLI11::CLI11)
  target_compile_options(${target} PRIVATE ${whipple_command_line_options})
  if(WHIPPLE_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM whipple_precompiled_command_line)
  endif()
endfunction()

# whipple_test(NAME [STARTS_MPI] [OPTIMIZED] [TIMEOUT seconds] SOURCES ... DEPENDS ... LABELS ...): one GoogleTest executable,
# each of its tests a CTest test. STARTS_MPI: the process initialises MPI itself. OPTIMIZED: the test itself computes much.
include(GoogleTest)
# The work is done in the libraries; without optimisation a test is compiled in two thirds of the time.
set(whipple_test_options $<$<CONFIG:Release>:-O0>)
set(whipple_optimized_test_options $<$<CONFIG:Release>:-O1>)
if(WHIPPLE_TESTS AND WHIPPLE_PRECOMPILED_HEADERS)
  foreach(kind test optimized_test)
    whipple_precompiled_headers(whipple_precompiled_${kind} HEADERS ${whipple_heavy_headers} <gtest/gtest.h> <gmock/gmock.h>
      DEPENDS Eigen3::Eigen GTest::gtest GTest::gmock OPTIONS ${whipple_${kind}_options})
  endforeach()
endif()
# whipple_test_flags(TARGET [OPTIMIZED]): also for what is no GoogleTest executable.
function(whipple_test_flags target)
  set(kind test)
  if("OPTIMIZED" IN_LIST ARGN)
    set(kind optimized_test)
  endif()
  target_link_libraries(${target} PRIVATE whipple_flags whipple_test_folders GTest::gtest)
  target_compile_options(${target} PRIVATE ${whipple_${kind}_options})
  if(WHIPPLE_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM whipple_precompiled_${kind})
  endif()
endfunction()
function(whipple_test name)
  cmake_parse_arguments(ARG "STARTS_MPI;OPTIMIZED" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 1500)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  whipple_compile_together(${name})
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} GTest::gtest_main)
  if(ARG_OPTIMIZED)
    whipple_test_flags(${name} OPTIMIZED)
  else()
    whipple_test_flags(${name})
  endif()
  gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
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
