#include "control/heidenhain/kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace probewright::control::heidenhain {

namespace {

constexpr std::array<const char*, 3> linearNames = {"X", "Y", "Z"};

void addVector(std::vector<KinematicEntry>& entries, const char* key, const Vector3& vector) {
  for (std::size_t i = 0; i < 3; ++i)
    entries.push_back({key, linearNames[i], vector[static_cast<Eigen::Index>(i)]});
}

Vector3 pointOf(const machine::MachineDescription& machine, std::size_t axis) {
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
    const Vector3 point = pointOf(built_, axis) + correction.position;
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
    correction->position = point - pointOf(built_, axis);
    correction->orientation = vector();
    correction->zero = (entry++)->value;
  }
  data.base = vector();
  return data;
}

std::string Kinematics::identifier() const {
  std::string text;
  for (const std::size_t axis : chain())
    text += built_.axes[axis].name;
  return text.empty() ? "XYZ" : text;
}

}  // namespace probewright::control::heidenhain
