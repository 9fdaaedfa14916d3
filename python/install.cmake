# Where the package goes below the prefix. An interpreter of Debian's has folders of its own below
# /usr and /usr/local.
execute_process(
  COMMAND ${Python_EXECUTABLE} -c
          "import sysconfig; print('deb_system' in sysconfig.get_scheme_names())"
  OUTPUT_VARIABLE of_debian OUTPUT_STRIP_TRAILING_WHITESPACE)
set(folder lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/site-packages)
if(of_debian STREQUAL True AND CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(folder lib/python3/dist-packages)
elseif(of_debian STREQUAL True AND CMAKE_INSTALL_PREFIX STREQUAL "/usr/local")
  set(folder lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/dist-packages)
endif()
set(NAVJIT_PYTHON_INSTALL_DIR ${folder} CACHE STRING "Where packages of Python are, below the prefix")
mark_as_advanced(NAVJIT_PYTHON_INSTALL_DIR)

set(destination ${NAVJIT_PYTHON_INSTALL_DIR}/navjit)
# Relative to the package: what is installed can be moved as a whole. In a wheel the library is in the
# package itself.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR
           BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}/${destination} OUTPUT_VARIABLE to_library)
set_target_properties(navjit_python PROPERTIES INSTALL_RPATH "$ORIGIN;$ORIGIN/${to_library}")
install(TARGETS navjit_python LIBRARY DESTINATION ${destination} COMPONENT python)
install(FILES ${files} DESTINATION ${destination} COMPONENT python)
# For pip (setup.py), below the folder of a wheel's packages.
install(TARGETS navjit_python libnavjit LIBRARY DESTINATION navjit COMPONENT wheel EXCLUDE_FROM_ALL
        NAMELINK_SKIP)
install(FILES ${files} DESTINATION navjit COMPONENT wheel EXCLUDE_FROM_ALL)
set(NAVJIT_PYTHON_MINOR ${Python_VERSION_MINOR} PARENT_SCOPE)  # for Debian's packages
