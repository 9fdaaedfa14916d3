// libFuzzer's target: any bytes as a ROOT file. See scripts/fuzz.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

#include "navjit/root.hpp"
#include "tests/fuzz/use_detector.hpp"

namespace {

/// Limits so low that whatever keeps to them is read in a fraction of a second.
navjit::RootOptions tight_options() {
  return {.limits = {.max_bytes = 1 << 20,
                     .max_keys = 100,
                     .max_placements = 2'000,
                     .max_name_bytes = 200'000,
                     .max_solid_depth = 50,
                     .max_solid_chain = 100,
                     .max_solid_parts = 200,
                     .max_facets = 2'000}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A file in memory: the reader opens it by name.
  static const int file = memfd_create("input.root", 0);
  if (ftruncate(file, 0) != 0) return -1;
  if (pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) return -1;
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  navjit::fuzz::use_world([&] { return navjit::read_root(path, tight_options()).model(); });
  return 0;
}
