#include <fmt/format.h>

#include <string>
#include <vector>

#include "conversion/heidenhain_tasks.hpp"
#include "conversion/to_sinumerik.hpp"

/// Several holes or spigots that make a line, a circle or a crossing: touch probe cycles 401, 402, 416, 418 and 430.
namespace probewright::conversion {

using namespace language;

namespace {

/// As far as a stroke goes in a hole whose size is not known, and how fast; mm, mm/min.
constexpr double stroke = 40, strokeFeed = 300;

}  // namespace

ToSinumerik::Centre ToSinumerik::holeByStrokes(int number, const Place& place, const Quantity& clearance) {
  approach({place[0], place[1], place[2] - ballRadius_}, clearance);
  Centre centre;
  for (std::size_t i = 0; i < 2; ++i) {
    centre[i] = formulas_.declare(fmt::format("_HOLE{}_{}", number, axis(i)));
    const auto touch = [&](double way) {
      out_.line(fmt::format("MEAS=1 G1 {}=IC({}) F{}", axis(i), numberText(way * millimetre_),
                            numberText(strokeFeed * millimetre_)));
      out_.line("IF NOT $AC_MEA[1]");
      out_.line("  SETAL(65001) ; no hole here");
      out_.line("ENDIF");
    };
    touch(stroke);
    out_.line(fmt::format("{}=$AA_MW[{}]", centre[i], axis(i)));
    out_.line(fmt::format("G0 {}", addressWord(axis(i), place[i])));
    touch(-stroke);
    out_.line(fmt::format("{0}=({0}+$AA_MW[{1}])/2", centre[i], axis(i)));
    out_.line(fmt::format("G0 {}={}", axis(i), centre[i]));
  }
  out_.line(fmt::format("G0 {}", addressWord(axis(2), clearance)));
  position_ = {std::nullopt, std::nullopt, clearance};
  return centre;
}

ToSinumerik::Centre ToSinumerik::spigotCentre(const Block& block, int number, const MeasuringTask& pair) {
  MeasuringTask spigot = pair;
  spigot.feature = Feature::Spigot;
  spigot.correction = Correction::None;
  if (number == 2) {
    spigot.place = pair.further[0];
    spigot.size[0] = pair.size[1];
  }
  spigot.angle = 0;
  Losses losses;
  const SinumerikPassage passage = sinumerikPassage(spigot, ballRadius_, losses);
  requireReach(block, spigot, passage);
  approach(*passage.start, pair.clearance);
  out_.line(callText(passage.call));
  Centre centre;
  for (std::size_t i = 0; i < 2; ++i) {
    centre[i] = formulas_.declare(fmt::format("_HOLE{}_{}", number, axis(i)));
    out_.line(fmt::format("{}=_OVR[{}]", centre[i], 5 + i));
  }
  out_.line(fmt::format("G0 {}", addressWord(axis(2), pair.clearance)));
  position_ = {std::nullopt, std::nullopt, pair.clearance};
  return centre;
}

void ToSinumerik::turnByPair(const MeasuringTask& pair, const std::vector<Centre>& centres) {
  const std::string angle = formulas_.declare("_HOLES_ANGLE");
  out_.line(fmt::format("{}=ATAN2({}-{},{}-{})", angle, centres[1][1], centres[0][1], centres[1][0], centres[0][0]));
  if (!(pair.angle == 0)) {  // less than a turn, as rotations are
    const std::string difference = sinumerikText(Quantity::of(angle) - pair.angle);
    out_.line(fmt::format("{0}=ATAN2(SIN({1}),COS({1}))", angle, difference));
  }
  setRotation(pair.active ? std::nullopt : std::optional(pair.row), Quantity::of(angle));
}

Place ToSinumerik::holePattern(const Block& block, const MeasuringTask& given, const std::string& heidenhainCycle) {
  MeasuringTask pattern = given;
  if (pattern.correction != Correction::None) {
    listRowAfterZero(block, pattern.row);
    listLackingRow(block, pattern.row);
  }
  if (pattern.correction != Correction::None && pattern.row == 0) {
    takeRowZero();
    pattern.row = 99;
  }
  if (pattern.correction != Correction::None && !pattern.row.isNumber())
    pattern.row = runningRow(pattern.row, RowZero::Preset);
  pattern.active = pattern.row.isNumber() && pattern.row.number() < 0;
  if (pattern.fromUnturned) takeRotationOut(pattern);
  std::vector<Centre> centres;
  std::vector<Place> places = pattern.further;
  if (pattern.feature != Feature::BoltCircle) places.insert(places.begin(), pattern.place);
  for (const Place& place : places) {
    const int number = static_cast<int>(centres.size()) + 1;
    centres.push_back(pattern.feature == Feature::SpigotPair ? spigotCentre(block, number, pattern)
                                                             : holeByStrokes(number, place, pattern.clearance));
  }
  besidePath_ = true;
  if (pattern.correction == Correction::Rotation) {
    turnByPair(pattern, centres);
    return {};
  }

  const auto own = [this](const char* what) { return formulas_.declare(fmt::format("_HOLES_{}", what)); };
  const Centre centre = {own("1"), own("2")};
  const auto set = [this](const std::string& name, const std::string& formula) {
    out_.line(fmt::format("{}={}", name, formula));
  };
  const auto way = [&](std::size_t to, std::size_t from, std::size_t i) {
    return fmt::format("({}-{})", centres[to][i], centres[from][i]);
  };
  std::string diameter;
  if (pattern.feature == Feature::BoltCircle) {
    // The circle through three points, counted from the first.
    diameter = own("DIAMETER");
    const std::string second = own("SQUARE2"), third = own("SQUARE3"), area = own("AREA");
    set(second, fmt::format("POT({})+POT({})", way(1, 0, 0), way(1, 0, 1)));
    set(third, fmt::format("POT({})+POT({})", way(2, 0, 0), way(2, 0, 1)));
    set(area, fmt::format("2*({}*{}-{}*{})", way(1, 0, 0), way(2, 0, 1), way(1, 0, 1), way(2, 0, 0)));
    set(centre[0], fmt::format("({}*{}-{}*{})/{}", way(2, 0, 1), second, way(1, 0, 1), third, area));
    set(centre[1], fmt::format("({}*{}-{}*{})/{}", way(1, 0, 0), third, way(2, 0, 0), second, area));
    set(diameter, fmt::format("2*SQRT(POT({})+POT({}))", centre[0], centre[1]));
    for (std::size_t i = 0; i < 2; ++i)
      set(centre[i], fmt::format("{}+{}", centre[i], centres[0][i]));
  } else {
    const std::string share = own("SHARE");
    set(share, fmt::format("({}*{}-{}*{})/({}*{}-{}*{})", way(1, 0, 0), way(3, 1, 1), way(1, 0, 1), way(3, 1, 0),
                           way(2, 0, 0), way(3, 1, 1), way(2, 0, 1), way(3, 1, 0)));
    for (std::size_t i = 0; i < 2; ++i)
      set(centre[i], fmt::format("{}+{}*{}", centres[0][i], share, way(2, 0, i)));
  }
  const std::map<Meaning, Quantity> found = {
      {Meaning::Centre1, Quantity::of(centre[0])},
      {Meaning::Centre2, Quantity::of(centre[1])},
      {Meaning::Size1, Quantity::of(diameter)},
      {Meaning::Centre1Deviation, Quantity::of(centre[0]) - pattern.place[0]},
      {Meaning::Centre2Deviation, Quantity::of(centre[1]) - pattern.place[1]},
      {Meaning::Size1Deviation, Quantity::of(diameter) - pattern.size[0]},
  };
  for (const auto& [meaning, name] : heidenhainResults(heidenhainCycle, pattern)) {
    const int number = std::stoi(name.substr(1));
    const auto value = found.find(meaning);
    if (usedQ_.contains(number) && value != found.end()) set(parameter(number), sinumerikText(value->second));
  }
  if (heidenhainCycle == "430") judgePattern(block, pattern, centre, diameter);
  const Place middle = {Quantity::of(centre[0]), Quantity::of(centre[1]), {}};
  if (pattern.correction == Correction::Origin) {
    forgetPosition();
    shiftOrigin(block, pattern, middle, SinumerikPassage::Rest::ShiftFromMeasured);
  }
  return middle;
}

void ToSinumerik::judgePattern(const Block& block, const MeasuringTask& pattern, const Centre& centre,
                               const std::string& diameter) {
  std::vector<std::string> scrap;  // no tool puts a circle of holes right
  if (pattern.limits[0]) {
    const Quantity deviation = Quantity::of(diameter) - pattern.size[0];
    const Limits& limits = *pattern.limits[0];
    const std::string value = sinumerikText(deviation);
    if (!(limits.upper == unlimited))
      scrap.push_back(
          onlyUnlessZero(limits.upperUnlessZero, fmt::format("({}>{})", value, sinumerikText(limits.upper))));
    if (!(limits.lower == -unlimited))
      scrap.push_back(
          onlyUnlessZero(limits.lowerUnlessZero, fmt::format("({}<{})", value, sinumerikText(limits.lower))));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (pattern.centreTolerance[i] == 0) continue;
    scrap.push_back(
        exceedsCentre(sinumerikText(Quantity::of(centre[i]) - pattern.place[i]), pattern.centreTolerance[i]));
  }
  const bool tells = !scrap.empty() && !pattern.stops;
  if (tells) {
    out_.list(block, "these limits: a message tells when they are exceeded; no SINUMERIK cycle judges three holes",
              "compare in the program that reads the results");
  }
  decide({}, scrap, pattern.stops, tells);
}

}  // namespace probewright::conversion
