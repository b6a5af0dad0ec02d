#include <fmt/format.h>

#include "conversion/modes.hpp"
#include "conversion/to_sinumerik.hpp"
#include "language/klartext/commands.hpp"

/// Rows that touch probe cycles write although the preset table of the control may lack them.
namespace probewright::conversion {

using namespace language;

namespace {

/// The row that cycle 247 selects here, if it stands there as a number.
std::optional<int> selectedRow(const Block& block) {
  for (const Instruction& instruction : block.instructions) {
    const auto* change = std::get_if<Transform>(&instruction);
    if (change == nullptr || klartext::kindOf(block, *change) != klartext::TransformKind::PresetByCycle) continue;
    if (change->words.count == 0) continue;
    if (const auto row = literalOf(block, block.words[change->words.first].value)) return static_cast<int>(*row);
  }
  return std::nullopt;
}

}  // namespace

std::map<int, std::string> ToSinumerik::rowsSelectedAfter(const Block& block) {
  std::map<int, std::string> rows;
  Block each;
  Diagnostics ignored;
  const auto place = graph_.at(block.position);
  if (next_.empty()) next_ = followers(graph_, std::vector<bool>(graph_.blocks().size(), false));
  std::vector<bool> seen(next_.size());
  std::vector<std::size_t> open;
  if (place) open.push_back(*place);
  while (!open.empty()) {
    const std::size_t from = open.back();
    open.pop_back();
    for (const std::size_t to : next_[from]) {
      if (seen[to]) continue;
      seen[to] = true;
      open.push_back(to);
      program_.parse(graph_.blocks()[to].position, each, ignored);
      if (const auto row = selectedRow(each)) rows.emplace(*row, fmt::format("line {}", each.position.line));
    }
  }
  // Which of two programs comes first is not known here.
  for (const auto& other : job_.others) {
    for (BlockPosition at = other->begin(); other->parse(at, each, ignored); at = each.next)
      if (const auto row = selectedRow(each))
        rows.emplace(*row, fmt::format("{}, line {}", other->file(), each.position.line));
  }
  return rows;
}

void ToSinumerik::listLackingRow(const Block& block, const Quantity& row) {
  if (row.isNumber() && (row.number() <= 0 || lackingRows_.contains(static_cast<int>(row.number())))) return;
  for (const auto& [number, where] : rowsSelectedAfter(block)) {
    const bool written = !row.isNumber() || row.number() == number;
    if (!written || number <= 0 || number > 99 || selectedRows_.contains(number)) continue;
    if (!lackingRows_.insert(number).second) continue;
    out_.list(block,
              fmt::format("PRESET.PR may lack row {0}, which this cycle writes and {1} selects: the HEIDENHAIN control "
                          "then takes what no cycle sets there from the preset in effect, the SINUMERIK keeps what {2} "
                          "holds",
                          number, where, settableCode(number)),
              fmt::format("make sure that {} holds what row {} is to hold before the program runs",
                          settableCode(number), number));
  }
}

}  // namespace probewright::conversion
