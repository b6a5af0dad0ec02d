#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "conversion/modes.hpp"
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

/// _FR of CYCLE800: how the tool retracts before the rotary axes turn.
enum Retraction : std::uint8_t { None = 0, AxisZ = 1, AllAxes = 2, ToolMaximum = 4, ToolDistance = 5 };

/// Which of two positions of the rotary axes reaches the plane: not said, or the one on this side of the tilting axis.
enum class Posture : std::int8_t { Smaller = -1, Unsaid = 0, Larger = 1 };

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

std::optional<ToSinumerik::Plane> ToSinumerik::planeAfter(const Block& block, const Transform& transform) {
  const klartext::TransformKind kind = klartext::kindOf(block, transform);
  if (kind == klartext::TransformKind::PlaneReset) return Plane();
  if (kind != klartext::TransformKind::PlaneSpatial) return std::nullopt;
  Plane plane{.isTilted = true};
  for (const Word& word : std::span<const Word>(block.words).subspan(transform.words.first, transform.words.count)) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (word.address != addressOf(std::array{"SPA", "SPB", "SPC"}[i])) continue;
      const auto angle = literalOf(block, word.value);
      if (!angle || word.mode == WordMode::Incremental) return std::nullopt;
      plane.angles[i] = *angle;
    }
  }
  return plane;
}

std::array<Quantity, 3> ToSinumerik::untilted(const std::array<Quantity, 3>& way) const {
  const Eigen::Matrix3d turned = (Eigen::AngleAxisd(plane_->angles[2] / degrees, Vector3::UnitZ()) *
                                  Eigen::AngleAxisd(plane_->angles[1] / degrees, Vector3::UnitY()) *
                                  Eigen::AngleAxisd(plane_->angles[0] / degrees, Vector3::UnitX()))
                                     .toRotationMatrix();
  const auto letter = [this](std::size_t index) { return axis(index)[0] - 'X'; };
  std::array<Quantity, 3> result;
  for (std::size_t to = 0; to < 3; ++to)
    for (std::size_t from = 0; from < 3; ++from)
      if (const double share = turned(letter(to), letter(from)); std::abs(share) > 1e-15)  // quarter turns
        result[to] = result[to] + way[from] * share;
  return result;
}

void ToSinumerik::plane(const Block& block, const Transform& transform) {
  const klartext::TransformKind kind = klartext::kindOf(block, transform);
  const auto words = std::span<const Word>(block.words).subspan(transform.words.first, transform.words.count);
  const auto find = [&](std::string_view address) {
    const auto found = std::ranges::find(words, addressOf(address), &Word::address);
    return found == words.end() ? nullptr : &*found;
  };
  const bool resets = kind == klartext::TransformKind::PlaneReset;
  if (!resets && kind != klartext::TransformKind::PlaneSpatial) {
    throw NotCarriedOver(fmt::format("{} is not converted", nameOf(kind)), "write it as PLANE SPATIAL");
  }
  if (!frame_.isNone()) {
    throw NotCarriedOver("CYCLE800 cancels shift and rotation of the program",
                         "tilt before them, or give the shift to CYCLE800");
  }
  for (const Word& word : words)
    if (word.mode == WordMode::Incremental) throw NotCarriedOver("incremental angles of planes are not converted");
  forgetPosition();

  const bool turns = find("STAY") == nullptr;
  std::string retraction = "0", distance;
  if (const Word* back = turns ? find("MB") : nullptr) {
    const bool toTheEnd = !back->value.present();
    retraction = std::to_string(toTheEnd ? ToolMaximum : ToolDistance);
    if (!toTheEnd) distance = fmt::format(",{}", sinumerikText(quantity(block, back->value)));
  }
  if (find("MOVE") != nullptr) {
    out_.lose(block, "MOVE, DIST: CYCLE800 turns the rotary axes alone, and the tip does not follow the workpiece");
  }
  if (turns && find("F") != nullptr) out_.lose(block, "F: CYCLE800 turns the rotary axes at rapid traverse");
  const auto turnHome = [&](std::string_view first) {
    out_.line(fmt::format("CYCLE800({},\"\",0,{},0,0,0,0,0,0,0,0,0,1{})", first, modeRotaryAxes,
                          first == "0" ? std::string() : distance));
  };
  // Other planes need rotary axes on a HEIDENHAIN control, too.
  const auto needsRotaryAxis = [&] {
    out_.listOnce(block,
                  "a SINUMERIK without rotary axes refuses CYCLE800 (62181), a HEIDENHAIN control takes PLANE where it "
                  "turns nothing but coordinates",
                  "on a machine without rotary axes write ROT for it", Severity::Note);
  };
  if (resets) {
    if (turns) needsRotaryAxis();
    // Where the plane is level the table may stand anywhere; PLANE RESET turns it home.
    if (turns) turnHome(retraction);
    plane_ = planeAfter(block, transform);
    return out_.line("CYCLE800()");
  }

  const auto angle = [&](std::string_view address) {
    const Word* word = find(address);
    return word == nullptr ? Quantity() : quantity(block, word->value);
  };
  const Quantity a = angle("SPA"), b = angle("SPB"), c = angle("SPC");
  const bool isTilted = (a.isNumber() && !(a == 0)) || (b.isNumber() && !(b == 0));
  const bool isLevel = a == 0 && b == 0;
  if (isLevel) needsRotaryAxis();
  if (!isTilted && turns && find("TABL") != nullptr) {
    out_.lose(block, "TABLE ROT: CYCLE800 turns the coordinates only where the plane is level");
  }
  Posture posture = Posture::Unsaid;
  for (const char* side : {"SEQ", "SYM"}) {
    if (const Word* word = find(side)) posture = word->value.number > 0 ? Posture::Larger : Posture::Smaller;
  }
  if (find("SYM") != nullptr) {
    out_.lose(block, "SYM: _DIR of CYCLE800 knows the sides of the rest position of the tilting axis only");
  } else if (turns && !isLevel && posture == Posture::Unsaid) {
    out_.listOnce(block,
                  "without SEQ the rotary axes take the nearest of the positions that reach a tilted plane, with "
                  "CYCLE800 the one that _DIR names",
                  "program SEQ+ or SEQ- in each PLANE block that turns the rotary axes");
  }
  plane_ = planeAfter(block, transform);
  const int direction = !turns ? 0 : posture == Posture::Smaller ? -1 : 1;
  const auto swivel = [&](std::string_view first) {
    out_.line(fmt::format("CYCLE800({},\"\",0,{},0,0,0,{},{},{},0,0,0,{}{})", first, modeZYX, sinumerikText(c),
                          sinumerikText(b), sinumerikText(a), direction, first == "0" ? std::string() : distance));
  };
  // A rotary axis that is free in a level plane goes to 0; CYCLE800 leaves it where it stands.
  if (isTilted || !turns) return swivel(retraction);
  if (!isLevel) out_.line(fmt::format("IF ({}==0) AND ({}==0)", sinumerikText(a), sinumerikText(b)));
  turnHome(retraction);
  swivel("0");
  if (isLevel) return;
  out_.line("ELSE");
  swivel(retraction);
  out_.line("ENDIF");
}

bool ToKlartext::deselectsPlane(const Block& block, const CallProgram& call) {
  const auto words = std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count);
  return words.empty() || std::ranges::any_of(words, [&](const Word& word) {
           if (word.address != 1 || word.value.node < 0) return false;
           const Node& node = block.nodes[static_cast<std::size_t>(word.value.node)];
           return node.operation == Operation::Text && block.at(node.text) == "0";
         });
}

bool ToKlartext::tiltsPlane(const Block& block, const CallProgram& call) {
  if (deselectsPlane(block, call)) return false;
  const auto words = std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count);
  return std::ranges::any_of(words, [&](const Word& word) {
    const bool isAngle = word.address >= 7 && word.address <= 9;
    return isAngle && word.value.present() && literalOf(block, word.value) != std::optional(0.0);
  });
}

void ToKlartext::listOtherDataSet(const Block& block, const CallProgram& call) {
  const auto words = std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count);
  const auto found = std::ranges::find(words, 1U, &Word::address);
  if (found == words.end() || found->value.node < 0) return;
  const Node& node = block.nodes[static_cast<std::size_t>(found->value.node)];
  const std::string name =
      node.operation == Operation::Text ? upperCase(block.at(node.text)) : std::string("a variable");
  if (name.empty() || name == "0") return;
  if (swivelDataSet_.empty()) swivelDataSet_ = name;
  if (name == swivelDataSet_) return;
  out_.list(block,
            fmt::format("_TC: this program swivels by more than one data set ({}, {}), a HEIDENHAIN control by the "
                        "kinematics that is active",
                        swivelDataSet_, name),
            "select the kinematics of the head or table by hand before this block");
}

void ToKlartext::swivel(const Block& block, const CallProgram& call) {
  const auto words = std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count);
  const auto argument = [&](std::uint32_t place, double otherwise = 0) {
    const auto found = std::ranges::find(words, place, &Word::address);
    return found == words.end() || !found->value.present() ? Quantity(otherwise) : quantity(block, found->value);
  };
  const auto known = [&](std::uint32_t place, const char* name, double otherwise = 0) {
    const Quantity value = argument(place, otherwise);
    if (!value.isNumber())
      throw NotCarriedOver(fmt::format("{} of CYCLE800 is known only when the program runs", name),
                           "write a number there");
    return value.number();
  };
  const int retracts = static_cast<int>(known(0, "_FR"));
  std::string retraction;
  switch (retracts) {
    case None:
      break;
    case AxisZ:
    case AllAxes:
      out_.listOnce(block,
                    fmt::format("_FR = {}: where the machine retracts to is in the swivel data set; here the tool "
                                "retracts along its axis to the end of the travel",
                                retracts),
                    "write _FR = 4, or check that the rotary axes turn freely from there");
      [[fallthrough]];
    case ToolMaximum:
      retraction = "MB MAX";
      break;
    case ToolDistance:
      if (!(argument(14) == 0)) retraction = fmt::format("MB{}", formulas_.value(argument(14)));
      break;
    default:
      throw NotCarriedOver(fmt::format("_FR = {} of CYCLE800 is not converted", retracts),
                           "retract the tool before the call, and write _FR = 0");
  }
  forgetPosition();
  listOtherDataSet(block, call);
  tilted_ = tiltsPlane(block, call);
  if (deselectsPlane(block, call)) {
    if (!retraction.empty()) line(fmt::format("L {} FMAX M140 {}", compensation_, retraction));
    if (!frameIsNone()) {
      out_.list(block, "a shift or rotation of the program outlives the tilted plane that it was programmed in",
                "cancel it with TRANS before CYCLE800()");
    }
    return line("PLANE RESET STAY");
  }
  for (const std::uint32_t place : {4U, 5U, 6U, 10U, 11U, 12U}) {
    if (!(argument(place) == 0))
      throw NotCarriedOver("the shifts of CYCLE800 are not converted", "write them as TRANS");
  }
  if (known(2, "_ST") != 0) {
    throw NotCarriedOver("_ST: planes that continue from the last one, and a tool tip that follows, are not converted",
                         "give the angles of the whole plane, and _ST = 0");
  }
  const int mode = static_cast<int>(known(3, "_MODE", modeXYZ));
  const int direction = static_cast<int>(known(13, "_DIR", -1));
  const std::string positioning =
      direction == 0 ? " STAY" : fmt::format(" TURN{}{} FMAX", retraction.empty() ? "" : " ", retraction);
  // CYCLE800 cancels the frames of the program, PLANE does not.
  const auto cancelFrames = [&] {
    if (direction == 0 && !retraction.empty()) line(fmt::format("L {} FMAX M140 {}", compensation_, retraction));
    if (!frame_.rotation || !(*frame_.rotation == 0)) writeRotation(0);
    if (!frame_.known || isShifted()) writeShift({});
    frame_ = {};
  };
  std::array<Quantity, 3> angles = {argument(9), argument(8), argument(7)};
  const bool isWhole = std::ranges::all_of(angles, [](const Quantity& each) { return each == 0; });
  if (mode == modeXYZ && !isWhole) {
    const auto converted = spaceAngles(known(7, "_A"), known(8, "_B"), known(9, "_C"));
    angles = {converted[0], converted[1], converted[2]};
  } else if (!isWhole && mode != modeZYX) {
    throw NotCarriedOver(fmt::format("_MODE = {} of CYCLE800 is not converted", mode), "tilt axis by axis: 57 or 27");
  }
  const auto isZero = [](const Quantity& each) { return each.isNumber() && std::abs(each.number()) < 1e-9; };
  const bool isLevel = isZero(angles[0]) && isZero(angles[1]);
  const bool isTilted = (angles[0].isNumber() && !isZero(angles[0])) || (angles[1].isNumber() && !isZero(angles[1]));
  if (direction != 0 && !isTilted && mode != modeRotaryAxes) {
    out_.listOnce(
        block,
        "in a level plane CYCLE800 leaves a rotary axis that turns about the tool where it stands, PLANE turns "
        "it to 0",
        fmt::format("turn the axes home with _MODE = {} before this block", modeRotaryAxes));
  }
  cancelFrames();
  if (isWhole) return line(fmt::format("PLANE RESET{}", positioning));
  std::string side;
  if (direction != 0 && !isLevel) {
    side = direction > 0 ? " SEQ+" : " SEQ-";
    out_.listOnce(block,
                  "where the rotary axes reach a plane on the other side only than _DIR names, CYCLE800 takes it, and "
                  "SEQ stops the program",
                  "leave SEQ out where the machine has one position for a plane");
  }
  line(fmt::format("PLANE SPATIAL SPA{} SPB{} SPC{}{}{}", formulas_.value(angles[0]), formulas_.value(angles[1]),
                   formulas_.value(angles[2]), positioning, side));
}

}  // namespace probewright::conversion
