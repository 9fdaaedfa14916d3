# What is installed, in two components: `runtime` and `development`; docs/install.md.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/navjit)
install(TARGETS libnavjit libnavjit_production EXPORT navjit-targets
        LIBRARY COMPONENT runtime NAMELINK_COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/navjit ${PROJECT_BINARY_DIR}/include/navjit
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(EXPORT navjit-targets NAMESPACE navjit:: DESTINATION ${package_folder}
        COMPONENT development)
configure_file(cmake/navjit-config.cmake.in ${PROJECT_BINARY_DIR}/cmake/navjit-config.cmake @ONLY)
# Until 1.0 each minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/navjit-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cmake/navjit-config.cmake
              ${PROJECT_BINARY_DIR}/cmake/navjit-config-version.cmake
        DESTINATION ${package_folder} COMPONENT development)

include(cmake/install_adapters.cmake)

# pkg-config's files name the prefix relative to themselves: what is installed can be moved.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX
           BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE to_prefix)
string(REGEX REPLACE "/$" "" prefix "\${pcfiledir}/${to_prefix}")
function(navjit_pkg_config name description)
  set(file ${PROJECT_BINARY_DIR}/cmake/${name}.pc)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/navjit.pc.in ${file} @ONLY)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()
navjit_pkg_config(navjit "${PROJECT_DESCRIPTION}")
navjit_pkg_config(navjit_production "${PROJECT_DESCRIPTION}; no compiler in it")

if(NAVJIT_COMMAND)
  install(TARGETS navjit navjit_production COMPONENT runtime)
  set_target_properties(navjit navjit_production PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
  file(GLOB detectors CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/detectors/*.gdml)
  install(FILES ${detectors} DESTINATION ${CMAKE_INSTALL_DATADIR}/navjit/detectors
          COMPONENT runtime)
endif()
if(NAVJIT_NATIVE)
  install(CODE "message(NOTICE \"navjit is compiled for this machine's processor: for others, \
configure with -D NAVJIT_NATIVE=OFF\")" ALL_COMPONENTS)
endif()
# Each package of Debian's has these.
function(navjit_install_documents package component)
  install(FILES cmake/copyright cmake/changelog
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endfunction()
navjit_install_documents(navjit runtime)
navjit_install_documents(navjit-dev development)
if(TARGET navjit_python)
  navjit_install_documents(python3-navjit python)
endif()
