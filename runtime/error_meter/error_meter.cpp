#include "runtime/error_meter/error_meter.hpp"

#include "geometry/navigation/generic.hpp"
#include "geometry/reference/wide_geometry.hpp"

namespace navjit {

struct ErrorMeter::Work {
  const Geometry& geometry;
  const kernels::Context& context;
  reference::WideGeometry reference;
  NavigationStack stack{};
};

ErrorMeter::ErrorMeter(const Geometry& geometry, const kernels::Context& context)
    : work_(new Work{geometry, context, reference::WideGeometry(geometry.share_world())}) {
  work_->stack.depth = -1;
}
ErrorMeter::~ErrorMeter() = default;

bool ErrorMeter::available() { return true; }

std::optional<double> ErrorMeter::error_at(const Sample& s) {
  const Geometry& geometry = work_->geometry;
  NavigationStack& stack = work_->stack;
  const reference::Chain chain = reference::chain_of(geometry.world(), s.touchable);
  const reference::WideAnswer right = work_->reference.step(
      chain, reference::widen(s.point), reference::widen_direction(s.direction));
  if (!(right.length < s.limit)) return std::nullopt;
  generic::restore(geometry, stack, s.touchable);
  const Vec3 &p = s.point, &v = s.direction;
  kernels::set_ray(stack, v.x, v.y, v.z);
  const kernels::DispatchEntry& entry = *kernels::dispatch_entry_of(&work_->context, s.volume);
  double length = entry.step(&stack, &work_->context, entry.data, p.x, p.y, p.z, s.limit);
  if (length < 0) length = generic::step(geometry, stack, p, v, s.limit);
  stack.depth = -1;
  return work_->reference.across(chain, p, v, length, right.length);
}

}  // namespace navjit
