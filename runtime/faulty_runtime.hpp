// A Runtime in which things go wrong on purpose. Only for tests.
#pragma once

#include <memory>

#include "navjit/runtime.hpp"
#include "runtime/faults.hpp"
#include "runtime/shared.hpp"

namespace navjit {

struct FaultyOptions : RuntimeOptions {
  std::shared_ptr<const Faults> faults{};  ///< null: none
};

class FaultyRuntime : public Runtime {
 public:
  FaultyRuntime(const Detector& detector, const FaultyOptions& options)
      : Runtime(detector,
                std::make_shared<detail::Shared>(detector.model(), options,
                                                 options.faults ? *options.faults : Faults{})) {}
};

}  // namespace navjit
