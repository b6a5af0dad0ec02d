#pragma once

#include <string_view>

/// The page's script and style, built from web/ and linked into the program.
namespace probewright::reports {

std::string_view embeddedReportJs();
std::string_view embeddedReportCss();

}  // namespace probewright::reports
