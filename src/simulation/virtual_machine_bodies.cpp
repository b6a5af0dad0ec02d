#include <fmt/format.h>

#include "geometry/place_text.hpp"
#include "simulation/virtual_machine.hpp"

/// What the bodies of the machine run into.
namespace probewright::simulation {

std::optional<BodyHit> VirtualMachine::bodyHit(const Motion& motion, const std::optional<Touch>& touch,
                                               BodyGuard::Touching touching) const {
  if (!guard_) return std::nullopt;
  auto hit = guard_->firstHit(motion, touch ? touch->fraction : 1, shape_, touching, stop_);
  if (hit && touch && hit->fraction >= touch->fraction) return std::nullopt;
  return hit;
}

std::string VirtualMachine::describe(const BodyHit& hit) const {
  if (!tellsTouches_) return ranIntoSomething;
  std::string what;
  if (!hit.byTool) {
    what = fmt::format("the machine's \"{}\" touched \"{}\"", hit.body, hit.other);
  } else {
    const std::string part = hit.shaft ? shape_.shafts[*hit.shaft].part : "stylus tip";
    what = fmt::format("{} touched the machine's \"{}\"",
                       part == cutterName ? toolName() : fmt::format("the {} of {}", part, toolName()), hit.body);
  }
  return fmt::format("{} at {} on the table", what, placeText(hit.point));
}

std::string VirtualMachine::stopAt(const Motion& motion, const BodyHit& hit, PathKind kind) {
  standAt(motion, hit.fraction, kind);
  if (recording_ == Recording::Everything) {
    PathTouch touch;
    touch.kind = kind;
    touch.solid = hit.byTool ? hit.body : hit.other;
    touch.part = !hit.byTool ? hit.body : hit.shaft ? shape_.shafts[*hit.shaft].part : "stylus tip";
    touch.point = hit.point;
    touch.normal = hit.normal;
    touch.seconds = clock_;
    path_.add(std::move(touch));
  }
  return describe(hit);
}

std::optional<std::string> VirtualMachine::bodyContact() const {
  auto hit = guard_ ? guard_->standing(slides_, clock_) : std::nullopt;
  if (!hit && guard_) hit = guard_->standing(slides_, clock_, shape_);
  if (!hit) return std::nullopt;
  return tellsTouches_ ? describe(*hit) : "something is touched";
}

}  // namespace probewright::simulation
