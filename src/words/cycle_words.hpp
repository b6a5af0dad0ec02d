#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "control/dialog_language.hpp"

/// What the catalogue says of cycles, their parameters and what can be chosen in them, in the other languages: the
/// table web/src/texts/cycles.json, and what the cycles' own files have. It is too long for every page; a report holds
/// what its calls need.
namespace probewright::words {

using control::DialogLanguage;

/// A description of the catalogue in this language; what the table does not know stays English.
std::string ofCatalogue(DialogLanguage language, std::string_view english);
/// The same with values in the places of {0}, {1}.
std::string ofCatalogue(DialogLanguage language, std::string_view english, const std::vector<std::string>& values);

/// In German, Russian, Swedish, Chinese and Polish, as the tables of phrases have them; also of a code with what its
/// digits choose: "measuring variant: front edge, measure only". Empty if the table does not know a part of it.
std::vector<std::string> inOtherLanguages(std::string_view english);

}  // namespace probewright::words
