#include "conversion/lacking_rows.hpp"

#include <fmt/format.h>

#include <utility>

#include "conversion/modes.hpp"

namespace probewright::conversion {

using namespace language;

LackingRows::LackingRows(Program& program, const FlowGraph& graph, const Job& job, Selected selected)
    : program_(program), graph_(graph), job_(job), selected_(std::move(selected)) {}

std::map<int, std::string> LackingRows::selectedAfter(const Block& block) {
  std::map<int, std::string> rows;
  if (const auto own = selected_(block)) rows.emplace(*own, "this block");
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
      if (const auto row = selected_(each)) rows.emplace(*row, fmt::format("line {}", each.position.line));
    }
  }
  // Which of two programs comes first is not known here.
  for (const auto& other : job_.others) {
    for (BlockPosition at = other->begin(); other->parse(at, each, ignored); at = each.next)
      if (const auto row = selected_(each))
        rows.emplace(*row, fmt::format("{}, line {}", other->file(), each.position.line));
  }
  return rows;
}

std::vector<LackingRows::Row> LackingRows::writtenBy(const Block& block, const Quantity& row,
                                                     const std::set<int>& there, int last) {
  std::vector<Row> rows;
  if (row.isNumber() && (row.number() <= 0 || told_.contains(static_cast<int>(row.number())))) return rows;
  for (auto& [number, where] : selectedAfter(block)) {
    const bool written = !row.isNumber() || row.number() == number;
    if (!written || number <= 0 || number > last || there.contains(number)) continue;
    if (told_.insert(number).second) rows.push_back({number, where});
  }
  return rows;
}

}  // namespace probewright::conversion
