// What a comparison of observations says: tables, JSON, a picture.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/accuracy/observed.hpp"

namespace navjit::accuracy {

/// How often `part` goes into `whole`; 0 where nothing was timed.
double faster(double whole, double part);

void print(const std::vector<ObservedFigures>& figures);
nlohmann::ordered_json to_json(const std::vector<ObservedFigures>& figures);

/// Speed-up against the change of a ray: an SVG or a PNG, by the file's suffix. Throws Error if the
/// suffix is another, if there is no gnuplot, or if it fails.
std::string draw(const std::vector<ObservedFigures>& figures, const std::string& title,
                 const std::string& file);

}  // namespace navjit::accuracy
