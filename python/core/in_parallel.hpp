// Elements of arrays, by one thread or several, without the interpreter's lock.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "python/core/engine.hpp"

namespace navjit::python {

/// Calls `chunk(navigator, begin, end, i)` for all of `count` elements in chunks of `size`, by the
/// calling thread and others, each with a navigator of its own; `i` is to be the element at hand.
/// What is thrown names it and ends the rest. The calling thread holds the interpreter's lock
/// before and after, and takes it now and then between to see whether the user interrupts.
template <class Chunk>
void in_parallel(Engine& engine, std::size_t count, std::size_t size, Chunk&& chunk) {
  const py::gil_scoped_release unlocked;
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr first;  // what the lowest element has thrown
  std::size_t first_element = 0;
  const auto fail = [&](std::size_t element, std::exception_ptr thrown) {
    const std::lock_guard lock(mutex);
    if (first && first_element <= element) return;
    first = std::move(thrown);
    first_element = element;
    next = count;
  };
  const auto work = [&](auto&& between) {
    std::size_t i = 0;
    try {
      Engine::Borrowed navigator(engine);
      for (;;) {
        const std::size_t begin = next.fetch_add(size);
        if (begin >= count) return;
        i = begin;
        chunk(*navigator, begin, std::min(begin + size, count), i);
        between();
      }
    } catch (const UsageError& error) {
      fail(i, std::make_exception_ptr(
                  UsageError("element " + std::to_string(i) + ": " + error.what())));
    } catch (...) {
      fail(i, std::current_exception());
    }
  };
  using Clock = std::chrono::steady_clock;
  Clock::time_point looked = Clock::now();
  {
    std::vector<std::jthread> others;
    const std::size_t chunks = (count + size - 1) / size;
    for (unsigned t = 1; t < engine.threads() && t < chunks; ++t) {
      others.emplace_back([&] { work([] {}); });
    }
    work([&] {
      if (Clock::now() - looked < std::chrono::milliseconds(100)) return;
      looked = Clock::now();
      const py::gil_scoped_acquire locked;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    });
  }
  if (!first) return;
  // A Python error needs the lock to be thrown again: it may be copied.
  const py::gil_scoped_acquire locked;
  std::rethrow_exception(first);
}

}  // namespace navjit::python
