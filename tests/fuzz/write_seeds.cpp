// Writes the seeds as files into a folder: libFuzzer starts from files.
#include <zlib.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/root_seeds.hpp"
#include "tests/fuzz/seeds.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_seeds FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const navjit::fuzz::Seed& seed : navjit::fuzz::seeds()) {
    std::ofstream(folder / (seed.name + ".gdml")) << seed.text;
    if (seed.name != "box") continue;
    const gzFile packed = gzopen((folder / (seed.name + ".gdml.gz")).c_str(), "wb");
    gzwrite(packed, seed.text.data(), static_cast<unsigned>(seed.text.size()));
    gzclose(packed);
  }
  navjit::fuzz::write_root_seeds(folder.string() + "_root");
  return 0;
}
