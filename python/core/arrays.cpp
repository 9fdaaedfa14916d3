#include "python/core/arrays.hpp"

#include <navjit/errors.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace navjit::python {
namespace {

/// An array of doubles of what was given; throws UsageError where it is none.
Doubles doubles(const py::object& given, const char* name, const char* shape) {
  Doubles array = Doubles::ensure(given);
  if (!array) {
    PyErr_Clear();
    throw UsageError(std::string(name) + ": numbers are needed, of shape " + shape);
  }
  return array;
}

std::string shape_of(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += std::to_string(array.shape(i)) + (i + 1 < array.ndim() || i == 0 ? "," : "");
  }
  return text + ")";
}

[[noreturn]] void refuse_shape(const char* name, const char* wanted, const py::array& array) {
  throw UsageError(std::string(name) + ": the shape is " + shape_of(array) + ", and " + wanted +
                   " is needed");
}

}  // namespace

py::dtype state_dtype() {
  py::list names, formats, offsets;
  names.append("touchable");
  names.append("volume");
  formats.append("=u8");
  formats.append("=u4");
  offsets.append(0);
  offsets.append(8);
  return py::dtype(names, formats, offsets, sizeof(State));
}

Vectors vectors(const py::object& given, const char* name) {
  Vectors v;
  v.array = doubles(given, name, "(N, 3)");
  v.data = reinterpret_cast<const char*>(v.array.data());
  if (v.array.ndim() == 1 && v.array.shape(0) == 3) {
    v.column = v.array.strides(0);
  } else if (v.array.ndim() == 2 && v.array.shape(1) == 3) {
    v.row = v.array.strides(0);
    v.column = v.array.strides(1);
    v.count = static_cast<std::size_t>(v.array.shape(0));
  } else {
    refuse_shape(name, "(N, 3), or (3,) for one that stands for all,", v.array);
  }
  return v;
}

Numbers numbers(const py::object& given, const char* name) {
  Numbers n;
  n.array = doubles(given, name, "(N,)");
  n.data = reinterpret_cast<const char*>(n.array.data());
  if (n.array.ndim() == 1) {
    n.row = n.array.strides(0);
    n.count = static_cast<std::size_t>(n.array.shape(0));
  } else if (n.array.ndim() != 0) {
    refuse_shape(name, "(N,), or a number that stands for all,", n.array);
  }
  return n;
}

States states(const py::object& given) {
  static constexpr int layout = static_cast<int>(py::array::c_style) |
                                static_cast<int>(py::detail::npy_api::NPY_ARRAY_ALIGNED_);
  const auto& api = py::detail::npy_api::get();
  py::array array = py::array::ensure(given);
  if (!array) {
    PyErr_Clear();
    throw UsageError("states: an array of states is needed, as locate() gives it");
  }
  const py::dtype wanted = state_dtype();
  if (array.dtype().kind() != 'V') {
    // Two columns: touchable, volume.
    const bool integers = array.dtype().kind() == 'u' || array.dtype().kind() == 'i';
    if (!integers || array.ndim() != 2 || array.shape(1) != 2) {
      throw UsageError(
          "states: an array of states is needed, as locate() gives it, or integers of "
          "shape (N, 2): touchable, volume");
    }
    const auto columns = py::array_t<std::uint64_t, py::array::forcecast>::ensure(array);
    const auto count = static_cast<std::size_t>(columns.shape(0));
    py::array made = new_states(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t volume = columns.at(i, 1);
      // What is no number of a volume stays one that is none.
      data_of(made)[i] =
          State{columns.at(i, 0), volume < ~std::uint32_t{0} ? static_cast<std::uint32_t>(volume)
                                                             : ~std::uint32_t{0}};
    }
    return {made, data_of(made), count};
  }
  if (array.ndim() != 1) refuse_shape("states", "(N,)", array);
  // numpy casts what has the same fields in another layout, and refuses all else.
  auto* cast = api.PyArray_FromAny_(array.ptr(), wanted.inc_ref().ptr(), 1, 1, layout, nullptr);
  if (cast == nullptr) {
    PyErr_Clear();
    throw UsageError("states: the fields are not those of navjit.state_dtype");
  }
  array = py::reinterpret_steal<py::array>(cast);
  return {array, static_cast<const State*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

std::size_t common_length(std::initializer_list<std::optional<std::size_t>> counts) {
  std::optional<std::size_t> length;
  for (const auto& count : counts) {
    if (!count) continue;
    if (length && *length != *count) {
      throw UsageError("arrays of " + std::to_string(*length) + " and of " +
                       std::to_string(*count) + " elements do not go together");
    }
    length = count;
  }
  return length.value_or(1);
}

State state_of(const py::object& given) {
  if (py::isinstance<State>(given)) return given.cast<State>();
  if (py::hasattr(given, "dtype") && py::hasattr(given, "item")) {
    try {
      const auto touchable = given.attr("__getitem__")("touchable").cast<TouchableId>();
      return {touchable, given.attr("__getitem__")("volume").cast<VolumeId>()};
    } catch (const std::exception&) {  // of another type
    }
  }
  throw UsageError("a navjit.State is needed, or an element of an array of states");
}

Vec3 vector_of(const py::object& given, const char* name) {
  const Doubles array = doubles(given, name, "(3,)");
  if (array.ndim() != 1 || array.shape(0) != 3) refuse_shape(name, "(3,)", array);
  return {array.at(0), array.at(1), array.at(2)};
}

py::array new_states(std::size_t count) {
  return py::array(state_dtype(), std::vector<py::ssize_t>{static_cast<py::ssize_t>(count)});
}

}  // namespace navjit::python
