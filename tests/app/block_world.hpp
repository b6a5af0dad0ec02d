#pragma once

#include <sstream>
#include <string>

/// A block on a mill with a TNC 640, a program that measures it, and what is said about both.
namespace probewright::app::testing {

/// The number of messages; how far a long import has got is none.
inline std::size_t messages(const std::string& errors) {
  std::size_t count = 0;
  std::istringstream lines(errors);
  for (std::string line; std::getline(lines, line);) {
    const auto has = [&](const char* kind) { return line.find(kind) != std::string::npos; };
    if (!line.empty() && line[0] != ' ' && (has(": error: ") || has(": warning: ") || has(": note: "))) ++count;
  }
  return count;
}

/// A setup with a block of 40 x 30 x 20 mm whose top face lies at Z -480, and `more` of a setup.
inline std::string blockSetup(const std::string& more = "") {
  return R"(
[control]
type = "TNC640"
[part]
pose = { z = -500 }
[[part.feature]]
shape = "box"
size = [40, 30, 20]
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 100
ball_radius = 3
[[preset]]
row = 1
origin = [0, 0, -480]
active = true
)" + more;
}

/// Measures the right side of the block, nominally at X 20, against these limits; `log` is Q281.
inline std::string blockProgram(const std::string& largest = "+0", const std::string& smallest = "+0", int log = 0) {
  return "0 BEGIN PGM BLOCK MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n"
         "3 TCH PROBE 427 SIDE ~\nQ263=+20 ~\nQ264=+0 ~\nQ261=-5 ~\nQ320=+2 ~\nQ272=+1 ~\nQ267=-1 ~\nQ260=+30 ~\n"
         "Q281=+" +
         std::to_string(log) + " ~\nQ288=" + largest + " ~\nQ289=" + smallest +
         " ~\nQ309=+0 ~\nQ330=+0\n4 END PGM BLOCK MM\n";
}

}  // namespace probewright::app::testing
