# Writes manual pages into FOLDER, of what the commands say with --help: for COMMAND, each of its
# subcommands, and PRODUCTION, whose subcommands are the same. HELP2MAN, INCLUDES (folder of more
# sections), VERSION.
function(man_page name command include)
  execute_process(COMMAND ${command} ${ARGN} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^\n]+" description "${help}")
  list(JOIN ARGN " " arguments)
  execute_process(
    COMMAND ${HELP2MAN} --no-info --include=${INCLUDES}/${include}.h2m "--name=${description}"
            "--version-string=${name} ${VERSION}" "--manual=navjit" --output=${FOLDER}/${name}.1
            "${command} ${arguments}"
    COMMAND_ERROR_IS_FATAL ANY)
  if(command STREQUAL PRODUCTION)
    return()
  endif()
  string(FIND "${help}" "\nSubcommands:\n" subcommands)
  if(subcommands EQUAL -1)
    return()
  endif()
  string(SUBSTRING "${help}" ${subcommands} -1 help)
  string(REGEX MATCHALL "\n  [a-z][a-z-]*" subcommands "${help}")
  foreach(subcommand IN LISTS subcommands)
    string(STRIP "${subcommand}" subcommand)
    man_page(${name}-${subcommand} ${command} ${include} ${ARGN} ${subcommand})
  endforeach()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
man_page(navjit ${COMMAND} manual)
man_page(navjit_production ${PRODUCTION} manual_production)
