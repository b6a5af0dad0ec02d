#include "language/klartext/m_functions.hpp"

#include <algorithm>
#include <array>

namespace probewright::language::klartext {

using control::ControlKind;

namespace {

constexpr std::array carriedOut = {0,  1,  2,  3,   4,   5,   6,   8,   9,   13,  14,  19,  20,  30,  89, 91,
                                   92, 94, 99, 126, 127, 128, 129, 130, 136, 137, 140, 141, 143, 144, 145};

/// Constant speed at corners, tool life, plunging feed, control gain, oversizes of replacement tools, feed of arcs and
/// of rotary axes, superimposed handwheel, exact stops, lift off, laser power.
constexpr std::array harmless = {7,   90,  101, 102, 103, 105, 106, 107, 108, 109, 110, 111,
                                 116, 117, 118, 134, 135, 148, 149, 200, 201, 202, 203, 204};

/// Contours beside the programmed one, other origins, a choice of rotary axes, limits that are switched off.
constexpr std::array notCarriedOut = {93, 95, 96, 97, 98, 104, 112, 113, 120, 124, 132, 138, 142, 150, 197};

/// Compensation of tilted axes by the control.
constexpr std::array onlyOlder = {114, 115};

bool in(const auto& list, int number) { return std::ranges::find(list, number) != list.end(); }

}  // namespace

FunctionEffect effectOf(int mFunction, ControlKind kind) {
  if (in(carriedOut, mFunction)) return FunctionEffect::CarriedOut;
  if (in(harmless, mFunction)) return FunctionEffect::Harmless;
  if (in(notCarriedOut, mFunction)) return FunctionEffect::NotCarriedOut;
  if (in(onlyOlder, mFunction)) {
    return kind == ControlKind::TNC640 ? FunctionEffect::OfOtherOne : FunctionEffect::CarriedOut;
  }
  return FunctionEffect::OfBuilder;
}

}  // namespace probewright::language::klartext
