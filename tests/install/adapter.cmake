# Installs the build in BINARY with the adapter NAME, moves it, and lets the program in outside_NAME
# use it by find_package. All of this is in FOLDER; ENGINE is the folder of the engine's package.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${FOLDER})
foreach(component runtime development ${NAME})
  run(unused ${CMAKE_COMMAND} --install ${BINARY} --prefix ${FOLDER}/first --component ${component})
endforeach()
file(RENAME ${FOLDER}/first ${FOLDER}/prefix)
set(configure ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/outside_${NAME}
    -D CMAKE_PREFIX_PATH=${FOLDER}/prefix -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_CXX_COMPILER=${COMPILER})
run(unused ${configure} -B ${FOLDER}/outside -D ${ENGINE_NAME}_DIR=${ENGINE})
run(unused ${CMAKE_COMMAND} --build ${FOLDER}/outside)
run(unused ${FOLDER}/outside/program)

# Without the engine, and for a component that does not exist, find_package says why it fails.
function(expect_failure pattern)
  execute_process(COMMAND ${ARGN} OUTPUT_QUIET ERROR_VARIABLE text RESULT_VARIABLE result)
  string(REGEX REPLACE "[ \n]+" " " text "${text}")
  if(result EQUAL 0 OR NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "not '${pattern}', but: ${text}")
  endif()
endfunction()
expect_failure("component ${NAME}: ${ENGINE_NAME} [0-9.]+ was not found" ${configure}
               -B ${FOLDER}/without -D CMAKE_DISABLE_FIND_PACKAGE_${ENGINE_NAME}=ON)
file(WRITE ${FOLDER}/other/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(other LANGUAGES CXX)
find_package(navjit 0.1 REQUIRED COMPONENTS other)\n")
expect_failure("component other: there is no such component" ${CMAKE_COMMAND} -S ${FOLDER}/other
               -B ${FOLDER}/other/build -D CMAKE_PREFIX_PATH=${FOLDER}/prefix
               -D CMAKE_CXX_COMPILER=${COMPILER})
