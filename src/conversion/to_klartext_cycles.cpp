#include <fmt/format.h>

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

void ToKlartext::copyResults(const Call& heidenhain, const Call& sinumerik, const MeasuringTask& task) {
  const Results wanted = sinumerikResults(sinumerik.cycle, task);
  const Results left = heidenhainResults(heidenhain.cycle, task);
  for (const auto& [meaning, name] : wanted) {
    const int index = std::stoi(name.substr(name.find('[') + 1));
    if (!usedResults_.contains(index)) continue;
    const auto found = left.find(meaning);
    if (found != left.end()) line(fmt::format("Q{} = {}", 1700 + index, found->second));
  }
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
  Losses losses;
  const Place start = here();
  MeasuringTask task = sinumerikTask(call, start, klartextBallRadius, losses);
  if (task.active) {
    const std::string row = formulas_.define("active preset", false);
    line(fmt::format("FN 18: SYSREAD {} = ID530 NR1", row));
    task.row = Quantity::of(row);
  }
  if (task.row == 99) task.row = 0;
  const Call measuring = heidenhainCall(task, losses);
  const cycles::CycleDefinition* heidenhain = cycles::heidenhainCycle(std::stoi(measuring.cycle));
  std::vector<std::string> lines = {fmt::format("TCH PROBE {} {} ~", measuring.cycle, heidenhain->title)};
  for (const cycles::Parameter& parameter : heidenhain->parameters) {
    if (!measuring.has(parameter.name)) continue;
    std::string meaning(parameter.meaning.substr(0, parameter.meaning.find_first_of(":;,")));
    lines.push_back(
        fmt::format("    {}={} ;{} ~", parameter.name, formulas_.value(measuring.number(parameter.name)), meaning));
  }
  lines.back().resize(lines.back().size() - 2);
  for (std::string& each : formulas_.takePrelude())
    out_.line(std::move(each));
  for (std::string& each : lines)
    out_.line(std::move(each));
  const Results results = heidenhainResults(measuring.cycle, task);
  copyResults(measuring, call, task);
  for (const std::string& loss : losses)
    out_.lose(block, loss);

  // The cycles of the SINUMERIK leave the probe elsewhere.
  const bool moved = task.correction != Correction::None;
  std::array<std::optional<Quantity>, 3> end = sinumerikEnd(call, task, start, results);
  forgetPosition();
  for (std::size_t i = 0; i < 2; ++i) {
    if (moved && end[i] && task.wish[i]) end[i] = *task.wish[i];
  }
  if (moved && task.wish[2]) end[2].reset();
  std::string back;
  for (std::size_t i = 0; i < 2; ++i)
    if (end[i]) back += fmt::format(" {}{}", axis(i), formulas_.value(*end[i]));
  if (!back.empty()) line(fmt::format("L{} {} FMAX", back, compensation_));
  for (std::size_t i = 0; i < 2; ++i)
    if (end[i] && end[i]->isNumber()) position_[i] = end[i];
  if (end[2] && end[2]->isNumber()) position_[2] = end[2];
}

}  // namespace probewright::conversion
