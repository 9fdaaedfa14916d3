# Writes a manual page for COMMAND and for each of its subcommands into FOLDER, of what they say with
# --help: HELP2MAN, INCLUDE (more sections), VERSION.
function(man_page name)
  execute_process(COMMAND ${COMMAND} ${ARGN} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^\n]+" description "${help}")
  list(JOIN ARGN " " arguments)
  execute_process(
    COMMAND ${HELP2MAN} --no-info --include=${INCLUDE} "--name=${description}"
            "--version-string=${name} ${VERSION}" "--manual=navjit" --output=${FOLDER}/${name}.1
            "${COMMAND} ${arguments}"
    COMMAND_ERROR_IS_FATAL ANY)
  string(FIND "${help}" "\nSubcommands:\n" subcommands)
  if(subcommands EQUAL -1)
    return()
  endif()
  string(SUBSTRING "${help}" ${subcommands} -1 help)
  string(REGEX MATCHALL "\n  [a-z][a-z-]*" subcommands "${help}")
  foreach(subcommand IN LISTS subcommands)
    string(STRIP "${subcommand}" subcommand)
    man_page(${name}-${subcommand} ${ARGN} ${subcommand})
  endforeach()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
man_page(navjit)
