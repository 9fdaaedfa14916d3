#include "apps/options/outputs.hpp"

#include <exception>

namespace navjit::apps {

void attempt_all(std::initializer_list<std::function<void()>> things) {
  std::exception_ptr failure;
  for (const auto& thing : things) {
    try {
      thing();
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace navjit::apps
