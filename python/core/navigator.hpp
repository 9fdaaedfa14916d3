// A Python Navigator.
#pragma once

#include <memory>
#include <utility>

#include "python/core/engine.hpp"

namespace navjit::python {

struct PythonNavigator {
  std::shared_ptr<Engine> engine;
  Navigator navigator;

  explicit PythonNavigator(std::shared_ptr<Engine> its)
      : engine(std::move(its)), navigator(engine->runtime().navigator()) {}
};

}  // namespace navjit::python
