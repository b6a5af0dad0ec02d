#include "simulation/contact.hpp"

namespace probewright::simulation {
namespace {

BallContact contactAt(const Way& way, const Meeting& meeting) {
  BallContact contact;
  const double travelled = std::max(0.0, meeting.when);
  contact.fraction = way.length > 0 ? std::min(1.0, travelled / way.length) : 0.0;
  contact.ballCentre = way.at(travelled);
  contact.touchPoint = meeting.point;
  return contact;
}

void setNormal(BallContact& contact, const Vector3& arm, const Way& way) {
  const double length = arm.norm();
  // A centre exactly on the surface has no such direction; against the way is where it came from.
  contact.normal = length > 1e-12 ? Vector3(arm / length) : Vector3(-way.direction);
}

}  // namespace

std::optional<BallContact> ballContact(const Way& way, const Meeting& meeting) {
  if (!meeting.found()) return std::nullopt;
  BallContact contact = contactAt(way, meeting);
  setNormal(contact, contact.ballCentre - contact.touchPoint, way);
  return contact;
}

std::optional<BallContact> capsuleContact(const Way& way, const Vector3& axis, const Meeting& meeting) {
  if (!meeting.found()) return std::nullopt;
  BallContact contact = contactAt(way, meeting);
  const Vector3 nearest = closestOnSegment(contact.touchPoint, contact.ballCentre, contact.ballCentre + axis);
  setNormal(contact, nearest - contact.touchPoint, way);
  return contact;
}

std::optional<BallContact> cylinderContact(const Way& way, const Vector3& axis, double radius, const Meeting& meeting) {
  if (!meeting.found()) return std::nullopt;
  BallContact contact = contactAt(way, meeting);
  const double length = axis.norm();
  const Vector3 up = axis / length;
  const Vector3 arm = contact.touchPoint - contact.ballCentre;
  const double height = arm.dot(up);
  const Vector3 aside = arm - height * up;
  constexpr double kOnEnd = 1e-6;
  if (std::min(height, length - height) < kOnEnd && aside.norm() < radius - kOnEnd) {
    contact.normal = height < length / 2 ? up : Vector3(-up);
  } else {
    setNormal(contact, -aside, way);
  }
  return contact;
}

BallContact contactWithin(const Way& way, double radius) {
  BallContact contact;
  contact.ballCentre = way.start;
  contact.normal = -way.direction;
  contact.touchPoint = way.start - radius * contact.normal;
  return contact;
}

std::size_t capsuleParts(const Vector3& axis, double radius) {
  Vector3 extent = axis.cwiseAbs();
  Eigen::Index longest = 0;
  extent.maxCoeff(&longest);
  extent[longest] = 0;
  return static_cast<std::size_t>(std::clamp(std::ceil(extent.maxCoeff() / (4 * radius)), 1.0, 16.0));
}

std::array<Vector3, 6> waysOut(const Bounds& box, const Vector3& point) {
  static const Vector3 kAlongZ = Vector3(0.1234567, 0.0841593, 0.9412357).normalized();
  static const Vector3 kAcross(0.0318282, -0.0271828, 0.0164321);
  struct Exit {
    double distance;
    Vector3 direction;
  };
  std::array<Exit, 6> exits;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Vector3 direction;
    for (Eigen::Index k = 0; k < 3; ++k)
      direction[(axis + 1 + k) % 3] = kAlongZ[k] + static_cast<double>(axis) * kAcross[k];
    direction.normalize();
    const auto place = 2 * static_cast<std::size_t>(axis);
    exits[place] = {box.maximum[axis] - point[axis], direction};
    exits[place + 1] = {point[axis] - box.minimum[axis], -direction};
  }
  std::ranges::sort(exits, {}, &Exit::distance);
  std::array<Vector3, 6> directions;
  std::ranges::transform(exits, directions.begin(), &Exit::direction);
  return directions;
}

}  // namespace probewright::simulation
