#include "python/core/rays.hpp"

#include <cstdint>
#include <cstring>
#include <vector>

#include "navjit/detail/standing.hpp"
#include "python/core/arrays.hpp"
#include "python/core/in_parallel.hpp"

namespace navjit::python {
namespace {

constexpr std::size_t chunk_of_rays = 64;

/// Calls sink(state, length) for each step of a ray; whether it came to its end and was not stuck.
template <class Sink>
bool follow(const ObservedDetector& seen, Navigator& navigator, Vec3 point, const Vec3& direction,
            double tolerance, Sink&& sink) {
  detail::Standing standing;
  for (State state = navigator.locate(point, direction); state.inside();) {
    const Step step = seen.step(navigator, state, point, direction);
    standing.count(step.length, tolerance);
    if (standing.stuck()) return false;
    sink(state, step.length);
    point += step.length * direction;
    state = step.next;
  }
  return true;
}

/// Points and directions of rays.
struct Rays {
  Vectors points, directions;
  std::size_t count;

  Rays(const py::object& given_points, const py::object& given_directions)
      : points(vectors(given_points, "points")),
        directions(vectors(given_directions, "directions")),
        count(common_length({points.count, directions.count})) {}
};

template <class T>
py::array_t<T> new_array(std::size_t count) {
  return py::array_t<T>(static_cast<py::ssize_t>(count));
}

/// The steps of some rays in a row.
struct Piece {
  std::vector<State> states;
  std::vector<double> lengths;
};

}  // namespace

py::object trace(Engine& engine, const py::object& points, const py::object& directions) {
  const Rays rays(points, directions);
  auto offset = new_array<std::int64_t>(rays.count + 1);
  auto stuck = new_array<bool>(rays.count);
  std::int64_t* const offsets = offset.mutable_data();  // first the steps of each ray
  bool* const is_stuck = stuck.mutable_data();
  std::vector<Piece> pieces((rays.count + chunk_of_rays - 1) / chunk_of_rays);
  const ObservedDetector& seen = engine.seen();
  const double tolerance = seen.detector().tolerance();
  in_parallel(engine, rays.count, chunk_of_rays,
              [&](Navigator& navigator, std::size_t begin, std::size_t end, std::size_t& i) {
                Piece& piece = pieces[begin / chunk_of_rays];
                for (i = begin; i < end; ++i) {
                  const std::size_t before = piece.states.size();
                  is_stuck[i] = !follow(seen, navigator, rays.points[i], rays.directions[i],
                                        tolerance, [&](const State& state, double length) {
                                          piece.states.push_back(state);
                                          piece.lengths.push_back(length);
                                        });
                  offsets[i + 1] = static_cast<std::int64_t>(piece.states.size() - before);
                }
              });
  offsets[0] = 0;
  for (std::size_t i = 0; i < rays.count; ++i) offsets[i + 1] += offsets[i];
  const auto steps = static_cast<std::size_t>(offsets[rays.count]);
  py::array state = new_states(steps);
  auto length = new_array<double>(steps);
  State* states = data_of(state);
  double* lengths = length.mutable_data();
  for (Piece& piece : pieces) {
    const Piece made = std::move(piece);
    std::copy(made.states.begin(), made.states.end(), states);
    std::copy(made.lengths.begin(), made.lengths.end(), lengths);
    states += made.states.size();
    lengths += made.lengths.size();
  }
  engine.log().hand_over();
  return py::module_::import("navjit.results").attr("Trace")(offset, state, length, stuck);
}

py::object scan(Engine& engine, const py::object& points, const py::object& directions,
                bool by_material) {
  const Rays rays(points, directions);
  const ObservedDetector& seen = engine.seen();
  const Detector& detector = seen.detector();
  const std::size_t materials = detector.materials();
  // By volume: its material, and radiation lengths in a mm.
  struct Filling {
    std::uint32_t material;
    double per_mm;  ///< 0: not known
  };
  std::vector<Filling> fillings(detector.volumes());
  for (std::size_t v = 0; v < fillings.size(); ++v) {
    const LogicalVolume& volume = detector.volume(static_cast<VolumeId>(v));
    const double length = detector.material(volume).radiation_length;
    fillings[v] = {volume.material, length > 0 ? 1 / length : 0};
  }
  auto length = new_array<double>(rays.count);
  auto radiation_lengths = new_array<double>(rays.count);
  auto unknown = new_array<double>(rays.count);
  auto steps = new_array<std::int64_t>(rays.count);
  auto stuck = new_array<bool>(rays.count);
  py::array_t<double> table({static_cast<py::ssize_t>(rays.count),
                             static_cast<py::ssize_t>(by_material ? materials : 0)});
  double* const parts = by_material ? table.mutable_data() : nullptr;
  std::fill_n(table.mutable_data(), table.size(), 0.0);
  double *const l = length.mutable_data(), *const x = radiation_lengths.mutable_data(),
                *const u = unknown.mutable_data();
  std::int64_t* const n = steps.mutable_data();
  bool* const is_stuck = stuck.mutable_data();
  const double tolerance = detector.tolerance();
  in_parallel(engine, rays.count, chunk_of_rays,
              [&](Navigator& navigator, std::size_t begin, std::size_t end, std::size_t& i) {
                for (i = begin; i < end; ++i) {
                  double sum = 0, radiation = 0, rest = 0;
                  std::int64_t made = 0;
                  is_stuck[i] = !follow(seen, navigator, rays.points[i], rays.directions[i],
                                        tolerance, [&](const State& state, double part) {
                                          const Filling& filling = fillings[state.volume()];
                                          ++made;
                                          sum += part;
                                          radiation += part * filling.per_mm;
                                          if (filling.per_mm == 0) rest += part;
                                          if (parts && filling.material < materials) {
                                            parts[i * materials + filling.material] += part;
                                          }
                                        });
                  l[i] = sum;
                  x[i] = radiation;
                  u[i] = rest;
                  n[i] = made;
                }
              });
  engine.log().hand_over();
  return py::module_::import("navjit.results")
      .attr("Scan")(length, radiation_lengths, unknown, steps, stuck, table);
}

}  // namespace navjit::python
