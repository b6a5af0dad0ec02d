#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "study/number_path.hpp"

/// Clampings: what of a setup may be otherwise than it is written, and by how much.
namespace probewright::survival {

enum class NumberKind {
  Shift,   ///< x, y, z of a pose, mm
  Turn,    ///< a, b, c of a pose, degrees
  Size,    ///< of a feature, mm
  Length,  ///< of a tool or its stylus, mm
};

/// A number of the setup and the range that it may lie in.
struct Tolerance {
  study::NumberPath quantity;
  NumberKind kind = NumberKind::Shift;
  double low = 0, high = 0;

  const std::string& name() const { return quantity.text(); }
  double middle() const { return (low + high) / 2; }
  double half() const { return (high - low) / 2; }
};

/// Reads "part.pose.x=0.5", so much to either side of what the setup has, or "part.pose.x=-0.2..0.8", from this value
/// to that one. Refused: what is not a number of a clamping, a range that is empty, a number that the setup does not
/// have.
Result<Tolerance> parseTolerance(std::string_view text, const toml::table& setup);

/// A box of clampings: a value for each tolerance between `low` and `high`.
struct Box {
  std::vector<double> low, high;

  std::vector<double> middle() const;
  bool holds(std::span<const double> values) const;
};

Box boxOf(std::span<const Tolerance> tolerances);

}  // namespace probewright::survival
