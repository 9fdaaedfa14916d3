// Pictures by gnuplot, called as a program.
#pragma once

#include <string>

namespace navjit::common {

/// Throws Error if the file's suffix is not that of a picture (.svg, .png), or if
/// there is no gnuplot: to be asked before anything was measured.
void check_picture(const std::string& file);

/// Runs a script that plots; gives the picture, of the kind that the file's suffix asks for. Throws
/// as above, and if gnuplot fails.
std::string plot(const std::string& script, const std::string& file);

/// In gnuplot's double quotes; what could end or steer the text is left out.
std::string quoted(const std::string& text);
std::string literal(double value);

}  // namespace navjit::common
