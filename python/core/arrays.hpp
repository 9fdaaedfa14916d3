// Arrays of numpy as navigation reads and writes them: in place where their type allows it.
#pragma once

#include <pybind11/numpy.h>
#include <navjit/state.hpp>
#include <navjit/vector.hpp>

#include <cstddef>
#include <cstring>
#include <optional>
#include <type_traits>

#include "python/core/bind.hpp"

namespace navjit::python {

static_assert(sizeof(State) == 16 && std::is_standard_layout_v<State> &&
              std::is_trivially_copyable_v<State>);

/// The numpy type whose elements are States: fields touchable (uint64) and volume (uint32).
py::dtype state_dtype();

/// Doubles of any stride, read where they are if they are doubles and aligned, and else a copy.
using Doubles = py::array_t<double, static_cast<int>(py::array::forcecast) |
                                        static_cast<int>(py::detail::npy_api::NPY_ARRAY_ALIGNED_)>;

/// N points or directions, or one that stands for all. Keeps the array.
struct Vectors {
  Doubles array;
  const char* data = nullptr;
  py::ssize_t row = 0, column = 0;   ///< bytes from one to the next; a row of 0: one for all
  std::optional<std::size_t> count;  ///< nothing: one for all

  Vec3 operator[](std::size_t i) const {
    const char* at = data + static_cast<py::ssize_t>(i) * row;
    return {number(at), number(at + column), number(at + 2 * column)};
  }

 private:
  static double number(const char* at) { return *reinterpret_cast<const double*>(at); }
};
/// Of shape (N, 3) or (3,). Throws UsageError, with the name.
Vectors vectors(const py::object& given, const char* name);

/// N numbers, or one that stands for all.
struct Numbers {
  Doubles array;
  const char* data = nullptr;
  py::ssize_t row = 0;
  std::optional<std::size_t> count;

  double operator[](std::size_t i) const {
    return *reinterpret_cast<const double*>(data + static_cast<py::ssize_t>(i) * row);
  }
};
/// Of shape (N,) or a number. Throws UsageError, with the name.
Numbers numbers(const py::object& given, const char* name);

/// N states. Read where they are if they are of state_dtype() and contiguous; two columns of
/// integers are copied.
struct States {
  py::array array;
  const State* data = nullptr;
  std::size_t count = 0;
};
States states(const py::object& given);

/// The common length of what goes together; throws UsageError where lengths differ. `counts`: of
/// those that have one.
std::size_t common_length(std::initializer_list<std::optional<std::size_t>> counts);

/// A State, or an element of an array of states.
State state_of(const py::object& given);
/// Three numbers.
Vec3 vector_of(const py::object& given, const char* name);

/// A new array of states; all are to be written.
py::array new_states(std::size_t count);
inline State* data_of(py::array& states) { return static_cast<State*>(states.mutable_data()); }

}  // namespace navjit::python
