#include "apps/accuracy/observed_report.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "common/gnuplot.hpp"
#include "navjit/errors.hpp"

namespace navjit::accuracy {
namespace {

/// Changes are drawn on a logarithmic scale, which knows no zero: this stands for it.
constexpr double least = 1e-6;

void print_directions(const ObservedFigures& f) {
  if (f.mean <= 1e-9) return;
  std::printf("\n%s, radiation lengths by direction\n%14s %6s %10s %10s %10s %10s\n",
              f.observe.c_str(), "cosine with z", "rays", "of a ray", "change", "99%", "largest");
  for (const DirectionFigures& d : f.directions) {
    if (d.rays == 0) continue;
    std::printf("  %+.1f to %+.1f %6zu %10.4g %10.3g %10.3g %10.3g\n", d.low, d.high, d.rays,
                d.whole, d.mean, d.most_of_100, d.largest);
  }
}

/// The materials whose paths change most.
void print_materials(const ObservedFigures& f) {
  constexpr std::size_t most = 8;
  std::vector<MaterialFigures> all = f.materials;
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.change > b.change; });
  if (all.empty() || all[0].change <= 1e-6) return;
  std::printf("\n%s, mm of a ray in each material\n%-32s %10s %10s %10s\n", f.observe.c_str(), "",
              "before", "after", "change");
  for (std::size_t i = 0; i < std::min(most, all.size()) && all[i].change > 1e-6; ++i) {
    std::printf("%-32.32s %10.4g %10.4g %10.3g\n", all[i].material.c_str(), all[i].before,
                all[i].after, all[i].change);
  }
}

}  // namespace

double faster(double whole, double part) { return part > 0 ? whole / part : 0; }

void print(const std::vector<ObservedFigures>& figures) {
  std::printf("%-28s %10s %10s %6s %10s %6s  %s\n", "observe", "steps/ray", "ns/ray", "",
              "bound to", "", "radiation lengths of a ray: mean, 99.9%, largest, bound");
  std::printf("%-28s %10s %10s %6s %10s %6s\n", "", "", "generic", "times", "data", "times");
  for (const ObservedFigures& f : figures) {
    std::printf("%-28s %10.2f %10.0f %6.2f %10.0f %6.2f  %.3g %.3g %.3g %.3g\n", f.observe.c_str(),
                f.steps_per_ray, f.ns_per_ray, faster(figures[0].ns_per_ray, f.ns_per_ray),
                f.data_ns_per_ray, faster(figures[0].data_ns_per_ray, f.data_ns_per_ray), f.mean,
                f.most_of_1000, f.largest, f.bound);
  }
  std::printf("of %.4g radiation lengths that a ray goes through in the mean\n", figures[0].whole);
  for (const ObservedFigures& f : figures) {
    if (f.entries.before == 0) continue;
    std::printf(
        "%s: %zu entries into observed volumes, %zu in the original; %zu rays differ; entries of "
        "the others are within %.2g mm\n",
        f.observe.c_str(), f.entries.after, f.entries.before, f.entries.rays_that_differ,
        f.entries.largest);
  }
  for (const ObservedFigures& f : figures) {
    if (!f.vecgeom_failure.empty()) {
      std::printf("%s: VecGeom %s\n", f.observe.c_str(), f.vecgeom_failure.c_str());
    } else if (f.vecgeom_ns_per_ray > 0) {
      std::printf("%s: VecGeom takes %.0f ns for a ray, %.2f times\n", f.observe.c_str(),
                  f.vecgeom_ns_per_ray,
                  faster(figures[0].vecgeom_ns_per_ray, f.vecgeom_ns_per_ray));
    }
  }
  for (const ObservedFigures& f : figures) {
    print_directions(f);
    print_materials(f);
  }
}

nlohmann::ordered_json to_json(const std::vector<ObservedFigures>& figures) {
  auto all = nlohmann::ordered_json::array();
  for (const ObservedFigures& f : figures) {
    auto directions = nlohmann::ordered_json::array();
    for (const DirectionFigures& d : f.directions) {
      directions.push_back({{"cosine_from", d.low},
                            {"cosine_to", d.high},
                            {"rays", d.rays},
                            {"radiation_lengths", d.whole},
                            {"mean_change", d.mean},
                            {"change_99_percent", d.most_of_100},
                            {"largest_change", d.largest}});
    }
    auto materials = nlohmann::ordered_json::array();
    for (const MaterialFigures& m : f.materials) {
      materials.push_back({{"material", m.material},
                           {"before_mm", m.before},
                           {"after_mm", m.after},
                           {"mean_change_mm", m.change}});
    }
    all.push_back(
        {{"observe", f.observe},
         {"bound_radiation_lengths", f.promises ? nlohmann::ordered_json(f.bound) : nullptr},
         {"steps_per_ray", f.steps_per_ray},
         {"generic_ns_per_ray", f.ns_per_ray},
         {"bound_to_data_ns_per_ray", f.data_ns_per_ray},
         {"radiation_lengths_per_ray", f.whole},
         {"mean_radiation_lengths", f.mean},
         {"radiation_lengths_99.9_percent", f.most_of_1000},
         {"largest_radiation_lengths", f.largest},
         {"largest_path_mm", f.largest_path},
         {"directions", std::move(directions)},
         {"materials", std::move(materials)},
         {"entries",
          {{"before", f.entries.before},
           {"after", f.entries.after},
           {"rays_that_differ", f.entries.rays_that_differ},
           {"largest_mm", f.entries.largest}}}});
    if (f.vecgeom_ns_per_ray > 0) all.back()["vecgeom_ns_per_ray"] = f.vecgeom_ns_per_ray;
    if (!f.vecgeom_failure.empty()) all.back()["vecgeom_failure"] = f.vecgeom_failure;
  }
  return all;
}

std::string draw(const std::vector<ObservedFigures>& figures, const std::string& title,
                 const std::string& file) {
  struct Series {
    const char* name;
    double ObservedFigures::*ns;
  };
  std::string data, plots;
  for (const Series& series : {Series{"navjit, generic", &ObservedFigures::ns_per_ray},
                               Series{"navjit, bound to data", &ObservedFigures::data_ns_per_ray},
                               Series{"VecGeom", &ObservedFigures::vecgeom_ns_per_ray}}) {
    std::string rows;
    for (const ObservedFigures& f : figures) {
      if (f.*series.ns <= 0 || figures[0].*series.ns <= 0) continue;
      rows += common::literal(std::max(f.mean, least)) + ' ' +
              common::literal(std::max(f.most_of_1000, least)) + ' ' +
              common::literal(figures[0].*series.ns / f.*series.ns) + ' ' +
              common::quoted(f.observe) + '\n';
    }
    if (rows.empty()) continue;
    const std::string block = "$s" + std::to_string(plots.size());
    data += block + " << EOD\n" + rows + "EOD\n";
    plots += (plots.empty() ? "plot " : ", ") + block +
             " using 1:3:1:2 with xerrorbars lw 2 pt 7 ps 1 title " + common::quoted(series.name);
    if (plots.find("labels") == std::string::npos) {
      plots += ", " + block + " using 1:3:4 with labels noenhanced offset 0,1 notitle";
    }
  }
  if (plots.empty()) throw Error(file + ": nothing was measured that could be drawn");
  return common::plot("set title " + common::quoted(title) + " noenhanced\n" +
                          "set xlabel 'change of a ray, radiation lengths: mean, and to 99.9%'\n" +
                          "set ylabel 'times the speed of every boundary'\nset logscale x\n" +
                          "set format x '10^{%L}'\nset yrange [0:*]\nset grid\n" +
                          "set key outside right top\n" + data + plots,
                      file);
}

}  // namespace navjit::accuracy
