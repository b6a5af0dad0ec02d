#pragma once

#include <filesystem>
#include <string>

#include "base/diagnostic.hpp"
#include "base/sink.hpp"

namespace probewright::app {

/// The Chromium that prints reports: $PROBEWRIGHT_CHROMIUM, or the first of the usual names in $PATH. A mistake if
/// there is none.
Result<std::filesystem::path> findChromium();

/// The report as pages in PDF, printed by this Chromium in a folder of its own.
Result<std::string> reportPdf(const std::filesystem::path& chromium, const Content& html);

}  // namespace probewright::app
