#include "session/answers.hpp"

#include <fmt/format.h>

#include "base/text.hpp"

namespace probewright::session {

Result<std::map<std::string, std::string>> parseAnswers(std::string_view text, const std::string& file) {
  std::map<std::string, std::string> answers;
  for (std::uint64_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view whole = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::string_view line = trimmed(whole.substr(0, whole.find('#')), blanksAndReturn);
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    const std::string name(trimmed(line.substr(0, equals), blanksAndReturn));
    if (equals == std::string_view::npos || name.empty()) {
      return fail({file, number, 1}, fmt::format("'{}' is not an answer", line.substr(0, 60)), "write NAME = VALUE");
    }
    if (!answers.emplace(name, trimmed(line.substr(equals + 1), blanksAndReturn)).second) {
      return fail({file, number, 1}, fmt::format("'{}' is answered twice", name.substr(0, 60)),
                  "remove one of the two lines");
    }
  }
  return answers;
}

}  // namespace probewright::session
