# Writes a C++ file with the SHA-256 of files: OUTPUT, ROOT (a folder), FILES (list of paths below it).
# The paths from ROOT count and what is above it does not, so that two builds of the same sources
# agree wherever they are. The files are listed in a comment, so that one can see what counted.
set(all "")
set(comment "")
foreach(path IN LISTS FILES)
  file(RELATIVE_PATH name ${ROOT} ${path})
  file(SHA256 ${path} hash)
  string(APPEND all "${name} ${hash}\n")
  string(APPEND comment "//   ${name}\n")
endforeach()
string(SHA256 fingerprint "${all}")
file(WRITE ${OUTPUT} "// Generated from the sources that decide what generated code is:
${comment}
#include \"runtime/plugin_text.hpp\"

namespace navjit {

const char* generator_fingerprint() { return \"${fingerprint}\"; }

}  // namespace navjit
")
