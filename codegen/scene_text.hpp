// The functions of one scene as C++ text.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "analysis/facts.hpp"
#include "codegen/shapes.hpp"

namespace navjit::codegen {

/// Volumes (each the first of its equals) whose relocation is in the same module and is called
/// directly.
struct Neighbours {
  std::set<VolumeId> enter;    ///< downward
  std::set<VolumeId> reenter;  ///< out of a daughter
};

/// Boxes in a block of the kernels "boxes" and "four_boxes".
constexpr std::size_t box_lanes = 8;
constexpr std::size_t lanes_of_four = 4;

/// A BoxBlock of `box(lane)`, rounded outwards; null: an empty lane.
std::string box_block(const std::function<const Extent*(std::size_t)>& box);

/// Writes what the plan says. All text is inside namespace navjit::kernels.
class SceneText {
 public:
  SceneText(const Geometry& geometry, const WorldFacts& facts, const ScenePlan& plan,
            const Neighbours& neighbours, Shapes& shapes);

  std::string enter_declaration() const;
  std::string reenter_declaration() const;
  /// Data of the daughters, frames, and the searches that the functions below use.
  std::string search() const;
  std::string enter() const;
  std::string reenter() const;
  std::string step(const std::string& symbol) const;
  std::string relocate(const std::string& symbol) const;
  /// Where the plan has one.
  std::string safety(const std::string& symbol) const;

 private:
  std::string frame() const;
  std::string margin_box(const Extent& extent) const;
  std::string shape_table(const DaughterClass& c, std::size_t number_of_class) const;
  std::string tables() const;
  std::string daughter_case(const DaughterClass& c, const char* call, const std::string& x,
                            const std::string& y, const std::string& z,
                            const std::string& rotation) const;
  std::string daughter_switch(const char* call) const;
  std::string daughter_tests() const;
  std::string search_all() const;
  std::string search_lanes() const;
  std::string search_slabs() const;
  std::string search_nest() const;
  std::string search_rings() const;
  std::string search_grid() const;
  std::string search_boxes() const;
  std::string search_neighbours() const;
  std::string push_translation() const;
  std::string push() const;
  std::string descend() const;
  std::string leave_to_mother(const char* blocked) const;
  bool leaf(VolumeId volume) const;

  const Geometry& geometry_;
  const WorldFacts& facts_;
  const ScenePlan& plan_;
  const Neighbours& neighbours_;
  Shapes& shapes_;
  const Scene& scene_;
  std::string ns_;  ///< namespace of the scene's functions
};

}  // namespace navjit::codegen
