#pragma once

#include <cstdint>
#include <string_view>

/// What a value that a cycle leaves is, as data. Logs, summaries, results files and exchange formats go by this; the
/// English text beside it is only its label.
namespace probewright::control {

/// What a value says of its characteristic.
enum class Role : std::uint8_t {
  Status,      ///< a flag or a number of the cycle itself: verdict, alarm, variant
  Setting,     ///< what the call asked for: safe area, data set of the probe
  Touch,       ///< the raw position at one touch
  Actual,      ///< as measured
  Set,         ///< as it should be
  Difference,  ///< actual less set
  LowerLimit,
  UpperLimit,
  Excess,      ///< by how much a limit is exceeded
  Correction,  ///< what goes into a table
  Statistic,   ///< gathered over several measurements: mean value, empirical value
};

/// What is measured.
enum class Quantity : std::uint8_t {
  None,
  Coordinate,  ///< of a surface or a point
  Centre,      ///< one coordinate of it
  Corner,      ///< one coordinate of a corner or an intersection
  Diameter,
  Radius,
  Width,
  Length,
  Angle,         ///< about the axis that `Along` names
  Projection,    ///< the angle of a plane as its projection shows it
  Eccentricity,  ///< of the stylus tip to the spindle
  Distance,
  Name,     ///< a text
  Scatter,  ///< a length: standard deviation, root mean square
};

/// Along which axis, about which axis for angles.
enum class Along : std::uint8_t {
  None,
  First,      ///< main axis of the working plane
  Second,     ///< minor axis of the working plane
  Third,      ///< tool axis
  Measuring,  ///< the axis that the call names
  Normal,     ///< of the surface
  X,
  Y,
  Z,
  A,
  B,
  Table,  ///< the axis of the rotary table
};

enum class System : std::uint8_t { Workpiece, Machine };

/// One thing that can be measured, in one call of a cycle. Its set value, actual value, difference and limits are
/// results with the same characteristic.
struct Characteristic {
  Quantity quantity = Quantity::None;
  Along along = Along::None;
  std::uint8_t item = 0;  ///< of several alike: 1 for the first; 0: the only one, or all
  System system = System::Workpiece;
  friend bool operator==(const Characteristic&, const Characteristic&) = default;

  /// The same of the n-th of several alike.
  constexpr Characteristic number(std::uint8_t n) const { return {quantity, along, n, system}; }
  constexpr Characteristic inMachine() const { return {quantity, along, item, System::Machine}; }
};

/// How near a result is to the question that the cycle was called for.
enum class Rank : std::uint8_t {
  Aside,
  Fallback,  ///< the answer where the variant leaves no main result
  Main,      ///< the answer
};

struct ResultKind {
  Role role = Role::Status;
  Characteristic of;
  Rank rank = Rank::Aside;

  constexpr ResultKind main() const { return {role, of, Rank::Main}; }
  constexpr ResultKind fallback() const { return {role, of, Rank::Fallback}; }
};

/// As files name them: "actual", "diameter", "first", "machine". Empty for None.
std::string_view nameOf(Role role);
std::string_view nameOf(Quantity quantity);
std::string_view nameOf(Along along);
std::string_view nameOf(System system);

}  // namespace probewright::control
