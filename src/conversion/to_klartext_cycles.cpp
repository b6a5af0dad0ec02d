#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.hpp"
#include "conversion/heidenhain_tasks.hpp"
#include "conversion/parameter_texts.hpp"
#include "conversion/sinumerik_formulas.hpp"
#include "conversion/sinumerik_tasks.hpp"
#include "conversion/to_klartext.hpp"
#include "conversion/touch_places.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/heidenhain/registry.hpp"

/// Measuring cycles of SINUMERIK programs as touch probe cycles.
namespace probewright::conversion {

using namespace language;

Place ToKlartext::here() {
  Place place;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!position_[i]) {
      const std::string name = formulas_.define(fmt::format("position {}", axis(i)));
      line(fmt::format("FN 18: SYSREAD {} = ID270 NR1 IDX{}", name, axis(i)[0] - 'X' + 1));
      if (millimetre_ != 1) line(fmt::format("{0} = {0} / 25.4", name));
      position_[i] = Quantity::of(name);
    }
    place[i] = *position_[i];
  }
  return place;
}

std::optional<Quantity> ToKlartext::measured(const MeasuringTask& task, const Results& left, Meaning meaning) const {
  const auto found = left.find(meaning);
  const auto differenceTo = [&](Meaning actual, const Quantity& set) -> std::optional<Quantity> {
    const auto result = left.find(actual);
    return result == left.end() ? std::nullopt : std::optional(Quantity::of(result->second) - set);
  };
  // Angles of touch probe cycles count from the main axis, those of CYCLE998 from the axis along the edge.
  const auto edgeAngle = [&]() -> std::optional<std::string> {
    const auto angle = left.find(Meaning::Angle);
    if (angle == left.end()) return std::nullopt;
    // Cycle 1410 counts from the first point to the second, that is along the positive axis.
    if (task.axis == 0 && angle->second == "Q964") return "Q964 - 90";
    if (task.axis == 0 && angle->second == "Q150") return "Q150 - 90 * SGN Q150";
    return angle->second;
  };
  const bool spaceAngle = found != left.end() && (found->second == "Q961" || found->second == "Q962");
  if (spaceAngle && toolAxis_ != 'Z') return std::nullopt;
  if (meaning == Meaning::Angle && task.feature == Feature::Edge) {
    const auto angle = edgeAngle();
    return angle ? std::optional(Quantity::of(*angle)) : std::nullopt;
  }
  if (meaning == Meaning::Angle && found != left.end() && found->second == "Q158") {
    return Quantity::of("ATAN (TAN Q158 * COS Q159)");
  }
  if (found != left.end()) return Quantity::of(found->second);
  switch (meaning) {
    case Meaning::Centre1Deviation:
      return differenceTo(Meaning::Centre1, task.place[0]);
    case Meaning::Centre2Deviation:
      return differenceTo(Meaning::Centre2, task.place[1]);
    case Meaning::Size1Deviation:
      return differenceTo(Meaning::Size1, task.size[0]);
    case Meaning::Size2Deviation:
      return differenceTo(Meaning::Size2, task.size[1]);
    case Meaning::CoordinateDeviation:
      return differenceTo(Meaning::Coordinate, task.place[static_cast<std::size_t>(task.axis)]);
    case Meaning::AngleDeviation: {
      const auto angle = task.feature == Feature::Edge ? edgeAngle() : std::nullopt;
      if (!angle) return std::nullopt;
      return Quantity::of(*angle) - sinumerikEdgeAngle(task, task.angle);
    }
    case Meaning::Centre1Set:
      return task.place[0];
    case Meaning::Centre2Set:
      return task.place[1];
    case Meaning::Size1Set:
      return task.size[0];
    case Meaning::Size2Set:
      return task.size[1];
    case Meaning::CoordinateSet:
      return task.place[static_cast<std::size_t>(task.axis)];
    default:
      return std::nullopt;
  }
}

void ToKlartext::copyResults(const Block& block, const Results& left, const MeasuringTask& task) {
  if (answersInOtherUnit_) {
    out_.list(block,
              "results of touch probe cycles count in the unit of the main program, which may not be that of this one",
              "let all programs of the job count in the same unit");
  }
  std::set<int> missing = wantedAfter(block);
  const Results results = sinumerikResults(task);
  std::vector<std::pair<Meaning, std::string>> wanted(results.begin(), results.end());
  if (task.feature == Feature::Surface) {  // the same once more, by axis
    wanted.emplace_back(Meaning::CoordinateSet, fmt::format("_OVR[{}]", 1 + task.axis));
    wanted.emplace_back(Meaning::Coordinate, fmt::format("_OVR[{}]", 5 + task.axis));
    wanted.emplace_back(Meaning::CoordinateDeviation, fmt::format("_OVR[{}]", 17 + task.axis));
  }
  for (const auto& [meaning, name] : wanted) {
    const int index = std::stoi(name.substr(name.find('[') + 1));
    if (!usedResults_.contains(index)) continue;
    const std::optional<Quantity> value = measured(task, left, meaning);
    if (!value) continue;
    missing.erase(index);
    line(fmt::format("Q{} = {}", 1700 + index, spacedExpressionText(*value)));
  }
  for (const int index : missing)
    out_.lose(block, fmt::format("_OVR[{}]: the touch probe cycle has no such result", index));
}

void ToKlartext::requireReach(const Block& block, const MeasuringTask& task) {
  Quantity reach = task.path + task.beyond;
  if (isInside(task.feature) && !isCorner(task.feature)) {  // at most from one wall to the other
    const Quantity across = isRectangular(task.feature) && task.size[1].isNumber() && task.size[0].isNumber()
                                ? Quantity(std::max(task.size[0].number(), task.size[1].number()))
                                : task.size[0];
    if (across.isNumber() && (!reach.isNumber() || across.number() < reach.number())) reach = across;
  }
  if (!reach.isNumber()) {
    out_.list(block, "how far this cycle looks for the surface is known only when the program runs",
              "make sure that DIST of the touch probe table is at least twice S_FA");
    return;
  }
  const double length = reach.number() / (selectsMetric_ ? 1 : millimetre_);
  const bool collides = isInside(task.feature) && !isCorner(task.feature) && task.size[0].isNumber() &&
                        task.path.isNumber() && task.path.number() > task.size[0].number() / 2;
  if (collides || length < probe_.travel - 1e-6) {
    out_.listOnce(block,
                  fmt::format("S_FA: this program may stop where the one that is written measures: {}",
                              collides ? "it begins beyond the middle and may touch the opposite wall on its way there"
                                       : "a touch probe looks for the surface along all its DIST, which is longer"),
                  "choose S_FA as the feature needs it", Severity::Note);
  }
  if (length <= std::max(probe_.travel, listedReach_) + 1e-6) return;
  listedReach_ = length;
  out_.list(
      block,
      fmt::format(
          "this cycle looks for the surface along {} mm, but a touch probe with DIST = {} looks along its DIST only",
          numberText(std::ceil(length * 1000 - 1e-3) / 1000), numberText(probe_.travel)),
      "enter at least this path as DIST in the touch probe table, and give the same number to --dist");
}

void ToKlartext::listTiltedPlane(const Block& block, int cycle) {
  const cycles::heidenhain::Entry* entry = cycles::heidenhain::findEntry(cycle);
  if (tilted_ == std::optional(false) || entry == nullptr || entry->conditions.tilted.contains(control_)) return;
  out_.list(block,
            fmt::format("a plane of CYCLE800 {} in effect here, with which a HEIDENHAIN control stops at cycle {}; the "
                        "SINUMERIK measures",
                        tilted_ ? "is" : "may be", cycle),
            "program CYCLE800() before the cycle");
}

std::string ToKlartext::writeTask(const MeasuringTask& task) {
  const Call call = heidenhainCall(task, control_, probe_);
  const cycles::CycleDefinition* definition = cycles::heidenhainCycle(std::stoi(call.cycle));
  std::vector<std::string> lines = {
      fmt::format("TCH PROBE {} {} ~", call.cycle, cycleTitle(std::stoi(call.cycle), control_))};
  for (const cycles::Parameter& parameter : definition->parameters) {
    const std::string text = call.text(parameter.name);
    if (!call.has(parameter.name) && text.empty()) continue;
    const std::string_view meaning =
        parameterText(std::stoi(call.cycle), static_cast<int>(parameter.address), control_);
    lines.push_back(fmt::format(
        "    {}={} ;{} ~", parameter.name,
        text.empty() ? formulas_.value(call.number(parameter.name)) : fmt::format("\"{}\"", text), meaning));
  }
  lines.back().resize(lines.back().size() - 2);
  writeWhole(std::move(lines));
  return call.cycle;
}

Results ToKlartext::cornerByTouches(const MeasuringTask& corner) {
  std::vector<Place> places = corner.further;  // of a right-angled corner two more, otherwise three
  places.insert(places.begin(), corner.place);
  const auto own = [this](const char* what) { return formulas_.define(fmt::format("corner {}", what)); };
  const auto text = [](const Quantity& quantity) { return spacedExpressionText(quantity); };
  // Where the ball's centre stood in the measuring direction.
  const std::array<std::string, 4> found = {own("touch 1"), own("touch 2"), own("touch 3"), own("touch 4")};
  for (std::size_t i = 0; i < places.size(); ++i) {
    MeasuringTask touch = corner;
    touch.feature = Feature::Surface;
    touch.place = places[i];
    touch.axis = i < 2 ? 1 : 0;
    touch.sign = i < 2 ? corner.sign : corner.secondSign;
    if (i == 2 && !corner.clearanceBetween) {
      // Round the corner, as the original goes.
      const Quantity back = corner.path + ballRadius_;
      line(fmt::format("L {}{} {}{} R0 FMAX", axis(0), formulas_.value(places[2][0] - back * corner.secondSign),
                       axis(1), formulas_.value(places[0][1] - back * corner.sign)));
    }
    writeTask(touch);
    out_.line(fmt::format("{} = Q160 {} {}", found[i], touch.sign > 0 ? "-" : "+", text(ballRadius_)));
  }
  // Each edge is a straight line one radius beside its two centres: y = at1 + slope1 * x and x = at2 + slope2 * y.
  const std::string slope1 = own("slope 1"), slope2 = own("slope 2"), at1 = own("edge 1"), at2 = own("edge 2");
  const auto edge = [&](const std::string& slope, const std::string& at, std::size_t first, std::size_t along,
                        int sign) {
    if (first + 1 < places.size()) {
      const Quantity apart = places[first + 1][along] - places[first][along];
      out_.line(fmt::format("{} = ({} - {}) / ({})", slope, found[first + 1], found[first], text(apart)));
    } else {
      out_.line(fmt::format("{} = -{}", slope, slope1));
    }
    out_.line(fmt::format("{0} = {1} - {2} * ({3}) {4} {5} * SQRT (1 + SQ {2})", at, found[first], slope,
                          text(places[first][along]), sign > 0 ? "+" : "-", text(ballRadius_)));
  };
  edge(slope1, at1, 0, 0, corner.sign);
  edge(slope2, at2, 2, 1, corner.secondSign);
  const std::string main = own("main axis"), minor = own("minor axis"), angle = own("angle");
  out_.line(fmt::format("{} = ({} + {} * {}) / (1 - {} * {})", main, at2, slope2, at1, slope1, slope2));
  out_.line(fmt::format("{} = {} + {} * {}", minor, at1, slope1, main));
  out_.line(fmt::format("{} = ATAN {}", angle, slope1));
  return {{Meaning::Centre1, main}, {Meaning::Centre2, minor}, {Meaning::Angle, angle}};
}

void ToKlartext::measuringLog(const Block& block, const Call& call) {
  const int screen = call.integer("S_PICT"), file = call.integer("S_PROT");
  log_ = file % 10 == 1                              ? MeasuringTask::Log::File
         : screen % 10 == 1 && screen / 10 % 10 == 3 ? MeasuringTask::Log::Screen
                                                     : MeasuringTask::Log::None;
  if (file % 10 == 2) {
    out_.lose(block, "S_PROT: the log of a measurement is asked for in its cycle (Q281), not after it");
  } else if (file % 10 == 1 && !call.text("S_PATH").starts_with("TCHPR")) {
    out_.list(block, "the logs have the names of their cycles: TCHPR421.TXT",
              "only cycles 420 to 427, 430 and 431 write logs; each writes its file anew");
  }
}

void ToKlartext::correctTool(const MeasuringTask& task, const Results& results) {
  const auto deviation = [&](Meaning meaning, Meaning actual, const Quantity& set) {
    const auto found = results.find(meaning);
    return found != results.end() ? Quantity::of(found->second) : Quantity::of(results.at(actual)) - set;
  };
  const std::string past = unusedLabel("TOOL");
  const std::string amount = formulas_.define("deviation of the tool");
  const auto passIf = [&](const Quantity& value, int function, const char* comparison, const Quantity& limit) {
    if (limit == 0) return;
    line(fmt::format("{} = ABS ({})", amount, spacedExpressionText(value)));
    const std::string bound = formulas_.value(limit);
    line(fmt::format("FN {}: IF +{} {} {} GOTO LBL \"{}\"", function, amount, comparison, bound, past));
  };
  const bool surface = task.feature == Feature::Surface;
  Quantity found = surface ? deviation(Meaning::CoordinateDeviation, Meaning::Coordinate, task.size[0])
                           : deviation(Meaning::Size1Deviation, Meaning::Size1, task.size[0]);
  passIf(found, 11, "GT", task.tool->most);
  if (isRectangular(task.feature)) {
    const Quantity second = deviation(Meaning::Size2Deviation, Meaning::Size2, task.size[1]);
    passIf(second, 11, "GT", task.tool->most);
    found = (found + second) / 2;
  }
  passIf(found, 12, "LT", task.tool->least);
  const std::string& name = task.tool->tool;
  std::string row = name;
  if (!std::ranges::all_of(name, isDigit)) {
    const std::string text = formulas_.define("name of a tool", KlartextFormulas::Holds::Text);
    row = formulas_.define("row of a tool");
    line(fmt::format("{} = \"{}\"", text, name));
    line(fmt::format("FN 18: SYSREAD {} = ID990 NR10 IDX{}", row, text.substr(2)));
  }
  // The tool table counts in millimetres: DL, DR.
  const double share = surface ? (task.axis == 2 ? -1 : task.sign) : isInside(task.feature) ? 0.5 : -0.5;
  const std::string datum = fmt::format("ID50 NR{} IDX{}", surface && task.axis == 2 ? 4 : 5, row);
  line(fmt::format("FN 18: SYSREAD {} = {}", amount, datum));
  line(fmt::format("{} = {}", amount, spacedExpressionText(Quantity::of(amount) + found * (share / millimetre_))));
  line(fmt::format("FN 17: SYSWRITE {} = +{}", datum, amount));
  line(fmt::format("LBL \"{}\"", past));
}

void ToKlartext::cycle(const Block& block, const CallProgram& called) {
  const cycles::CycleDefinition* definition = cycles::sinumerikCycle(block.at(called.name));
  measuredWithTool_ = measuredWithTool_ || definition->number != 150;
  if (called.arguments.count == 0 && definition->number != 150) {
    throw NotCarriedOver(
        fmt::format("{} without arguments takes them from _MVAR, _SETVAL and their like", definition->name),
        "write the arguments into the call");
  }
  Call call;
  call.cycle = definition->name;
  call.millimetre = millimetre_;
  call.probe = probe_;
  for (const cycles::Parameter& parameter : definition->parameters)
    if (parameter.standard) call.numbers[std::string(parameter.name)] = *parameter.standard;
  for (const Word& word : std::span<const Word>(block.words).subspan(called.arguments.first, called.arguments.count)) {
    const cycles::Parameter* parameter = definition->parameter(word.address);
    if (parameter == nullptr || !word.value.present()) continue;
    if (parameter->kind == cycles::ValueKind::Text) {
      const bool text =
          word.value.node >= 0 && block.nodes[static_cast<std::size_t>(word.value.node)].operation == Operation::Text;
      if (text)
        call.texts[std::string(parameter->name)] =
            block.at(block.nodes[static_cast<std::size_t>(word.value.node)].text);
      continue;
    }
    call.numbers[std::string(parameter->name)] = quantity(block, word.value);
  }
  if (call.cycle == "CYCLE150") return measuringLog(block, call);
  if (const int plane = call.has("_DMODE") ? call.digit("_DMODE", 1) : 0; plane >= 1 && plane <= 3) {
    const char toolAxis = "ZYX"[plane - 1];
    if (toolAxis != toolAxis_ || axisDoubtful_) {
      throw NotCarriedOver(fmt::format("_DMODE: this call measures in the plane of G{}, a touch probe cycle in that of "
                                       "the tool axis",
                                       16 + plane),
                           fmt::format("program G{} before it, and 0 in the units of _DMODE", 16 + plane));
    }
  }
  rely(block, axisDoubtful_, "the tool axis (G17, G18, G19)");
  if (call.cycle == "CYCLE971") return toolMeasurement(block, call);
  rely(block, logDoubtful_, "the measuring log (CYCLE150)");
  Losses losses;
  const bool calibrates = call.cycle == "CYCLE976";
  if (std::ranges::find(beside_, true) != beside_.end()) {
    out_.list(block,
              "this cycle begins where the measuring cycle before it has left the probe, which is elsewhere here",
              "move to the place before the cycle, in all three axes");
    beside_ = {};
  }
  const Place start = calibrates ? Place{} : here();
  MeasuringTask task = sinumerikTask(call, start, ballRadius_, losses);
  requireReach(block, task);
  noteTouchPlaces(out_, block, task);
  const bool turns = task.correction == Correction::Rotation || task.correction == Correction::RotaryAxis;
  if (turns && activeRow_ && task.row == *activeRow_) task.active = true;
  task.fromUnturned = std::exchange(unturned_, false) && turns;
  task.log = log_;
  if (task.active && !turns) {
    const std::string row = formulas_.define("active preset");
    line(fmt::format("FN 18: SYSREAD {} = ID530 NR1", row));
    task.row = Quantity::of(row);
  }
  if (task.correction != Correction::None && !task.active)
    listLackingRow(block, task.row, Lacking::CopiesPresetInEffect);
  if (task.row == 99) {
    if (task.correction != Correction::None && !rowZeroIsDue_ && activeRow_ != 99) {
      throw NotCarriedOver("G599 is row 0 of the preset table, which a touch probe cycle selects when it corrects it",
                           "select G599 before this cycle, or correct another zero offset");
    }
    task.row = 0;
    rowZeroIsDue_ = false;
  }
  const MeasuringTask framed = task;
  const bool leaves = leaveFrame(task);
  const std::optional<SafeArea> safe = safeArea(call, framed);
  before_ = {};
  const bool showsInPreset = safe && deviatesInActivePresetOnly(*safe, task);
  if (safe && !showsInPreset) rememberPreset(block, task);
  const bool measuresCorner = isCorner(task.feature) && task.correction == Correction::None;
  const bool measuresBefore = task.feature == Feature::Surface && task.correction != Correction::None &&
                              task.axis != 2 && !wantedAfter(block).empty();
  // Cycles with Q330 correct always, and by the first side of a rectangle.
  const bool correctsLater =
      task.tool && (isRectangular(task.feature) || !(task.tool->least == 0) || !(task.tool->most == 0) || safe);
  const bool restorable = task.correction == Correction::None || before_.row;
  const Quantity offset = call.number("S_KNUM");
  if (task.correction != Correction::None && offset.isNumber() && offset.number() < 10000) {
    line("; S_KNUM: THE FINE OFFSET, WHICH PRESETS DO NOT HAVE APART");
    out_.list(block, "S_KNUM: the fine offset is corrected, the preset has none apart from its coordinates",
              "write S_KNUM = 10001 and on where fine and coarse offset need not be told apart", Severity::Note);
  }
  const bool elder = control_ == control::ControlKind::iTNC530;
  if (safe && !restorable && elder) {
    out_.list(block, "S_TSA: the iTNC530 cannot put the preset back when the safe area is found to be exceeded",
              "measure first, and correct in a second call");
  }
  const bool measuresFirst = safe && !elder && (!restorable || showsInPreset);
  if (measuresFirst) {
    line("; THE SAFE AREA FIRST");
    out_.listOnce(block, "S_TSA: this feature is touched twice, to compare with the safe area and to correct",
                  "leave the correction to a second call if each touch counts", Severity::Note);
    MeasuringTask inspection = task;
    inspection.correction = Correction::None;
    const Results found =
        isCorner(task.feature) ? cornerByTouches(inspection) : heidenhainResults(writeTask(inspection), inspection);
    if (isCorner(task.feature) && !task.clearanceBetween) {
      // Back round the corner, to where the cycle began.
      const auto back = [&](std::size_t i) { return formulas_.value(start[i] + task.place[i] - framed.place[i]); };
      line(fmt::format("L {}{} {}{} R0 FMAX", axis(0), back(0), axis(1), back(1)));
    }
    monitor(block, *safe, inspection, found);
  }
  if (!measuresCorner) listTiltedPlane(block, std::stoi(heidenhainCall(task, control_, probe_).cycle));
  Results results;
  if (measuresCorner) {
    results = cornerByTouches(task);
  } else if (correctsLater) {
    MeasuringTask inspection = task;
    inspection.tool.reset();
    results = heidenhainResults(writeTask(inspection), task);
  } else {
    if (measuresBefore) {  // cycle 419 has no results
      out_.listOnce(block, "this surface is touched twice: cycle 419, which corrects the preset, has no results",
                    "read no results after it if each touch counts", Severity::Note);
      MeasuringTask inspection = task;
      inspection.correction = Correction::None;
      results = heidenhainResults(writeTask(inspection), task);
    }
    results.merge(heidenhainResults(writeTask(task), task));
  }
  if (leaves) comeBackToFrame(framed, results);
  copyResults(block, results, framed);
  if (safe && !measuresFirst) monitor(block, *safe, framed, results);
  if (correctsLater) correctTool(framed, results);
  for (const std::string& loss : losses)
    out_.lose(block, loss);
  if (!calibrates) goBack(framed, sinumerikEnd(call, framed, start, ballRadius_, results));
  if (task.feature == Feature::ProbeInRing || task.feature == Feature::ProbeOnBall) {
    // Q108 knows the new radius from the next tool call on.
    const std::string radius = formulas_.define("ball radius");
    line(fmt::format("FN 18: SYSREAD {} = ID350 NR52 IDX1", radius));
    if (millimetre_ != 1) line(fmt::format("{0} = {0} / 25.4", radius));
    ballRadius_ = Quantity::of(radius);
  }
}

void ToKlartext::goBack(const MeasuringTask& task, std::array<std::optional<Quantity>, 3> end) {
  forgetPosition();
  const bool heightKnown = end[2].has_value();
  const bool moved = task.correction != Correction::None;
  if (moved) {
    // In the corrected coordinates the feature lies where it should; other places are not known.
    const bool isActive = task.active || (activeRow_ && task.row == (*activeRow_ == 99 ? 0 : *activeRow_));
    const bool centred = isRound(task.feature) || isRectangular(task.feature) || isWidth(task.feature);
    const bool otherRow = activeRow_ && !isActive;
    if (!otherRow) {
      for (std::size_t i = 0; i < 3; ++i)
        end[i] = isActive && end[i] && centred && i < 2 && task.wish[i] ? task.wish[i] : std::nullopt;
    }
  }
  std::string back;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool height = i == 2 && task.feature == Feature::Surface && task.axis == 2;
    if (end[i] && (i < 2 || height)) back += fmt::format(" {}{}", axis(i), formulas_.value(*end[i]));
  }
  if (!back.empty()) line(fmt::format("L{} {} FMAX", back, compensation_));
  for (std::size_t i = 0; i < 3; ++i)
    if (end[i] && end[i]->isNumber()) position_[i] = end[i];
  beside_ = {!end[0], !end[1], !heightKnown};
}

}  // namespace probewright::conversion
