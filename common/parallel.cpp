#include "common/parallel.hpp"

#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "navjit/errors.hpp"

namespace navjit::common {

void in_parallel(unsigned threads, std::atomic<bool>& stop, const std::function<void()>& work) {
  std::mutex failing;
  std::exception_ptr failure;
  const auto fail = [&](std::exception_ptr what) {
    const std::lock_guard lock(failing);
    if (!failure) failure = std::move(what);
    stop = true;
  };
  const auto guarded = [&]() noexcept {
    try {
      work();
    } catch (...) {
      fail(std::current_exception());
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      others.reserve(threads);
      while (others.size() + 1 < threads) others.emplace_back(guarded);
    } catch (const std::system_error& error) {
      fail(std::make_exception_ptr(Error("only " + std::to_string(others.size() + 1) + " of " +
                                         std::to_string(threads) + " threads could be started (" +
                                         error.code().message() + "); try fewer --threads")));
    } catch (...) {
      fail(std::current_exception());
    }
    if (!stop) guarded();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace navjit::common
