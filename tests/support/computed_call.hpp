#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace probewright::testing_support {

/// A call such as "CYCLE982(1,0,,5)" whose numbers come from R parameters, from R50 on, so that only the run knows
/// them. R parameters and empty places stay as they are.
inline std::string computedCall(const std::string& call) {
  const std::size_t open = call.find('(') + 1, close = call.find(')');
  const std::string arguments = call.substr(open, close - open);
  std::string before, after;
  int number = 50;
  for (std::size_t from = 0; from <= arguments.size();) {
    const std::size_t comma = std::min(arguments.find(',', from), arguments.size());
    const std::string value = arguments.substr(from, comma - from);
    if (from > 0) after += ',';
    if (value.empty() || value.front() == 'R') {
      after += value;
    } else {
      before += fmt::format("R{}={}\n", number, value);
      after += fmt::format("R{}", number++);
    }
    from = comma + 1;
  }
  return before + call.substr(0, open) + after + call.substr(close);
}

}  // namespace probewright::testing_support
