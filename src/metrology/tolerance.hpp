#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"
#include "metrology/verdict.hpp"

/// Tolerances of dimensions, how programs write them, and what they say about a measured value. mm.
namespace probewright::metrology {

/// Permitted deviations from a nominal dimension, signed: 10 +0.02/-0.01 has lower -0.01 and upper +0.02.
struct Tolerance {
  double lower = 0;
  double upper = 0;
  double width() const { return upper - lower; }
  bool operator==(const Tolerance&) const = default;
};

/// Least and greatest permitted value of a dimension.
struct Limits {
  double lower = 0;
  double upper = 0;
  /// The value that deviations of HEIDENHAIN's 14xx cycles refer to.
  double middle() const { return (lower + upper) / 2; }
};

Limits limits(double nominal, const Tolerance& tolerance);

enum class Conformance { Below, Within, Above };

/// Where `actual` lies. A value on a limit is within; limits are met to 1e-9 mm, so that the rounding of decimal
/// numbers decides nothing.
Conformance conformance(double actual, const Limits& limits);

/// Too small a bore has material left (Rework), too large a one has lost it (Scrap). Slots and pockets likewise.
Verdict boreVerdict(double actual, const Limits& limits);

/// Too large a stud has material left (Rework), too small a one has lost it (Scrap). Ridges and lengths likewise.
Verdict studVerdict(double actual, const Limits& limits);

/// A position outside its limits cannot be repaired: Scrap on both sides.
Verdict positionVerdict(double actual, const Limits& limits);

/// The more severe of two findings about one workpiece.
Verdict worst(Verdict a, Verdict b);

/// What can be stated about a dimension measured with expanded uncertainty `uncertainty` (ISO 14253-1).
enum class Statement { Conforms, Undecided, DoesNotConform };
Statement statement(double actual, double uncertainty, const Limits& limits);

/// A dimension as HEIDENHAIN's 14xx cycles take it in a text parameter:
///   [?] [nominal [tolerance]] [@ actual]
/// where the tolerance is one deviation ("10+0.02": the other is 0), two in any order ("10+0.02-0.01", "10-1-0.5"), a
/// symmetrical one ("10+-0.02"), an ISO 286 class ("10H7", "8m7") or an ISO 2768-1 class ("10m"). Decimal point or
/// comma.
struct DimensionText {
  bool unknownPosition = false;        ///< "?": the place on the workpiece is not known beforehand
  std::optional<double> nominal;       ///< absent in "?"
  std::optional<Tolerance> tolerance;  ///< absent where nothing is to be monitored
  std::string toleranceClass;          ///< "H7", "m" where the text names one
  std::optional<double> actual;        ///< "@10.0123": known, not to be probed
  std::string actualParameter;         ///< "Q1900" where the actual value is in a parameter

  /// Absent without tolerance, or where both limits are the same, which monitors nothing.
  std::optional<Limits> limits() const;
};

/// Fails with the column of what is wrong.
Result<DimensionText> parseDimension(std::string_view text);

/// Permissible deviations of ISO 2768-1:1989, table 1 (linear sizes), class f, m, c or v, 0.5 mm to 4000 mm.
Result<Tolerance> generalTolerance(double nominal, std::string_view toleranceClass);

}  // namespace probewright::metrology
