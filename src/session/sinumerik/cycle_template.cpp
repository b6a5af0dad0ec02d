#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/number_text.hpp"
#include "session/first_value.hpp"
#include "session/sinumerik/family_parts.hpp"
#include "words/cycle_words.hpp"

namespace probewright::session::sinumerik {

std::string sinumerikTemplate(const cycles::CycleDefinition& cycle, control::ControlKind kind,
                              control::DialogLanguage language) {
  std::string comments, call;
  std::size_t last = 0;
  const std::size_t count = cycle.parameters.size();
  std::vector<std::string> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const cycles::Parameter& parameter = cycle.parameters[i];
    if (!parameter.controls.contains(kind)) continue;
    const FirstValue first = firstValue(cycle, parameter);
    values[i] = parameter.kind == cycles::ValueKind::Text ? '"' + first.text + '"' : formatShortest(first.number);
    last = i + 1;
    const std::string meaning = words::ofCatalogue(language, parameter.meaning);
    comments += fmt::format("; {:<10}= {:<6} {}\n", parameter.name, values[i],
                            first.isExample ? words::ofCatalogue(language, "{0} (an example)", {meaning}) : meaning);
  }
  for (std::size_t i = 0; i < last; ++i)
    call += (i > 0 ? "," : "") + values[i];
  return fmt::format("{}{}({})\n", comments, cycle.name, call);
}

}  // namespace probewright::session::sinumerik
