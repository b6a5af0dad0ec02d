#pragma once

#include <string>

#include "base/sink.hpp"
#include "control/journal.hpp"
#include "records/run_info.hpp"
#include "reports/scene.hpp"

namespace probewright::reports {

/// The report of a run as one HTML file: a view of part, path and touches in 3D, the results, the changes made,
/// messages and the program. It holds everything it needs, asks no network for anything and opens from disk. Texts of
/// any content and encoding are safe in it.
///
/// Of a program longer than `longestProgram` lines only the surroundings of cycles and events are shown.
std::string reportHtml(const control::Journal& journal, const records::RunInfo& run, const Scene& scene,
                       std::size_t longestProgram = 20000);

/// The same piece by piece, for runs that leave more than should be in memory a second time.
void writeReport(const Sink& sink, const control::Journal& journal, const records::RunInfo& run, const Scene& scene,
                 std::size_t longestProgram = 20000);

}  // namespace probewright::reports
