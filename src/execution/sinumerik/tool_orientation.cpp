#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "control/alarm.hpp"
#include "execution/sinumerik/motion.hpp"
#include "execution/sinumerik/spindle_speed.hpp"
#include "execution/sinumerik/swivel.hpp"
#include "language/sinumerik/check.hpp"

/// Words that motions have besides axes and arcs: the direction of the tool under TRAORI, the pitch of threads.
namespace probewright::execution::sinumerik {

using control::Alarm;

bool PathMotion::readOrientationWord(std::uint32_t address, double value, Words& words) {
  if (machineAxis(address)) return false;
  if (const std::string_view skipped = skippedMoveWord(address); !skipped.empty()) {
    if (onIgnoredWord) onIgnoredWord(skipped);
    return true;
  }
  const std::string name = addressName(address);
  if (name.size() != 2 || name[0] < 'A' || name[0] > 'C') return false;
  const auto place = static_cast<std::size_t>(name[0] - 'A');
  if (name[1] == '3') {
    words.direction[place] = value;
  } else if (name[1] == '2') {
    words.angles[place] = value;
  } else {
    return false;
  }
  return true;
}

/// A3, B3, C3 are the tool's direction in the workpiece; A2, B2, C2 turn the Z axis into it. The rotary axes take the
/// posture that is nearest.
void PathMotion::resolveOrientation(Words& words) const {
  const auto given = [](const auto& three) { return three[0] || three[1] || three[2]; };
  const bool vector = given(words.direction);
  if (!vector && !given(words.angles)) return;
  if (!control_.transformation)
    throw Alarm("14100", "A2, B2, C2 and A3, B3, C3 orient the tool, and no transformation is active",
                "program TRAORI before them, or the rotary axes themselves");
  if (vector && given(words.angles))
    throw Alarm("14110", "a block orients the tool by a vector and by angles", "write A3, B3, C3 or A2, B2, C2");
  if (words.anyRotary)
    throw Alarm("14111", "a block orients the tool and moves rotary axes", "write the one or the other");
  Vector3 direction = Vector3::UnitZ();
  if (vector) {
    for (std::size_t i = 0; i < 3; ++i)
      direction[static_cast<Eigen::Index>(i)] = words.direction[i].value_or(0);
    if (direction.norm() < 1e-9)
      throw Alarm("14112", "the vector A3, B3, C3 has no length", "write the direction in which the tool points");
  } else {
    const auto turn = [&](std::size_t place, const Vector3& axis) {
      return Matrix3(rotation(axis, words.angles[place].value_or(0)).linear());
    };
    const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
    if (!state_.rpyAngles) {
      direction = turn(0, z) * turn(1, x) * turn(2, z) * z;
    } else if (state_.rpyAboutX) {
      direction = turn(0, x) * turn(1, y) * turn(2, z) * z;
    } else {
      direction = turn(2, z) * turn(1, y) * turn(0, x) * z;
    }
  }
  const control::Channel& channel = control_.channel;
  const machine::MachineDescription& machine = channel.description();
  const AxisPositions now = channel.axes();
  const Vector3 wanted = (control_.machineFromWorkpiece().linear() * direction).normalized();
  const std::vector<AxisPositions> postures = toolPostures(machine, channel.rotaryOffset, now, wanted);
  if (postures.empty())
    throw Alarm("14112", "the rotary axes cannot point the tool in this direction within their travels",
                "check A3, B3, C3 or A2, B2, C2, and the travels of the rotary axes");
  const AxisPositions& posture = postures.front();
  for (std::size_t axis = 0; axis < machine.axes.size(); ++axis) {
    const machine::Axis& description = machine.axes[axis];
    if (description.kind != machine::AxisKind::Rotary) continue;
    // The shortest way, if the travel has room for it.
    const double near = now[axis] + normalizedDegrees(posture[axis] - now[axis]);
    const bool inside = description.modulo || (near >= description.minimum && near <= description.maximum);
    words.target.rotary[axis] = (inside ? near : posture[axis]) - channel.rotaryOffset[axis];
    words.anyRotary = true;
  }
}

/// The feed along the way, mm/min: the tool goes on by the pitch I, J or K with each turn.
double PathMotion::threadFeed(const Words& words, const Vector3& way) {
  double share = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!words.centre[i]) continue;
    const double along = std::abs(way[static_cast<Eigen::Index>(i)]);
    state_.pitch = std::abs(words.centre[i]->second);
    share = along > 1e-9 ? way.norm() / along : 1;
  }
  if (!(state_.pitch > 0))
    throw Alarm("16720", fmt::format("G{} has no pitch", state_.thread), "write it as K, I or J: G33 Z-20 K1.5");
  const double speed = spindleSpeedAt(state_, control_.channel.position());
  if (!(speed > 0))
    throw Alarm("16710", fmt::format("G{} needs the speed of the spindle", state_.thread), "program S before it");
  return state_.pitch * share * speed;
}

}  // namespace probewright::execution::sinumerik
