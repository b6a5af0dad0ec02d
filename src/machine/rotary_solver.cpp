#include "machine/rotary_solver.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::machine {

namespace {

constexpr double tolerance = 1e-9;

/// A rotation in the chain from the table to the tool: exp(sign * angle * axis).
struct Joint {
  std::size_t axis = 0;
  Vector3 direction = Vector3::UnitZ();
  double sign = 1;
};

/// The angle (degrees) that turns `from` to `to` about `axis`, both unit vectors on the same cone; 0 on the axis.
double angleAbout(const Vector3& axis, const Vector3& from, const Vector3& to) {
  const Vector3 a = from - axis * axis.dot(from);
  const Vector3 b = to - axis * axis.dot(to);
  if (a.norm() < tolerance || b.norm() < tolerance) return 0;
  return degreesFromRadians(std::atan2(axis.dot(a.cross(b)), a.dot(b)));
}

/// The value within the travel that is nearest to `now` and equal to `angle` modulo 360.
std::optional<double> withinTravel(const machine::Axis& axis, double angle, double now) {
  std::optional<double> best;
  const double first = angle + 360 * std::round((now - angle) / 360);
  for (const double turn : {0.0, -360.0, 360.0, -720.0, 720.0}) {
    const double value = first + turn;
    const bool inside = axis.modulo || (value >= axis.minimum - tolerance && value <= axis.maximum + tolerance);
    if (inside && (!best || std::abs(value - now) < std::abs(*best - now) - tolerance)) best = value;
  }
  return best;
}

/// The rotary axes in their order from the workpiece to the tool. Direction in the table = inverse of the table's
/// rotations, from the table outwards, then those of the spindle.
std::vector<Joint> rotaryJoints(const MachineDescription& machine) {
  std::vector<Joint> joints;
  for (auto element = machine.tableChain.rbegin(); element != machine.tableChain.rend(); ++element) {
    if (element->axis && machine.axes[*element->axis].kind == machine::AxisKind::Rotary) {
      joints.push_back({*element->axis, element->direction, -1});
    }
  }
  for (const machine::ChainElement& element : machine.spindleChain) {
    if (element.axis && machine.axes[*element.axis].kind == machine::AxisKind::Rotary) {
      joints.push_back({*element.axis, element.direction, 1});
    }
  }
  return joints;
}

/// Without those at the end that turn the tool about itself.
std::vector<Joint> turningJoints(const MachineDescription& machine, const Vector3& toolAxis) {
  std::vector<Joint> joints = rotaryJoints(machine);
  while (!joints.empty() && joints.back().direction.cross(toolAxis).norm() < tolerance)
    joints.pop_back();
  return joints;
}

}  // namespace

std::optional<TiltingAxis> tiltingAxis(const MachineDescription& machine, const Vector3& toolAxis) {
  const std::vector<Joint> joints = turningJoints(machine, toolAxis);
  if (joints.empty()) return std::nullopt;
  const Joint& inner = joints.back();
  if (joints.size() == 1) return TiltingAxis{inner.axis, 0};
  const Joint& outer = joints[joints.size() - 2];
  return TiltingAxis{inner.axis, inner.sign * angleAbout(inner.direction, toolAxis, outer.sign * outer.direction)};
}

std::optional<std::size_t> freeRotaryAxis(const MachineDescription& machine, const Vector3& direction,
                                          const AxisPositions& reference) {
  const std::vector<Joint> joints = rotaryJoints(machine);
  if (joints.empty()) return std::nullopt;
  const Vector3 inTable = baseFromTable(machine, reference).linear().transpose() * direction;
  if (joints.front().direction.cross(inTable).norm() > 1e-7) return std::nullopt;
  return joints.front().axis;
}

std::optional<double> alignedAngle(const MachineDescription& machine, std::size_t axis, const Vector3& along,
                                   const Vector3& target, const AxisPositions& reference, const AxisPositions& rest) {
  const std::vector<Joint> joints = rotaryJoints(machine);
  const auto joint = std::ranges::find(joints, axis, &Joint::axis);
  if (joint == joints.end()) return std::nullopt;
  AxisPositions others = rest;
  others[axis] = 0;
  double angle = 0;
  if (joint->sign < 0) {
    const Vector3 inTable = baseFromTable(machine, reference).linear().transpose() * along;
    angle = angleAbout(joint->direction, inTable, baseFromTable(machine, others).linear().transpose() * target);
  } else {
    angle = angleAbout(joint->direction, target, along);
  }
  return withinTravel(machine.axes[axis], angle, rest[axis]);
}

Matrix3 toolOrientation(const MachineDescription& machine, const AxisPositions& reference, const AxisPositions& axes) {
  return machine::baseFromTable(machine, reference).linear() *
         machine::baseFromTable(machine, axes).linear().transpose() * machine::baseFromSpindle(machine, axes).linear();
}

std::vector<AxisPositions> solveRotaryAxes(const MachineDescription& machine, const Vector3& direction,
                                           const Vector3& toolAxis, const AxisPositions& reference,
                                           const AxisPositions& now) {
  const std::vector<Joint> joints = turningJoints(machine, toolAxis);

  const Vector3 wanted = machine::baseFromTable(machine, reference).linear().transpose() * direction;
  std::vector<AxisPositions> solutions;
  const auto keep = [&](AxisPositions candidate) {
    for (const Joint& joint : joints) {
      const std::optional<double> value =
          withinTravel(machine.axes[joint.axis], candidate[joint.axis], now[joint.axis]);
      if (!value) return;
      candidate[joint.axis] = *value;
    }
    const Vector3 reached = toolOrientation(machine, reference, candidate) * toolAxis;
    if ((reached - direction).norm() > 1e-6) return;
    for (const AxisPositions& known : solutions) {
      double difference = 0;
      for (const Joint& joint : joints)
        difference = std::max(difference, std::abs(known[joint.axis] - candidate[joint.axis]));
      if (difference < 1e-7) return;
    }
    solutions.push_back(candidate);
  };

  if (joints.empty()) {
    keep(now);
    return solutions;
  }
  if (joints.size() == 1) {
    AxisPositions candidate = now;
    candidate[joints[0].axis] = joints[0].sign * angleAbout(joints[0].direction, toolAxis, wanted);
    keep(candidate);
    return solutions;
  }
  // The last two joints turn the tool; what is before them stays as it is.
  Vector3 target = wanted;
  for (std::size_t i = 0; i + 2 < joints.size(); ++i) {
    target = rotation(joints[i].direction, -joints[i].sign * now[joints[i].axis]).linear() * target;
  }
  const Joint& outer = joints[joints.size() - 2];
  const Joint& inner = joints[joints.size() - 1];
  const Vector3 a = outer.direction;
  const Vector3 b = inner.direction;
  const double ab = a.dot(b);
  const double determinant = 1 - ab * ab;
  if (determinant < tolerance) {
    AxisPositions candidate = now;
    candidate[inner.axis] =
        inner.sign * angleAbout(b, toolAxis, target) - outer.sign * inner.sign * now[outer.axis] * ab;
    keep(candidate);
    return solutions;
  }
  // The tool, turned by the inner axis alone, lies on two cones: about b as it was, about a as it will be.
  const double onA = a.dot(target);
  const double onB = b.dot(toolAxis);
  const double alpha = (onA - ab * onB) / determinant;
  const double beta = (onB - ab * onA) / determinant;
  const Vector3 inPlane = alpha * a + beta * b;
  const double rest = 1 - inPlane.squaredNorm();
  if (rest < -1e-9) return solutions;
  // Where the two solutions meet, rounding would push them apart.
  const double gamma = rest < 1e-15 ? 0 : std::sqrt(rest / determinant);
  for (const double side : {1.0, -1.0}) {
    const Vector3 between = (inPlane + side * gamma * a.cross(b)).normalized();
    AxisPositions candidate = now;
    candidate[inner.axis] = inner.sign * angleAbout(b, toolAxis, between);
    const bool free = between.cross(a).norm() < 1e-7;  // the outer axis does not matter: it goes to 0
    candidate[outer.axis] = free ? 0 : outer.sign * angleAbout(a, between, target);
    keep(candidate);
  }
  return solutions;
}

}  // namespace probewright::machine
