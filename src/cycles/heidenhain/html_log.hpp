#pragma once

#include <string>
#include <vector>

#include "cycles/heidenhain/context.hpp"

/// Logs in HTML beside the program: TCHPRAUTO.html of calibrations and cycles 1410 to 1420, TCHPR444.html.
namespace probewright::cycles::heidenhain {

/// Adds a table, a heading row and the rows, to the section of the running cycle. The first table of a call opens that
/// section with the cycle's name, time, program, tool and touch probe. Cells are plain text; they, the headings and the
/// title appear in the control's conversational language. "good" is shown green, "rework"
/// orange, "scrap" red.
void addToHtmlLog(Context& context, const std::vector<std::string>& heading,
                  const std::vector<std::vector<std::string>>& rows, const std::string& file = "TCHPRAUTO.html");

}  // namespace probewright::cycles::heidenhain
