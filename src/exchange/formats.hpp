#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"
#include "exchange/inspection.hpp"

/// Files for other programs.
namespace probewright::exchange {

struct Format {
  std::string_view name;   ///< as the command line calls it
  std::string_view file;   ///< what the run leaves
  std::string_view about;  ///< one sentence
  Result<std::string> (*write)(const Inspection& inspection);
};

/// All formats, in the order in which help texts list them.
std::span<const Format> formats();

/// The format of this name, in any case; null if there is none.
const Format* formatNamed(std::string_view name);

/// RFC 4180: a head line, then a row each; numbers with a decimal point and all their digits, UTF-8.
std::string csvText(const Inspection& inspection);

/// The record of many runs: the columns of csvText, before them those of the run (started, setup, part, seed).
/// `record`: as it stands in the file, empty for a new one; with the rows of one more run at its end. Fails if its
/// first line is not that of such a record, or its last one is not whole.
bool isRecord(std::string_view text);
Result<std::string> recordWith(std::string record, const Inspection& inspection);

/// Office Open XML: a sheet of the rows with colours for the verdicts and one of the run. Fails if no temporary file
/// can be written.
Result<std::string> xlsxFile(const Inspection& inspection);

/// JUnit XML: a suite for the run, a case for each characteristic that has limits and for each cycle that ended with an
/// alarm. Out of tolerance is a failure, an alarm an error.
std::string junitText(const Inspection& inspection);

/// Q-DAS ASCII transfer format (AQDEF) with keys of part, characteristics and values in one file.
std::string dfqText(const Inspection& inspection);

/// DMIS 5.2 (ISO 22093), its output: a nominal and an actual tolerance for each value that has limits. Plain ASCII.
std::string dmisText(const Inspection& inspection);

/// QIF 3.0 (ANSI/DMSC, ISO 23952): definitions, nominals, items and measurements of the characteristics.
std::string qifText(const Inspection& inspection);

}  // namespace probewright::exchange
