// Finds rows of places in a plane: the places of wires, seen along the wires.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace navjit {

struct PlaceAcross {
  std::uint32_t daughter;
  double x, y;  ///< mm
};

struct RowsAcross {
  std::array<double, 2> along{};                 ///< unit vector along the rows
  std::vector<std::vector<std::uint32_t>> rows;  ///< daughters; at least four in each
};

/// The parallel rows that offer a ray the fewest places, which are discs of this radius (mm);
/// nothing if there are none. Rows may run in any direction. Those along or across one of the
/// directions `likely` (vectors of any length) are tried first.
std::optional<RowsAcross> find_rows(std::span<const PlaceAcross> places,
                                    std::span<const std::array<double, 2>> likely, double radius);

}  // namespace navjit
