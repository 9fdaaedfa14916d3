#include "python/core/report.hpp"

namespace navjit::python {
namespace {

py::str text(const std::string& s) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(s.data(), static_cast<py::ssize_t>(s.size()), "replace"));
}

py::dict dict_of(const BudgetReport& b) {
  py::dict d;
  d["promised"] = b.met;
  d["bound_mm"] = b.bound_mm;
  d["measured_mm"] = b.measured_mm;
  d["states"] = b.states;
  d["why"] = text(b.why);
  return d;
}

py::dict dict_of(const SceneReport& s) {
  py::dict d;
  d["volume"] = text(s.volume);
  d["volume_number"] = s.volume_id;
  d["structure"] = text(s.structure);
  d["steps"] = s.steps;
  d["share"] = s.share;
  d["relocations"] = s.relocations;
  d["generic_ns_per_step"] = s.generic_ns_per_step;
  d["specialised_ns_per_step"] = s.specialised_ns_per_step;
  d["compile_ms"] = s.compile_ms;
  d["specialised_at_s"] = s.specialised_at_s;
  d["swapped_at_s"] = s.swapped_at_s;
  d["code"] = origin_name(s.origin);
  d["compiled_solids"] = s.compiled_solids;
  d["binding"] = binding_name(s.binding);
  d["status"] = status_name(s.status);
  d["note"] = text(s.note);
  if (s.budget) d["budget"] = dict_of(*s.budget);
  return d;
}

py::list list_of(const std::vector<ObservationReport::Entry>& entries) {
  py::list all;
  for (const ObservationReport::Entry& e : entries) {
    py::dict d;
    d["volume"] = text(e.volume);
    d["mother"] = text(e.mother);
    d["placements"] = e.placements;
    d["bound_radiation_lengths"] = e.bound;
    d["why"] = text(e.why);
    all.append(d);
  }
  return all;
}

}  // namespace

py::dict dict_of(const RuntimeReport& report) {
  py::dict d;
  d["seconds"] = report.seconds;
  d["steps"] = report.steps;
  d["modules"] = report.modules;
  d["cached_modules"] = report.cached_modules;
  d["plugin_scenes"] = report.plugin_scenes;
  d["deoptimised"] = report.deoptimised;
  d["compile_ms"] = report.compile_ms;
  d["code_bytes"] = report.code_bytes;
  py::list scenes;
  for (const SceneReport& scene : report.scenes) scenes.append(dict_of(scene));
  d["scenes"] = scenes;
  return d;
}

py::dict dict_of(const ObservedDetector& seen) {
  const ObservationReport& r = seen.report();
  py::dict d;
  d["kind"] = text(observation_text(seen.observation()));
  d["invisible"] = r.invisible;
  d["dissolved"] = r.dissolved;
  d["sampled"] = r.sampled;
  d["bound_radiation_lengths"] = r.bound;
  d["placements_before"] = r.placements_before;
  d["placements_after"] = r.placements_after;
  d["touchables_before"] = r.touchables_before;
  d["touchables_after"] = r.touchables_after;
  d["gone"] = list_of(r.gone);
  d["left"] = list_of(r.left);
  return d;
}

}  // namespace navjit::python
