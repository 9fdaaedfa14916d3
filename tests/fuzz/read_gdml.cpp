// libFuzzer's target: any bytes as a GDML file. See scripts/fuzz.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/use_detector.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  navjit::fuzz::Engine random(seed);
  if (random() % 4 == 0) return LLVMFuzzerMutate(data, size, most);
  std::string text(reinterpret_cast<const char*>(data), size);
  for (auto changes = 1 + random() % 4; changes > 0; --changes) {
    navjit::fuzz::mutate_once(text, random);
  }
  const std::size_t length = std::min(text.size(), most);
  std::copy_n(text.data(), length, data);
  return length;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A file in memory: the reader opens it by name.
  static const int file = memfd_create("input.gdml", 0);
  if (ftruncate(file, 0) != 0) return -1;
  if (pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) return -1;
  navjit::fuzz::use_detector("/proc/self/fd/" + std::to_string(file));
  return 0;
}
