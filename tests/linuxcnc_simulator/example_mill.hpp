#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/linuxcnc_session.hpp"

namespace probewright::testing {

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The numbers of the line of `output` that begins with `word`, as (PRINT) of G-code writes it.
inline std::vector<double> line(const std::string& output, const std::string& word) {
  const std::size_t at = output.find("\n" + word + " ");
  if (at == std::string::npos) return {};
  return LinuxCncSession::told("desk: " + output.substr(at + 1), word);
}

/// mm: how far an axis goes in a servo period of 1 ms at this probing feed, per minute, and a little more.
constexpr double within(double feed) { return feed / 60 * 0.001 + 1e-4; }

/// A machine of examples/linuxcnc with a script as its display.
class ExampleMill {
public:
  explicit ExampleMill(const std::string& name = "mill3")
      : session(PROBEWRIGHT_SOURCE_DIR, PROBEWRIGHT_BUILD_DIR),
        example(std::filesystem::path(PROBEWRIGHT_SOURCE_DIR) / "examples/linuxcnc" / name),
        ini(contents(example / (name + ".ini"))) {
    replace("DISPLAY = axis", "DISPLAY = ./display.py");
    replace("HALFILE = probewright_feel.tcl",
            "HALFILE = " + (session.source() / "linuxcnc/feel/probewright_feel.tcl").string());
    replace("libprobewright_interp.so", (session.build() / "linuxcnc/interpreter/libprobewright_interp.so").string());
    replace("SETUP = practice.toml", "SETUP = practice.toml\nPROGRAM = " + program());
  }
  /// All files of the example but its configuration are there.
  void copyAll() const {
    for (const auto& file : std::filesystem::directory_iterator(example))
      std::filesystem::copy(file, session.outside() / file.path().filename());
  }
  /// Who is not root needs the module installed.
  bool feels() { return session.needModule("linuxcnc/feel/probewright_feel.so"); }
  static constexpr const char* unfelt = "only root can lend LinuxCNC a module that is not installed";

  /// The program probewright as LinuxCNC sees it.
  std::string program() const { return (session.build() / "apps/probewright/probewright").string(); }
  /// In the configuration, wherever it stands.
  void replace(const std::string& what, const std::string& by) { replaceIn(ini, what, by); }
  /// In a file of the session.
  void replace(const std::string& file, const std::string& what, const std::string& by) const {
    std::string text = contents(session.outside() / file);
    replaceIn(text, what, by);
    session.write(file, text);
  }
  /// G-code is LinuxCNC's own, and nothing else runs.
  void leaveInterpreterOut() {
    const std::size_t at = ini.find("INTERPRETER = ");
    ini.erase(at, ini.find('\n', at) + 1 - at);
  }
  /// Axes that are faster than those of the example.
  void hurry() {
    for (const char* speed : {"MAX_VELOCITY = 100", "MAX_VELOCITY = 80", "MAX_LINEAR_VELOCITY = 150"})
      replace(speed, std::string(speed, std::string(speed).find(' ')) + " = 500");
    replace("MAX_ACCELERATION = 1000", "MAX_ACCELERATION = 8000");
  }
  /// Runs LinuxCNC with this script, which has a Desk as `desk`, until that ends; what all of it has printed.
  std::string run(const std::string& script, int seconds = 300) const {
    session.write("test.ini", ini);
    session.display(script);
    return session.run("test.ini", seconds);
  }

  LinuxCncSession session;
  std::filesystem::path example;
  std::string ini;

private:
  static void replaceIn(std::string& text, const std::string& what, const std::string& by) {
    EXPECT_NE(text.find(what), std::string::npos) << what;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
      text.replace(at, what.size(), by);
  }
};

}  // namespace probewright::testing
