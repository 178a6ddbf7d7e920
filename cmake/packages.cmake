# Manual page and completion of shells, written by the program itself when it is installed; packages (scripts/package.sh).
set(folder ${PROJECT_BINARY_DIR}/share)
install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} -DWHIPPLE=$<TARGET_FILE:whipple> -DFOLDER=${folder}
  -P ${PROJECT_SOURCE_DIR}/cmake/write_manual.cmake COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${folder}/whipple.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
foreach(started whipple-md whipple-fit)  # by whipple, whose page tells of them
  install(FILES ${folder}/${started}.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endforeach()
install(FILES ${folder}/whipple.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME whipple)
install(FILES ${folder}/_whipple DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${folder}/whipple.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
# Who made the packages, in the form "Name <address>": a name that others can write to where they are given away.
set(WHIPPLE_MAINTAINER "The whipple authors <whipple@localhost>" CACHE STRING "Maintainer that packages name")
string(TIMESTAMP packaged_at "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH, if that is set
foreach(package whipple libwhipple-dev python3-whipple)
  configure_file(packaging/changelog.in ${folder}/${package}/changelog @ONLY)
  execute_process(COMMAND gzip -9nkf ${folder}/${package}/changelog COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${folder}/${package}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${package})
  install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${package})
endforeach()

set(CPACK_PACKAGE_VENDOR "whipple")
set(CPACK_PACKAGE_CONTACT "${WHIPPLE_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # the first line of each description
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_STRIP_FILES ON)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/packaging/copyright)
set(CPACK_COMPONENTS_ALL whipple libwhipple-dev python3-whipple)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
if(whipple_processor)
  set(processors "The code is for processors with AVX2 (x86-64-v3);
kernels for AVX-512 are chosen at run time.")
else()
  set(processors "The code is for every processor of the architecture.")
endif()
set(CPACK_DEBIAN_WHIPPLE_DESCRIPTION "equations of state from atoms, and hypervelocity impact
Programs whipple, whipple-md and whipple-fit with materials,
experiments and cases.
${processors}")
set(CPACK_DEBIAN_WHIPPLE_PACKAGE_NAME whipple)
set(CPACK_DEBIAN_WHIPPLE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_WHIPPLE_PACKAGE_RECOMMENDS "openmpi-bin, lammps-data, python3-numpy, python3-h5py, python3-matplotlib")
set(CPACK_DEBIAN_WHIPPLE_PACKAGE_SUGGESTS "python3-whipple, paraview, gmsh")
set(CPACK_DEBIAN_LIBWHIPPLE-DEV_DESCRIPTION "libraries and headers of whipple
For programs that use its equations of state, cases, solver and
analysis: find_package(whipple).
${processors}")
set(CPACK_DEBIAN_LIBWHIPPLE-DEV_PACKAGE_NAME libwhipple-dev)
set(CPACK_DEBIAN_LIBWHIPPLE-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBWHIPPLE-DEV_PACKAGE_DEPENDS "libopenmpi-dev, libhdf5-openmpi-dev, zlib1g-dev, libp4est-dev, libeigen3-dev, \
libboost-dev, libspdlog-dev, libfmt-dev, libtomlplusplus-dev, libudunits2-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_PYTHON3-WHIPPLE_DESCRIPTION "equations of state, cases and runs of whipple for Python
${processors}")
set(CPACK_DEBIAN_PYTHON3-WHIPPLE_PACKAGE_NAME python3-whipple)
set(CPACK_DEBIAN_PYTHON3-WHIPPLE_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-WHIPPLE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON3-WHIPPLE_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, whipple (= ${PROJECT_VERSION})")
include(CPack)
