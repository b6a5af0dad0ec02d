#include <fmt/format.h>
#include <gtest/gtest.h>

#include "setup/setup.hpp"

/// What a setup can get wrong about cutting tools and tool touch probes: each mistake is named once, at its place.
namespace probewright::setup {
namespace {

std::string mistakes(const std::string& text) {
  Diagnostics diagnostics;
  static_cast<void>(parseSetup(text, "setup.toml", diagnostics));
  std::string all;
  for (const Diagnostic& diagnostic : diagnostics)
    all += format(diagnostic) + "\n";
  return all;
}

/// A tool of 80 mm with a radius of 6 mm; `keys` follow those of [tool.cutter].
std::string tool(const std::string& keys, const std::string& kind = "mill") {
  return fmt::format("[[tool]]\nnumber = 9\nkind = \"{}\"\nlength = 80\nradius = 6\n[tool.cutter]\n{}", kind, keys);
}

struct Mistake {
  std::string setup;
  const char* text;
  int line;
};

TEST(ToolKeys, NameEachMistakeAtItsPlace) {
  const std::string insert = "[tool.cutter.insert]\nnose_radius = 0.8\n";
  const std::string tooth = "teeth = 2\n[[tool.cutter.tooth]]\n";
  const std::string probe = "[tool_probe]\ndiameter = 40\n";
  const Mistake list[] = {
      {tool("corner_radius = 7\n"), "the corner radius is larger than the radius of the tool", 7},
      {tool("corner_radius = 1\npoint_angle = 118\n"), "a tool has either a point angle or a corner radius", 8},
      {tool("holder_radius = 20\nholder_length = 80\n"), "the holder is longer than the whole tool", 8},
      {tool("holder_radius = 20\n"), "a holder needs both holder_radius and holder_length", 7},
      {tool("holder_length = 20\n"), "a holder needs both holder_radius and holder_length", 6},
      {tool("helix = 86\n"), "must be at least -85 and at most 85", 7},
      {tool("cutting_direction = \"M5\"\n"), "M3", 7},
      {tool(tooth + "number = 3\n"), "there is no tooth 3; \"teeth\" says 2", 9},
      {tool(tooth + "number = 1\n[[tool.cutter.tooth]]\nnumber = 1\n"), "tooth 1 appears here twice", 11},
      {tool(tooth + "number = 1\nradial = 11\n"), "must be at least -10 and at most 10", 10},
      {tool("corner_radius = 6\n" + tooth + "number = 1\nradial = -0.1\n"), "leave less than the corner radius", 11},
      {tool(insert), "only tools of kind \"turn\" have an insert", 7},
      {tool("teeth = 2\n" + insert, "turn"), "a tool with an insert has no teeth", 7},
      {tool("[tool.cutter.insert]\n", "turn"), "nose_radius", 7},
      {tool(insert + "edge_normals = [10, 190]\n", "turn"), "are at least 1 and less than 180 degrees apart", 9},
      {tool(insert + "wear = 0.8\n", "turn"), "the wear leaves nothing of the nose radius", 9},
      {probe + "directions = \"+X up\"\n", "\"up\" is not a direction of the contact", 3},
      {probe + "directions = \"\"\n", "a contact that gives way in no direction never signals", 3},
      {probe + "signal_delay = 2\n", "must be at least 0 and at most 1", 3},
  };
  for (const Mistake& each : list) {
    SCOPED_TRACE(each.setup);
    const std::string said = mistakes(each.setup);
    EXPECT_NE(said.find(each.text), std::string::npos) << said;
    EXPECT_TRUE(said.starts_with(fmt::format("setup.toml:{}:", each.line))) << said;
  }
}

TEST(ToolKeys, TakeWhatIsRight) {
  EXPECT_EQ(mistakes(tool("corner_radius = 6\nhelix = -30\ncutting_length = 20\nshank_radius = 5\nholder_radius = "
                          "20\nholder_length = 30\nteeth = 2\n[[tool.cutter.tooth]]\nnumber = 2\naxial_wear = 0.2\n")),
            "");
  EXPECT_EQ(mistakes(tool("[tool.cutter.insert]\nnose_radius = 0.4\nwear = 0.1\n", "turn")), "");
  EXPECT_EQ(mistakes("[tool_probe]\nsize = [25, 25]\ndirections = \"+X -X\"\n"), "");
}

}  // namespace
}  // namespace probewright::setup
