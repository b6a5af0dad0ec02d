#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/text.hpp"
#include "cycles/sinumerik/corrections.hpp"

namespace probewright::cycles::sinumerik {

using control::Alarm;
using control::sinumerik::DataIndex;
using control::sinumerik::DataKey;
using control::sinumerik::Frame;
using control::sinumerik::FramePart;

namespace {

constexpr int settableRank = 1000;
constexpr int channelRank = 100;
constexpr int globalRank = 1;

/// The place of a frame in the chain, from the outside in.
int rankOf(const FrameTarget& target) {
  if (target.name == "$P_SETFR") return 0;
  if (target.name == "$P_NCBFR") return globalRank + target.number.value_or(0);
  if (target.name == "$P_CHBFR") return channelRank + target.number.value_or(0);
  return settableRank;
}

DataKey keyOf(const FrameTarget& target) {
  std::vector<DataIndex> indices;
  if (target.number) indices.emplace_back(*target.number);
  return {target.name, indices};
}

void writeComponent(Context& context, const FrameTarget& target, std::string_view axis, FramePart part, double value) {
  std::vector<DataIndex> indices;
  if (target.number) indices.emplace_back(*target.number);
  indices.emplace_back(axis);
  indices.emplace_back(name(part));
  context.control().write(DataKey(target.name, indices), value);
}

/// The chain with the target in its place: machine from workpiece = before * own * after.
struct ChainAround {
  Eigen::Affine3d before = Eigen::Affine3d::Identity();
  Frame own;
  Eigen::Affine3d after = Eigen::Affine3d::Identity();
  Eigen::Affine3d whole() const { return before * transform(own) * after; }
};

ChainAround chainAround(const Control& control, const FrameTarget& target) {
  ChainAround chain;
  chain.own = control.data.frame(keyOf(target));
  const int own = rankOf(target);
  const auto add = [&](int rank, const Frame& frame) {
    if (rank < own) chain.before = chain.before * transform(frame);
    if (rank > own) chain.after = chain.after * transform(frame);
  };
  add(0, control.data.frame("$P_SETFR", {}));
  for (const DataKey& key : control.baseFrameKeys()) {
    const int number = static_cast<int>(parseInteger(key.indices.front()).value_or(0));
    add((key.name == "$P_NCBFR" ? globalRank : channelRank) + number, control.data.frame(key));
  }
  add(settableRank, control.frames.settableFrame);
  chain.after = chain.after * transform(control.frames.toolOriented) * transform(control.frames.programmed);
  return chain;
}

Matrix3 xyzFromPlaneMatrix(const Context& context) {
  const control::WorkingPlane plane = context.control().workingPlane();
  Matrix3 matrix;
  for (int axis = 0; axis < 3; ++axis)
    matrix.col(axis) = plane.xyzFromPlane(PlaneWay::unit(axis)).vector();
  return matrix;
}

void noteCorrection(Context& context, const FrameTarget& target) {
  context.control().applyFrames();
  context.resultInteger(0, target.shown);
  context.resultInteger(11, 1);
}

/// A rotary axis takes fine offsets where bit 6 of MD 52207 releases it; a machine without the datum releases all.
bool hasFineOffset(const Control& control, std::size_t axis) {
  const DataKey key("$MCS_AXIS_USAGE_ATTRIB", {static_cast<int>(axis)});
  return !control.data.isSet(key) || (truncated<long>(control.data.number(key)) >> 6 & 1) != 0;
}

constexpr std::array<std::string_view, 3> axisNames = {"X", "Y", "Z"};

}  // namespace

std::optional<FrameTarget> frameTarget(Context& context, GlobalBase globalBase) {
  const int code = context.integer("S_KNUM");
  if (code == 0) return std::nullopt;
  const Control& control = context.control();
  const int number = code % 100;
  const int kind = context.digit("S_KNUM", 4);
  const int fine = context.digit("S_KNUM", 5);
  if (code < 0 || code >= 100000) context.alarm(61324, fmt::format("S_KNUM = {}", code));
  if (context.digit("S_KNUM", 3) != 0) context.alarm(61321, fmt::format("hundreds of S_KNUM = {}", code));
  if (fine > 1) context.alarm(61323, fmt::format("S_KNUM = {}", code));
  // Nothing to correct is named; the base reference and the active frame have no number.
  if (number == 0 && (kind == 0 || kind == 1 || kind == 3)) return std::nullopt;
  FrameTarget target;
  target.coarse = fine == 1 || control.machineData("$MN_MM_FRAME_FINE_TRANS", 1) == 0;
  target.shown = code % 10000;
  const auto baseNumber = [&] {
    if (number < 1 || number > 16) context.alarm(61321, fmt::format("base frame {}: 1 to 16 are possible", number));
    return number - 1;
  };
  switch (kind) {
    case 0: {
      const int count = truncated(control.machineData("$MC_MM_NUM_USER_FRAMES", 100));
      if (number < 1 || number >= count) {
        context.alarm(61321, fmt::format("settable zero offset {}: 1 to {} are possible", number, count - 1));
      }
      target.name = "$P_UIFR";
      target.number = number;
      return target;
    }
    case 1:
      target.name = "$P_CHBFR";
      target.number = baseNumber();
      return target;
    case 2:
      target.name = "$P_SETFR";
      return target;
    case 3:
      if (globalBase == GlobalBase::Refused)
        context.alarm(61322, "this variant has no correction of global base frames");
      target.name = "$P_NCBFR";
      target.number = baseNumber();
      return target;
    case 9: {
      if (control.frames.settable > 0) {
        target.name = "$P_UIFR";
        target.number = control.frames.settable;
        target.shown = control.frames.settable;
        return target;
      }
      target.name = "$P_CHBFR";
      target.number = 0;
      for (const DataKey& key : control.baseFrameKeys()) {
        if (key.name == "$P_CHBFR") target.number = static_cast<int>(parseInteger(key.indices.front()).value_or(0));
      }
      target.shown = 1001 + *target.number;
      return target;
    }
    default:
      context.alarm(61322, fmt::format("S_KNUM = {}", code));
  }
}

PartInMachine machinePoint(Context& context, const PartPoint& point) {
  const Control& control = context.control();
  return PartInMachine(control.machineFromWorkpiece() * control.workingPlane().xyzFromPlane(point).vector());
}

void correctTranslation(Context& context, const FrameTarget& target, const PartInMachine& feature, const PartPoint& set,
                        std::span<const PlaneWay> directions) {
  const ChainAround chain = chainAround(context.control(), target);
  const Matrix3 xyzFromPlane = xyzFromPlaneMatrix(context);
  const Vector3 present = chain.whole().inverse() * feature.vector();
  const Vector3 error = present - xyzFromPlane * set.vector();
  Vector3 shift = Vector3::Zero();
  for (const PlaneWay& direction : directions) {
    const Vector3 along = xyzFromPlane * direction.vector();
    shift += along * along.dot(error);
  }
  // The feature F lies at p = (B O A)^-1 F, with the frames before (B), own (O) and after (A). A shift c of the own
  // frame makes O' = T(c) O, and so p' = (O A)^-1 T(-c) B^-1 F = p - lin(O A)^-1 c. That is to be p - shift: c = lin(O)
  // lin(A) shift.
  const Vector3 change = transform(chain.own).linear() * chain.after.linear() * shift;
  const FramePart part = target.coarse ? FramePart::Translation : FramePart::Fine;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(change[axis]) < 1e-10) continue;
    const std::string_view name = axisNames[static_cast<std::size_t>(axis)];
    writeComponent(context, target, name, part, chain.own.get(name, part) + change[axis]);
  }
  noteCorrection(context, target);
}

void correctRotation(Context& context, const FrameTarget& target, const Matrix3& turn) {
  if (target.name == "$P_NCBFR") context.alarm(61322, "global base frames have no rotation");
  const ChainAround chain = chainAround(context.control(), target);
  const Matrix3 xyzFromPlane = xyzFromPlaneMatrix(context);
  const Matrix3 turned =
      context.control().machineFromWorkpiece().linear() * xyzFromPlane * turn * xyzFromPlane.transpose();
  // The workpiece W = B O A is to be turned in its plane: B O' A = W turn, so O' = B^-1 (W turn) A^-1.
  Eigen::Affine3d own = Eigen::Affine3d::Identity();
  own.linear() = chain.before.linear().inverse() * turned * chain.after.linear().inverse();
  const std::array mirrors = {chain.own.geometry[0].mirror, chain.own.geometry[1].mirror, chain.own.geometry[2].mirror};
  const Result<Frame> frame = control::sinumerik::frameFromTransform(own, mirrors);
  if (!frame) throw Alarm("18314", "Frames cannot be chained: " + frame.error().message, frame.error().advice);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double angle = frame->geometry[axis].rotation;
    if (std::abs(angle - chain.own.geometry[axis].rotation) < 1e-10) continue;
    writeComponent(context, target, axisNames[axis], FramePart::Rotation, std::abs(angle) < 1e-12 ? 0 : angle);
  }
  noteCorrection(context, target);
}

namespace {

/// By how many degrees the part turns about `direction` when the axis turns by one.
double rotaryEffect(Context& context, std::size_t axis, const PlaneWay& direction) {
  const Control& control = context.control();
  const machine::MachineDescription& description = context.channel().description();
  if (axis >= description.axes.size() || description.axes[axis].kind != machine::AxisKind::Rotary) {
    context.alarm(61329, fmt::format("channel axis {} is not a rotary axis (S_RA)", axis + 1));
  }
  machine::AxisPositions here = context.channel().axes();
  machine::AxisPositions turned = here;
  turned[axis] += 1;
  const Matrix3 turn =
      baseFromTable(description, turned).linear() * baseFromTable(description, here).linear().transpose();
  const Eigen::AngleAxisd perDegree(turn);
  const Vector3 about =
      (control.machineFromWorkpiece().linear() * control.workingPlane().xyzFromPlane(direction).vector()).normalized();
  const double effect = degreesFromRadians(perDegree.angle()) * perDegree.axis().dot(about);
  if (std::abs(effect) < 0.999) {
    context.alarm(61329, fmt::format("axis {} does not turn the workpiece about the axis at right angles to measuring "
                                     "and offset axis (S_RA)",
                                     description.axes[axis].name));
  }
  return effect;
}

}  // namespace

void requireRotaryAxis(Context& context, std::size_t axis, const PlaneWay& direction) {
  rotaryEffect(context, axis, direction);
}

void correctRotaryAxis(Context& context, const FrameTarget& target, std::size_t axis, const PlaneWay& direction,
                       double angle) {
  const Control& control = context.control();
  const double effect = rotaryEffect(context, axis, direction);
  const bool fine = !target.coarse && hasFineOffset(control, axis);
  const FramePart part = fine ? FramePart::Fine : FramePart::Translation;
  const std::string name = upperCase(context.channel().description().axes[axis].name);
  // The part stands askew by `angle`; d degrees of the axis turn it by effect * d: effect * d = -angle makes it
  // straight.
  const double old = control.data.frame(keyOf(target)).get(name, part);
  writeComponent(context, target, name, part, old - angle / effect);
  noteCorrection(context, target);
}

}  // namespace probewright::cycles::sinumerik
