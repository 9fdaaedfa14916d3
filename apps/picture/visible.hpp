// Which volumes a picture shows, and where they are.
#pragma once

#include <string>
#include <vector>

#include "apps/picture/cuts.hpp"
#include "geometry/model/world.hpp"
#include "navjit/runtime.hpp"

namespace navjit::picture {

/// Names of volumes or materials, in which * and ? stand for any characters.
struct ShowOptions {
  std::vector<std::string> hide{};  ///< passed
  std::vector<std::string> show{};  ///< seen, although a gas
  std::vector<std::string> only{};  ///< volumes: nothing but them, and what is in them
};

/// By number of the volume.
struct Visible {
  std::vector<bool> opaque;   ///< rays end on it
  std::vector<bool> counted;  ///< it is there at all: neither hidden nor left out
};

/// Gases, vacuum and the world volume itself are passed, unless the options say otherwise. Throws
/// Error for a name that is neither a volume's nor a material's.
Visible visible_of(const World& world, const ShowOptions& options);

/// A gas, by its state or by its density (g/cm3), or nothing at all.
bool is_transparent(const Material& material);

/// The box around what rays along the axes see first, mm; made of coarse rays, so that what is very
/// thin may reach out of it. The world's if they see nothing.
Extent seen_box(Runtime& runtime, const Visible& visible, const std::vector<Cut>& cuts);

}  // namespace navjit::picture
