#include "control/sinumerik/frame.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "control/sinumerik/text.hpp"

namespace probewright::control::sinumerik {

namespace {

constexpr std::array<std::string_view, 3> geometryNames = {"X", "Y", "Z"};

/// Angles closer to the pole than this (as cosine of Y) leave X and Z undetermined.
constexpr double poleCosine = 2e-9;

/// Relative size of what may be rounding when a map is taken apart.
constexpr double shearTolerance = 1e-9;

FrameAxis* axisOf(Frame& frame, std::string_view axis) {
  if (const auto index = geometryAxisOf(axis)) return &frame.geometry[*index];
  return &frame.others[upperCase(axis)];
}

bool isLinearNeutral(const FrameAxis& axis) { return axis.rotation == 0 && axis.scale == 1 && !axis.mirror; }

std::array<bool, 3> mirrorsOf(const Frame& outer, const Frame& inner) {
  std::array<bool, 3> mirrors = {};
  for (std::size_t i = 0; i < 3; ++i)
    mirrors[i] = outer.geometry[i].mirror != inner.geometry[i].mirror;
  return mirrors;
}

double valueOf(const FrameAxis& axis, FramePart part) {
  switch (part) {
    case FramePart::Translation:
      return axis.coarse;
    case FramePart::Fine:
      return axis.fine;
    case FramePart::Rotation:
      return axis.rotation;
    case FramePart::Scale:
      return axis.scale;
    case FramePart::Mirror:
      break;
  }
  return axis.mirror ? 1 : 0;
}

void setValue(FrameAxis& axis, FramePart part, double value) {
  switch (part) {
    case FramePart::Translation:
      axis.coarse = value;
      return;
    case FramePart::Fine:
      axis.fine = value;
      return;
    case FramePart::Rotation:
      axis.rotation = value;
      return;
    case FramePart::Scale:
      axis.scale = value;
      return;
    case FramePart::Mirror:
      axis.mirror = value != 0;
  }
}

/// Solid angles: two traces span the new plane; the first one is an axis of the new system.
Result<Matrix3> rotationFromSolidAngles(std::size_t first, double firstDegrees, double secondDegrees) {
  // First named axis k, second named axis k + 1. The new axis k is the old one turned about axis k + 1; the other trace
  // is the old axis k + 1 turned about axis k.
  const std::size_t second = (first + 1) % 3;
  const auto unit = [](std::size_t axis) -> Vector3 {
    return Matrix3::Identity().col(static_cast<Eigen::Index>(axis));
  };
  const Vector3 newFirst = rotation(unit(second), secondDegrees) * unit(first);
  const Vector3 trace = rotation(unit(first), firstDegrees) * unit(second);
  const Vector3 normal = newFirst.cross(trace);
  if (normal.norm() < 1e-9) return fail("these solid angles give no plane", "choose angles of less than 90 degrees");
  Matrix3 result;
  result.col(static_cast<Eigen::Index>(first)) = newFirst;
  result.col(static_cast<Eigen::Index>((first + 2) % 3)) = normal.normalized();
  result.col(static_cast<Eigen::Index>(second)) = normal.normalized().cross(newFirst);
  return result;
}

}  // namespace

std::string_view name(FramePart part) {
  constexpr std::array<std::string_view, 5> names = {"TR", "FI", "RT", "SC", "MI"};
  return names[static_cast<std::size_t>(part)];
}

std::optional<FramePart> framePartOf(std::string_view text) {
  const std::string upper = upperCase(text);
  for (const FramePart part : allFrameParts) {
    if (name(part) == upper) return part;
  }
  return std::nullopt;
}

std::optional<std::size_t> geometryAxisOf(std::string_view axis) {
  const std::string upper = upperCase(axis);
  const auto found = std::find(geometryNames.begin(), geometryNames.end(), upper);
  if (found == geometryNames.end()) return std::nullopt;
  return static_cast<std::size_t>(found - geometryNames.begin());
}

double Frame::get(std::string_view axis, FramePart part) const {
  if (const auto index = geometryAxisOf(axis)) return valueOf(geometry[*index], part);
  const auto found = others.find(upperCase(axis));
  return valueOf(found == others.end() ? FrameAxis() : found->second, part);
}

void Frame::set(std::string_view axis, FramePart part, double value) { setValue(*axisOf(*this, axis), part, value); }

Matrix3 rotationFromRpy(const Vector3& degrees) {
  return (rotation(Vector3::UnitZ(), degrees.z()) * rotation(Vector3::UnitY(), degrees.y()) *
          rotation(Vector3::UnitX(), degrees.x()))
      .linear();
}

Vector3 rpyFromRotation(const Matrix3& r) {
  const double cosineY = std::hypot(r(0, 0), r(1, 0));
  const double y = std::atan2(-r(2, 0), cosineY);
  Vector3 angles;
  if (cosineY < poleCosine) {
    angles = {0.0, y, std::atan2(-r(0, 1), r(1, 1))};
  } else {
    angles = {std::atan2(r(2, 1), r(2, 2)), y, std::atan2(r(1, 0), r(0, 0))};
  }
  for (double& angle : angles)
    angle = degreesFromRadians(angle);
  // atan2 gives -180 for a negative zero.
  for (double& angle : angles) {
    if (angle == -180.0) angle = 180.0;
    if (angle == 0.0) angle = 0.0;
  }
  return angles;
}

Eigen::Affine3d transform(const Frame& frame) {
  Vector3 angles, diagonal;
  for (std::size_t i = 0; i < 3; ++i) {
    const FrameAxis& axis = frame.geometry[i];
    angles[static_cast<Eigen::Index>(i)] = axis.rotation;
    diagonal[static_cast<Eigen::Index>(i)] = axis.mirror ? -axis.scale : axis.scale;
  }
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() = rotationFromRpy(angles) * diagonal.asDiagonal();
  map.translation() = frame.translation();
  return map;
}

Result<Frame> frameFromTransform(const Eigen::Affine3d& map, std::array<bool, 3> mirrors) {
  const Matrix3 linear = map.linear();
  const Vector3 scale = linear.colwise().norm();
  if (!map.matrix().allFinite() || !(scale.minCoeff() > 0)) {
    return fail("this transform has no inverse and makes no frame", "use scale factors other than 0");
  }
  const Matrix3 unit = linear * scale.cwiseInverse().asDiagonal();
  const Matrix3 shear = unit.transpose() * unit - Matrix3::Identity();
  if (shear.cwiseAbs().maxCoeff() > shearTolerance) {
    return fail("unequal scale factors before a rotation shear the coordinate system; no frame can hold that",
                "scale all axes alike, or rotate before scaling");
  }
  const bool mirrored = unit.determinant() < 0;
  if (((mirrors[0] != mirrors[1]) != mirrors[2]) != mirrored) mirrors = {mirrored, false, false};
  Matrix3 rotation = unit;
  Frame frame;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (mirrors[i]) rotation.col(column) *= -1;
    frame.geometry[i].mirror = mirrors[i];
    frame.geometry[i].scale = std::abs(scale[column] - 1) < 1e-14 ? 1 : scale[column];
    frame.geometry[i].coarse = map.translation()[column];
  }
  const Vector3 angles = rpyFromRotation(rotation);
  for (std::size_t i = 0; i < 3; ++i)
    frame.geometry[i].rotation = angles[static_cast<Eigen::Index>(i)];
  return frame;
}

Result<Frame> chain(const Frame& outer, const Frame& inner) {
  Frame result;
  const bool outerOnlyShifts = std::all_of(outer.geometry.begin(), outer.geometry.end(), isLinearNeutral);
  const bool innerOnlyShifts = std::all_of(inner.geometry.begin(), inner.geometry.end(), isLinearNeutral);
  if (outerOnlyShifts || innerOnlyShifts) {
    // Nothing to multiply: the angles stay as they were entered.
    result.geometry = outerOnlyShifts ? inner.geometry : outer.geometry;
  } else {
    auto product = frameFromTransform(transform(outer) * transform(inner), mirrorsOf(outer, inner));
    if (!product) return product;
    result = *product;
  }
  const Vector3 total = (transform(outer) * transform(inner)).translation();
  for (std::size_t i = 0; i < 3; ++i) {
    FrameAxis& axis = result.geometry[i];
    axis.fine = outer.geometry[i].fine + (outerOnlyShifts ? inner.geometry[i].fine : 0.0);
    axis.coarse = outerOnlyShifts ? outer.geometry[i].coarse + inner.geometry[i].coarse
                                  : total[static_cast<Eigen::Index>(i)] - axis.fine;
  }
  result.others = outer.others;
  for (const auto& [axis, added] : inner.others) {
    FrameAxis& sum = result.others[axis];
    const double factor = sum.mirror ? -sum.scale : sum.scale;
    sum.coarse += factor * added.coarse;
    sum.fine += factor * added.fine;
    sum.scale *= added.scale;
    sum.mirror = sum.mirror != added.mirror;
  }
  return result;
}

Result<Frame> frameFunction(std::string_view function, std::span<const AxisValue> arguments) {
  const std::string upper = upperCase(function);
  constexpr std::array<std::pair<std::string_view, FramePart>, 6> functions = {{{"CTRANS", FramePart::Translation},
                                                                                {"CFINE", FramePart::Fine},
                                                                                {"CROT", FramePart::Rotation},
                                                                                {"CROTS", FramePart::Rotation},
                                                                                {"CSCALE", FramePart::Scale},
                                                                                {"CMIRROR", FramePart::Mirror}}};
  const auto* const found =
      std::find_if(functions.begin(), functions.end(), [&](const auto& entry) { return entry.first == upper; });
  if (found == functions.end()) {
    return fail(fmt::format("{} is not a frame function", upper),
                "known are CTRANS, CFINE, CROT, CROTS, CSCALE, CMIRROR");
  }
  const FramePart part = found->second;
  Frame frame;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string axis = upperCase(arguments[i].axis);
    const double value = part == FramePart::Mirror ? 1 : arguments[i].value;
    for (std::size_t k = 0; k < i; ++k) {
      if (upperCase(arguments[k].axis) == axis) return fail(fmt::format("{} names axis {} twice", upper, axis));
    }
    if (part == FramePart::Rotation && !geometryAxisOf(axis)) {
      return fail(fmt::format("{} rotates about geometry axes only, not about {}", upper, axis), "use X, Y or Z");
    }
    if (!std::isfinite(value) || (part == FramePart::Scale && value == 0)) {
      return fail(fmt::format("{} cannot take this value for axis {}", upper, axis));
    }
    frame.set(axis, part, value);
    // A negative factor mirrors.
    if (part == FramePart::Scale && value < 0) {
      frame.set(axis, part, -value);
      frame.set(axis, FramePart::Mirror, 1);
    }
  }
  if (upper == "CROTS" && arguments.size() > 1) {
    if (arguments.size() > 2) return fail("CROTS takes at most two solid angles");
    std::size_t first = *geometryAxisOf(arguments[0].axis);
    const std::size_t second = *geometryAxisOf(arguments[1].axis);
    const bool inOrder = second == (first + 1) % 3;
    const AxisValue& a = inOrder ? arguments[0] : arguments[1];
    const AxisValue& b = inOrder ? arguments[1] : arguments[0];
    if (!inOrder) first = second;
    const auto solid = rotationFromSolidAngles(first, a.value, b.value);
    if (!solid) return tl::unexpected(solid.error());
    const Vector3 angles = rpyFromRotation(*solid);
    for (std::size_t i = 0; i < 3; ++i)
      frame.geometry[i].rotation = angles[static_cast<Eigen::Index>(i)];
  }
  return frame;
}

std::string frameExpression(const Frame& frame) {
  constexpr std::array<std::string_view, 5> functions = {"CTRANS", "CFINE", "CROT", "CSCALE", "CMIRROR"};
  std::string text;
  for (const FramePart part : allFrameParts) {
    const double neutral = part == FramePart::Scale ? 1 : 0;
    std::string list;
    const auto append = [&](std::string_view axis, const FrameAxis& values) {
      const double value = valueOf(values, part);
      if (value == neutral) return;
      if (!list.empty()) list += ',';
      list += axis;
      if (part != FramePart::Mirror) list += fmt::format(",{}", numberText(value));
    };
    for (std::size_t i = 0; i < 3; ++i)
      append(geometryNames[i], frame.geometry[i]);
    for (const auto& [axis, values] : frame.others)
      append(axis, values);
    if (list.empty()) continue;
    if (!text.empty()) text += ':';
    text += fmt::format("{}({})", functions[static_cast<std::size_t>(part)], list);
  }
  return text.empty() ? "CTRANS()" : text;
}

}  // namespace probewright::control::sinumerik
