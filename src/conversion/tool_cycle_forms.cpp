#include "conversion/tool_cycle_forms.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "cycles/heidenhain/probe_words.hpp"
#include "language/klartext/writer.hpp"

namespace probewright::conversion {

using language::Block;
using language::CycleCall;
using language::Operand;
using language::Word;

namespace {

namespace word = cycles::heidenhain::probe_word;

constexpr int apart = 450;  ///< between the numbers of an old cycle and its new one
constexpr double newStatus = 199;

struct Twins {
  std::uint32_t old, now;
};
constexpr std::array<Twins, 3> parameters = {{{word::check, 340}, {word::height, 260}, {word::teeth, 341}}};

/// The number of the touch probe cycle that is all of the block; 0 of other blocks.
int cycleOf(const Block& block) {
  const auto* cycle = block.instructions.empty() ? nullptr : std::get_if<CycleCall>(&block.instructions.front());
  return cycle != nullptr && block.at(cycle->name) == "TCH PROBE" ? cycle->number : 0;
}

/// The block with another number and the words that `rename` keeps.
template <class Rename>
Block renumbered(const Block& block, int by, const Rename& rename) {
  Block written = block;
  auto& cycle = std::get<CycleCall>(written.instructions.front());
  cycle.number += by;
  std::vector<Word> words;
  for (std::uint32_t i = 0; i < cycle.parameters.count; ++i) {
    Word each = written.words[cycle.parameters.first + i];
    if (rename(each)) words.push_back(each);
  }
  cycle.parameters = {static_cast<std::uint32_t>(written.words.size()), static_cast<std::uint32_t>(words.size())};
  written.words.insert(written.words.end(), words.begin(), words.end());
  return written;
}

}  // namespace

std::optional<ToolCycleForm> newToolCycle(const Block& block) {
  const int number = cycleOf(block);
  if (number < 30 || number > 33) return std::nullopt;
  ToolCycleForm form;
  form.block = renumbered(block, apart, [&](Word& each) {
    if (each.address == word::result && each.value.isLiteral()) form.status = each.value.number;
    const auto known = std::ranges::find(parameters, each.address, &Twins::old);
    if (known == parameters.end()) return false;
    each.address = known->now;
    return true;
  });
  return form;
}

bool hasNewToolCycle(const Block& block) {
  const int number = cycleOf(block);
  return number >= 480 && number <= 483;
}

std::optional<ToolCycleForm> oldToolCycle(const Block& block) {
  if (!hasNewToolCycle(block) || language::klartext::writeBlock(block).find("=PREDEF") != std::string::npos)
    return std::nullopt;
  ToolCycleForm form;
  form.block = renumbered(block, -apart, [&](Word& each) {
    const auto known = std::ranges::find(parameters, each.address, &Twins::now);
    if (known == parameters.end()) return false;
    each.address = known->old;
    return true;
  });
  // 31.1 to 33.1 name the parameter of the status: that of the new form.
  auto& cycle = std::get<CycleCall>(form.block.instructions.front());
  if (cycle.number == 30) return form;
  Word result;
  result.address = word::result;
  result.value = Operand::of(newStatus);
  form.block.words.push_back(result);
  ++cycle.parameters.count;
  return form;
}

}  // namespace probewright::conversion
