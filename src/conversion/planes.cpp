#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conversion/to_klartext.hpp"
#include "conversion/to_sinumerik.hpp"
#include "language/klartext/commands.hpp"

/// Tilted planes: PLANE SPATIAL and CYCLE800.
namespace probewright::conversion {

using namespace language;

namespace {

/// _MODE of CYCLE800, axis by axis: about Z, then the new Y, then the new X, which are the space angles of PLANE
/// SPATIAL from the last to the first; and the usual order X, Y, Z.
/// With the last mode the angles are those of the rotary axes.
constexpr int modeZYX = 27, modeXYZ = 57, modeRotaryAxes = 192;

constexpr double degrees = 180 / std::numbers::pi;

/// Space angles of the rotation about X, the new Y and the new Z.
std::array<double, 3> spaceAngles(double x, double y, double z) {
  const double a = x / degrees, b = y / degrees, c = z / degrees;
  const double r00 = std::cos(b) * std::cos(c);
  const double r10 = std::cos(a) * std::sin(c) + std::sin(a) * std::sin(b) * std::cos(c);
  const double r20 = std::sin(a) * std::sin(c) - std::cos(a) * std::sin(b) * std::cos(c);
  const double r21 = std::sin(a) * std::cos(c) + std::cos(a) * std::sin(b) * std::sin(c);
  const double r22 = std::cos(a) * std::cos(b);
  return {std::atan2(r21, r22) * degrees, std::asin(std::clamp(-r20, -1.0, 1.0)) * degrees,
          std::atan2(r10, r00) * degrees};
}

}  // namespace

void ToSinumerik::plane(const Block& block, const Transform& transform) {
  const klartext::TransformKind kind = klartext::kindOf(block, transform);
  const std::string_view name = nameOf(kind);
  const auto words = std::span<const Word>(block.words).subspan(transform.words.first, transform.words.count);
  const auto find = [&](std::string_view address) {
    const auto found = std::ranges::find(words, addressOf(address), &Word::address);
    return found == words.end() ? nullptr : &*found;
  };
  if (!frame_.isNone()) {
    throw NotCarriedOver("CYCLE800 cancels shift and rotation of the program",
                         "tilt before them, or give the shift to CYCLE800");
  }
  const int direction = find("STAY") != nullptr ? 0 : 1;
  if (kind == klartext::TransformKind::PlaneReset) {
    // Where the plane is level the table may stand anywhere; PLANE RESET turns it home.
    if (direction != 0) out_.line(fmt::format("CYCLE800(0,\"\",0,{},0,0,0,0,0,0,0,0,0,1)", modeRotaryAxes));
    out_.line("CYCLE800()");
  } else if (kind == klartext::TransformKind::PlaneSpatial) {
    for (const Word& word : words)
      if (word.mode == WordMode::Incremental) throw NotCarriedOver("incremental angles of planes are not converted");
    const auto angle = [&](std::string_view address) {
      const Word* word = find(address);
      return word == nullptr ? Quantity() : quantity(block, word->value);
    };
    if (find("SEQ") != nullptr || find("SYM") != nullptr) {
      out_.lose(block, "SEQ and SYM: CYCLE800 chooses the posture that is nearest");
    }
    out_.line(fmt::format("CYCLE800(0,\"\",0,{},0,0,0,{},{},{},0,0,0,{})", modeZYX, sinumerikText(angle("SPC")),
                          sinumerikText(angle("SPB")), sinumerikText(angle("SPA")), direction));
  } else {
    throw NotCarriedOver(fmt::format("{} is not converted", name), "write it as PLANE SPATIAL");
  }
  forgetPosition();
}

void ToKlartext::swivel(const Block& block, const CallProgram& call) {
  const auto words = std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count);
  const auto argument = [&](std::uint32_t place) {
    const auto found = std::ranges::find(words, place, &Word::address);
    return found == words.end() || !found->value.present() ? Quantity() : quantity(block, found->value);
  };
  const auto known = [&](std::uint32_t place) {
    const Quantity value = argument(place);
    if (!value.isNumber()) throw NotCarriedOver("the angles of this plane are known only when the program runs");
    return value.number();
  };
  for (const std::uint32_t place : {4U, 5U, 6U, 10U, 11U, 12U}) {
    if (!(argument(place) == 0))
      throw NotCarriedOver("the shifts of CYCLE800 are not converted", "write them as TRANS");
  }
  const std::string positioning = argument(13) == 0 ? " STAY" : " TURN FMAX";
  forgetPosition();
  frame_ = {};
  const bool level = argument(7) == 0 && argument(8) == 0 && argument(9) == 0;
  if (level) return line(fmt::format("PLANE RESET{}", positioning));
  if (argument(2).number() != 0) throw NotCarriedOver("planes that continue from the last one are not converted");
  const int mode = static_cast<int>(known(3));
  std::array<Quantity, 3> angles = {argument(9), argument(8), argument(7)};
  if (mode == modeXYZ) {
    const auto converted = spaceAngles(known(7), known(8), known(9));
    angles = {converted[0], converted[1], converted[2]};
  } else if (mode != modeZYX) {
    throw NotCarriedOver(fmt::format("_MODE = {} of CYCLE800 is not converted", mode), "tilt axis by axis: 57 or 27");
  }
  line(fmt::format("PLANE SPATIAL SPA{} SPB{} SPC{}{}", formulas_.value(angles[0]), formulas_.value(angles[1]),
                   formulas_.value(angles[2]), positioning));
}

}  // namespace probewright::conversion
