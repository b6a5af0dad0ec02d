#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/believed_kinematics.hpp"
#include "control/heidenhain/compensation_grid.hpp"
#include "control/heidenhain/typed_table.hpp"
#include "machine/rotary_correction.hpp"

/// The active kinematics: where the control believes the axes of rotation to be, and its table KINEMATIC.TAB.
namespace probewright::control::heidenhain {

/// All entries of axes and transformations: what cycle 450 saves and restores, and cycles 451 and 452 write.
struct KinematicData {
  /// What separates the axes from the description of the machine's builder, in the order of the machine's axes.
  std::vector<machine::RotaryCorrection> axes;
  Vector3 base = Vector3::Zero();  ///< mm, machine axes: by which the tool is further than the axes tell
  bool operator==(const KinematicData&) const = default;
};

/// An entry as table and logs show it: mm, degrees.
struct KinematicEntry {
  /// TRANS: the way from the axis before (first: the spindle nose) to this one; ROT: the compensation of its direction;
  /// AXIS: its machine datum; BASE: by which the tool is further than the axes tell.
  std::string key;
  std::string axis;  ///< X, Y, Z; with AXIS the name of the rotary axis
  double value = 0;
};

class Kinematics {
public:
  explicit Kinematics(machine::MachineDescription built);

  const machine::MachineDescription& built() const { return built_; }
  const KinematicData& data() const { return data_; }
  void set(KinematicData data) { data_ = std::move(data); }

  /// The machine that the control computes with.
  machine::MachineDescription description() const { return machine::corrected(built_, data_.axes); }

  /// Degrees between the positions of a Hirth coupling, by axis index; 0: the axis stands anywhere.
  machine::AxisPositions hirthGrid;

  /// Rotary axes from the spindle to the table.
  std::vector<std::size_t> chain() const;
  /// What `data` is as entries of the chain that begins at the spindle nose: exact, and independent of how the chain of
  /// the machine is laid.
  std::vector<KinematicEntry> entries(const KinematicData& data) const;
  /// The other way. Fails if they are not those of this machine.
  Result<KinematicData> dataOf(const std::vector<KinematicEntry>& entries) const;
  /// What identifies the description: axes and transformations, without their values.
  std::string identifier() const;
  /// The point of the axis that the entries lead to, from the spindle nose with all axes at 0, mm.
  Vector3 pointOf(const KinematicData& data, std::size_t axis) const;

  /// DATA450.KD, where it exists.
  std::optional<TypedTable> saved;
  /// The compensation of cycle 453, *.KCO, where the machine's builder has made one.
  std::optional<CompensationGrid> grid;
  std::optional<TypedTable> gridTable;
  /// The kinematics is of a file, or was changed: it outlives the run.
  bool tabled = false;

private:
  machine::MachineDescription built_;
  KinematicData data_;
};

class Control;

/// Puts `data` into effect and notes every entry of KINEMATIC.TAB that changes. Equal values are not written.
void changeKinematics(Control& control, const KinematicData& data);

}  // namespace probewright::control::heidenhain
