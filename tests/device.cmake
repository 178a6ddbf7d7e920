# Tests of the step on a device, which the threads of the host emulate.
whipple_test(test_device STARTS_MPI SOURCES verification/solver_device_test.cpp DEPENDS whipple_run GTest::gmock LABELS fast)
# Suites of other subjects on the emulated device: those of their tests that it computes. Left out are elements, heat
# conduction, other schemes and shape functions, more than two bodies at a node, and affine fields that are only turned.
function(whipple_suite_on_device name executable filter)
  add_test(NAME device.${name} COMMAND ${executable} --gtest_filter=${filter})
  set_tests_properties(device.${name} PROPERTIES ENVIRONMENT "WHIPPLE_TEST_DEVICE=emulated;OMP_NUM_THREADS=2" LABELS long)
endfunction()
whipple_suite_on_device(gaps test_contact Gap.*:FirstTouch.*:Fields/Pressed.*-Gap.HeatFlows*:*Elements)
string(CONCAT whipple_of_contact "Contact.ABlock*:Contact.BarsReboundAndPart:Contact.BodiesDoNotFeelOneAnotherBeforeTheyTouch:"
  "Contact.FieldsElsewhereChangeNothing:Contact.IsExactWhereABodyArrivesAtAPlaneOnWhichAnotherStands")
whipple_suite_on_device(contact test_solver ${whipple_of_contact})
whipple_suite_on_device(walls test_solver WallContact.*-*EveryShapeFunction*:*AGasThatFills*:*StopsElements*)
whipple_suite_on_device(exact test_exact ExactGas.*:ExactSolid.*:Of/ExactImpact.*:Of/ExactMelting.*-*Oblique*)
