# Configures SOURCE without the JIT into BINARY, with LLVM hidden, and checks that nothing of LLVM
# is there.
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} -G Ninja -D CMAKE_BUILD_TYPE=Release
          -D NAVJIT_JIT=OFF -D NAVJIT_BENCH=OFF -D CMAKE_DISABLE_FIND_PACKAGE_LLVM=ON
          -D CMAKE_IGNORE_PREFIX_PATH=/usr/lib/llvm-19
  OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${output}")
endif()
file(STRINGS ${BINARY}/build.ninja found REGEX "libLLVM|libclang|llvm-19")
if(found)
  message(FATAL_ERROR "the build without a compiler mentions one: ${found}")
endif()
file(STRINGS ${BINARY}/build.ninja program REGEX "build bin/navjit:")
if(NOT program)
  message(FATAL_ERROR "no navjit would be built")
endif()
