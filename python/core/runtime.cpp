// The runtime: options in, navigation of arrays, a report out.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <limits>

#include "python/core/arrays.hpp"
#include "python/core/detector.hpp"
#include "python/core/navigator.hpp"
#include "python/core/rays.hpp"
#include "python/core/report.hpp"
#include "python/core/step_arrays.hpp"

namespace navjit::python {
namespace {

using Shared = std::shared_ptr<Engine>;

JitMode jit_mode(const std::string& name) {
  if (name == "off") return JitMode::off;
  if (name == "on") return JitMode::on;
  if (name == "wait") return JitMode::wait;
  if (name == "shadow") return JitMode::shadow;
  throw UsageError("jit: 'off', 'on', 'wait' or 'shadow', not '" + name + "'");
}

/// None or False: none; True: the user's; else a folder.
Cache cache_of(const py::object& given) {
  if (given.is_none() || given.is(py::bool_(false))) return {};
  if (given.is(py::bool_(true))) return Cache::user_default();
  try {
    return Cache::in(given.cast<std::filesystem::path>().string());
  } catch (const py::cast_error&) {
    throw py::type_error("cache: a folder, True for the user's, or None");
  }
}

struct PythonRuntime {
  Shared engine;
};

/// The thread that specialises ends before the interpreter does, whoever still holds a Runtime
/// then: behind it nothing may run that uses the library.
void stop_at_exit(const Shared& engine) {
  const auto stop = [weak = std::weak_ptr<Engine>(engine)] {
    const Shared still = weak.lock();
    if (!still) return;
    const py::gil_scoped_release unlocked;
    const std::lock_guard lock(still->mutex());
    still->runtime().final_report(0);
  };
  py::module_::import("atexit").attr("register")(py::cpp_function(stop));
}

struct Options {
  std::string jit, plugin, observe;
  py::object cache;
  std::optional<double> budget;
  int threads, nice;
  bool safety, constants;
};

PythonRuntime make(const py::object& detector, const Options& o) {
  if (o.threads < 1 || o.threads > 1024) throw UsageError("threads: 1 to 1024");
  if (o.nice < 0 || o.nice > 19) throw UsageError("nice: 0 to 19");
  if (o.budget && !(*o.budget > 0)) throw UsageError("budget: a length in mm, above 0");
  RuntimeOptions options;
  options.jit = jit_mode(o.jit);
  options.cache = cache_of(o.cache);
  options.plugin = o.plugin;
  options.budget = o.budget;
  options.specialiser.nice = o.nice;
  options.specialiser.safety = o.safety;
  options.specialiser.constants = o.constants;
  const Observation observation = parse_observation(o.observe);
  const Detector its = detector_of(detector);
  Shared engine;
  {
    const py::gil_scoped_release unlocked;
    engine = std::make_shared<Engine>(its, observation, options, static_cast<unsigned>(o.threads));
  }
  stop_at_exit(engine);
  engine->log().hand_over();
  return {engine};
}

py::dict report(PythonRuntime& self, bool final, double most_seconds) {
  RuntimeReport made;
  Engine& engine = *self.engine;
  {
    const py::gil_scoped_release unlocked;
    if (final) {
      const std::lock_guard lock(engine.mutex());
      made = engine.runtime().final_report(most_seconds);
    } else {
      made = engine.runtime().report();
    }
  }
  engine.log().hand_over();
  py::dict d = dict_of(made);
  if (engine.seen().observation().kind != Observation::Kind::all) {
    d["observe"] = dict_of(engine.seen());
  }
  return d;
}

}  // namespace

void bind_runtime(py::module_& module) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  using R = PythonRuntime;
  py::class_<R>(module, "Runtime", R"doc(Navigates a detector, and specialises hot scenes meanwhile.

jit: 'on' (specialise in the background), 'off', 'wait' (everything first) or 'shadow' (compare).
cache: where compiled code is kept: a folder, True for the user's, None for none.
observe: 'all', 'materials[,VOLUME...]', 'budget:E[,VOLUME...]' or 'mixtures:E[,VOLUME...]'
(docs/observation.md).
plugin: a file that `navjit specialise` made.
threads: how many navigate an array together.
budget: hold every scene to this error, mm; report(final=True) says which keep it.
nice: priority of the compiler's thread. safety: specialise it, too. constants: compile code for
the hottest scenes; without, they are bound to data alone.

Arrays of points and directions are of shape (N, 3), or (3,) for one that stands for all. The
interpreter's lock is released while they are navigated. Points are mm, directions of unit length.)doc")
      .def(py::init([](const py::object& detector, const std::string& jit, const py::object& cache,
                       const std::string& observe, const std::string& plugin, int threads,
                       std::optional<double> budget, int nice, bool safety, bool constants) {
             return make(detector,
                         {jit, plugin, observe, cache, budget, threads, nice, safety, constants});
           }),
           py::arg("detector"), py::kw_only(), py::arg("jit") = "on", py::arg("cache") = py::none(),
           py::arg("observe") = "all", py::arg("plugin") = "", py::arg("threads") = 1,
           py::arg("budget") = py::none(), py::arg("nice") = 0, py::arg("safety") = true,
           py::arg("constants") = true)
      .def(
          "navigator", [](R& r) { return PythonNavigator(r.engine); },
          "A Navigator, for one point at a time.")
      .def_property_readonly(
          "detector", [](R& r) { return python_detector(r.engine->seen().detector()); },
          "What is navigated, and what states belong to: the Detector that was given, or what "
          "observe leaves of it.")
      .def(
          "original",
          [](R& r, const py::object& states, const py::object& points,
             const py::object& directions) {
            return original(*r.engine, states, points, directions);
          },
          py::arg("states"), py::arg("points") = py::none(), py::arg("directions") = py::none(),
          "The states of the Detector that was given for states of this Runtime, which are those "
          "of runtime.detector. With points and directions: of the deepest touchables there, what "
          "nothing observes included.")
      .def(
          "locate",
          [](R& r, const py::object& points, const py::object& directions) {
            return locate(*r.engine, points, directions);
          },
          py::arg("points"), py::arg("directions") = py::none(),
          "The state of the deepest touchable with each point: an array of state_dtype. On faces "
          "the directions decide; without them the first volume in file order.")
      .def(
          "step",
          [](R& r, const py::object& states, const py::object& points, const py::object& directions,
             const py::object& limit, const py::object& out) {
            return step(*r.engine, states, points, directions, limit, out);
          },
          py::arg("states"), py::arg("points"), py::arg("directions"), py::arg("limit") = infinity,
          py::kw_only(), py::arg("out") = py::none(),
          "One step of each track: Steps(length, boundary, next). limit: mm, a number or one for "
          "each. out: Steps to write to; its next may be states itself. Tracks that are outside "
          "the "
          "world stay there, with a length of 0.")
      .def(
          "safety",
          [](R& r, const py::object& states, const py::object& points, const py::object& enough) {
            return safety(*r.engine, states, points, enough);
          },
          py::arg("states"), py::arg("points"), py::arg("enough") = infinity,
          "A lower bound of the distance to the nearest boundary, mm, or enough if that is less; 0 "
          "outside the world.")
      .def(
          "trace",
          [](R& r, const py::object& points, const py::object& directions) {
            return trace(*r.engine, points, directions);
          },
          py::arg("points"), py::arg("directions"),
          "Every step of straight rays until they leave the world: Trace(offset, state, length, "
          "stuck).")
      .def(
          "scan",
          [](R& r, const py::object& points, const py::object& directions, bool by_material) {
            return scan(*r.engine, points, directions, by_material);
          },
          py::arg("points"), py::arg("directions"), py::kw_only(), py::arg("by_material") = false,
          "What straight rays go through: Scan(length, radiation_lengths, unknown, steps, stuck, "
          "by_material).")
      .def(
          "report", &report, py::kw_only(), py::arg("final") = false, py::arg("most_seconds") = 1,
          "Steps and specialisations so far, as a dict with keys as in docs/report.md. final: also "
          "times generic navigators, for most_seconds at the most; nothing is specialised after "
          "it.")
      .def(
          "save_profile",
          [](R& r, const std::filesystem::path& path) {
            const py::gil_scoped_release unlocked;
            const std::lock_guard lock(r.engine->mutex());
            Runtime& runtime = r.engine->runtime();
            runtime.final_report(0);
            write_profile(runtime.step_profile(), path.string());
          },
          py::arg("path"),
          "Writes how often each volume was used, for `navjit specialise`. Nothing is specialised "
          "after it.")
      .def(
          "wait",
          [](R& r) {
            {
              const py::gil_scoped_release unlocked;
              const std::lock_guard lock(r.engine->mutex());
              r.engine->runtime().wait_until_idle();
            }
            r.engine->log().hand_over();
          },
          "Returns when no specialisation is under way or due.")
      .def_property_readonly(
          "specialised", [](R& r) { return r.engine->runtime().specialised(); },
          "How many scenes have navigators of their own by now.")
      .def_property_readonly(
          "threads", [](R& r) { return r.engine->threads(); },
          "How many navigate an array together.");
}

}  // namespace navjit::python
