#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "language/block.hpp"

/// Which words stand together in a block: the groups of G functions, of which a block has one function each, and the
/// words that each motion and each frame takes. The control refuses every other block.
namespace probewright::language::sinumerik {

/// The group of a G function, by the number that the control gives it: 6 for "G17", 29 for "DIAMON". Nothing for those
/// that stand in no group here: motions (group 1), frames and the functions of single blocks.
std::optional<int> groupOf(std::string_view name);

/// What the words of a block belong to.
enum class Takes : std::uint8_t {
  Line,     ///< G0, G1
  Thread,   ///< G33 to G35, G63, G331, G332: also I, J, K
  Arc,      ///< G2, G3
  Points,   ///< CIP
  Tangent,  ///< CT
  Spline,   ///< and POLY, involutes: whatever they take
  Frame,    ///< TRANS, SCALE, MIRROR, G58, G59...
  Turn,     ///< ROT, AROT, ROTS...: also RPL
  Pole,     ///< G110 to G112: also AP, RP
  Limit,    ///< G25, G26
  Dwell,    ///< G4: F or S
  Fixed,    ///< G74, G75
  Measure,  ///< MEAS, MEAW
};

struct WordMistake {
  std::uint32_t column = 0;
  std::string message, advice;
  std::string_view alarm;  ///< what the control reports
};

/// What is wrong with the words of a block under `takes`, whose name in messages is `name`: a word that does not belong
/// to it, a circle that is determined twice, polar beside Cartesian coordinates. `plane`: of G17 to G19, if it is
/// known.
std::optional<WordMistake> wordMistake(Takes takes, std::string_view name, const Block& block, WordRange words,
                                       std::optional<int> plane);

}  // namespace probewright::language::sinumerik
