// Writes docs/extremes.md: every extreme, and how each engine does in it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/extremes/outcome.hpp"

namespace {

using namespace navjit;
using accuracy::EngineFigures;

constexpr const char* introduction =
    R"(# Extremes: where numbers end

Written by `navjit_extremes --vecgeom build/release/bin/vecgeom_trace`; the tests `extremes/...` are the
same cases with fewer rays. Scenes and rays are made in `tests/extremes`: all solids are one of each of
the 30 kinds of GDML, 10 mm in size before scaling, every second one turned; their rays are a quarter
plain ones, a quarter from points on surfaces and up to 1000 tolerances off them, a quarter tangents to
1e-15, a quarter from corners with directions that hold zeros, negative zeros and denormals. Tori nearly
degenerate get a quarter more through their centres and past them by denormals and more.

Each step is held against the reference of 113 bits, from the very same point, direction and touchable
(docs/accuracy.md). A *fault* is a ray that is stuck or lost, a volume claimed that is not there, or a
step that ends where no surface is or passes one, by more than four tolerances (docs/tolerance.md), or a
step that is off the surface by more than its scene's bound, where one is known (docs/accuracy.md). *Ulp*
is the last bit of the largest coordinate of both ends in any frame on the way. Where a ray grazes, its
path to the surface is badly conditioned, and rounding of the last bit moves the end along the surface by
much: hence two columns, the distance of the end from the surface, and the error of the length. Steps that
part from the reference's with either right, along an edge or a face within the tolerance, are not in
these two.

The specialised navigators are compiled for all scenes beforehand; what is counted are steps whose bits
differ from the generic navigator's, none of which there may be. So the columns of faults and errors are those
of every level: `exact`, and `fast` and `single`, which run it (docs/accuracy.md).

VecGeom 1.2.1 runs in processes of its own, for 60 s at most, with its automatic choice of navigator, and
is given the kinds of solids that its reader takes (19 of the 30). It moves points by 1e-6 mm: its
steps shorter than 1e-5 mm are not judged, and nearer than 2.2e-6 mm to a surface nothing is held against
it, though at the smallest scale that is much of a solid.

)";

constexpr const char* conclusion = R"(
NaN and infinity in a file of rays, in a GDML file, and in every call of `Navigator` are refused
(`tests/extremes/not_finite_test.cpp`, `tests/geometry/gdml`).
)";

/// "none", or what went wrong, and how often.
std::string faults(const EngineFigures& f) {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(f.stuck, "stuck");
  add(f.lost, "lost");
  add(f.all.wrong_volume, "wrong volumes");
  add(f.all.wrong_end, "wrong ends");
  add(f.beyond_bound, "beyond the scene's bound");
  return text.empty() ? "none" : text;
}

std::string largest(const std::vector<float>& values) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", accuracy::quantiles(values).largest);
  return text;
}

void show_wrong(const std::string& name, const char* engine, const EngineFigures& f) {
  for (const accuracy::WorstStep& w : f.wrong) {
    const Vec3 &p = w.point, &v = w.ray.direction, &s = w.ray.position;
    std::fprintf(stderr,
                 "%s, %s: ray %zu (start %a, %a, %a) step %zu in %s from (%a, %a, %a) along (%a, "
                 "%a, %a): %.17g mm, the reference's %.17g%s%s\n",
                 name.c_str(), engine, w.ray_index, s.x, s.y, s.z, w.judged.step, w.claim.c_str(),
                 p.x, p.y, p.z, v.x, v.y, v.z, w.length, w.judged.reference,
                 w.judged.wrong_volume ? ", wrong volume" : "",
                 w.judged.wrong_end ? ", wrong end" : "");
  }
}

void show_given_up(const std::string& name, const char* engine, const EngineFigures& f) {
  for (const accuracy::WorstStep& w : f.given_up) {
    const Vec3 &p = w.point, &v = w.ray.direction, &s = w.ray.position;
    std::fprintf(stderr,
                 "%s, %s: ray %zu from (%a, %a, %a) along (%a, %a, %a): %s at (%a, %a, %a)\n",
                 name.c_str(), engine, w.ray_index, s.x, s.y, s.z, v.x, v.y, v.z, w.claim.c_str(),
                 p.x, p.y, p.z);
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(2, f.worst_across.size()); ++i) {
    const accuracy::WorstStep& w = f.worst_across[i];
    const Vec3 &p = w.point, &v = w.ray.direction;
    std::fprintf(stderr,
                 "%s, %s: off the surface, %.3g ulp of %.3g mm: ray %zu in %s from (%a, "
                 "%a, %a) along (%a, %a, "
                 "%a): %.17g mm, the reference's %.17g\n",
                 name.c_str(), engine, w.judged.across / w.judged.ulp, w.judged.ulp, w.ray_index,
                 w.claim.c_str(), p.x, p.y, p.z, v.x, v.y, v.z, w.length, w.judged.reference);
  }
}

bool right(const extremes::Case& extreme, const extremes::Outcomes& outcomes) {
  const auto good = [&](const extremes::Outcome& o) {
    const EngineFigures& f = o.figures;
    if (extreme.refused) return f.rays == 0;
    return o.refused + f.stuck + f.lost + f.all.wrong_volume + f.all.wrong_end + f.beyond_bound ==
           0;
  };
  return good(outcomes.generic) && good(outcomes.specialised) &&
         outcomes.specialised.differing == 0;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Extremes: what navjit makes of them, and VecGeom.");
  std::string only, vecgeom, keep;
  bool quick = false, show = false;
  double seconds = 60;
  app.add_option("--only", only, "Cases whose name has this");
  app.add_option("--keep", keep, "Folder for the detectors, as GDML");
  app.add_option("--vecgeom", vecgeom, "The program vecgeom_trace");
  app.add_option("--vecgeom-seconds", seconds, "For each of its runs");
  app.add_flag("--quick", quick, "As few rays as the tests have");
  app.add_flag("--show", show, "Wrong steps in detail, on standard error");
  CLI11_PARSE(app, argc, argv);
  bool good = true;
  if (only.empty()) std::fputs(introduction, stdout);
  std::printf(
      "| extreme | rays | steps | navjit, generic: faults | step's end from the surface, ulp, at "
      "most | error of the length, ulp, at most | specialised: steps that differ |%s\n"
      "|---|--:|--:|---|--:|--:|--:|%s\n",
      vecgeom.empty() ? "" : " VecGeom: faults | error of the length, mm, at most |",
      vecgeom.empty() ? "" : "---|--:|");
  for (const extremes::Case& extreme : extremes::all_cases(!quick)) {
    if (extreme.name.find(only) == std::string::npos) continue;
    if (!keep.empty()) {
      std::filesystem::create_directories(keep);
      std::ofstream(std::filesystem::path(keep) / (extreme.name + ".gdml")) << extreme.gdml;
    }
    const extremes::Outcomes outcomes = run_case(extreme);
    const extremes::Outcome& generic = outcomes.generic;
    const EngineFigures& f = generic.figures;
    good = right(extreme, outcomes) && good;
    const unsigned long long rays = f.rays + generic.refused;
    std::printf("| %s | %llu | %llu | %s%s | %s | %s | %llu |", extreme.name.c_str(), rays,
                static_cast<unsigned long long>(f.made),
                generic.refused > 0 ? (std::to_string(generic.refused) + " refused; ").c_str() : "",
                faults(f).c_str(), largest(f.all.errors.across_ulp).c_str(),
                largest(f.all.errors.along_ulp).c_str(),
                static_cast<unsigned long long>(outcomes.specialised.differing));
    if (show) {
      show_wrong(extreme.name, "generic", f);
      show_given_up(extreme.name, "generic", f);
      for (const std::string& words : outcomes.specialised.differences) {
        std::fprintf(stderr, "%s, specialised: %s\n", extreme.name.c_str(), words.c_str());
      }
      show_wrong(extreme.name, "specialised", outcomes.specialised.figures);
    }
    if (!vecgeom.empty() && !extreme.for_vecgeom) std::printf(" not given to it | |");
    if (!vecgeom.empty() && extreme.for_vecgeom) {
      const extremes::Outcome theirs = run_vecgeom(extreme, vecgeom, seconds);
      std::string words = theirs.failure;
      if (words.empty() && extreme.refused) {
        words = "answers " + std::to_string(theirs.figures.made) + " steps, none refused; " +
                faults(theirs.figures);
      }
      std::printf(" %s | %s |", words.empty() ? faults(theirs.figures).c_str() : words.c_str(),
                  theirs.figures.all.errors.along_mm.empty()
                      ? ""
                      : largest(theirs.figures.all.errors.along_mm).c_str());
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  if (only.empty()) std::fputs(conclusion, stdout);
  return good ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "navjit_extremes: %s\n", error.what());
  return 1;
}
