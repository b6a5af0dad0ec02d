#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/number_text.hpp"
#include "control/sinumerik/tool_data.hpp"
#include "truth/family_truth.hpp"
#include "truth/feeling.hpp"

/// What calls and data of SINUMERIK controls say of the true world.
namespace probewright::truth {

namespace {

using control::CycleRecord;
using records::EntryKind;

std::optional<ExpectedRound> round(const CycleRecord& cycle, const control::WorkingPlane&, const Vector3& start) {
  const auto diameter = valueOf(cycle, "S_SETV");
  const auto variant = valueOf(cycle, "S_MVAR");
  // Units: the feature. 1 hole, 2 spigot.
  const int feature = variant ? static_cast<int>(*variant) % 10 : 0;
  const bool round = (cycle.name == "CYCLE977" || cycle.name == "CYCLE979") && (feature == 1 || feature == 2);
  if (!round || !diameter || !(*diameter > 0)) return std::nullopt;
  return ExpectedRound{start, *diameter, "the start position"};
}

std::optional<ExpectedWalls> walls(const CycleRecord& cycle, const control::WorkingPlane& plane, const Vector3& start) {
  const auto variant = valueOf(cycle, "S_MVAR");
  const int feature = variant ? static_cast<int>(*variant) % 10 : 0;
  if (cycle.name != "CYCLE977" || feature < 3 || feature > 6) return std::nullopt;
  const double angle = valueOf(cycle, "S_STA1").value_or(0);
  ExpectedWalls expected;
  expected.inside = feature == 3 || feature == 5;
  expected.pairs = feature <= 4 ? wallPair(plane, valueOf(cycle, "S_MA"), valueOf(cycle, "S_SETV"), angle)
                                : wallPairs(plane, valueOf(cycle, "S_SETV0"), valueOf(cycle, "S_SETV1"), angle);
  if (expected.pairs.empty()) return std::nullopt;
  Vector3 inPlane = plane.planeFromXyz(start);
  if (!expected.inside) inPlane.z() += valueOf(cycle, "S_ID").value_or(0);
  expected.centre = plane.xyzFromPlane(inPlane);
  expected.from = "the start position";
  return expected;
}

Vector2 along(double degrees) { return {std::cos(radiansFromDegrees(degrees)), std::sin(radiansFromDegrees(degrees))}; }

/// The call names places from which is probed and a pole from which both sides can be reached, not the corner.
std::optional<PlaneCorner> corner(const CycleRecord& cycle, double height) {
  if (cycle.name != "CYCLE961") return std::nullopt;
  const auto value = [&](const char* name) { return valueOf(cycle, name).value_or(0); };
  const int code = static_cast<int>(value("S_MVAR")), units = code % 10, which = code / 10000 % 10;
  const bool rightAngled = units <= 6, inside = units == 5 || units == 7;
  PlaneCorner known;
  Vector2 first, second;
  if (code / 10 % 10 == 1) {
    const Vector2 p0(value("S_SETV0"), value("S_SETV1")), p1(value("S_SETV2"), value("S_SETV3")),
        p2(value("S_SETV4"), value("S_SETV5")), p3(value("S_SETV6"), value("S_SETV7"));
    first = p1 - p0;
    second = rightAngled ? Vector2(-first.y(), first.x()) : Vector2(p3 - p2);
    const auto pole = crossing(p0, first, p2, second);
    if (!pole) return std::nullopt;
    known.corner = *pole;
    known.point = {p1, rightAngled ? p2 : p3};
  } else {
    const auto signedAs = [](double length, bool negative) { return negative ? -std::abs(length) : length; };
    const bool back1 = which == 2 || which == 3, back2 = which == 3 || which == 4;
    first = along(value("S_STA1"));
    second = along(value("S_STA1") + (rightAngled ? 90 : value("S_INCA")));
    const double far1 = signedAs(value("S_SETV1"), back1), far2 = signedAs(value("S_SETV3"), back2);
    double near2 = signedAs(value("S_SETV2"), back2);
    if (near2 == 0) near2 = far2 / 2;
    known.corner = {value("S_SETV4"), value("S_SETV5")};
    known.point = {known.corner + first * far1, known.corner + second * (rightAngled ? near2 : far2)};
  }
  const Vector2 edge1 = (known.point[0] - known.corner).normalized(),
                edge2 = (known.point[1] - known.corner).normalized();
  if (!(std::abs(cross(edge1, edge2)) > 0.01)) return std::nullopt;
  const double side = inside ? -1 : 1;
  known.into = {side * (edge2 - edge1 * edge1.dot(edge2)).normalized(),
                side * (edge1 - edge2 * edge2.dot(edge1)).normalized()};
  known.height = height - (code / 1000 % 10 == 1 ? std::abs(value("S_ID")) : 0);
  known.from = "the pole";
  return known;
}

std::string zeroOffsetName(const std::string& index) {
  const auto number = parseInteger(index);
  if (!number || *number < 1) return "$P_UIFR[" + index + "]";
  return *number <= 4 ? fmt::format("G{}", 53 + *number) : fmt::format("G{}", 500 + *number);
}

std::optional<FrameNumber> frameNumber(const std::string& table, const std::string& entry) {
  static constexpr std::string_view frames[] = {"$P_UIFR", "$P_CHBFR", "$P_NCBFR", "$P_SETFR", "$P_PARTFR"};
  if (std::ranges::find(frames, table) == std::end(frames)) return std::nullopt;
  // "[1,X,TR]" or, of frames without a number, "[X,TR]".
  std::vector<std::string> words(1);
  for (const char c : entry) {
    if (c == ',')
      words.emplace_back();
    else if (c != '[' && c != ']')
      words.back() += c;
  }
  if (words.size() < 2) return std::nullopt;
  const std::string part = words.back(), axis = words[words.size() - 2];
  const std::string index = words.size() > 2 ? words.front() : "";
  if (axis.size() != 1 || axis[0] < 'X' || axis[0] > 'Z') return std::nullopt;
  const bool translation = part == "TR" || part == "FI" || part == "SI";
  if (!translation && part != "RT") return std::nullopt;
  FrameNumber number{EntryKind::ZeroOffset, table == "$P_UIFR" ? zeroOffsetName(index) : table + "[" + index + "]",
                     axis + (part == "TR" ? "" : " " + part)};
  number.axis = axis[0] - 'X';
  number.angle = !translation;
  return number;
}

/// From as far before the surface as it goes on beyond.
Reach reach(const CycleRecord* cycle, double way, control::ControlKind) {
  const auto path = cycle != nullptr ? valueOf(*cycle, "S_FA") : std::nullopt;
  return {path ? "S_FA" : "DFA", path.value_or(way / 2), true};
}

bool isOfTools(std::string_view table) {
  return control::sinumerik::isToolSize(table) || table.starts_with("$SNS_MEA_");
}

bool isOfKinematics(std::string_view table) { return table.starts_with("$TC_CARR"); }

}  // namespace

const FamilyTruth sinumerikTruth = {.family = "SINUMERIK",
                                    .round = round,
                                    .walls = walls,
                                    .corner = corner,
                                    .reach = reach,
                                    .frameNumber = frameNumber,
                                    .isOfTools = isOfTools,
                                    .tools = sinumerikToolEntries,
                                    .isOfKinematics = isOfKinematics};

}  // namespace probewright::truth
