# The documents and the programming interface as a site, in site/ of the build: target `site`.
# docs/site/make.py makes and checks it.
find_program(NAVJIT_DOXYGEN doxygen)
find_package(Python3 3.9 COMPONENTS Interpreter)
mark_as_advanced(NAVJIT_DOXYGEN)
if(NOT NAVJIT_DOXYGEN OR NOT Python3_Interpreter_FOUND)
  message(STATUS "Doxygen or Python not found: there is no target `site`")
  return()
endif()
set(make_site ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${Python3_EXECUTABLE}
              ${PROJECT_SOURCE_DIR}/docs/site/make.py ${PROJECT_SOURCE_DIR})
add_custom_target(site COMMAND ${make_site} ${PROJECT_BINARY_DIR}/site ${PROJECT_VERSION} ${NAVJIT_DOXYGEN}
                  COMMENT "Making the site" VERBATIM)
if(NAVJIT_TESTS)
  add_test(NAME docs/site COMMAND ${make_site} ${PROJECT_BINARY_DIR}/tests/site ${PROJECT_VERSION}
                                  ${NAVJIT_DOXYGEN})
endif()
