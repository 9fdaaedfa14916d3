# Installs the build in BINARY into FOLDER, moves it, and imports the package from there: PACKAGES
# is its folder in the prefix, and PYTHON the interpreter.
include(${CMAKE_CURRENT_LIST_DIR}/../install/run.cmake)

file(REMOVE_RECURSE ${FOLDER})
foreach(component runtime python)
  run(unused ${CMAKE_COMMAND} --install ${BINARY} --prefix ${FOLDER}/first --component ${component})
endforeach()
file(RENAME ${FOLDER}/first ${FOLDER}/prefix)
set(package ${FOLDER}/prefix/${PACKAGES}/navjit)
foreach(file __init__.py results.py _core.pyi py.typed)
  if(NOT EXISTS ${package}/${file})
    message(FATAL_ERROR "${package}/${file} was not installed")
  endif()
endforeach()
run(unused ${CMAKE_COMMAND} -E env PYTHONPATH=${FOLDER}/prefix/${PACKAGES} ${PYTHON} -c "
import navjit
assert navjit.__file__.startswith('${FOLDER}/prefix/'), navjit.__file__
with open('/proc/self/maps') as maps:
    libraries = {line.split()[-1] for line in maps if 'libnavjit' in line}
assert libraries and all(l.startswith('${FOLDER}/prefix/') for l in libraries), libraries
runtime = navjit.Runtime(navjit.read_gdml('${DETECTOR}'))
assert runtime.scan([0, 0, 0], [0, 0, 1]).steps[0] > 0
")
