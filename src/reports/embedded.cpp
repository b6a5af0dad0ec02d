#include "reports/embedded.hpp"

#include <cstddef>

// Defined in embedded.S.
extern "C" {
extern const char probewrightReportJs[];
extern const char probewrightReportJsEnd[];
extern const char probewrightReportCss[];
extern const char probewrightReportCssEnd[];
extern const char probewrightMachineJs[];
extern const char probewrightMachineJsEnd[];
extern const char probewrightMachineCss[];
extern const char probewrightMachineCssEnd[];
}

namespace probewright::reports {

namespace {

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

}  // namespace

std::string_view embeddedReportJs() { return between(probewrightReportJs, probewrightReportJsEnd); }
std::string_view embeddedReportCss() { return between(probewrightReportCss, probewrightReportCssEnd); }
std::string_view embeddedMachineJs() { return between(probewrightMachineJs, probewrightMachineJsEnd); }
std::string_view embeddedMachineCss() { return between(probewrightMachineCss, probewrightMachineCssEnd); }

}  // namespace probewright::reports
