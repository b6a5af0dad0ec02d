#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "conversion/heidenhain_tasks.hpp"
#include "conversion/sinumerik_tasks.hpp"
#include "conversion/to_sinumerik.hpp"
#include "conversion/touch_places.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/registry.hpp"
#include "geometry/primitives.hpp"

/// Touch probe cycles of HEIDENHAIN programs as measuring cycles of a SINUMERIK.
namespace probewright::conversion {

using namespace language;

namespace {

/// True if CYCLE998 measures the plane: its second point lies along the main axis, the third beyond both.
bool alongMainAxis(const MeasuringTask& plane) {
  const auto apart = [&](std::size_t point, std::size_t axis) {
    return plane.further.at(point)[axis] - plane.place[axis];
  };
  return apart(0, 1) == 0 && apart(0, 0).isNumber() && apart(0, 0).number() > 0 && apart(1, 1).isNumber() &&
         apart(1, 1).number() > 0;
}

}  // namespace

std::string callText(const Call& call) {
  const cycles::CycleDefinition* definition = cycles::sinumerikCycle(call.cycle);
  std::vector<std::string> places(definition->parameters.size());
  for (const cycles::Parameter& parameter : definition->parameters) {
    if (call.has(parameter.name)) places[parameter.address] = sinumerikText(call.number(parameter.name));
    if (const std::string text = call.text(parameter.name); !text.empty())
      places[parameter.address] = fmt::format("\"{}\"", text);
  }
  while (!places.empty() && places.back().empty())
    places.pop_back();
  return fmt::format("{}({})", call.cycle, fmt::join(places, ","));
}

Call ToSinumerik::callOf(const Block& block, const CycleCall& cycle) {
  Call call;
  call.cycle = std::to_string(cycle.number);
  call.millimetre = millimetre_;
  call.probe = probe_;
  for (const Word& word : std::span<const Word>(block.words).subspan(cycle.parameters.first, cycle.parameters.count)) {
    const std::string name = fmt::format("Q{}", word.address);
    if (word.value.node >= 0) {
      const Node& node = block.nodes[static_cast<std::size_t>(word.value.node)];
      if (node.operation == Operation::Text) {
        call.texts[name] = block.at(node.text);
        continue;
      }
      if (node.operation == Operation::Call && node.function == Function::Host && block.at(node.text) == "PREDEF") {
        const auto found = global_.find(static_cast<int>(word.address));
        if (found == global_.end()) throw NotCarriedOver(fmt::format("{} = PREDEF has no GLOBAL DEF above it", name));
        call.numbers[name] = found->second;
        continue;
      }
    }
    if (word.value.present()) call.numbers[name] = quantity(block, word.value);  // MB MAX has no number
  }
  return call;
}

void ToSinumerik::globalDefinition(const Block& block, const Command& command) {
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  for (const Word& word : words.subspan(1)) {
    Quantity value = quantity(block, word.value);
    if (!value.isNumber()) {  // as it is here, whatever becomes of the parameter
      const std::string own = formulas_.declare(fmt::format("_GLOBAL_{}", word.address));
      out_.line(fmt::format("{}={}", own, sinumerikText(value)));
      value = Quantity::of(own);
    }
    const auto [global, isNew] = global_.try_emplace(static_cast<int>(word.address), value);
    if (!isNew && graph_.branches() && !(global->second == value)) {
      out_.list(
          block,
          fmt::format("Q{} = PREDEF takes this value in all cycles below, whichever path leads to them", word.address),
          "write the value in the cycles");
    }
    global->second = value;
  }
}

void ToSinumerik::cycle(const Block& block, const CycleCall& cycle) {
  if (block.at(cycle.name) != "TCH PROBE") {
    throw NotCarriedOver(fmt::format("cycle {} is not a measuring cycle", cycle.number), "write it by hand");
  }
  requireAxis();
  const cycles::CycleDefinition* definition = cycles::heidenhainCycle(cycle.number);
  const Call call = callOf(block, cycle);
  listForbiddenFrame(block, cycle.number);
  const bool intoAnyParameter = cycle.number == 0 || cycle.number == 3 || cycle.number == 4;
  const bool answers = intoAnyParameter || (definition != nullptr && !readResults(call.cycle).empty());
  if (answers && cyclesAnswerInOtherUnit()) {
    out_.list(block,
              "results of cycles count in the unit of the main program, which may not be that of this one; on a "
              "SINUMERIK they count in that of this one",
              "let all programs of the job count in the same unit");
  }
  if (measuresTools(cycle.number)) return toolMeasurement(block, call);
  if (cycle.number == 404) return basicRotation(block, call);
  if (cycle.number == 403) return alignRotaryAxis(block, call);
  if (cycle.number == 0 || cycle.number == 3 || cycle.number == 4) return singleTouch(block, cycle, call);
  Losses losses;
  const std::vector<MeasuringTask> tasks = heidenhainTasks(call, ballRadius_, losses);
  out_.line(fmt::format("; {} {}", cycle.number, definition == nullptr ? "" : definition->title));
  // A file of the same name as on the HEIDENHAIN control; or the result screen until NC start.
  const MeasuringTask::Log log = tasks.front().log;
  if (log == MeasuringTask::Log::File) out_.line(fmt::format("CYCLE150(0,1,\"TCHPR{}\")", call.cycle));
  if (log == MeasuringTask::Log::Screen) out_.line("CYCLE150(31,0)");
  Place found;
  for (MeasuringTask each : tasks) {
    noteTouchPlaces(out_, block, each);
    if (!each.answers) countFromNewOrigin(tasks.front(), found, each);
    const Feature what = each.feature;
    if (what == Feature::HolePair || what == Feature::SpigotPair || what == Feature::BoltCircle ||
        what == Feature::HoleDiagonals) {
      found = holePattern(block, each, call.cycle);
    } else if (call.cycle == "431" && !alongMainAxis(each)) {
      planeByTouches(block, each);
    } else {
      found = task(block, each, call.cycle);
    }
  }
  if (log != MeasuringTask::Log::None) out_.line("CYCLE150(0,0)");
  for (const std::string& loss : losses)
    out_.lose(block, loss);
}

void ToSinumerik::listForbiddenFrame(const Block& block, int cycle) {
  const cycles::heidenhain::Entry* entry = cycles::heidenhain::findEntry(cycle);
  if (entry == nullptr) return;
  const bool levelOnly = !entry->conditions.tilted.contains(control::ControlKind::TNC640);
  if (levelOnly && plane_ != std::optional(Plane())) {
    out_.list(block,
              fmt::format("a tilted working plane {} in effect here, with which a TNC 640 stops at cycle {}; the "
                          "SINUMERIK measures",
                          plane_ ? "is" : "may be", cycle),
              "program PLANE RESET before the cycle");
  }
  const auto forbidden = cycles::heidenhain::forbiddenTransformations(entry->conditions);
  const bool shifted = std::ranges::any_of(frame_.shift, [](const Quantity& each) { return !(each == 0); });
  const bool turned = frame_.rotation && !(*frame_.rotation == 0);
  const bool mayBeShifted = forbidden.shift && !frame_.known, mayBeTurned = forbidden.rotation && !frame_.rotation;
  if (mayBeShifted || mayBeTurned) {
    return out_.list(block,
                     fmt::format("on one of the ways to this block a {} by the program is in effect, with which a TNC "
                                 "640 stops at cycle {}; the SINUMERIK measures",
                                 mayBeShifted ? "datum shift" : "rotation", cycle),
                     "reset it on every way to the cycle");
  }
  if (!((forbidden.shift && shifted) || (forbidden.rotation && turned))) return;
  out_.list(block,
            fmt::format("a {} by the program is in effect here, with which a TNC 640 stops at cycle {}; the SINUMERIK "
                        "measures",
                        forbidden.shift && shifted ? "datum shift" : "rotation", cycle),
            "reset it before the cycle");
}

void ToSinumerik::requireReach(const Block& block, const MeasuringTask& task, const SinumerikPassage& passage) {
  if (passage.looksFarEnough || std::exchange(listedReach_, true)) return;
  const Quantity enough = (task.path + task.beyond) / 2 - Quantity(probe_.setUp * millimetre_);
  out_.list(block,
            fmt::format("a touch probe with DIST = {} looks for the surface farther beyond its place than before "
                        "it, SINUMERIK cycles as far as S_FA only",
                        numberText(probe_.travel)),
            enough.isNumber() ? fmt::format("program Q320 = {} if there is room, or tell by --dist what DIST is",
                                            numberText(enough.number()))
                              : std::string("tell by --dist what DIST is"));
}

void ToSinumerik::approach(const Place& start, const Quantity& clearance) {
  std::optional<Quantity> height = position_[2];
  const bool high = height && height->isNumber() && clearance.isNumber() && height->number() >= clearance.number();
  if (!height) {
    // Up, never down: the original program may come from above.
    out_.line(fmt::format("G0 {0}=MAXVAL($AA_IW[{0}],{1})", axis(2), sinumerikText(clearance)));
  } else if (!high) {
    out_.line(fmt::format("G0 {}", addressWord(axis(2), clearance)));
    height = clearance;
  }
  out_.line(fmt::format("G0 {} {}", addressWord(axis(0), start[0]), addressWord(axis(1), start[1])));
  if (!height || !(*height == start[2])) out_.line(fmt::format("G0 {}", addressWord(axis(2), start[2])));
}

Place ToSinumerik::task(const Block& block, const MeasuringTask& given, const std::string& heidenhainCycle) {
  MeasuringTask task = given;
  const bool corrects = task.correction != Correction::None;
  if (corrects && !task.active) {
    listRowAfterZero(block, task.row);
    listLackingRow(block, task.row);
  }
  if (corrects && !task.active && task.row == 0) {
    takeRowZero();
    task.row = 99;
  }
  if (corrects && !task.active && !task.row.isNumber()) {
    task.row = runningRow(task.row, task.correction == Correction::Rotation ? RowZero::InEffect : RowZero::Preset);
  }
  Losses losses;
  const SinumerikPassage passage = sinumerikPassage(task, ballRadius_, losses);
  requireReach(block, task, passage);
  if (task.fromUnturned) takeRotationOut(task);
  if (passage.start) approach(*passage.start, task.clearance);
  out_.line(callText(passage.call));
  if (task.answers) copyResults(block, heidenhainCycle, task, passage);
  if (task.tool && !passage.correctsTool) correctTool(task, passage);
  const cycles::CycleDefinition& cycle = *cycles::heidenhainCycle(std::stoi(heidenhainCycle));
  if (cycle.family == cycles::CycleFamily::Inspection && cycle.parameter(309) != nullptr) judge(block, task, passage);
  if (passage.start) out_.line(fmt::format("G0 {}", addressWord(axis(2), task.clearance)));
  shiftToWish(block, task, passage.rest);
  if (task.correction == Correction::RotaryAxis) {
    // A table turns the workpiece against the direction of its axis (ISO 841).
    setComponent(std::nullopt, tableAxis() + ",TR", [](const std::string& present) { return present + "+_OVR[16]"; });
  }
  for (const std::string& loss : losses)
    out_.lose(block, loss);
  forgetPosition();
  if (task.feature == Feature::ProbeInRing || task.feature == Feature::ProbeOnBall) {
    ballRadius_ = calibratedBallRadius * millimetre_;  // the tool data may keep the old one
  }
  if (!corrects && passage.start) position_[2] = task.clearance;
  besidePath_ = true;
  Place found = task.place;
  for (const auto& [meaning, name] : sinumerikResults(task)) {
    if (meaning == Meaning::Centre1) found[0] = Quantity::of(name);
    if (meaning == Meaning::Centre2) found[1] = Quantity::of(name);
    if (meaning == Meaning::Coordinate) found[static_cast<std::size_t>(task.axis)] = Quantity::of(name);
  }
  return found;
}

void ToSinumerik::countFromNewOrigin(const MeasuringTask& preset, const Place& found, MeasuringTask& touch) {
  const bool known = preset.active || preset.row == 0 || (activeRow_ && preset.row.isNumber());
  if (known && !preset.active && !(preset.row == 0) && !(preset.row == *activeRow_)) return;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!preset.wish[i]) continue;
    const Quantity moved = touch.place[i] + *preset.wish[i] - found[i];
    if (known) {
      touch.place[i] = moved;
      continue;
    }
    const std::string own = formulas_.declare(fmt::format("_TOUCH_{}", axis(i)));
    out_.line(fmt::format("{}={}", own, sinumerikText(touch.place[i])));
    out_.line(fmt::format("IF $P_UIFRNUM=={}", sinumerikText(preset.row)));
    out_.line(fmt::format("  {}={}", own, sinumerikText(moved)));
    out_.line("ENDIF");
    touch.place[i] = Quantity::of(own);
  }
}

void ToSinumerik::correctTool(const MeasuringTask& task, const SinumerikPassage& passage) {
  const std::string& tool = task.tool->tool;
  const bool number = std::ranges::all_of(tool, isDigit);
  const std::string wear = fmt::format("$TC_DP15[{},1]", number ? tool : fmt::format("GETT(\"{}\",1)", tool));
  // Tool data count in millimetres.
  out_.line(fmt::format(
      "{0}={0}{1}{2}", wear, isInside(task.feature) ? "+" : "-",
      sinumerikText(Quantity::of(resultsOf(task, passage).at(Meaning::Size1Deviation), 0.5 / millimetre_))));
}

void ToSinumerik::shiftToWish(const Block& block, const MeasuringTask& task, SinumerikPassage::Rest rest) {
  if (rest == SinumerikPassage::Rest::Nothing) return;
  const bool fromMeasured = rest == SinumerikPassage::Rest::ShiftFromMeasured;
  // By the correction the feature has the coordinates of its place; the origin moves by what is left.
  const Place now = fromMeasured ? Place{Quantity::of("_OVR[5]"), Quantity::of("_OVR[6]"), {}} : task.place;
  shiftOrigin(block, task, now, rest);
}

void ToSinumerik::shiftOrigin(const Block& block, const MeasuringTask& task, const Place& now,
                              SinumerikPassage::Rest from) {
  std::array<Quantity, 3> left;
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!task.wish[i]) continue;
    left[i] = now[i] - *task.wish[i];
    any = any || !(left[i] == 0);
  }
  if (!any) return;
  if (plane_ && plane_->isTilted) left = untilted(left);
  if (!plane_) {
    out_.list(block, "the origin is shifted as if no plane were tilted here, which only the running program knows",
              "ask for the coordinates that the cycle expects, or give the angles of PLANE as numbers");
  }
  const bool isActive = task.active || (activeRow_ && task.row == *activeRow_);
  if (from == SinumerikPassage::Rest::ShiftFromMeasured && !isActive) {
    out_.list(block, "the origin is shifted as if its zero offset were the one in effect",
              "select the preset with cycle 247 before this cycle");
  }
  const std::string row = task.active ? "$P_UIFRNUM" : sinumerikText(task.row);
  const auto component = [&](std::size_t i) { return fmt::format("$P_UIFR[{},{},TR]", row, axis(i)); };
  const std::string angle = fmt::format("$P_UIFR[{},{},RT]", row, axis(2));
  const auto times = [&](const char* function, const Quantity& value, double sign) {
    if (value == 0) return std::string();
    const std::string text = sinumerikText(sign < 0 ? -value : value);
    const std::string factor = text.front() == '-' ? fmt::format("({})", text) : factorText(text);
    return fmt::format("+{}*{}({})", factor, function, angle);
  };
  if (!(left[0] == 0 && left[1] == 0)) {
    out_.line(fmt::format("{0}={0}{1}{2}", component(0), times("COS", left[0], 1), times("SIN", left[1], -1)));
    out_.line(fmt::format("{0}={0}{1}{2}", component(1), times("SIN", left[0], 1), times("COS", left[1], 1)));
  }
  if (!(left[2] == 0)) {
    const std::string text = sinumerikText(left[2]);
    out_.line(fmt::format("{0}={0}{1}{2}", component(2), text.front() == '-' ? "" : "+", text));
  }
  if (task.row.isNumber() && activeRow_ && task.row == *activeRow_) {
    out_.line(settableCode(*activeRow_));
  } else if (task.active || !activeRow_ || !task.row.isNumber()) {
    selectAgain();
  }
}

void ToSinumerik::selectAgain() { out_.line(std::string(selectedAgain)); }

void ToSinumerik::takeRotationOut(const MeasuringTask& task) {
  if (activeRow_ && !task.active && !(task.row == *activeRow_)) {
    throw NotCarriedOver("the cycle takes the rotation of the active preset out, but corrects another one",
                         "select the preset with cycle 247 before this cycle");
  }
  setRotation(task.active ? std::nullopt : std::optional(task.row), 0);
}

void ToSinumerik::setRotation(const std::optional<Quantity>& row, const Quantity& angle) {
  setComponent(row, axis(2) + ",RT", [&](const std::string&) { return sinumerikText(angle); });
}

void ToSinumerik::setComponent(const std::optional<Quantity>& row, const std::string& component,
                               const std::function<std::string(const std::string&)>& value) {
  const auto write = [&](const std::string& number) {
    const std::string text = fmt::format("$P_UIFR[{},{}]", number, component);
    out_.line(fmt::format("{}={}", text, value(text)));
  };
  forgetPosition();
  if (activeRow_ && (!row || *row == *activeRow_)) {
    write(std::to_string(*activeRow_));
    out_.line(settableCode(*activeRow_));
  } else if (row) {
    write(sinumerikText(*row));
    if (!activeRow_ || !row->isNumber()) selectAgain();
  } else {
    write("$P_UIFRNUM");
    selectAgain();
  }
}

void ToSinumerik::takeRowZero() {
  out_.line("$P_UIFR[99]=$P_UIFR[$P_UIFRNUM]");
  out_.line(settableCode(0));
  activeRow_ = 99;
  forgetPosition();
}

Quantity ToSinumerik::runningRow(const Quantity& row, RowZero zero) {
  const std::string own = formulas_.declare("_ROW");
  out_.line(fmt::format("{}={}", own, sinumerikText(row)));
  out_.line(fmt::format("IF {}<{}0", own, zero == RowZero::InEffect ? "=" : ""));
  out_.line(fmt::format("  {}=$P_UIFRNUM", own));
  out_.line("ENDIF");
  if (zero == RowZero::Preset) {
    out_.line(fmt::format("IF {}==0", own));
    out_.line("  $P_UIFR[99]=$P_UIFR[$P_UIFRNUM]");
    out_.line(fmt::format("  {}", settableCode(0)));
    out_.line(fmt::format("  {}=99", own));
    out_.line("ENDIF");
    activeRow_.reset();
  }
  forgetPosition();
  return Quantity::of(own);
}

void ToSinumerik::listRowAfterZero(const Block& block, const Quantity& row) {
  const bool inRow0 = (!activeRow_ && graph_.branches()) || activeRow_ == std::optional(99);
  if (!cyclesSetRow0_ || !inRow0 || (row.isNumber() && row.number() <= 0)) return;
  out_.list(
      block,
      "with Q305 = 0 in the cycle before a TNC 640 goes on in row 0, an iTNC 530 in the row in effect, which this "
      "cycle may set at once; the SINUMERIK does as a TNC 640",
      "select a row with cycle 247 before this cycle");
}

void ToSinumerik::basicRotation(const Block& block, const Call& call) {
  Quantity row = call.has("Q305") ? call.number("Q305") : Quantity(-1);
  listRowAfterZero(block, row);
  listLackingRow(block, row);
  if (row == 0) takeRowZero();
  if (!row.isNumber()) row = runningRow(row, RowZero::Preset);
  const bool active = row.isNumber() && row.number() <= 0;
  setRotation(active ? std::nullopt : std::optional(row), call.number("Q307"));
}

void ToSinumerik::planeByTouches(const Block& block, const MeasuringTask& plane) {
  static constexpr int heights[] = {173, 174, 175};
  const std::array<Place, 3> points = {plane.place, plane.further.at(0), plane.further.at(1)};
  std::set<int> missing = readResults("431");
  for (std::size_t i = 0; i < 3; ++i) {
    MeasuringTask touch = plane;
    touch.feature = Feature::Surface;
    touch.place = points[i];
    touch.axis = 2;
    touch.sign = -1;
    Losses losses;
    const SinumerikPassage passage = sinumerikPassage(touch, ballRadius_, losses);
    approach(*passage.start, plane.clearance);
    out_.line(callText(passage.call));
    out_.line(fmt::format("{}=_OVR[4]", parameter(heights[i])));
    missing.erase(heights[i]);
    out_.line(fmt::format("G0 {}", addressWord(axis(2), plane.clearance)));
    position_ = {touch.place[0], touch.place[1], plane.clearance};
  }
  besidePath_ = true;
  const auto apart = [&](std::size_t point, std::size_t axis) {
    return fmt::format("({})", sinumerikText(points[point][axis] - points[0][axis]));
  };
  const std::string z1 = fmt::format("({}-{})", parameter(174), parameter(173)),
                    z2 = fmt::format("({}-{})", parameter(175), parameter(173));
  const std::string x1 = apart(1, 0), y1 = apart(1, 1), x2 = apart(2, 0), y2 = apart(2, 1);
  // The normal is the cross product of two sides.
  const std::string nx = fmt::format("{}*{}-{}*{}", y1, z2, z1, y2), ny = fmt::format("{}*{}-{}*{}", z1, x2, x1, z2),
                    nz = fmt::format("{}*{}-{}*{}", x1, y2, y1, x2);
  const std::pair<int, std::string> angles[] = {{158, fmt::format("ATAN2(-({})/({}),1)", ny, nz)},
                                                {159, fmt::format("ATAN2(({})/({}),1)", nx, nz)}};
  for (const auto& [number, formula] : angles) {
    if (!usedQ_.contains(number)) continue;
    missing.erase(number);
    out_.line(fmt::format("{}={}", parameter(number), formula));
  }
  for (const int number : missing)
    out_.lose(block, fmt::format("Q{}: no SINUMERIK cycle has such a result", number));
}

}  // namespace probewright::conversion
