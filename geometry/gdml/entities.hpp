// Which entities of a document refer to which.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/gdml/expressions.hpp"

namespace navjit::gdml {

/// How deep the internal entities of a document refer to one another. It is kept up to date as they
/// are declared, since the parser may follow them right after.
struct EntityReferences {
  /// Declares an entity and its text; of several declarations of a name the first holds. False if
  /// some entity now begins a chain of more than `deepest`.
  bool declare(std::string_view name, std::string_view text, std::size_t deepest);
  bool is_declared(std::string_view name) const {
    const auto found = entities_.find(name);
    return found != entities_.end() && found->second.depth > 0;
  }

 private:
  struct Entity {
    std::size_t depth = 0;  ///< entities in the longest chain from here; 0 before it is declared
    std::vector<Entity*> users;  ///< the entities whose text refers to it
  };
  StringMap<Entity> entities_;
};

}  // namespace navjit::gdml
