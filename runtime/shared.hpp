// What a Runtime, its navigators and its specialiser share. Private to runtime/.
#pragma once

#include <mutex>
#include <vector>

#include "runtime/navigator.hpp"
#include "runtime/options.hpp"

namespace navjit::detail {

struct Shared {
  Shared(std::shared_ptr<const World> world, RuntimeOptions runtime_options)
      : options(std::move(runtime_options)),
        geometry(std::move(world), options.geometry),
        table(geometry) {}

  RuntimeOptions options;
  Geometry geometry;
  NavigatorTable table;
  std::mutex profiles_mutex;
  /// Of all navigators there ever were: their counts stay part of the totals.
  std::vector<std::shared_ptr<Profile>> profiles;
};

}  // namespace navjit::detail
