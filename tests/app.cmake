# Tests of the command line and of the scripts.
whipple_test(process_test SOURCES unit/process_run.cpp DEPENDS whipple_process LABELS fast)
whipple_test(sweep_test SOURCES unit/sweep_test.cpp DEPENDS whipple_sweep LABELS fast)
whipple_test(shields_test SOURCES unit/shields_equations_test.cpp unit/shields_cases_test.cpp DEPENDS whipple_shields whipple_case GTest::gmock LABELS fast)
whipple_test(bench_test SOURCES unit/bench_reference_kernel_test.cpp DEPENDS whipple_bench LABELS fast)
whipple_test(app_command_line_test SOURCES unit/app_command_line.cpp DEPENDS GTest::gmock nlohmann_json::nlohmann_json LABELS fast)
whipple_test(app_planar_impact_test SOURCES unit/app_planar_impact_test.cpp unit/monitor_table_test.cpp DEPENDS whipple_app nlohmann_json::nlohmann_json LABELS fast)
whipple_test(editor_test SOURCES unit/editor_test.cpp DEPENDS whipple_editor GTest::gmock nlohmann_json::nlohmann_json LABELS fast)
whipple_test(step_test SOURCES unit/app_step_test.cpp ../src/app/step_mesher.cpp DEPENDS whipple_case whipple_process GTest::gmock LABELS fast)
whipple_test(foreign_files_test SOURCES fuzz/foreign_files.cpp DEPENDS whipple_app GTest::gmock LABELS fast)
whipple_test(decks_import_test SOURCES unit/decks_import_test.cpp unit/decks_dyna_test.cpp unit/decks_eos_card_test.cpp unit/decks_soil_test.cpp unit/decks_points_test.cpp DEPENDS whipple_decks whipple_case GTest::gmock LABELS fast)
add_dependencies(app_command_line_test whipple whipple-md whipple-fit)

# Which module may depend on which (docs/manual/architecture.md), and that the checker finds violations.
add_test(NAME layers COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/scripts/check_layers.py)
add_test(NAME wide_kernels COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/scripts/check_wide_kernels.py
  $<TARGET_FILE:whipple_transfer> $<TARGET_FILE:whipple_fem>)
add_test(NAME layers_self_test COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/scripts/check_layers.py --self-test)
# Links, widths and no diary in the documents, and that the checker finds violations.
add_test(NAME documents COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/scripts/check_documents.py)
add_test(NAME documents_self_test COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/scripts/check_documents.py --self-test)
set_tests_properties(layers layers_self_test wide_kernels documents documents_self_test PROPERTIES LABELS fast)

if(WHIPPLE_PYTHON)
  add_test(NAME studies COMMAND ${WHIPPLE_PYTHON} -m unittest discover -s studies/tests -t .
           WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(studies PROPERTIES LABELS fast TIMEOUT 120)
  # The site of the documents: formulas as TeX; all of it built, links followed, opened in a browser.
  add_test(NAME site_formulas COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/site_formulas.py ${PROJECT_SOURCE_DIR})
  set_tests_properties(site_formulas PROPERTIES LABELS fast TIMEOUT 120 SKIP_RETURN_CODE 77)
  add_test(NAME site_pages COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/site_pages.py ${PROJECT_SOURCE_DIR}
           ${CMAKE_CURRENT_BINARY_DIR}/site)
  set_tests_properties(site_pages PROPERTIES LABELS "browser;long" TIMEOUT 1800 COST 200 SKIP_RETURN_CODE 77)
  # What shells and man read, from the parser of the program.
  add_test(NAME app_completion COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_completion.py $<TARGET_FILE:whipple>
           ${CMAKE_CURRENT_BINARY_DIR}/app_completion)
  set_tests_properties(app_completion PROPERTIES LABELS fast TIMEOUT 120 SKIP_RETURN_CODE 77)
  add_test(NAME app_surroundings COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_surroundings.py
           ${PROJECT_BINARY_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml)
  set_tests_properties(app_surroundings PROPERTIES LABELS fast TIMEOUT 300)
  # Schemas of the inputs for editors, against every input of the repository.
  add_test(NAME app_json_schema COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_json_schema.py $<TARGET_FILE:whipple>
           ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml)
  set_tests_properties(app_json_schema PROPERTIES LABELS fast TIMEOUT 300)
  add_test(NAME app_export COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_export.py $<TARGET_FILE:whipple>
           ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml)
  set_tests_properties(app_export PROPERTIES LABELS fast TIMEOUT 300)
  add_test(NAME app_monitor COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_monitor.py $<TARGET_FILE:whipple>
           ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml ${CMAKE_CURRENT_BINARY_DIR}/app_monitor)
  add_test(NAME app_monitor_browser COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_monitor_browser.py
           $<TARGET_FILE:whipple> ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml ${CMAKE_CURRENT_BINARY_DIR}/app_monitor_browser)
  add_test(NAME app_edit_page COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_edit_page.py $<TARGET_FILE:whipple>
           ${CMAKE_CURRENT_SOURCE_DIR}/data/small_impact.toml ${CMAKE_CURRENT_BINARY_DIR}/app_edit_page)
  add_test(NAME app_edit_browser COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_edit_browser.py
           $<TARGET_FILE:whipple> ${CMAKE_CURRENT_BINARY_DIR}/app_edit_browser)
  add_test(NAME app_sweep COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_sweep.py $<TARGET_FILE:whipple>
           ${CMAKE_CURRENT_SOURCE_DIR}/data/thrown_block.toml ${CMAKE_CURRENT_BINARY_DIR}/app_sweep)
  add_test(NAME app_shield COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/app_shield.py $<TARGET_FILE:whipple>
           ${PROJECT_SOURCE_DIR}/cases/ryan_shields/shots.csv ${CMAKE_CURRENT_BINARY_DIR}/app_shield)
  set_tests_properties(app_shield PROPERTIES LABELS fast TIMEOUT 300)
  set_tests_properties(app_sweep PROPERTIES LABELS fast TIMEOUT 300 COST 30)
  set_tests_properties(app_monitor PROPERTIES LABELS fast TIMEOUT 300)
  set_tests_properties(app_edit_page PROPERTIES LABELS fast TIMEOUT 300)
  set_tests_properties(app_edit_browser PROPERTIES LABELS "browser;long" TIMEOUT 900 COST 80 SKIP_RETURN_CODE 77)
  set_tests_properties(app_monitor_browser PROPERTIES LABELS "browser;long" TIMEOUT 300 COST 80 SKIP_RETURN_CODE 77)
endif()

# The library as another program finds it; the libraries of a build with sanitizers need their flags.
if(WHIPPLE_PYTHON AND NOT WHIPPLE_SANITIZE)
  add_test(NAME installed_library COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/installed/library.py
           ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR}/examples/plate_impact ${CMAKE_CXX_COMPILER} ${CMAKE_C_COMPILER})
  set_tests_properties(installed_library PROPERTIES LABELS fast TIMEOUT 300 COST 20)
endif()

# Packages, and where it is asked for (docs/manual/testing.md) their installation into an empty Debian: minutes.
if(TARGET whipple_python_eos AND WHIPPLE_PYTHON AND NOT WHIPPLE_SANITIZE)
  add_test(NAME packages COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/installed/packages.py ${PROJECT_BINARY_DIR}
           ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/packages)
  add_test(NAME packages_installed COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/installed/packages.py ${PROJECT_BINARY_DIR}
           ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/packages --install)
  set_tests_properties(packages PROPERTIES LABELS long TIMEOUT 600 COST 100 FIXTURES_SETUP packages)
  set_tests_properties(packages_installed PROPERTIES LABELS long TIMEOUT 2400 COST 200 FIXTURES_REQUIRED packages SKIP_RETURN_CODE 77)
endif()

# Where it is asked for in the same way: the program for another processor, and by other compilers; up to an hour each.
if(WHIPPLE_PYTHON AND NOT WHIPPLE_SANITIZE AND NOT CMAKE_CROSSCOMPILING)
  foreach(other processor compilers)
    add_test(NAME other_${other} COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/installed/other_${other}.py
             $<TARGET_FILE:whipple> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/other_${other})
    set_tests_properties(other_${other} PROPERTIES LABELS long TIMEOUT 10800 PROCESSORS 2 SKIP_RETURN_CODE 77)
  endforeach()
endif()

# Coarse runs against stored numbers, half a minute of one core. Sanitizers would make it minutes.
if(WHIPPLE_PYTHON AND NOT WHIPPLE_SANITIZE)
  add_test(NAME drift COMMAND ${WHIPPLE_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/drift.py --threads 2
           --whipple $<TARGET_FILE:whipple> --work ${CMAKE_CURRENT_BINARY_DIR}/drift)
  set_tests_properties(drift PROPERTIES LABELS drift TIMEOUT 300 COST 20)
endif()

# How to cite: the title of CITATION.cff, and the sources of every table of a material.
file(STRINGS ${PROJECT_SOURCE_DIR}/CITATION.cff title REGEX "^title:")
string(REGEX REPLACE "^title: \"(.*)\"$" "\\1" title "${title}")
add_test(NAME app_cite COMMAND whipple cite copper)
set_tests_properties(app_cite PROPERTIES LABELS fast
  PASS_REGULAR_EXPRESSION "title = {${title}}.*copper.toml.* material +GRAY: Liu.* eos +Liu.* strength +Johnson.* failure +calibrated")

# Tutorials, as they stand: those without the Python module, and those that need it. The limit of what runs them is lower.
if(WHIPPLE_PYTHON AND NOT WHIPPLE_SANITIZE)
  set(tutorials first_impact shield import steering own_metal)
  if(TARGET whipple_python_eos)
    list(APPEND tutorials python_study)
  endif()
  foreach(tutorial IN LISTS tutorials)
    add_test(NAME tutorial_${tutorial} COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/tutorial.py
             ${PROJECT_SOURCE_DIR}/docs/tutorials/${tutorial}.md ${CMAKE_CURRENT_BINARY_DIR}/tutorials/${tutorial})
    set_tests_properties(tutorial_${tutorial} PROPERTIES LABELS fast TIMEOUT 300 ENVIRONMENT "${mpi_environment};\
PYTHONPATH=${PROJECT_BINARY_DIR}/python;WHIPPLE_PROGRAM=$<TARGET_FILE:whipple>"
      ENVIRONMENT_MODIFICATION "PATH=path_list_prepend:${PROJECT_BINARY_DIR}/bin")
  endforeach()
  # It builds a copy of the sources.
  add_test(NAME tutorial_own_law COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/tutorial.py
           ${PROJECT_SOURCE_DIR}/docs/tutorials/own_law.md ${CMAKE_CURRENT_BINARY_DIR}/tutorials/own_law --within 3000)
  set_tests_properties(tutorial_own_law PROPERTIES LABELS long TIMEOUT 3600 ENVIRONMENT "${mpi_environment};\
SOURCES=${PROJECT_SOURCE_DIR}")
  add_test(NAME tutorial_pages COMMAND ${WHIPPLE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/unit/tutorial_pages.py
           ${CMAKE_CURRENT_BINARY_DIR}/tutorial_pages)
  set_tests_properties(tutorial_pages PROPERTIES LABELS fast TIMEOUT 120)
  set_tests_properties(tutorial_own_metal PROPERTIES LABELS "long" COST 40)
endif()
