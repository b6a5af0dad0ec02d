#pragma once

#include "linuxcnc/run_bench.hpp"

namespace probewright::testing {

/// A LinuxCNC whose [TASK]INTERPRETER is Probewright's.
class AsInterpreter : public LinuxCncRun {
protected:
  AsInterpreter() {
    std::string ini = text("mill.ini");
    const auto add = [&](const std::string& section, const std::string& lines) {
      ini.replace(ini.find(section), section.size(), section + "\n" + lines);
    };
    add("[TASK]", "INTERPRETER = " + (session_.build() / "linuxcnc/interpreter/libprobewright_interp.so").string());
    session_.write("mill.ini", ini + "[PROBEWRIGHT]\nCONTROL = setup.toml\nOUT = out\nPROGRAM = " +
                                   (session_.build() / "apps/probewright/probewright").string() + "\n");
  }

  /// Axes that are faster than any program.
  void fastAxes() {
    std::string ini = text("mill.ini");
    for (const auto& [key, value] : {std::pair{"MAX_VELOCITY", "5000"},
                                     {"MAX_LINEAR_VELOCITY", "5000"},
                                     {"MAX_ACCELERATION", "2000000"},
                                     {"FERROR", "100"},
                                     {"MIN_FERROR", "100"}})
      ini = std::regex_replace(ini, std::regex(std::string("\n") + key + " = [^\n]*"),
                               std::string("\n") + key + " = " + value);
    session_.write("mill.ini", ini);
  }

  /// A word for the scripts: runs a program to its end, keeps what it left in the folder `name`.
  static constexpr const char* keeps = R"(
import shutil
def written():
    # The engine writes when its program has ended, however that was.
    desk.until('results', lambda s: os.path.exists('out/results.json'), 300)
def keep(name):
    written()
    idle()
    os.rename('out', name)
def run(program, name):
    begin(program)
    keep(name)
def fresh():
    desk.mdi('G10 L2 P1 X0 Y0 Z-250 R0')
def begin(program):
    desk.begin(program)
def idle():
    desk.until('the end', lambda s: s.interp_state == linuxcnc.INTERP_IDLE and s.inpos)
    desk.settle()
)";

  void agrees(const std::string& folder, double bound) const {
    const nlohmann::json measured = results(folder), expected = results("virtual-" + folder);
    ASSERT_TRUE(measured.is_object()) << output;
    const std::vector<double> real = touches(measured), simulated = touches(expected);
    ASSERT_EQ(real.size(), simulated.size()) << folder;
    ASSERT_EQ(real.size(), 15U) << folder;
    for (std::size_t i = 0; i < real.size(); ++i)
      EXPECT_NEAR(real[i], simulated[i], bound) << folder << ", touch " << i / 3 << ", axis " << i % 3;
    EXPECT_EQ(measured.at("verdict"), expected.at("verdict"));
  }
  World world;
};

}  // namespace probewright::testing
