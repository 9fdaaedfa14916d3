#include "geometry/gdml/entities.hpp"

#include <algorithm>

namespace navjit::gdml {

bool EntityReferences::declare(std::string_view name, std::string_view text, std::size_t deepest) {
  Entity& own = entities_[std::string(name)];
  if (own.depth > 0) return true;
  own.depth = 1;
  for (;;) {
    const auto begin = text.find('&');
    const auto end = text.find(';', begin);
    if (end == std::string_view::npos) break;
    const std::string_view wanted = text.substr(begin + 1, end - begin - 1);
    text.remove_prefix(end + 1);
    if (wanted.starts_with('#')) continue;
    Entity& other = entities_[std::string(wanted)];
    if (other.users.empty() || other.users.back() != &own) other.users.push_back(&own);
    own.depth = std::max(own.depth, other.depth + 1);
  }
  // Entities that refer to it may have become deeper. The parser refuses circles through it.
  std::vector<const Entity*> changed{&own};
  while (!changed.empty()) {
    const Entity& entity = *changed.back();
    changed.pop_back();
    if (entity.depth > deepest) return false;
    for (Entity* user : entity.users) {
      if (user == &own || user->depth == 0 || user->depth > entity.depth) continue;
      user->depth = entity.depth + 1;
      changed.push_back(user);
    }
  }
  return true;
}

}  // namespace navjit::gdml
