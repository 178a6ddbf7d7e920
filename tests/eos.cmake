# Tests of the equations of state.
whipple_test(eos_test
  SOURCES unit/eos_gray_test.cpp unit/eos_gray_71_test.cpp verification/eos_gray_melting_test.cpp
          verification/eos_gray_metals_test.cpp unit/eos_mie_gruneisen_test.cpp unit/eos_debye_test.cpp
          unit/eos_modifiers_test.cpp unit/eos_md_test.cpp unit/eos_concrete_test.cpp property/eos_closure_test.cpp property/eos_mixture_of_two_test.cpp
          property/eos_identities_test.cpp property/eos_corrected_gray_test.cpp property/eos_wide_gray_test.cpp property/eos_solid_transition_test.cpp
          property/eos_constant_heat_test.cpp verification/eos_loci_test.cpp verification/eos_models_test.cpp
          verification/eos_shock_test.cpp verification/eos_gas_loci_test.cpp validation/eos_copper_test.cpp
          unit/eos_table_test.cpp verification/eos_table_error_test.cpp unit/eos_vapour_dome_test.cpp
  DEPENDS whipple_eos GTest::gmock LABELS fast)
# What the command line shows, without the command line.
whipple_test(eos_curves_test SOURCES unit/eos_curves_test.cpp unit/eos_experiments_test.cpp
             DEPENDS whipple_eos_curves whipple_eos_experiments LABELS fast)
# The catalogue of materials is read by whipple_material.
whipple_test(eos_library_test
  SOURCES property/eos_inversions_test.cpp property/eos_audit_test.cpp validation/eos_library_test.cpp
          unit/eos_table_file_test.cpp unit/eos_sesame_test.cpp verification/eos_table_metals_test.cpp
          verification/eos_explosives_test.cpp
  DEPENDS whipple_material whipple_eos_curves GTest::gmock LABELS fast)
add_test(NAME eos_table_error.at_a_million_states COMMAND eos_test --gtest_filter=EosTableError*:-*Isochoric*)
set_tests_properties(eos_table_error.at_a_million_states PROPERTIES
  ENVIRONMENT "WHIPPLE_TABLE_STATES=1000000;OMP_NUM_THREADS=1" LABELS long)

add_executable(eos_benchmark EXCLUDE_FROM_ALL benchmark/eos_benchmark.cpp)
target_link_libraries(eos_benchmark PRIVATE whipple_eos benchmark::benchmark)

whipple_test(eos_command_test SOURCES unit/eos_command_test.cpp DEPENDS whipple_base GTest::gmock fmt::fmt LABELS fast)
add_dependencies(eos_command_test whipple)

# The command: figures of the library's copper through the executable, exit codes, files.
set(eos_csv ${CMAKE_CURRENT_BINARY_DIR}/eos_hugoniot.csv)
add_test(NAME eos_command.hugoniot_prints_shock_melting
  COMMAND whipple eos hugoniot copper --to "300 GPa" --points 7 --csv ${eos_csv} --plot ${eos_csv}.png --force
          --with ${PROJECT_SOURCE_DIR}/eos/data/cu_hugoniot_marsh1980.csv)
set_tests_properties(eos_command.hugoniot_prints_shock_melting PROPERTIES
  PASS_REGULAR_EXPRESSION "written.*png.*onset 221\\.9.*completion 285\\.9" FIXTURES_SETUP eos_csv)
add_test(NAME eos_command.refuses_to_overwrite COMMAND whipple eos hugoniot copper --csv ${eos_csv})
set_tests_properties(eos_command.refuses_to_overwrite PROPERTIES
  PASS_REGULAR_EXPRESSION "exists; --force overwrites it" FIXTURES_REQUIRED eos_csv)
add_test(NAME eos_command.release_to_one_bar_vaporises_a_tenth
  COMMAND whipple eos release copper --pressure "396 GPa" --to "1 bar")
set_tests_properties(eos_command.release_to_one_bar_vaporises_a_tenth PROPERTIES
  PASS_REGULAR_EXPRESSION "0\\.100[0-9]* +liquid and vapour")
add_test(NAME eos_command.beyond_the_model_is_a_state_error COMMAND whipple eos hugoniot copper --pressure "900 TPa")
set_tests_properties(eos_command.beyond_the_model_is_a_state_error PROPERTIES
  PASS_REGULAR_EXPRESSION "beyond the maximum density of model gray")
add_test(NAME eos_command.less_energy_than_the_coldest_state COMMAND whipple eos state copper --density "8.9 g/cm^3" --energy "-1 MJ/kg")
set_tests_properties(eos_command.less_energy_than_the_coldest_state PROPERTIES
  PASS_REGULAR_EXPRESSION "physics error: gray: no state with -1e.06 J/kg at 8900 kg/m.3: the coldest one, of 1 K, has -116[0-9]+")
add_test(NAME eos_command.audit_of_an_explosive COMMAND whipple eos audit tnt)
set_tests_properties(eos_command.audit_of_an_explosive PROPERTIES
  PASS_REGULAR_EXPRESSION "Chapman-Jouguet: 6\\.9[0-9]* km/s, 2[01][.0-9]* GPa.*verdict: sound")
set_tests_properties(eos_command.less_energy_than_the_coldest_state eos_command.audit_of_an_explosive PROPERTIES LABELS fast)
# Composition B meets copper and water; its cylinder test; what is no explosive.
add_test(NAME eos_command.contact COMMAND whipple eos contact composition_b copper_ofhc_mie_gruneisen water_linear_mie_gruneisen)
set_tests_properties(eos_command.contact PROPERTIES PASS_REGULAR_EXPRESSION "shock +0\\.98[0-9]+ .* 47\\.[0-9]+ .*expansion +2\\.[0-9]+")
add_test(NAME eos_command.cylinder COMMAND whipple eos cylinder composition_b --from "6 mm" --to "19 mm" --points 2)
set_tests_properties(eos_command.cylinder PROPERTIES PASS_REGULAR_EXPRESSION "6 +1\\.398.*19 +1\\.626")
add_test(NAME eos_command.gurney COMMAND whipple eos gurney composition_b --volume 7 --points 3)
set_tests_properties(eos_command.gurney PROPERTIES PASS_REGULAR_EXPRESSION "\n *1 +2\\.307")
add_test(NAME eos_command.products COMMAND whipple eos products composition_b --to "1 GPa" --points 3)
add_test(NAME eos_command.detonation_of_copper COMMAND whipple eos detonation tnt copper)
set_tests_properties(eos_command.products PROPERTIES PASS_REGULAR_EXPRESSION "29\\.49[0-9]+ ")
set_tests_properties(eos_command.detonation_of_copper PROPERTIES PASS_REGULAR_EXPRESSION "error: model gray describes no explosive")
foreach(query contact cylinder gurney products detonation_of_copper)
  set_tests_properties(eos_command.${query} PROPERTIES LABELS fast)
endforeach()
foreach(query isotherm isentrope dome)
  add_test(NAME eos_command.${query} COMMAND whipple eos ${query} copper --points 5)
endforeach()
# 100 GPa: 0.7206 of the volume at 300 K (Dewaele et al. 2004 within 0.5 GPa); on the isentrope hotter and less dense, entropy kept.
set_tests_properties(eos_command.isotherm PROPERTIES PASS_REGULAR_EXPRESSION "0\\.72056[0-9]* +100 +300 .*solid")
set_tests_properties(eos_command.isentrope PROPERTIES PASS_REGULAR_EXPRESSION "0\\.72282[0-9]* +100 +528\\.[0-9]+ .* [0-9.]+e-(09|1[0-9]) .*solid")
set_tests_properties(eos_command.dome PROPERTIES PASS_REGULAR_EXPRESSION "critical point 8511\\.[0-9] K, 1\\.035 GPa, 2\\.595 g/cm")
add_test(NAME eos_command.audit_of_debye_gruneisen COMMAND whipple eos audit copper_debye)
set_tests_properties(eos_command.audit_of_debye_gruneisen PROPERTIES
  PASS_REGULAR_EXPRESSION "c 3\\.904[0-9]* km/s, K_S 136\\.[0-9]+ GPa.*by shock 221\\.[0-9]+.*verdict: sound")
# The audit: the verdict, and exit code 2 for constants that are not usable (compressed by 1.6 % only).
add_test(NAME eos_command.audit COMMAND whipple eos audit copper)
set_tests_properties(eos_command.audit PROPERTIES
  PASS_REGULAR_EXPRESSION "by shock 221\\.9 .*critical point 851[0-9].*solid +[0-9]+ +[0-9.]+e-[01].*melting +[0-9]+ +[0-9.]+e-1[0-9].*verdict: sound")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/unusable.toml [=[
name = "slope mistyped"
source = "test"
[eos]
model = "mie_gruneisen"
reference_density = "2785 kg/m^3"
hugoniot_intercept = "5328 m/s"
hugoniot_slope = 60
gruneisen = 2.0
heat_capacity = "863 J/(kg K)"
]=])
add_test(NAME eos_command.audit_refuses_unusable_constants
  COMMAND sh -c "$<TARGET_FILE:whipple> eos audit unusable.toml 2>&1 | grep 'error: slope mistyped: not usable: compression limit' && $<TARGET_FILE:whipple> eos audit unusable.toml; test $? -eq 2"
  WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
foreach(query audit_refuses_unusable_constants hugoniot_prints_shock_melting refuses_to_overwrite release_to_one_bar_vaporises_a_tenth
        beyond_the_model_is_a_state_error audit_of_debye_gruneisen isotherm isentrope dome audit)
  set_property(TEST eos_command.${query} PROPERTY LABELS fast)
endforeach()

# Tables: written, verified, used as the model of a material; damaged and existing files.
set(eos_table_file ${CMAKE_CURRENT_BINARY_DIR}/copper.eos.h5)
add_test(NAME eos_command.table
  COMMAND whipple eos table copper --error 1e-3 -o ${eos_table_file} --force)
set_tests_properties(eos_command.table PROPERTIES
  PASS_REGULAR_EXPRESSION "requested 0.001 in T and p.*solid +[0-9]+.*wrote .*copper.eos.h5" FIXTURES_SETUP eos_table_file)
add_test(NAME eos_command.table_refuses_to_overwrite COMMAND whipple eos table copper -o ${eos_table_file})
set_tests_properties(eos_command.table_refuses_to_overwrite PROPERTIES
  PASS_REGULAR_EXPRESSION "exists; --force overwrites it" FIXTURES_REQUIRED eos_table_file)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/copper_tabulated.toml
  "name = \"Copper\"\nsource = \"test\"\n[eos]\nmodel = \"table\"\nfile = \"copper.eos.h5\"\n")
add_test(NAME eos_command.hugoniot_of_a_table
  COMMAND whipple eos hugoniot ${CMAKE_CURRENT_BINARY_DIR}/copper_tabulated.toml --to "300 GPa" --points 7)
set_tests_properties(eos_command.hugoniot_of_a_table PROPERTIES
  PASS_REGULAR_EXPRESSION "onset 22[0-9]\\.[0-9]* GPa.*completion 28[0-9]\\.[0-9]* GPa" FIXTURES_REQUIRED eos_table_file)
foreach(query table table_refuses_to_overwrite hugoniot_of_a_table)
  set_property(TEST eos_command.${query} PROPERTY LABELS fast)
endforeach()

# SESAME files: written, used as the model of a material, never overwritten unasked.
set(eos_sesame_file ${CMAKE_CURRENT_BINARY_DIR}/copper.ses)
add_test(NAME eos_command.sesame
  COMMAND whipple eos table copper --sesame ${eos_sesame_file} --number 90029 --atomic-number 29 --atomic-mass "63.546 g/mol" --force --verbose)
set_tests_properties(eos_command.sesame PROPERTIES
  PASS_REGULAR_EXPRESSION "SESAME material 90029: copper .*with Helmholtz energy, table 401 of.*wrote .*copper.ses" FIXTURES_SETUP eos_sesame_file)
add_test(NAME eos_command.sesame_refuses_to_overwrite COMMAND whipple eos table copper --sesame ${eos_sesame_file})
set_tests_properties(eos_command.sesame_refuses_to_overwrite PROPERTIES
  PASS_REGULAR_EXPRESSION "exists; --force overwrites it" FIXTURES_REQUIRED eos_sesame_file)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/copper_sesame.toml
  "name = \"Copper\"\nsource = \"test\"\n[eos]\nmodel = \"sesame\"\nfile = \"copper.ses\"\nmaterial = 90029\n")
add_test(NAME eos_command.hugoniot_of_a_sesame_table
  COMMAND whipple eos hugoniot ${CMAKE_CURRENT_BINARY_DIR}/copper_sesame.toml --to "200 GPa" --points 5)
set_tests_properties(eos_command.hugoniot_of_a_sesame_table PROPERTIES
  PASS_REGULAR_EXPRESSION "2\\.77[0-9]* +8\\.0[56][0-9]* +136[34][0-9.]+ +0\\.65[0-9]* +200 " FIXTURES_REQUIRED eos_sesame_file)
add_test(NAME eos_command.table_needs_one_file
  COMMAND sh -c "$<TARGET_FILE:whipple> eos table copper -q 2>&1 | grep 'expected --output NAME.eos.h5 or --sesame FILE' && $<TARGET_FILE:whipple> eos table copper -o none.eos.h5 --sesame none.ses; test $? -eq 2 && test ! -e none.ses"
  WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
foreach(query sesame sesame_refuses_to_overwrite hugoniot_of_a_sesame_table table_needs_one_file)
  set_property(TEST eos_command.${query} PROPERTY LABELS fast)
endforeach()

# The material library on the command line: what a word finds, a file with its sources and its validity.
add_test(NAME materials_command.search COMMAND whipple materials search STEINBERG tantalum)
set_tests_properties(materials_command.search PROPERTIES PASS_REGULAR_EXPRESSION "tantalum_mie_gruneisen  ")
add_test(NAME materials_command.search_without_result COMMAND whipple materials search unobtainium)
set_tests_properties(materials_command.search_without_result PROPERTIES PASS_REGULAR_EXPRESSION "error: no material of the library")
add_test(NAME materials_command.show COMMAND whipple materials show copper)
set_tests_properties(materials_command.show PROPERTIES
  PASS_REGULAR_EXPRESSION "source = .GRAY: Liu, Wang and Zhang.*hugoniot_intercept = .3.94 km/s.*valid +density .*verdict: sound")
foreach(query search search_without_result show)
  set_tests_properties(materials_command.${query} PROPERTIES LABELS fast)
endforeach()
