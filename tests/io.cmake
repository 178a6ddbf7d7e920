# Output and restart: unit tests of src/io, damage of files, ranks, the files as other programs see them.
whipple_test(hdf5_test SOURCES unit/hdf5_test.cpp DEPENDS whipple_hdf5 GTest::gmock LABELS fast)
whipple_test(test_io
  SOURCES unit/io_history.cpp unit/io_run_directory.cpp unit/io_checkpoint.cpp unit/io_particle_series.cpp
          fuzz/io_checkpoint_damage.cpp
  DEPENDS whipple_io GTest::gmock LABELS fast)

# Written and read by several ranks.
add_executable(test_io_ranks parallel/io_ranks.cpp)
target_link_libraries(test_io_ranks PRIVATE whipple_io GTest::gmock GTest::gtest)
whipple_test_flags(test_io_ranks)
foreach(ranks 1 3)
  add_test(NAME test_io_ranks.${ranks}
           COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:test_io_ranks>)
  set_tests_properties(test_io_ranks.${ranks} PROPERTIES LABELS fast TIMEOUT 120
    ENVIRONMENT "${mpi_environment}")
endforeach()

# A made-up run, to test what reads runs.
add_executable(io_synthetic_cloud unit/io_synthetic_cloud.cpp)
target_link_libraries(io_synthetic_cloud PRIVATE whipple_io)
whipple_test_flags(io_synthetic_cloud OPTIMIZED)

# The layout as h5py sees it, written by one and by three ranks.
if(WHIPPLE_PYTHON)
  foreach(ranks 1 3)
    set(cloud ${CMAKE_CURRENT_BINARY_DIR}/synthetic_cloud_${ranks})
    add_test(NAME io_synthetic_cloud.${ranks}
             COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:io_synthetic_cloud> ${cloud} 20000 5)
    set_tests_properties(io_synthetic_cloud.${ranks} PROPERTIES LABELS fast TIMEOUT 120 COST 50
      ENVIRONMENT "${mpi_environment}" FIXTURES_SETUP synthetic_cloud_${ranks})
    add_test(NAME io_vtkhdf_schema.${ranks}
             COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_vtkhdf_schema.py ${cloud} ${ranks})
    set_tests_properties(io_vtkhdf_schema.${ranks} PROPERTIES LABELS fast TIMEOUT 120
      FIXTURES_REQUIRED synthetic_cloud_${ranks})
  endforeach()
  add_test(NAME report COMMAND ${WHIPPLE_PYTHON} -m unittest discover -s report/tests -t .
           WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(report PROPERTIES LABELS fast TIMEOUT 120)
  if(NOT WHIPPLE_SANITIZE)
    set_tests_properties(report PROPERTIES ENVIRONMENT "WHIPPLE_FAILING_CALLS=$<TARGET_FILE:failing_calls>")
  endif()
  foreach(part whole several)
    add_test(NAME io_report.${part} COMMAND ${WHIPPLE_PYTHON} ${PROJECT_SOURCE_DIR}/report/tests/synthetic_cloud.py
             ${CMAKE_CURRENT_BINARY_DIR}/synthetic_cloud_1 $<TARGET_FILE:whipple> ${part})
    set_tests_properties(io_report.${part} PROPERTIES LABELS fast TIMEOUT 300 COST 40 FIXTURES_REQUIRED synthetic_cloud_1)
  endforeach()
endif()

# What ParaView makes of the series; where it is installed (scripts/install_deps.sh --paraview).
find_program(WHIPPLE_PVBATCH pvbatch)
find_program(WHIPPLE_XVFB_RUN xvfb-run)
if(WHIPPLE_PYTHON AND WHIPPLE_PVBATCH AND WHIPPLE_XVFB_RUN)
  foreach(ranks 1 3)
    add_test(NAME io_paraview.${ranks}
             COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_paraview.py
                     ${CMAKE_CURRENT_BINARY_DIR}/synthetic_cloud_${ranks})
    set_tests_properties(io_paraview.${ranks} PROPERTIES LABELS "paraview" TIMEOUT 300 PROCESSORS 2
      FIXTURES_REQUIRED synthetic_cloud_${ranks})
  endforeach()
endif()
