#pragma once

#include <array>
#include <optional>

#include "conversion/quantity.hpp"

/// Roundings and chamfers that are larger than the lines that they join: a HEIDENHAIN control stops, a SINUMERIK makes
/// them smaller.
namespace probewright::conversion {

/// Main and minor axis, as far as the program tells them.
using PlanePoint = std::array<std::optional<Quantity>, 2>;

enum class Corner { Rounding, Chamfer };

/// Follows the corners of a program in their order: what one has taken of a line is gone for the next one.
class CornerRoom {
public:
  enum class Fit {
    Fits,
    TooLarge,
    Unknown,  ///< known only when the program runs, or beside an arc
  };
  /// A corner at `at`, between the lines from `from` and to `to`; `size`: radius or length.
  Fit fitOf(Corner corner, const std::optional<Quantity>& size, const PlanePoint& from, const PlanePoint& at,
            const PlanePoint& to);
  /// A path without a corner at its end.
  void pathWithoutCorner() { taken_ = 0; }

private:
  std::optional<double> taken_ = 0;  ///< of the path that follows
};

inline constexpr const char* tooLargeCorner =
    "this corner is larger than one of its two lines: a HEIDENHAIN control stops, a SINUMERIK makes it smaller";
inline constexpr const char* cornerOfUnknownRoom =
    "whether this corner fits its two paths is not known before the program runs: one that is too large stops a "
    "HEIDENHAIN control, a SINUMERIK makes it smaller";

}  // namespace probewright::conversion
