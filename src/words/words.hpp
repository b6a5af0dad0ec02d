#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "control/dialog_language.hpp"
#include "control/result_kind.hpp"

/// What people read, in six languages: the tables of the report's page (web/src/texts), for whoever writes outside of
/// it. The record of a run itself is in English; words stand only in what is shown.
namespace probewright::words {

using control::DialogLanguage;

/// What takes the place of a {name} in a text.
using Values = std::initializer_list<std::pair<std::string_view, std::string>>;

/// The text of `key` in the language's table, with `values` in it. `n` decides between singular and plurals, where the
/// key has them, and takes the place of {n}. Throws std::logic_error for a key that no table has.
std::string text(DialogLanguage language, std::string_view key, Values values = {});
std::string counted(DialogLanguage language, std::string_view key, std::size_t n, Values values = {});

/// A title of a cycle, a name of an alarm or a sentence about a run in another language, by web/src/texts/phrases.json:
/// a phrase as it stands there, or one with values in the places of {0}, {1}...; of "NAME: sentence" each part for
/// itself, of "Hole 40" the word before its size. What the table does not know stays English.
std::string translated(DialogLanguage language, std::string_view english);

/// The same of the text as a whole: for what may be a program's own words.
std::string phrase(DialogLanguage language, std::string_view english);

/// What a value is of, "diameter" or "centre, main axis": `english` in English and where no table has the quantity.
/// Where phrases.json has the English words as they stand, these say more than the quantity does: "standard deviation
/// of A" of a distance.
std::string characteristic(DialogLanguage language, const control::Characteristic& of, std::string_view english);

/// "actual value, diameter": its role too.
std::string meaning(DialogLanguage language, const control::ResultKind& kind, std::string_view english);

}  // namespace probewright::words
