#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/sink.hpp"
#include "control/journal.hpp"
#include "records/run_info.hpp"

/// The results of a run as JSON, for other programs: layout in docs/results.schema.json.
namespace probewright::records {

/// The layout's number; it grows when a reader of the older layout would misread the newer.
inline constexpr int resultsSchemaVersion = 1;

/// Everything that a run left behind. Lengths in mm, angles in degrees, times in seconds of the machine clock. A value
/// that is not a number (NaN, infinity) becomes null; texts become UTF-8 (see ReadableText).
nlohmann::json resultsJson(const control::Journal& journal, const RunInfo& run);

/// What is measured, as an object: `quantity`, and where they say something `along`, `item`, `system` and `label`. Null
/// if nothing is.
nlohmann::json characteristicJson(const control::Characteristic& characteristic, const std::string& label);

/// How JSON is laid out.
enum class Layout { Indented, Compact };

/// The same as text, element by element: a run may leave more than should be in memory a second time.
void writeResults(const Sink& sink, const control::Journal& journal, const RunInfo& run, Layout layout);

/// The text of `results.json`: indented UTF-8, numbers in the shortest form that reads back as the same
/// double, a newline at the end.
std::string resultsText(const control::Journal& journal, const RunInfo& run);

/// The worst verdict of all cycles; None if nothing was toleranced.
control::Verdict worstVerdict(const control::Journal& journal);

/// Measuring moves that came to a touch, and those that did not.
struct TouchCount {
  std::size_t touched = 0, failed = 0;
};
TouchCount countTouches(const control::Journal& journal);

/// "message", "alarm", "stop", "skipped", "tool", "warning": the names in results.json.
std::string_view eventName(control::EventKind kind);

/// "none", "good", "rework", "scrap": the names in results.json.
std::string_view verdictName(control::Verdict verdict);

/// "good", "out of tolerance", "input mistake", "stopped", "internal error": the names in results.json.
std::string_view exitName(ExitState state);

}  // namespace probewright::records
