#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "language/block.hpp"

/// Which words the path functions of Klartext take. A control refuses a block with any other word, so nothing of a path
/// block is ever left out in silence.
namespace probewright::language::klartext {

/// How the end point of a path function is written.
enum class EndPoint : std::uint8_t {
  None,       ///< it follows from other words
  Cartesian,  ///< axes X, Y, Z, A, B, C, U, V, W
  Centre,     ///< a circle centre: X, Y, Z
  Polar,      ///< PR and PA, and the other axes; of X, Y, Z one at most, for two lie in the plane of PR and PA
  PolarArc,   ///< PA only: the radius is the distance of the starting point from the pole
};

enum class Compensations : std::uint8_t { None, OffOnly, All };

/// The words of one path function. M functions go with each of them.
struct PathWords {
  std::string_view name;  ///< as it stands in a program: "L", "APPR PLT"
  EndPoint end = EndPoint::Cartesian;
  std::string_view words =
      {};  ///< beside those of the end point, separated by blanks; "R+" for R+ and R- without number
  Compensations compensations = Compensations::All;
  bool feed = true;
  std::string_view twin = {};  ///< the function with the other kind of coordinates; empty: there is none
};

/// The words of the path function `name`; throws std::logic_error for a name that is none.
const PathWords& pathWords(std::string_view name);

/// True if `word`, one of a path block but no feed, belongs to the function.
bool takes(const PathWords& function, const Word& word);

/// What to do about the word of this address, which the function does not take.
std::string adviceAgainst(const PathWords& function, std::uint32_t address);

/// All that the function takes, as a message names it: "PR, PA, the other axes, RL, RR, R0, F and M".
std::string summaryOf(const PathWords& function);

/// The word as a program writes it, without its value: "X", "IPA", "R+".
std::string writtenName(const Word& word);

}  // namespace probewright::language::klartext
