#pragma once

#include <string>
#include <vector>

#include "cycles/heidenhain/context.hpp"

/// Logs in HTML beside the program: TCHPRAUTO.html of calibrations and cycles 1410 to 1420, TCHPR444.html.
namespace probewright::cycles::heidenhain {

/// Adds a section with the cycle's name, time and tool and a table: a heading row, then the rows. Cells are plain text;
/// they, the headings and the title appear in the control's conversational language. "good" is shown green, "rework"
/// orange, "scrap" red.
void addToHtmlLog(Context& context, const std::vector<std::string>& heading,
                  const std::vector<std::vector<std::string>>& rows, const std::string& file = "TCHPRAUTO.html");

}  // namespace probewright::cycles::heidenhain
