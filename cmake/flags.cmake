# What every target is compiled with. Contraction is off for a reason: answers have to be the same
# bits as those of generated code (docs/numerics.md).
# A project that navjit is a part of may compile with -ffast-math: the later option counts.
add_compile_options(-fno-fast-math -ffp-contract=off -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict)  # false alarms in std::string, GCC bug 105329
endif()
if(NAVJIT_NATIVE)
  add_compile_options(-march=native)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Wide vectors are passed differently without AVX; here between functions of one file alone.
  add_compile_options(-Wno-psabi)
endif()
# Packing neighbouring numbers into vectors made the navigator slower (docs/experiments.md).
add_compile_options(-fno-tree-slp-vectorize)
if(NAVJIT_SANITIZE)
  # At -O3 GCC 12's address sanitizer sees uses after scope where temporaries were merged.
  add_compile_options(-fsanitize=${NAVJIT_SANITIZE} -fno-omit-frame-pointer -g1 -O1)
  add_link_options(-fsanitize=${NAVJIT_SANITIZE})
  if(NAVJIT_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
endif()

if(NAVJIT_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link,address -fno-omit-frame-pointer -g1 -O1)
  add_link_options(-fsanitize=address)
endif()

# For what takes longer to compile than to run.
set(little_optimised $<$<CONFIG:Release>:-O1>)

# A library of all sources of this folder, with the project's root as include directory. Sources below
# the folders that follow the name are left out.
function(navjit_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(folder IN LISTS ARGN)
    list(FILTER sources EXCLUDE REGEX "^${folder}")
  endforeach()
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include
                                            ${PROJECT_BINARY_DIR}/include)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  navjit_precompiled(${name} library)
endfunction()
