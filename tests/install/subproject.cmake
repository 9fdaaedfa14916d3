# Configures, in FOLDER, a project that has navjit, at SOURCE, as a part, by add_subdirectory and by
# FetchContent. The project itself checks its settings; here it is checked what would be built. It
# is not built, since that would be all of navjit once more.
file(REMOVE_RECURSE ${FOLDER})
foreach(fetch OFF ON)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR}/subproject -B ${FOLDER}
            -D NAVJIT_SOURCE=${SOURCE} -D NAVJIT_JIT=${JIT} -D BY_FETCH_CONTENT=${fetch}
            -D CMAKE_BUILD_TYPE=Release
    OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${output}")
  endif()
  file(STRINGS ${FOLDER}/build.ninja programs
       REGEX "^build .*: CXX_(EXECUTABLE|SHARED_LIBRARY|MODULE_LIBRARY)_LINKER")
  list(TRANSFORM programs REPLACE "^build ([^ :]*).*" "\\1")
  list(TRANSFORM programs REPLACE ".*/" "")
  list(SORT programs)
  file(STRINGS ${SOURCE}/CMakeLists.txt version REGEX "^project\\(")
  string(REGEX REPLACE ".*VERSION ([0-9.]+).*" "\\1" version "${version}")
  if(NOT "${programs}" STREQUAL "libnavjit.so.${version};libnavjit_production.so.${version};\
simulation_navjit;simulation_production")
    message(FATAL_ERROR "what would be built: ${programs}")
  endif()
  if(EXISTS ${FOLDER}/CTestTestfile.cmake)
    message(FATAL_ERROR "there would be tests")
  endif()
  file(STRINGS ${FOLDER}/build.ninja native REGEX "march=native|ccache")
  if(native)
    message(FATAL_ERROR "navjit's own habits: ${native}")
  endif()
endforeach()
