// Files of surfaces, written from meshes.
#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "tests/support/meshes.hpp"

namespace navjit::tests {

inline std::string little_endian(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
  return bytes;
}

inline std::string binary_stl(const Mesh& mesh) {
  std::string bytes(80, ' ');
  bytes += little_endian(static_cast<std::uint32_t>(mesh.size()));
  for (const FacetCorners& f : mesh) {
    bytes += std::string(12, '\0');
    for (const Vec3& p : f) {
      for (const double x : {p.x, p.y, p.z}) {
        bytes += little_endian(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
      }
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string words_of(const Vec3& p) {
  char text[96];
  std::snprintf(text, sizeof text, "%.17g %.17g %.17g", p.x, p.y, p.z);
  return text;
}

inline std::string ascii_stl(const Mesh& mesh) {
  std::string text = "solid of a test\n";
  for (const FacetCorners& f : mesh) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const Vec3& p : f) text += "   vertex " + words_of(p) + "\n";
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid of a test\n";
}

/// Writes each corner of each facet by itself; every second face counts back from the last one.
inline std::string obj(const Mesh& mesh) {
  std::string text = "# a test\no thing\n";
  std::size_t count = 0;
  for (const FacetCorners& f : mesh) {
    for (const Vec3& p : f) text += "v " + words_of(p) + "\n";
    text += "f";
    const bool back = count / 3 % 2 == 1;
    for (std::size_t i = 0; i < f.size(); ++i) {
      const auto number =
          back ? -static_cast<long>(f.size() - i) : static_cast<long>(count + i + 1);
      text += ' ' + std::to_string(number) + (back ? "//7" : "/1/2");
    }
    count += f.size();
    text += "\n";
  }
  return text;
}

}  // namespace navjit::tests
