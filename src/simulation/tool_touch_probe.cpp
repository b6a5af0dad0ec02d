#include "simulation/tool_touch_probe.hpp"

namespace probewright::simulation {

ContactElement ContactElement::disc(double diameter, double thickness) {
  return ContactElement(std::make_shared<RoundBar>(diameter / 2, -thickness, 0), thickness);
}

ContactElement ContactElement::cuboid(double length, double width, double thickness) {
  const Vector3 half(length / 2, width / 2, 0);
  return ContactElement(std::make_shared<Box>(Vector3(-half.x(), -half.y(), -thickness), half), thickness);
}

ContactElement ContactElement::on(double stemDiameter, double stemLength) && {
  stem_ = std::make_shared<RoundBar>(stemDiameter / 2, -thickness_ - stemLength, -thickness_);
  return std::move(*this);
}

Bounds ContactElement::bounds() const {
  Bounds all = contact_->bounds();
  if (!stem_) return all;
  const Bounds stem = stem_->bounds();
  return {all.minimum.cwiseMin(stem.minimum), all.maximum.cwiseMax(stem.maximum)};
}

ClosestPoint ContactElement::closest(const Vector3& point) const {
  const ClosestPoint contact = contact_->closest(point);
  if (!stem_) return contact;
  const ClosestPoint stem = stem_->closest(point);
  return stem.distance < contact.distance ? stem : contact;
}

}  // namespace probewright::simulation
