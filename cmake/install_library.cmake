# The libraries for other programs: find_package(whipple), target whipple::whipple, headers <whipple/...>
# (docs/manual/library.md). The programs and what only they need are not part of it.
set(exported base input parallel hdf5 eos eos_curves eos_experiments eos_files particles grid material transfer device_material device fem
    contact afemp quasi_static io solids case solver run analysis view)
list(TRANSFORM exported PREPEND whipple_)
foreach(library IN LISTS exported)
  string(REPLACE whipple_ "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
endforeach()
add_library(whipple_all INTERFACE)
target_link_libraries(whipple_all INTERFACE ${exported})
set_target_properties(whipple_all PROPERTIES EXPORT_NAME whipple)
set_target_properties(whipple_consumer PROPERTIES EXPORT_NAME consumer)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/whipple)
install(TARGETS ${exported} whipple_all whipple_consumer EXPORT whipple COMPONENT libwhipple-dev)
install(EXPORT whipple NAMESPACE whipple:: FILE whippleTargets.cmake DESTINATION ${package} COMPONENT libwhipple-dev)
include(CMakePackageConfigHelpers)
configure_package_config_file(cmake/whippleConfig.cmake.in ${PROJECT_BINARY_DIR}/whippleConfig.cmake
  INSTALL_DESTINATION ${package} PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/whippleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/whippleConfig.cmake ${PROJECT_BINARY_DIR}/whippleConfigVersion.cmake
              cmake/dependencies.cmake DESTINATION ${package} COMPONENT libwhipple-dev)
install(CODE "set(source \"${PROJECT_SOURCE_DIR}\")\nset(headers \"${CMAKE_INSTALL_INCLUDEDIR}/whipple\")" COMPONENT libwhipple-dev)
install(SCRIPT cmake/install_headers.cmake COMPONENT libwhipple-dev)
