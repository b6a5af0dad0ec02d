#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A trunnion with a tool touch probe, a calibration sphere and a camera, and programs that measure with a mixture of
/// the cycles for them: for tests of whole runs.
namespace probewright::mixed {

/// A mill that the control knows too short, a table axis 0.03 mm too low, a sphere beside its preset.
inline constexpr std::string_view toolSetup = R"toml([machine]
name = "mill5-table-table"
[control]
type = "TNC640"
[errors.rotary.A]
position = [0, 0.01, -0.03]
[sphere]
diameter = 25
stem_diameter = 8
stem_length = 100
pose = { x = 120, y = 40, z = -480 }
[tool_probe]
diameter = 20
thickness = 8
stem_diameter = 6
stem_length = 100
pose = { x = -150.3, y = -60, z = -480, b = 0.02 }
pretravel = 0.002
repeatability = 0.0002
[camera]
position = [0, -130, -20]
direction = [0, 0.25, -1]
resolution = [160, 120]
field_of_view = 45
ambient = 0.3
[[camera.lamp]]
position = [-350, -250, 150]
brightness = 0.5
[[tool]]
number = 1
name = "TS"
kind = "probe"
length = 200
ball_radius = 2
stylus_radius = 1
stylus_length = 60
body_radius = 20
maximum_travel = 20
[[tool]]
number = 9
name = "PIN"
kind = "mill"
length = 75
radius = 8
[tool.cutter]
shank_radius = 10
cutting_length = 50
eccentricity = [0.008, 0]
cutting_direction = "none"
[[tool]]
number = 12
name = "MILL D16"
kind = "mill"
length = 92.417
radius = 7.994
believed_length = 92
believed_radius = 8
[tool.cutter]
teeth = 4
first_tooth = 25
corner_radius = 0.5
helix = 30
cutting_length = 30
shank_radius = 7.9
holder_radius = 20
holder_length = 40
[[tool.cutter.tooth]]
number = 1
radial = 0.006
axial = 0.002
[[tool.cutter.tooth]]
number = 3
radial = -0.008
axial_wear = 0.01
[[tool.cutter.tooth]]
number = 4
radial_wear = 0.08
[[preset]]
row = 1
origin = [120.3, 39.8, -479.8]
active = true
[parameters]
"centerPos.0" = -150
"centerPos.1" = -60
"centerPos.2" = -480
[answers]
"601 MIX" = """
REFERENCE IMAGE; CONFIGURE; DRAW AREA 20 15 120 90; SAVE AND BACK; REPEAT; REFERENCE IMAGE; REPEAT; REFERENCE IMAGE;
BACK
"""
)toml";

/// `rounds` times length, radius, both (481 to 483), the kinematics saved and optimised (450, 451), the pole of the
/// sphere (427) and the working space (601); before them the calibration of the tool touch probe and a first
/// measurement of the tool.
inline std::string toolProgram(int rounds) {
  using Words = std::vector<std::pair<std::string_view, std::string_view>>;
  const auto probe = [](std::string_view cycle, const Words& words) {
    std::string text = "TCH PROBE " + std::string(cycle) + " MEASURE";
    for (const auto& [parameter, value] : words)
      text += " ~\n  " + std::string(parameter) + "=" + std::string(value) + " ;VALUE";
    return text + "\n";
  };
  const auto tool = [&](std::string_view cycle, std::string_view check) {
    return probe(cycle, {{"Q340", check}, {"Q260", "+100"}, {"Q341", "+0"}});
  };
  const std::string away = "L Z+0 R0 FMAX M91\n", above = "L X+0 Y+0 R0 FMAX\nL Z+16 R0 FMAX\n";
  const Words kinematics = {{"Q406", "+1"},   {"Q407", "+12.5"}, {"Q320", "+0"},  {"Q408", "+0"}, {"Q253", "+3000"},
                            {"Q380", "+45"},  {"Q411", "-60"},   {"Q412", "+60"}, {"Q413", "+0"}, {"Q414", "+3"},
                            {"Q415", "+0"},   {"Q416", "+0"},    {"Q417", "+0"},  {"Q418", "+0"}, {"Q419", "+90"},
                            {"Q420", "+270"}, {"Q421", "+0"},    {"Q422", "+3"},  {"Q423", "+4"}, {"Q431", "+0"},
                            {"Q432", "+0"}};
  const Words pole = {{"Q263", "+0"},    {"Q264", "+0"},    {"Q261", "+12.5"}, {"Q320", "+2"},
                      {"Q272", "+3"},    {"Q267", "-1"},    {"Q260", "+50"},   {"Q281", "+0"},
                      {"Q288", "+12.4"}, {"Q289", "+12.2"}, {"Q309", "+0"},    {"Q330", "+0"}};
  std::string text =
      "BEGIN PGM MIX MM\nTOOL CALL 9 Z\n" + probe("480", {{"Q260", "+100"}}) + "TOOL CALL 12 Z\n" + tool("483", "+0");
  for (int round = 0; round < rounds; ++round) {
    text += "TOOL CALL 12 Z\n" + tool("481", "+1") + tool("482", "+1") + tool("483", "+1") + away + "TOOL CALL 1 Z\n" +
            above + probe("450", {{"Q410", "+0"}, {"QS409", "\"BEFORE\""}}) + probe("451", kinematics) +
            "PLANE RESET STAY\n" + away + "L A+0 C+0 R0 FMAX\n" + above + probe("427", pole) + away +
            probe("601", {{"QS600", "\"MIX\""}, {"Q309", "+1"}, {"Q613", "+0"}, {"Q617", "+3"}});
  }
  return text + "END PGM MIX MM\n";
}

}  // namespace probewright::mixed
