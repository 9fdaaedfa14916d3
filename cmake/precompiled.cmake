# Headers that most files read, parsed once for all of them instead of once for each: 24 files, taken at
# random, compiled in 0.73 of the time. A compiler cache (ccache) does not keep what is compiled so, and is
# faster once it is filled: scripts/build chooses.
option(NAVJIT_PRECOMPILE "Parse common headers once; for builds without a filled compiler cache" OFF)

set(headers_of_library <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdio> <filesystem> <functional>
    <limits> <map> <memory> <numbers> <optional> <set> <span> <string> <string_view> <thread> <vector>)
set(headers_of_tests ${headers_of_library} <fstream> <gtest/gtest.h> <random> <sstream>)

# For use by navjit_precompiled(), `kind`: library or tests. Those that share one are compiled alike.
function(navjit_precompile kind)
  set(source ${PROJECT_BINARY_DIR}/precompiled/${kind}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Nothing: what counts is what is parsed before it.\n")
  add_library(navjit_precompiled_${kind} OBJECT ${source})
  target_precompile_headers(navjit_precompiled_${kind} PRIVATE ${headers_of_${kind}})
endfunction()

function(navjit_precompiled target kind)
  if(NAVJIT_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM navjit_precompiled_${kind})
  endif()
endfunction()

if(NAVJIT_PRECOMPILE)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms in std::string, which GCC does not take for a system header's once it is parsed.
    add_compile_options(-Wno-array-bounds -Wno-stringop-overflow)
  endif()
  navjit_precompile(library)
  set_target_properties(navjit_precompiled_library PROPERTIES POSITION_INDEPENDENT_CODE ON)
endif()
