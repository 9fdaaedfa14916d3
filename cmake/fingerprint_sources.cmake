# Writes a C++ file with the SHA-256 of files: OUTPUT, FILES (list of paths). Names count, folders do
# not, so that two builds of the same sources agree wherever they are.
set(all "")
foreach(path IN LISTS FILES)
  get_filename_component(name ${path} NAME)
  file(SHA256 ${path} hash)
  string(APPEND all "${name} ${hash}\n")
endforeach()
string(SHA256 fingerprint "${all}")
file(WRITE ${OUTPUT} "// Generated from the sources that decide what generated code is.
#include \"runtime/plugin_text.hpp\"

namespace navjit {

const char* generator_fingerprint() { return \"${fingerprint}\"; }

}  // namespace navjit
")
