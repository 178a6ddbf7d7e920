# Tests of the step on a device, which the threads of the host emulate.
whipple_test(test_device STARTS_MPI SOURCES verification/solver_device_test.cpp DEPENDS whipple_run GTest::gmock LABELS fast)
# Suites of other subjects on the emulated device: those of their tests that it computes. Left out are elements, heat
# conduction, other schemes and shape functions, more than two bodies at a node, and affine fields that are only turned.
function(whipple_suite_on_device name executable filter)
  add_test(NAME device.${name} COMMAND ${executable} --gtest_filter=${filter})
  set_tests_properties(device.${name} PROPERTIES ENVIRONMENT "WHIPPLE_TEST_DEVICE=emulated;OMP_NUM_THREADS=1" LABELS long)
endfunction()
whipple_suite_on_device(gaps test_contact Gap.*:FirstTouch.*:Fields/Pressed.*-Gap.HeatFlows*:*Elements)
string(CONCAT whipple_of_contact "Contact.ABlock*:Contact.BarsReboundAndPart:Contact.BodiesDoNotFeelOneAnotherBeforeTheyTouch:"
  "Contact.FieldsElsewhereChangeNothing:Contact.IsExactWhereABodyArrivesAtAPlaneOnWhichAnotherStands")
whipple_suite_on_device(contact test_solver ${whipple_of_contact})
whipple_suite_on_device(walls test_solver WallContact.*-*EveryShapeFunction*:*AGasThatFills*:*StopsElements*)
whipple_suite_on_device(exact test_exact ExactGas.*:ExactSolid.*:Of/ExactImpact.*:Of/ExactMelting.*-*Oblique*)

# Stored states and the program that compares with them; registers and other compilers of the kernels.
if(WHIPPLE_PYTHON)
  add_test(NAME device_check COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/device_check.py $<TARGET_FILE:whipple>
           $<TARGET_FILE:whipple-device-check> ${CMAKE_CXX_COMPILER} ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/device_check)
  set_tests_properties(device_check PROPERTIES LABELS fast TIMEOUT 120)
  if(WHIPPLE_HAS_CUDA)
    add_test(NAME device_registers COMMAND ${WHIPPLE_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/device_registers.py
             ${PROJECT_BINARY_DIR}/src/device/gpu.log ${PROJECT_BINARY_DIR}/src/device/gpu_section.log --check)
    set_tests_properties(device_registers PROPERTIES LABELS fast)
    find_program(WHIPPLE_CLANG NAMES clang++-19 clang++-18 clang++)
    if(WHIPPLE_CLANG)
      add_test(NAME device_clang COMMAND ${WHIPPLE_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/device_clang.py ${WHIPPLE_CLANG}
               ${CUDAToolkit_BIN_DIR}/.. ${CMAKE_CURRENT_BINARY_DIR}/device_clang)
      set_tests_properties(device_clang PROPERTIES LABELS long TIMEOUT 600)
    endif()
  endif()
endif()
