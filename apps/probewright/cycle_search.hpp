#pragma once

#include <string_view>
#include <vector>

#include "cycles/catalogue.hpp"

namespace probewright::app {

/// The cycles that somebody may mean by these words (UTF-8, between blanks), which all must be found: in the title,
/// else in the summary, the parameters or the results. Words of shops, and German, Russian, Swedish, Chinese and Polish
/// ones, stand for what the catalogue calls them in English; capitals and accents do not matter. Titles first,
/// otherwise in the order of `known`. Words of one letter find nothing.
std::vector<const cycles::CycleDefinition*> cyclesAbout(std::string_view words,
                                                        const std::vector<const cycles::CycleDefinition*>& known);

}  // namespace probewright::app
