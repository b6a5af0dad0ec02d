#pragma once

#include <regex>

#include "conversion/twins.hpp"

/// What programs are written for: controls, units and tool axes.
namespace probewright::testing_support {

/// What a program is written for.
struct Setting {
  std::string name;
  ControlKind control = ControlKind::TNC640;
  bool inch = false;
  char toolAxis = 'Z';
  int worlds = 200;
};

inline void PrintTo(const Setting& setting, std::ostream* out) { *out << setting.name; }

inline const Setting settings[] = {{.name = "TNC640"},
                                   {.name = "iTNC530", .control = ControlKind::iTNC530},
                                   {.name = "Inch", .inch = true, .worlds = 60},
                                   {.name = "ToolAxisX", .toolAxis = 'X', .worlds = 60},
                                   {.name = "ToolAxisY", .toolAxis = 'Y', .worlds = 60}};

/// The text with `replaced(match)` in place of each match.
template <class Replace>
std::string replaced(const std::string& text, const std::regex& pattern, const Replace& replace) {
  std::string result;
  auto last = text.begin();
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    result.append(last, (*match)[0].first);
    result += replace(*match);
    last = (*match)[0].second;
  }
  return result.append(last, text.end());
}

/// X, Y, Z as the main, minor and tool axis of another tool axis.
inline char turnedAxis(char name, char toolAxis) {
  const std::string names = toolAxis == 'X' ? "YZX" : "ZXY";
  return names[static_cast<std::size_t>(name - 'X')];
}

/// The same world lying along another tool axis: the probe stands in an angle head.
inline void turn(PlantedPart& part, char toolAxis) {
  Pose turn = Pose::Identity();
  const int main = toolAxis == 'X' ? 1 : 2;
  for (int i = 0; i < 3; ++i)
    turn.linear().col(i) = Vector3::Unit((main + i) % 3);
  turn.translation() = toolAxis == 'X' ? Vector3(150, 0, -300) : Vector3(0, 250, -300);
  for (simulation::PlacedSolid& placed : part.bench.setup.world.truth.solids)
    placed.tableFromSolid = turn * placed.tableFromSolid;
  for (control::BelievedFrame& frame : part.bench.setup.beliefs.presets) {
    frame.origin = turn * frame.origin;
    frame.rotation = turn.linear() * frame.rotation;
  }
  part.bench.setup.world.truth.tools.front().shankDirection = turn.linear() * Vector3::UnitZ();
}

}  // namespace probewright::testing_support
