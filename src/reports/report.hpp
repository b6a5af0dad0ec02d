#pragma once

#include <string>

#include "base/sink.hpp"
#include "control/journal.hpp"
#include "records/run_info.hpp"
#include "records/run_trace.hpp"
#include "reports/scene.hpp"

namespace probewright::reports {

/// How the page begins, and what it shows besides the results.
struct PageOptions {
  /// Of a longer program only the surroundings of cycles and events are shown; lines.
  std::size_t longestProgram = 200'000;
  const records::RunTrace* trace = nullptr;  ///< what a replay follows; null: nothing was recorded
  std::string language = "en";               ///< of the page, ISO 639-1; readers switch it there
};

/// The report of a run as one HTML file: a view of part, path and touches in 3D, the results, the changes made,
/// messages and the program. It holds everything it needs, asks no network for anything and opens from disk. Texts of
/// any content and encoding are safe in it: they are compressed data until the page shows them as text.
std::string reportHtml(const control::Journal& journal, const records::RunInfo& run, const Scene& scene,
                       const PageOptions& options = {});

/// The same piece by piece, for runs that leave more than should be in memory a second time.
void writeReport(const Sink& sink, const control::Journal& journal, const records::RunInfo& run, const Scene& scene,
                 const PageOptions& options = {});

}  // namespace probewright::reports
