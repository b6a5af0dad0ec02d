#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "control/operator_panel.hpp"

namespace probewright::app {

/// The operator at the terminal: what a program asks is shown on standard output and answered on standard input. A
/// stop (Ctrl-C) ends the waiting for an answer, which then counts as none.
class OperatorTerminal {
public:
  explicit OperatorTerminal(std::stop_token stop) : stop_(std::move(stop)) {}

  /// Shows the text of a stop; true to go on. False where the input ends.
  bool goesOn(const std::string& text);

  /// Asks until the answer can be understood or the input ends. Nothing if there is no terminal.
  std::optional<std::string> answer(const control::Question& question);

private:
  std::optional<std::string> line();

  std::stop_token stop_;
  std::string typed_;  ///< what has come after the last line
};

}  // namespace probewright::app
