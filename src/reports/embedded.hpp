#pragma once

#include <string_view>

/// The pages' scripts and styles, built from web/ and linked into the program.
namespace probewright::reports {

std::string_view embeddedReportJs();
std::string_view embeddedReportCss();
std::string_view embeddedMachineJs();
std::string_view embeddedMachineCss();

}  // namespace probewright::reports
