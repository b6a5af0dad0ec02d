#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/diagnostic.hpp"
#include "control/sinumerik/data_store.hpp"
#include "geometry/primitives.hpp"
#include "machine/description.hpp"

/// How a SINUMERIK control keeps the kinematics of its machine: orientable tool carriers, which are the swivel data
/// sets of CYCLE800 ($TC_CARR1[n] to $TC_CARR60[n]), and the machine data of TRAORI ($MC_TRAFO5_...).
namespace probewright::control::sinumerik {

/// The vectors of a swivel data set, machine coordinates with the rotary axes in the basic setting, mm. With M the
/// readings of X, Y, Z, t from the tool tip to the tool adapter, p the tip in workpiece coordinates and R(V, a) the
/// rotation about V by the angle a of a rotary axis:
///
///   Head   M = p + I1 + R(V1, a1) (I2 + R(V2, a2) (I3 + t))
///   Table  M - t = I2 + R(V1, a1) (I3 + R(V2, a2) (I4 + p))
///   Mixed  M = c + I1 + R(V1, a1) (I2 + t),  c = I3 + R(V2, a2) (I4 + p)
///
/// A rotary axis of the table turns the workpiece about its V: (0, 0, -1) for an axis C as ISO 841 has it.
struct ToolCarrier {
  enum class Kind : char { Head = 'T', Table = 'P', Mixed = 'M' };

  Kind kind = Kind::Table;
  std::array<Vector3, 4> offset{Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};  ///< I1 to I4
  std::array<Vector3, 2> axis{Vector3::Zero(), Vector3::Zero()};  ///< V1, V2; 0 where there is no such axis
  std::array<double, 2> basicSetting{};                           ///< $TC_CARR24, 25: degrees of the rotary axes there
  std::array<std::string, 2> axisName;                            ///< $TC_CARR35, 36, capitals; may be empty
  std::string name;                                               ///< $TC_CARR34

  /// Rotary axes that it has: 0 to 2.
  int axes() const { return axis[0].isZero() ? 0 : axis[1].isZero() ? 1 : 2; }
  /// True if rotary axis 0 or 1 turns the tool.
  bool inHead(int which) const { return kind == Kind::Head || (kind == Kind::Mixed && which == 0); }
};

/// Data of a swivel data set by number: $TC_CARR`datum`[`carrier`].
DataKey carrierDatum(int datum, int carrier);
/// The first of the three data of an offset vector (0: I1, to 3: I4) and of an axis vector (0: V1, 1: V2).
constexpr int firstDatumOfOffset(int vector) { return vector < 2 ? 1 + 3 * vector : 9 + 3 * vector; }
constexpr int firstDatumOfAxis(int axis) { return 7 + 3 * axis; }

/// Swivel data set `number`; nothing where its kind ($TC_CARR23) is not set. The fine offsets $TC_CARR41 to 60 count
/// with SD 42974.
std::optional<ToolCarrier> toolCarrier(const DataStore& store, int number);
/// Enters a data set with all its vectors and names; neither a correction nor noted.
void loadCarrier(DataStore& store, int number, const ToolCarrier& carrier);
/// The number of the data set called `name` (case does not matter); nothing if there is none.
std::optional<int> carrierNamed(const DataStore& store, const std::string& name);

/// What TRAORI computes with: the data set that MD 24582 names for type 72, the vectors of the machine data for types
/// 24, 40 and 56; data set 1 where MD 24100 says nothing. Nothing for the types that know neither.
std::optional<ToolCarrier> transformationCarrier(const DataStore& store);

/// A machine with one or two rotary axes as a data set: closed, each vector to the point of its axis that the machine
/// names. Nothing for machines that no data set describes: another number of rotary axes, one that is the main spindle,
/// one that carries a linear axis.
std::optional<ToolCarrier> carrierOf(const machine::MachineDescription& machine);

/// `machine` with the rotary axes where the data set has them, whether its chains of vectors close or not.
Result<machine::MachineDescription> withCarrier(machine::MachineDescription machine, const ToolCarrier& carrier);

}  // namespace probewright::control::sinumerik
