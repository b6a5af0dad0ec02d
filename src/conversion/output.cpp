#include "conversion/output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace probewright::conversion {

void Output::list(const language::Block& block, std::string message, std::string advice, Severity severity) {
  std::string_view line = block.at(block.source);
  line = trimmed(line.substr(0, line.find('\n')), lineBlanks);
  listed_.push_back(
      {severity, {file_, block.position.line, 1}, std::move(message), std::string(line), std::move(advice), {}});
}

void Output::listOnce(const language::Block& block, const std::string& message, std::string advice, Severity severity) {
  if (listedOnce_.insert(message).second) list(block, message, std::move(advice), severity);
}

void Output::leaveOut(const language::Block& block, std::string_view word, std::string_view control) {
  listOnce(
      block,
      fmt::format("{} says how the path is travelled or the program shown, not where it leads: it is left out", word),
      fmt::format("say it by the words of the {} control, if need be", control), Severity::Note);
}

void Output::lose(const language::Block& block, const std::string& what) {
  list(block, what);
  line("; NOT CARRIED OVER: " + what);
}

void Output::keepAsComment(const language::Block& block, const std::string& message, const std::string& advice) {
  list(block, message, advice);
  std::string_view rest = trimmed(block.at(block.source), lineBlanks);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    line("; NOT CARRIED OVER: " + std::string(trimmed(rest.substr(0, end), lineBlanks)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

}  // namespace probewright::conversion
