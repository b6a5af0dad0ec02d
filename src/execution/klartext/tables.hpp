#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "control/heidenhain/text_table.hpp"
#include "execution/klartext/parameters.hpp"
#include "execution/klartext/tools.hpp"

namespace probewright::execution::klartext {

/// FN 26 TABOPEN, FN 27 TABWRITE, FN 28 TABREAD: freely definable tables. TABDATA: entries of the tool and the preset
/// table.
class Tables {
public:
  Tables(RunContext& run, Parameters& parameters, Tools& tools)
      : run_(run), control_(run.control), parameters_(parameters), tools_(tools) {}

  void open(std::string_view path);
  void write(const Command& command, Evaluation& evaluation);
  void read(const Command& command, Evaluation& evaluation);
  void tableData(const Command& command, Evaluation& evaluation);

private:
  void writeNumber(bool tool, const std::string& row, const std::string& column, double value);

  RunContext& run_;
  control::heidenhain::Control& control_;
  Parameters& parameters_;
  Tools& tools_;
  std::optional<control::heidenhain::TextTable> table_;  ///< opened with FN 26
};

}  // namespace probewright::execution::klartext
