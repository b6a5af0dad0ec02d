#include <fmt/format.h>

#include <utility>

#include "conversion/heidenhain_tasks.hpp"
#include "conversion/sinumerik_formulas.hpp"
#include "conversion/sinumerik_tasks.hpp"
#include "conversion/to_klartext.hpp"
#include "cycles/catalogue.hpp"

/// Measuring cycles of SINUMERIK programs as touch probe cycles.
namespace probewright::conversion {

using namespace language;

Place ToKlartext::here() {
  Place place;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!position_[i]) {
      const std::string name = formulas_.define(fmt::format("position {}", axis(i)), false);
      line(fmt::format("FN 18: SYSREAD {} = ID270 NR1 IDX{}", name, axis(i)[0] - 'X' + 1));
      position_[i] = Quantity::of(name);
    }
    place[i] = *position_[i];
  }
  return place;
}

void ToKlartext::copyResults(const Block& block, const Results& left, const MeasuringTask& task) {
  std::set<int> missing = wantedAfter_[cycleNumber_];
  const auto deviationOf = [&](Meaning meaning) -> std::optional<std::pair<Meaning, Quantity>> {
    const auto axis = static_cast<std::size_t>(task.axis);
    switch (meaning) {
      case Meaning::Centre1Deviation:
        return std::pair(Meaning::Centre1, task.place[0]);
      case Meaning::Centre2Deviation:
        return std::pair(Meaning::Centre2, task.place[1]);
      case Meaning::Size1Deviation:
        return std::pair(Meaning::Size1, task.size[0]);
      case Meaning::Size2Deviation:
        return std::pair(Meaning::Size2, task.size[1]);
      case Meaning::CoordinateDeviation:
        return std::pair(Meaning::Coordinate, task.place[axis]);
      default:
        return std::nullopt;
    }
  };
  const Results results = sinumerikResults(task);
  std::vector<std::pair<Meaning, std::string>> wanted(results.begin(), results.end());
  if (task.feature == Feature::Surface) {  // the same once more, by axis
    wanted.emplace_back(Meaning::Coordinate, fmt::format("_OVR[{}]", 5 + task.axis));
    wanted.emplace_back(Meaning::CoordinateDeviation, fmt::format("_OVR[{}]", 17 + task.axis));
  }
  for (const auto& [meaning, name] : wanted) {
    const int index = std::stoi(name.substr(name.find('[') + 1));
    if (!usedResults_.contains(index)) continue;
    const auto found = left.find(meaning);
    const auto deviation = deviationOf(meaning);
    std::string formula;
    if (found != left.end() && found->second == "Q964") {
      // From the first point to the second, that is along the positive axis.
      formula = task.axis == 0 ? "Q964 - 90" : "Q964";
    } else if (found != left.end() && task.feature == Feature::Edge && task.axis == 0 && found->second == "Q150") {
      formula = fmt::format("{0} - 90 * SGN {0}", found->second);
    } else if (found != left.end() && found->second == "Q158") {
      formula = "ATAN (TAN Q158 * COS Q159)";
    } else if (found != left.end()) {
      formula = found->second;
    } else if (deviation && left.contains(deviation->first)) {
      formula = expressionText(Quantity::of(left.at(deviation->first)) - deviation->second, true);
    } else if (meaning == Meaning::AngleDeviation && left.contains(Meaning::Angle)) {
      const std::string angle = left.at(Meaning::Angle);
      formula = task.axis == 0 ? fmt::format("{0} - 90 * SGN {0}", angle) : angle;
      formula = fmt::format("{} - ({})", formula, expressionText(sinumerikEdgeAngle(task, task.angle), true));
    } else {
      continue;
    }
    missing.erase(index);
    line(fmt::format("Q{} = {}", 1700 + index, formula));
  }
  for (const int index : missing)
    out_.lose(block, fmt::format("_OVR[{}]: the touch probe cycle has no such result", index));
}

void ToKlartext::cycle(const Block& block, const CallProgram& called) {
  const cycles::CycleDefinition* definition = cycles::sinumerikCycle(block.at(called.name));
  Call call;
  call.cycle = definition->name;
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
  ++cycleNumber_;
  Losses losses;
  const bool calibrates = call.cycle == "CYCLE976";
  const Place start = calibrates ? Place{} : here();
  MeasuringTask task = sinumerikTask(call, start, klartextBallRadius, losses);
  const bool turns = task.correction == Correction::Rotation;
  if (turns && activeRow_ && task.row == *activeRow_) task.active = true;
  task.fromUnturned = std::exchange(unturned_, false) && turns;
  if (task.active && !turns) {
    const std::string row = formulas_.define("active preset", false);
    line(fmt::format("FN 18: SYSREAD {} = ID530 NR1", row));
    task.row = Quantity::of(row);
  }
  if (task.row == 99) task.row = 0;
  const Call measuring = heidenhainCall(task);
  const cycles::CycleDefinition* heidenhain = cycles::heidenhainCycle(std::stoi(measuring.cycle));
  std::vector<std::string> lines = {fmt::format("TCH PROBE {} {} ~", measuring.cycle, heidenhain->title)};
  for (const cycles::Parameter& parameter : heidenhain->parameters) {
    if (!measuring.has(parameter.name)) continue;
    const std::string_view meaning = parameter.meaning.substr(0, parameter.meaning.find_first_of(":;,"));
    lines.push_back(
        fmt::format("    {}={} ;{} ~", parameter.name, formulas_.value(measuring.number(parameter.name)), meaning));
  }
  lines.back().resize(lines.back().size() - 2);
  for (std::string& each : formulas_.takePrelude())
    out_.line(std::move(each));
  for (std::string& each : lines)
    out_.line(std::move(each));
  const Results results = heidenhainResults(measuring.cycle, task);
  copyResults(block, results, task);
  for (const std::string& loss : losses)
    out_.lose(block, loss);
  if (!calibrates) goBack(task, sinumerikEnd(call, task, start, klartextBallRadius, results));
}

void ToKlartext::goBack(const MeasuringTask& task, std::array<std::optional<Quantity>, 3> end) {
  forgetPosition();
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
}

}  // namespace probewright::conversion
