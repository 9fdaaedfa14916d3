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

/// The key of a bound, which has its unit in its name, as in the reports of `navjit run`.
const char* key_of_bound(const Observation& o) {
  if (o.unit == Observation::Unit::grams_per_cm2) return "bound_g_per_cm2";
  const bool relative = o.unit == Observation::Unit::relative;
  return relative && o.kind == Observation::Kind::budget ? "bound_relative"
                                                         : "bound_radiation_lengths";
}

py::list list_of(const std::vector<ObservationReport::Entry>& entries, const char* bound) {
  py::list all;
  for (const ObservationReport::Entry& e : entries) {
    py::dict d;
    d["volume"] = text(e.volume);
    d["mother"] = text(e.mother);
    d["placements"] = e.placements;
    d[bound] = e.bound;
    d["why"] = text(e.why);
    all.append(d);
  }
  return all;
}

py::list list_of(const std::vector<ObservationReport::Mixture>& mixtures, const char* bound) {
  py::list all;
  for (const ObservationReport::Mixture& m : mixtures) {
    py::list of;
    for (const std::string& daughter : m.of) of.append(text(daughter));
    py::dict d;
    d["volume"] = text(m.volume);
    d["of"] = of;
    d["placements"] = m.placements;
    d["material"] = text(m.material);
    d["density_g_per_cm3"] = m.density;
    d["radiation_length_mm"] = m.radiation_length;
    d[bound] = m.bound;
    all.append(d);
  }
  return all;
}

py::dict dict_of(const ObservationReport::Measured& m, Observation::Unit unit) {
  py::dict d;
  d["unit"] = unit == Observation::Unit::grams_per_cm2 ? "g/cm2" : "radiation lengths";
  d["rays"] = m.rays;
  d["mean_of_ray"] = m.whole;
  d["mean_change"] = m.mean;
  d["mean_change_error"] = m.mean_error;
  d["signed_mean_change"] = m.signed_mean;
  d["signed_mean_change_error"] = m.signed_error;
  d["change_99_percent"] = m.of_99_percent;
  d["change_99.9_percent"] = m.of_999_permille;
  d["largest_change"] = m.largest;
  return d;
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
  const char* bound = key_of_bound(seen.observation());
  py::dict d;
  d["kind"] = text(observation_text(seen.observation()));
  d["invisible"] = r.invisible;
  d["dissolved"] = r.dissolved;
  d["sampled"] = r.sampled;
  d[bound] = r.bound;
  d["placements_before"] = r.placements_before;
  d["placements_after"] = r.placements_after;
  d["touchables_before"] = r.touchables_before;
  d["touchables_after"] = r.touchables_after;
  d["gone"] = list_of(r.gone, bound);
  d["left"] = list_of(r.left, bound);
  if (seen.observation().kind == Observation::Kind::mixtures) {
    d["mixtures"] = list_of(r.mixtures, bound);
    d["measured"] = dict_of(r.measured, seen.observation().unit);
  }
  return d;
}

}  // namespace navjit::python
