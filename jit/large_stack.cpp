#include "jit/detail/large_stack.hpp"

#include <pthread.h>

#include <system_error>

namespace navjit::jit::detail {
namespace {

void* run(void* work) {
  (*static_cast<const std::function<void()>*>(work))();
  return nullptr;
}

}  // namespace

std::optional<Failure> run_on_large_stack(std::size_t bytes, const std::function<void()>& work) {
  pthread_attr_t attributes;
  int error = pthread_attr_init(&attributes);
  if (error == 0) {
    error = pthread_attr_setstacksize(&attributes, bytes);
    pthread_t thread{};
    if (error == 0) {
      error = pthread_create(&thread, &attributes, run, const_cast<std::function<void()>*>(&work));
    }
    pthread_attr_destroy(&attributes);
    if (error == 0) error = pthread_join(thread, nullptr);
  }
  if (error == 0) return std::nullopt;
  return Failure{"no thread to compile on: " + std::generic_category().message(error),
                 /*exhausted=*/true};
}

}  // namespace navjit::jit::detail
