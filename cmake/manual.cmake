# The command's manual pages, of what it says itself, and its completion, which asks it.
find_program(NAVJIT_HELP2MAN help2man)
mark_as_advanced(NAVJIT_HELP2MAN)
if(NAVJIT_HELP2MAN)
  set(man_pages ${PROJECT_BINARY_DIR}/man)
  add_custom_command(
    OUTPUT ${man_pages}/navjit.1
    COMMAND ${CMAKE_COMMAND} -D COMMAND=$<TARGET_FILE:navjit>
            -D PRODUCTION=$<TARGET_FILE:navjit_production> -D HELP2MAN=${NAVJIT_HELP2MAN}
            -D VERSION=${PROJECT_VERSION} -D FOLDER=${man_pages}
            -D INCLUDES=${PROJECT_SOURCE_DIR}/apps/shell
            -P ${PROJECT_SOURCE_DIR}/cmake/man_pages.cmake
    DEPENDS navjit navjit_production ${PROJECT_SOURCE_DIR}/cmake/man_pages.cmake
            ${PROJECT_SOURCE_DIR}/apps/shell/manual.h2m
            ${PROJECT_SOURCE_DIR}/apps/shell/manual_production.h2m
    COMMENT "Writing manual pages"
    VERBATIM)
  add_custom_target(navjit_man_pages ALL DEPENDS ${man_pages}/navjit.1)
  if(NAVJIT_INSTALL)
    install(DIRECTORY ${man_pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime)
  endif()
else()
  message(STATUS "help2man not found: no manual pages")
endif()
if(NAVJIT_INSTALL)
  install(FILES ${PROJECT_SOURCE_DIR}/apps/shell/navjit.bash RENAME navjit
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT runtime)
  install(FILES ${PROJECT_SOURCE_DIR}/apps/shell/navjit.bash RENAME navjit_production
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT runtime)
endif()
