# Output and restart: unit tests of src/io, damage of files, ranks, the files as other programs see them.
whipple_test(test_io
  SOURCES unit/io_hdf5.cpp unit/io_history.cpp unit/io_run_directory.cpp unit/io_checkpoint.cpp
          unit/io_particle_series.cpp
  DEPENDS whipple_io GTest::gmock LABELS fast)
whipple_test(test_io_damage SOURCES fuzz/io_checkpoint_damage.cpp DEPENDS whipple_io GTest::gmock LABELS fast)

add_executable(test_io_ranks parallel/io_ranks.cpp)
target_link_libraries(test_io_ranks PRIVATE whipple_flags whipple_io GTest::gmock GTest::gtest)
foreach(ranks 1 3)
  add_test(NAME test_io_ranks.${ranks}
           COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:test_io_ranks>)
  set_tests_properties(test_io_ranks.${ranks} PROPERTIES LABELS fast TIMEOUT 120 PROCESSORS 2
    ENVIRONMENT "OMP_NUM_THREADS=1;OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1;OMPI_MCA_mpi_yield_when_idle=1")
endforeach()

# A made-up run, to test what reads runs.
add_executable(io_synthetic_cloud unit/io_synthetic_cloud.cpp)
target_link_libraries(io_synthetic_cloud PRIVATE whipple_flags whipple_io)
