#pragma once

#include <map>
#include <string>
#include <string_view>

#include "execution/klartext/parameters.hpp"
#include "execution/klartext/protocol_mask.hpp"

namespace probewright::execution::klartext {

/// What programs write for people: FN 16, FN 15, FN 38.
class Protocol {
public:
  Protocol(RunContext& run, Parameters& parameters) : run_(run), control_(run.control), parameters_(parameters) {}

  /// FN 16: F-PRINT mask / target.
  void write(const Command& command, Evaluation& evaluation);
  /// FN 15: PRINT 12/Q5/QS1 adds a line to %FN15RUN.A: numbers with their sign, a decimal comma and up to four
  /// decimals.
  void print(std::string_view text);
  /// FN 38: SEND /"X = %F" / +Q1: the text with its values, among the messages.
  void send(std::string_view text);

private:
  void insertParameters(std::string& text) const;
  std::string fileOf(const std::string& target) const;
  void writeFile(const std::string& name, const ProtocolResult& result);

  RunContext& run_;
  control::heidenhain::Control& control_;
  Parameters& parameters_;
  std::map<std::string, bool> open_;
};

}  // namespace probewright::execution::klartext
