# The adapters that were built, each a component to install and one of find_package(navjit): it
# finds the engine, which navjit itself does without.
function(navjit_install_adapter name)
  install(TARGETS ${ARGN} EXPORT navjit-${name}-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/adapters/${name}/include/navjit
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${name})
  install(EXPORT navjit-${name}-targets NAMESPACE navjit:: DESTINATION ${package_folder}
          COMPONENT ${name})
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/navjit-${name}.cmake DESTINATION ${package_folder}
          COMPONENT ${name})
endfunction()
if(TARGET navjit_geant4)
  navjit_install_adapter(geant4 navjit_geant4)
endif()
if(TARGET navjit_vecgeom)
  navjit_install_adapter(vecgeom navjit_vecgeom navjit_vecgeom_user)
endif()
