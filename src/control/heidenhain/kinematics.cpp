#include "control/heidenhain/kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/number_text.hpp"
#include "control/heidenhain/control.hpp"
#include "control/heidenhain/kinematic_tables.hpp"

namespace probewright::control::heidenhain {

namespace {

constexpr std::array<const char*, 3> linearNames = {"X", "Y", "Z"};

void addVector(std::vector<KinematicEntry>& entries, const char* key, const Vector3& vector) {
  for (std::size_t i = 0; i < 3; ++i)
    entries.push_back({key, linearNames[i], vector[static_cast<Eigen::Index>(i)]});
}

Vector3 builtPoint(const machine::MachineDescription& machine, std::size_t axis) {
  for (const auto* chain : {&machine.spindleChain, &machine.tableChain}) {
    for (const machine::ChainElement& element : *chain) {
      if (element.axis == axis) return element.point;
    }
  }
  return Vector3::Zero();
}

}  // namespace

Kinematics::Kinematics(machine::MachineDescription built)
    : built_(std::move(built)), data_{believedCorrections(built_, {}), Vector3::Zero()} {}

std::vector<std::size_t> Kinematics::chain() const {
  std::vector<std::size_t> axes;
  const auto add = [&](const machine::ChainElement& element) {
    if (element.axis && built_.axes[*element.axis].kind == machine::AxisKind::Rotary) axes.push_back(*element.axis);
  };
  std::for_each(built_.spindleChain.rbegin(), built_.spindleChain.rend(), add);
  std::ranges::for_each(built_.tableChain, add);
  return axes;
}

std::vector<KinematicEntry> Kinematics::entries(const KinematicData& data) const {
  std::vector<KinematicEntry> entries;
  Vector3 last = Vector3::Zero();
  for (const std::size_t axis : chain()) {
    const auto found = std::ranges::find(data.axes, axis, &machine::RotaryCorrection::axis);
    const machine::RotaryCorrection correction = found == data.axes.end() ? machine::RotaryCorrection{} : *found;
    const Vector3 point = builtPoint(built_, axis) + correction.position;
    addVector(entries, "TRANS", point - last);
    addVector(entries, "ROT", correction.orientation);
    entries.push_back({"AXIS", built_.axes[axis].name, correction.zero});
    last = point;
  }
  addVector(entries, "BASE", data.base);
  return entries;
}

Result<KinematicData> Kinematics::dataOf(const std::vector<KinematicEntry>& entries) const {
  const std::vector<KinematicEntry> own = this->entries(data_);
  if (entries.size() != own.size()) {
    return fail(fmt::format("these are {} entries; the kinematics of this machine has {}", entries.size(), own.size()));
  }
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (entries[i].key == own[i].key && entries[i].axis == own[i].axis) continue;
    return fail(fmt::format("entry {} is {} {}; that of this machine is {} {}", i, entries[i].key, entries[i].axis,
                            own[i].key, own[i].axis));
  }
  auto entry = entries.begin();
  const auto vector = [&] {
    Vector3 read;
    for (double& value : read)
      value = (entry++)->value;
    return read;
  };
  KinematicData data = data_;
  Vector3 point = Vector3::Zero();
  for (const std::size_t axis : chain()) {
    const auto correction = std::ranges::find(data.axes, axis, &machine::RotaryCorrection::axis);
    point += vector();
    correction->position = point - builtPoint(built_, axis);
    correction->orientation = vector();
    correction->zero = (entry++)->value;
  }
  data.base = vector();
  return data;
}

Vector3 Kinematics::pointOf(const KinematicData& data, std::size_t axis) const {
  const auto found = std::ranges::find(data.axes, axis, &machine::RotaryCorrection::axis);
  return builtPoint(built_, axis) + (found == data.axes.end() ? Vector3(Vector3::Zero()) : found->position);
}

std::string Kinematics::identifier() const {
  std::string text;
  for (const std::size_t axis : chain())
    text += built_.axes[axis].name;
  return text.empty() ? "XYZ" : text;
}

void changeKinematics(Control& control, const KinematicData& data) {
  Kinematics& kinematics = *control.kinematics;
  const std::vector<KinematicEntry> before = kinematics.entries(kinematics.data()), after = kinematics.entries(data);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::string old = formatFixed(before[i].value, 9), now = formatFixed(after[i].value, 9);
    if (old != now) control.journal.write({kinematicTableName, fmt::format("row {}, column VALUE", i), old, now});
  }
  kinematics.set(data);
  kinematics.tabled = true;
  control.applyKinematics();
}

}  // namespace probewright::control::heidenhain
