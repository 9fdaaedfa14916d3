# Packages travel: they have to be of a build for any machine, below /usr.
if(CPACK_NAVJIT_NATIVE OR NOT CPACK_NAVJIT_PREFIX STREQUAL "/usr")
  message(FATAL_ERROR "packages are made of the preset `package`: cmake --preset package")
endif()
