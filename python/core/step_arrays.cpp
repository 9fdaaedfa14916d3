#include "python/core/step_arrays.hpp"

#include <initializer_list>
#include <limits>
#include <utility>

#include "python/core/arrays.hpp"
#include "python/core/in_parallel.hpp"

namespace navjit::python {
namespace {

constexpr std::size_t chunk_of_points = 2048;

/// One of the named tuples of navjit.results.
py::object result(const char* name) { return py::module_::import("navjit.results").attr(name); }

/// What the caller gave to be written to, or a new one.
template <class T>
py::array_t<T> output(const py::object& given, std::size_t count, const char* name) {
  if (given.is_none()) return py::array_t<T>(static_cast<py::ssize_t>(count));
  if (!py::isinstance<py::array_t<T, py::array::c_style>>(given)) {
    throw UsageError(std::string("out.") + name + ": a contiguous array of type " +
                     py::str(py::dtype::of<T>()).cast<std::string>() + " is needed");
  }
  auto array = given.cast<py::array_t<T>>();
  if (array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != count ||
      !array.writeable()) {
    throw UsageError(std::string("out.") + name + ": " + std::to_string(count) +
                     " elements that may be written are needed");
  }
  return array;
}

py::array states_output(const py::object& given, std::size_t count) {
  if (given.is_none()) return new_states(count);
  const auto array = given.cast<py::array>();
  if (!array.dtype().equal(state_dtype()) || array.ndim() != 1 ||
      static_cast<std::size_t>(array.shape(0)) != count || !array.writeable() ||
      array.strides(0) != sizeof(State)) {
    throw UsageError("out.next: " + std::to_string(count) +
                     " contiguous states that may be written are needed");
  }
  return array;
}

/// What is written while other elements are still to be read must not be what is read. The same
/// states from the same element on are no harm: each is read before it is written.
void refuse_shared(const py::object& written, const char* name, const py::object& states,
                   std::initializer_list<std::pair<const char*, py::object>> read) {
  const py::module_ numpy = py::module_::import("numpy");
  const auto share = [&](const py::object& other) {
    return py::isinstance<py::array>(other) &&
           numpy.attr("may_share_memory")(written, other).cast<bool>();
  };
  const auto refuse = [&](const char* other) {
    throw UsageError(std::string("out.") + name + ": it shares memory with " + other +
                     ", which is still to be read; give it memory of its own");
  };
  for (const auto& [other, array] : read) {
    if (share(array)) refuse(other);
  }
  if (!share(states)) return;
  const auto first = [](const py::object& array) { return array.cast<py::array>().data(); };
  if (std::string(name) != "next" || first(written) != first(states)) refuse("states");
}

}  // namespace

py::object locate(Engine& engine, const py::object& given_points,
                  const py::object& given_directions) {
  const Vectors points = vectors(given_points, "points");
  Vectors directions;
  const bool directed = !given_directions.is_none();
  if (directed) directions = vectors(given_directions, "directions");
  const std::size_t count = common_length({points.count, directions.count});
  py::array made = new_states(count);
  State* const out = data_of(made);
  in_parallel(engine, count, chunk_of_points,
              [&](Navigator& navigator, std::size_t begin, std::size_t end, std::size_t& i) {
                for (i = begin; i < end; ++i) {
                  out[i] = directed ? navigator.locate(points[i], directions[i])
                                    : navigator.locate(points[i]);
                }
              });
  engine.log().hand_over();
  return made;
}

py::object step(Engine& engine, const py::object& given_states, const py::object& given_points,
                const py::object& given_directions, const py::object& given_limit,
                const py::object& out) {
  const States from = states(given_states);
  const Vectors points = vectors(given_points, "points");
  const Vectors directions = vectors(given_directions, "directions");
  const Numbers limit = numbers(given_limit, "limit");
  const std::size_t count =
      common_length({from.count, points.count, directions.count, limit.count});
  const auto part = [&](int i) -> py::object {
    return out.is_none() ? py::none() : py::object(out[py::int_(i)]);
  };
  auto length = output<double>(part(0), count, "length");
  auto boundary = output<bool>(part(1), count, "boundary");
  py::array next = states_output(part(2), count);
  if (!out.is_none()) {
    for (const auto& [name, array] : {std::pair<const char*, py::object>{"length", length},
                                      {"boundary", boundary},
                                      {"next", next}}) {
      refuse_shared(
          array, name, given_states,
          {{"points", given_points}, {"directions", given_directions}, {"limit", given_limit}});
    }
  }
  double* const lengths = length.mutable_data();
  bool* const boundaries = boundary.mutable_data();
  State* const nexts = data_of(next);
  const ObservedDetector& seen = engine.seen();
  in_parallel(engine, count, chunk_of_points,
              [&](Navigator& navigator, std::size_t begin, std::size_t end, std::size_t& i) {
                for (i = begin; i < end; ++i) {
                  const State state = from.data[i];
                  if (!state.inside()) {
                    lengths[i] = 0;
                    boundaries[i] = false;
                    nexts[i] = State{};
                    continue;
                  }
                  engine.require_known(state);
                  const Step made = seen.step(navigator, state, points[i], directions[i], limit[i]);
                  lengths[i] = made.length;
                  boundaries[i] = made.boundary;
                  nexts[i] = made.next;
                }
              });
  engine.log().hand_over();
  return out.is_none() ? result("Steps")(length, boundary, next) : out;
}

py::object original(Engine& engine, const py::object& given_states, const py::object& given_points,
                    const py::object& given_directions) {
  const bool located = !given_points.is_none();
  if (located == given_directions.is_none()) {
    throw UsageError("points and directions are needed, or neither");
  }
  const States at = states(given_states);
  Vectors points, directions;
  if (located) points = vectors(given_points, "points");
  if (located) directions = vectors(given_directions, "directions");
  const std::size_t count =
      located ? common_length({at.count, points.count, directions.count}) : at.count;
  py::array made = new_states(count);
  State* const out = data_of(made);
  const ObservedDetector& seen = engine.seen();
  in_parallel(engine, count, chunk_of_points,
              [&](Navigator&, std::size_t begin, std::size_t end, std::size_t& i) {
                for (i = begin; i < end; ++i) {
                  const State state = at.data[i];
                  if (state.inside()) engine.require_known(state);
                  out[i] = located && state.inside()
                               ? seen.original(state, points[i], directions[i])
                               : seen.original(state);
                }
              });
  engine.log().hand_over();
  return made;
}

py::object safety(Engine& engine, const py::object& given_states, const py::object& given_points,
                  const py::object& given_enough) {
  const States at = states(given_states);
  const Vectors points = vectors(given_points, "points");
  const Numbers enough = numbers(given_enough, "enough");
  const std::size_t count = common_length({at.count, points.count, enough.count});
  py::array_t<double> made(static_cast<py::ssize_t>(count));
  double* const out = made.mutable_data();
  in_parallel(engine, count, chunk_of_points,
              [&](Navigator& navigator, std::size_t begin, std::size_t end, std::size_t& i) {
                for (i = begin; i < end; ++i) {
                  const State state = at.data[i];
                  if (!state.inside()) {
                    out[i] = 0;
                    continue;
                  }
                  engine.require_known(state);
                  out[i] = navigator.safety(state, points[i], enough[i]);
                }
              });
  engine.log().hand_over();
  return made;
}

}  // namespace navjit::python
