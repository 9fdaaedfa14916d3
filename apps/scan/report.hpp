// What `navjit scan` tells: a table for people, CSV for programs, a plot.
#pragma once

#include <string>

#include "apps/scan/scan.hpp"

namespace navjit::scan {

/// A line for each bin of eta: means over phi, the least and the largest of the quantity, and the
/// material with most of it.
std::string table_text(const Scan& scan, const World& world, Quantity quantity);

/// A row for each bin: eta_low,eta_high,phi_low,phi_high,rays,x0,g_cm2,lambda,path_mm.
std::string csv_text(const Scan& scan);

/// The quantity against eta, materials on top of one another, and below it against eta and phi. An
/// SVG or PNG by the file's suffix. Throws what common::plot throws.
std::string draw(const Scan& scan, const World& world, Quantity quantity, const std::string& title,
                 const std::string& file);

}  // namespace navjit::scan
