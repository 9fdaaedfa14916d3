// Writes the seeds as files into a folder: libFuzzer starts from files.
#include <cstdio>
#include <filesystem>
#include <fstream>

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
  }
  return 0;
}
