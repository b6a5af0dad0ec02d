#pragma once

#include <nlohmann/json.hpp>

#include "cycles/catalogue.hpp"

/// What the files of cycles say in other languages, in the form of the tables in web/src/texts: the English text, and
/// German, Russian, Swedish, Chinese and Polish for it.
namespace probewright::words {

void addOwnWords(const cycles::CycleDefinition& cycle, nlohmann::json& table);

/// Those of all cycles.
void addOwnWords(nlohmann::json& table);

}  // namespace probewright::words
