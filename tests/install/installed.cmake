# Installs the build in BINARY, moves it, and lets a program outside use it by find_package and by
# pkg-config. All of this is in FOLDER.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

function(expect text pattern)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "not '${pattern}', but: ${text}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
foreach(component runtime development)
  run(unused ${CMAKE_COMMAND} --install ${BINARY} --prefix ${FOLDER}/first --component ${component})
endforeach()
file(RENAME ${FOLDER}/first ${FOLDER}/prefix)

foreach(file bin/navjit bin/navjit_production share/navjit/detectors/shashlik.gdml
             share/man/man1/navjit-run.1 share/man/man1/navjit_production.1
             share/doc/navjit/changelog share/bash-completion/completions/navjit)
  if(NOT EXISTS ${FOLDER}/prefix/${file})
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()

# The installed headers include only navjit's own headers and those of the standard library.
file(GLOB_RECURSE headers ${FOLDER}/prefix/include/*)
foreach(header IN LISTS headers)
  file(STRINGS ${header} includes REGEX "^#include [<\"].*[/.]")
  foreach(include IN LISTS includes)
    expect("${include}" "^#include \"navjit/")
  endforeach()
endforeach()

# The shared libraries export nothing of the libraries that they contain.
foreach(library navjit navjit_production)
  file(GLOB_RECURSE path ${FOLDER}/prefix/lib*/lib${library}.so)
  run(symbols nm -DC --defined-only --format=just-symbols ${path})
  string(REGEX REPLACE "(^|\n)((typeinfo |typeinfo name |vtable )for )?navjit::[^\n]*" "" others
                       "${symbols}")
  expect("x${others}" "^x[\n]*$")
endforeach()

run(unused ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/outside -B ${FOLDER}/outside
    -D CMAKE_PREFIX_PATH=${FOLDER}/prefix -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_CXX_COMPILER=g++)
run(unused ${CMAKE_COMMAND} --build ${FOLDER}/outside)
run(text ${FOLDER}/outside/simulation_navjit)
expect("${text}" "equal to the last bit; [1-9].* [1-9][0-9]* of them compiled")
run(text ${FOLDER}/outside/simulation_production)
expect("${text}" "equal to the last bit; [1-9].* 0 of them compiled")
run(libraries ldd ${FOLDER}/outside/simulation_production)
if(libraries MATCHES "LLVM|clang")
  message(FATAL_ERROR "production has a compiler in it:\n${libraries}")
endif()

# Tests pkg-config, for both libraries.
file(GLOB_RECURSE pc ${FOLDER}/prefix/*/navjit.pc)
cmake_path(GET pc PARENT_PATH pc_folder)
cmake_path(GET pc_folder PARENT_PATH lib)
foreach(library navjit navjit_production)
  run(flags ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pc_folder}
      pkg-config --cflags --libs ${library})
  separate_arguments(flags UNIX_COMMAND "${flags}")
  file(WRITE ${FOLDER}/version.cpp "#include <navjit/navjit.hpp>
int main() { return navjit::version() == std::string(NAVJIT_VERSION) ? 0 : 1; }\n")
  run(unused g++ ${FOLDER}/version.cpp -o ${FOLDER}/version_${library} ${flags})
  run(unused ${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${lib} ${FOLDER}/version_${library})
endforeach()
