#include "navjit/version.hpp"

namespace navjit {

const char* version() { return NAVJIT_VERSION; }

}  // namespace navjit
