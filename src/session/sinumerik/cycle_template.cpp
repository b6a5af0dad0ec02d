#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/number_text.hpp"
#include "session/first_value.hpp"
#include "session/sinumerik/family_parts.hpp"

namespace probewright::session {

std::string sinumerikTemplate(const cycles::CycleDefinition& cycle, control::ControlKind kind,
                              control::DialogLanguage) {
  std::string comments, call;
  std::size_t last = 0;
  const std::size_t count = cycle.parameters.size();
  std::vector<std::string> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const cycles::Parameter& parameter = cycle.parameters[i];
    if (!parameter.controls.contains(kind)) continue;
    // Without a way to measure there is no call.
    const double value = parameter.name == "S_FA" ? 10 : firstValue(parameter);
    values[i] = parameter.kind == cycles::ValueKind::Text ? "\"\"" : formatShortest(value);
    last = i + 1;
    comments += fmt::format("; {:<10}= {:<6} {}\n", parameter.name, values[i], parameter.meaning);
  }
  for (std::size_t i = 0; i < last; ++i)
    call += (i > 0 ? "," : "") + values[i];
  return fmt::format("{}{}({})\n", comments, cycle.name, call);
}

}  // namespace probewright::session
