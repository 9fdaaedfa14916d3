// For programs without the reference at 113 bits.
#include "runtime/error_meter/error_meter.hpp"

namespace navjit {

struct ErrorMeter::Work {};

ErrorMeter::ErrorMeter(const Geometry&, const kernels::Context&) {}
ErrorMeter::~ErrorMeter() = default;

bool ErrorMeter::available() { return false; }

std::optional<double> ErrorMeter::error_at(const Sample&) { return std::nullopt; }

}  // namespace navjit
