#include <fmt/format.h>

#include <vector>

#include "conversion/heidenhain_tasks.hpp"
#include "conversion/sinumerik_tasks.hpp"
#include "conversion/to_sinumerik.hpp"
#include "cycles/catalogue.hpp"

/// Touch probe cycles of HEIDENHAIN programs as measuring cycles of a SINUMERIK.
namespace probewright::conversion {

using namespace language;

namespace {

/// The call as text: each parameter at its place.
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

}  // namespace

Call ToSinumerik::callOf(const Block& block, const CycleCall& cycle) {
  Call call;
  call.cycle = std::to_string(cycle.number);
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
    call.numbers[name] = quantity(block, word.value);
  }
  return call;
}

void ToSinumerik::globalDefinition(const Block& block, const Command& command) {
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  for (const Word& word : words.subspan(1))
    global_[static_cast<int>(word.address)] = quantity(block, word.value);
}

void ToSinumerik::cycle(const Block& block, const CycleCall& cycle) {
  if (block.at(cycle.name) != "TCH PROBE") {
    throw NotCarriedOver(fmt::format("cycle {} is no measuring cycle", cycle.number), "write it by hand");
  }
  const cycles::CycleDefinition* definition = cycles::heidenhainCycle(cycle.number);
  const Call call = callOf(block, cycle);
  Losses losses;
  const std::vector<MeasuringTask> tasks = heidenhainTasks(call, sinumerikBallRadius, losses);
  out_.line(fmt::format("; {} {}", cycle.number, definition == nullptr ? "" : definition->title));
  for (const MeasuringTask& each : tasks)
    task(block, each, call.cycle);
  for (const std::string& loss : losses)
    out_.lose(block, loss);
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

void ToSinumerik::task(const Block& block, const MeasuringTask& given, const std::string& heidenhainCycle) {
  MeasuringTask task = given;
  if (task.correction != Correction::None && task.row == 0) {
    // Row 0 is the preset that the cycle sets at once; its twin is the last settable zero offset.
    out_.line("$P_UIFR[99]=$P_UIFR[$P_UIFRNUM]");
    out_.line(settableCode(0));
    task.row = 99;
    forgetPosition();
  }
  Losses losses;
  const SinumerikPassage passage = sinumerikPassage(task, sinumerikBallRadius, losses);
  approach(passage.start, task.clearance);
  out_.line(callText(passage.call));
  copyResults(heidenhainCycle, task, passage.call.cycle);
  out_.line(fmt::format("G0 {}", addressWord(axis(2), task.clearance)));
  shiftToWish(task);
  for (const std::string& loss : losses)
    out_.lose(block, loss);
  forgetPosition();
  if (task.correction == Correction::None) position_[2] = task.clearance;
  besidePath_ = true;
}

void ToSinumerik::shiftToWish(const MeasuringTask& task) {
  if (task.correction != Correction::Origin) return;
  // The cycle has given the feature the coordinates that it was expected at; the origin moves by what is left.
  std::array<Quantity, 3> left;
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!task.wish[i]) continue;
    left[i] = task.place[i] - *task.wish[i];
    any = any || !(left[i] == 0);
  }
  if (!any) return;
  const std::string row = task.active ? "$P_UIFRNUM" : sinumerikText(task.row);
  const auto component = [&](std::size_t i) { return fmt::format("$P_UIFR[{},{},TR]", row, axis(i)); };
  const std::string angle = fmt::format("$P_UIFR[{},{},RT]", row, axis(2));
  const auto times = [&](const char* function, const Quantity& value, double sign) {
    if (value == 0) return std::string();
    const std::string text = factorText(sinumerikText(sign < 0 ? -value : value));
    return fmt::format("+{}*{}({})", text.front() == '-' ? "(" + text + ")" : text, function, angle);
  };
  if (!(left[0] == 0 && left[1] == 0)) {
    out_.line(fmt::format("{0}={0}{1}{2}", component(0), times("COS", left[0], 1), times("SIN", left[1], -1)));
    out_.line(fmt::format("{0}={0}{1}{2}", component(1), times("SIN", left[0], 1), times("COS", left[1], 1)));
  }
  if (!(left[2] == 0)) out_.line(fmt::format("{0}={0}+{1}", component(2), factorText(sinumerikText(left[2]))));
  if (!task.row.isNumber() || task.active) {
    out_.line("G[8]=$P_UIFRNUM+1");
  } else {
    const int number = static_cast<int>(task.row.number());
    out_.line(fmt::format("IF $P_UIFRNUM=={}", number));
    out_.line("  " + settableCode(number));
    out_.line("ENDIF");
  }
}

void ToSinumerik::copyResults(const std::string& heidenhainCycle, const MeasuringTask& task, const std::string& cycle) {
  const Results wanted = heidenhainResults(heidenhainCycle, task);
  const Results left = sinumerikResults(cycle, task);
  for (const auto& [meaning, name] : wanted) {
    if (!usedQ_.contains(std::stoi(name.substr(1)))) continue;
    const auto found = left.find(meaning);
    if (found == left.end()) continue;
    VariableRef variable;
    variable.index[0] = Operand::of(std::stod(name.substr(1)));
    out_.line(fmt::format("{}={}", formulas_.variable(variable), found->second));
  }
}

}  // namespace probewright::conversion
