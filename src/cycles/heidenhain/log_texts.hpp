#pragma once

#include <span>
#include <string>
#include <string_view>

#include "control/dialog_language.hpp"
#include "cycles/heidenhain/registry.hpp"

/// The words of the logs of HEIDENHAIN cycles in the conversational languages: those that several cycles have; the
/// words of one cycle are in its file (Entry::logTerms).
///
/// English, Russian and Swedish logs are worded as the manuals of these languages print the log of cycle 421; what is
/// not printed there (the other cycles) takes the terms that the manuals use for the same parameters. German logs have
/// the same layout and the terms of German shops. The Chinese manual prints the log in English and the Polish one
/// prints none: these languages have the English words.
namespace probewright::cycles::heidenhain {

using control::DialogLanguage;

/// What stands around the values of a measuring log.
struct LogFrame {
  std::string_view title;  ///< with {0} for the cycle's number and {1} for its title
  std::string_view date, time, program;
  std::string_view dateForm;  ///< strftime form
  std::string_view nominal, limits, actual, deviations, further;
  std::string_view end;
};
const LogFrame& logFrame(DialogLanguage language);

/// The languages whose logs have the English words.
bool hasEnglishLogs(DialogLanguage language);

/// The log of cycle 423 as the manual of the iTNC 530 prints it in English: in capitals, with terms of its own.
const LogFrame& capitalLogFrame();
std::string capitalTerm(std::string_view term, std::span<const CapitalTerm> own);

/// A label, heading or title of a log in another language than English, by the cycle's own words or the common ones;
/// what has no translation stays English.
std::string_view translated(std::string_view term, DialogLanguage language, std::span<const LogTerm> own = {});

/// `text` (UTF-8) with blanks after it up to `columns` characters.
std::string padded(std::string_view text, std::size_t columns);

}  // namespace probewright::cycles::heidenhain
