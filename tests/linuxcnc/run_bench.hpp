#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "support/linuxcnc_session.hpp"

namespace probewright::testing {

/// A LinuxCNC with a plate that has a bore (world/plate.hal), and programs that measure it.
class LinuxCncRun : public ::testing::Test {
protected:
  /// Where the plate is. The control believes in a preset at X0 Y0 Z-250; the probe is 100 mm long.
  struct World {
    double x = 0.7, y = -0.4, top = -250.25, diameter = 30.01;
  };
  static constexpr double ball = 3;        // mm, radius
  static constexpr double period = 0.001;  // s, of the servo thread

  LinuxCncRun() : session_(PROBEWRIGHT_SOURCE_DIR, PROBEWRIGHT_BUILD_DIR) {
    for (const char* name : {"bench.py", "mill.ini", "plate.hal", "tool.tbl"})
      std::filesystem::copy(std::filesystem::path(PROBEWRIGHT_SOURCE_DIR) / "tests/linuxcnc/world" / name,
                            session_.outside() / name);
    session_.write("mill.var", "");
  }

  /// The setup of the virtual machine with the same world, of which a run on LinuxCNC takes the beliefs.
  static std::string setup(const std::string& control, const World& world, double feed) {
    std::ostringstream text;
    text << "[control]\ntype = \"" << control << "\"\n[part]\nname = \"plate\"\npose = { x = " << world.x
         << ", y = " << world.y << ", z = " << world.top - 20
         << " }\n[[part.feature]]\nshape = \"box\"\nsize = [90, 80, 20]\n[[part.feature]]\nshape = \"hole\"\n"
         << "centre = [0, 0, 20]\ndiameter = " << world.diameter
         << "\n[[tool]]\nnumber = 1\nname = \"PROBE\"\nkind = \"probe\"\nlength = 100\nball_radius = 3\nprobing_feed = "
         << feed << "\n[[tool]]\nnumber = 2\nname = \"MILL\"\nkind = \"mill\"\nlength = 90\nradius = 5\n"
         << (control == "TNC640" ? "[[preset]]\nrow = 1\n" : "[[zero_offset]]\nname = \"G54\"\n")
         << "origin = [0, 0, -250]\nactive = true\n";
    return text.str();
  }
  /// In the words of bench.world().
  static std::string call(const World& world) {
    std::ostringstream text;
    text.precision(12);
    text << "world(" << world.x << ", " << world.y << ", " << world.diameter / 2 - ball << ", " << world.top + 100
         << ")\n";
    return text.str();
  }

  /// The top face becomes Z0, the middle of the bore X0 Y0.
  static std::string klartext(int starts = 1) {
    return "0 BEGIN PGM BORE MM\n1 TOOL CALL " + std::to_string(starts) +
           " Z\n2 L X+25 Y+0 Z+8 R0 FMAX\n"
           "3 TCH PROBE 417 PRESET IN TS AXIS ~\n Q263=+25 ~\n Q264=+0 ~\n Q294=+0 ~\n Q320=+0 ~\n Q260=+5 ~\n"
           " Q305=+1 ~\n Q333=+0 ~\n Q303=+1\n"
           "4 TCH PROBE 412 PRESET INSIDE CIRCLE ~\n Q321=+0 ~\n Q322=+0 ~\n Q262=+30 ~\n Q325=+0 ~\n Q247=+90 ~\n"
           " Q261=-8 ~\n Q320=+0 ~\n Q260=+5 ~\n Q301=+0 ~\n Q305=+1 ~\n Q331=+0 ~\n Q332=+0 ~\n Q303=+1 ~\n Q381=+0 "
           "~\n"
           " Q382=+0 ~\n Q383=+0 ~\n Q384=+0 ~\n Q333=+0 ~\n Q423=+4 ~\n Q365=+1\n5 L Z+8 R0 FMAX\n6 END PGM BORE MM\n";
  }
  /// The top face becomes Z0: one touch.
  static std::string top() {
    std::string program = klartext();
    const std::size_t from = program.find("4 TCH PROBE 412"), to = program.find("5 L Z+8");
    return program.erase(from, to - from);
  }
  static std::string sinumerik() {
    return "N10 G17 G90 G71 G94 G54\nN20 T=\"PROBE\"\nN30 M6 D1\nN40 G0 X25 Y0\nN50 G0 Z6\n"
           "N60 CYCLE978(100,10001,,1,0,6,3,3,2,1,\"\",,0,,0,0,,,,,1,)\nN70 G0 Z8\nN80 X0 Y0\nN90 G1 Z-8 F3000\n"
           "N100 CYCLE977(101,10001,,1,30,,,3,3,0,,,,1,1,\"\",,0,,0,0,,,,,1,)\nN110 G0 Z8\nM30\n";
  }

  /// Runs LinuxCNC, switched on and homed, with this script at the desk; keeps what was printed.
  void atTheDesk(const std::string& script, int seconds = 300) {
    forTheDesk(script);
    output = session_.run("mill.ini", seconds);
  }
  void forTheDesk(const std::string& script) const {
    session_.display("from bench import *\nimport bench\nbench.PROGRAM = '" +
                     (session_.build() / "apps/probewright/probewright").string() + "'\ndesk.ready()\n" + script);
  }
  /// What was told of the run `name`: "CODE TEXT".
  std::string told(const std::string& name) const {
    std::smatch found;
    return std::regex_search(output, found, std::regex("desk: " + name + " ([^\n]*)")) ? found[1].str() : "nothing";
  }
  std::string text(const std::string& name) const {
    std::ifstream file(session_.outside() / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  nlohmann::json results(const std::string& folder) const {
    return nlohmann::json::parse(text(folder + "/results.json"), nullptr, false);
  }
  /// The virtual machine's results of the same program.
  void runVirtually(const std::string& program, const std::string& folder) const {
    const auto file = [&](const std::string& name) { return " '" + (session_.outside() / name).string() + "'"; };
    const std::string command = PROBEWRIGHT_BUILD_DIR "/apps/probewright/probewright run --quiet" + file(program) +
                                " --setup" + file("setup.toml") + " --out" + file(folder);
    EXPECT_EQ(std::system(command.c_str()), 0);
  }
  /// X, Y and Z of all touches.
  static std::vector<double> touches(const nlohmann::json& results) {
    std::vector<double> all;
    for (const auto& cycle : results.at("cycles"))
      for (const auto& touch : cycle.at("touches"))
        for (const char* axis : {"X", "Y", "Z"})
          all.push_back(touch.at("axes").at(axis).get<double>());
    return all;
  }
  /// X, Y and Z of preset 1.
  std::vector<double> preset(const std::string& folder) const {
    std::istringstream lines(text(folder + "/PRESET.PR"));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::vector<double> row;
      for (double number = 0; words >> number;)
        row.push_back(number);
      if (row.size() >= 4 && row[0] == 1) return {row[1], row[2], row[3]};
    }
    return {};
  }

  LinuxCncSession session_;
  std::string output;
};

}  // namespace probewright::testing
