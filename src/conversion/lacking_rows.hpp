#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "conversion/flow_graph.hpp"
#include "conversion/job.hpp"
#include "conversion/quantity.hpp"
#include "language/block.hpp"
#include "language/program.hpp"

/// Rows that a program writes although the preset table of the HEIDENHAIN control may lack them. The control adds such
/// a row as a copy of the preset in effect; a settable zero offset of a SINUMERIK is always there and keeps what nobody
/// sets.
namespace probewright::conversion {

class LackingRows {
public:
  /// The row or the zero offset that a block selects, if its number stands there.
  using Selected = std::function<std::optional<int>(const language::Block& block)>;

  /// The program and what it belongs to must outlive this.
  LackingRows(language::Program& program, const FlowGraph& graph, const Job& job, Selected selected);

  struct Row {
    int number = 0;
    std::string where;  ///< "line 12": a block that selects it
  };
  /// Rows 1 to `last` that the block writes and then it or a later one selects; each is told once. `row`: the one that
  /// is written, any of them if only the running program knows it. `there`: rows that the table has.
  std::vector<Row> writtenBy(const language::Block& block, const Quantity& row, const std::set<int>& there, int last);
  /// True the first time that it is asked of a row that has not been told yet.
  bool isNew(int row) { return told_.insert(row).second; }

private:
  std::map<int, std::string> selectedAfter(const language::Block& block);

  language::Program& program_;
  const FlowGraph& graph_;
  const Job& job_;
  Selected selected_;
  std::set<int> told_;
  std::vector<std::vector<std::size_t>> next_;  ///< which blocks may follow each
};

}  // namespace probewright::conversion
