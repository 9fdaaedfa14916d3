# Tests of navjit::vecgeom, where it is built. VecGeom does not free what it reads, and these tests
# are not to find that; the thread sanitizer looks at this project's part.
if(TARGET navjit_vecgeom AND TARGET VecGeom::vgdml AND NOT NAVJIT_SANITIZE MATCHES "address|undefined")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*_test.cpp)
  navjit_test_executable(adapters_vecgeom_test adapters/vecgeom/ "${sources}" navjit_vecgeom
                         VecGeom::vgdml navjit_runtime)
  navjit_uses_vecgeom(adapters_vecgeom_test)
endif()
