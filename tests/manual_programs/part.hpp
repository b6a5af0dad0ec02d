#pragma once

#include <string>

#include "manual_programs/record.hpp"
#include "support/heidenhain_bench.hpp"

namespace probewright::control {

/// How the names of tests show a control.
inline void PrintTo(ControlKind kind, std::ostream* out) { *out << name(kind); }

}  // namespace probewright::control

/// Parts for the printed examples: features by their program coordinates, the preset at the origin.
namespace probewright::testing_support {

constexpr double tableHeight = -400;  ///< machine z of the preset's origin

class Part {
public:
  explicit Part(ControlKind control, const std::string& machine = "mill3") : bench(control, machine) {
    bench.preset(1, {0, 0, tableHeight});
    bench.probeOf(110, 2);
  }

  void box(const Vector3& least, const Vector3& greatest) {
    bench.part(simulation::Box(least, greatest), pose({0, 0, tableHeight}));
  }
  /// A wall whose face goes through `point` in the direction `angle`; the material lies on its left.
  void wall(const Vector2& point, double angle) {
    bench.part(simulation::Box({-150, 0, -60}, {150, 60, 0}), pose({point.x(), point.y(), tableHeight}, {0, 0, angle}));
  }
  void hole(const Vector2& centre, double diameter, double top = 0) {
    bench.part(simulation::Ring(diameter / 2, diameter / 2 + 6, -40),
               pose({centre.x(), centre.y(), tableHeight + top}));
  }
  void stud(const Vector2& centre, double diameter, double top = 0) {
    bench.part(simulation::RoundBar(diameter / 2, -40, 0), pose({centre.x(), centre.y(), tableHeight + top}));
  }
  /// Four walls around a rectangle.
  void pocket(const Vector2& centre, const Vector2& length) {
    const Vector2 low = centre - length / 2, high = centre + length / 2;
    constexpr double thick = 30;
    box({high.x(), low.y() - thick, -40}, {high.x() + thick, high.y() + thick, 0});
    box({low.x() - thick, low.y() - thick, -40}, {low.x(), high.y() + thick, 0});
    box({low.x(), high.y(), -40}, {high.x(), high.y() + thick, 0});
    box({low.x(), low.y() - thick, -40}, {high.x(), low.y(), 0});
  }
  void block(const Vector2& centre, const Vector2& length) {
    const Vector2 low = centre - length / 2, high = centre + length / 2;
    box({low.x(), low.y(), -40}, {high.x(), high.y(), 0});
  }

  Ran run(int cycle, const Words& words, const std::string& after = {}) const {
    Ran ran = bench.run(probe(cycle, words) + after);
    EXPECT_TRUE(ran.finished()) << ran.why();
    return ran;
  }

  /// A program as the control's manual prints it: that of the iTNC 530 begins with TOOL CALL 0, which names no tool but
  /// the axis of the touch probe that the operator has put in.
  Ran printed(const std::string& blocks) const {
    Ran ran = bench.runBare((bench.control == ControlKind::iTNC530 ? "TOOL CALL 0 Z\n" : "TOOL CALL 1 Z\n") + blocks);
    EXPECT_TRUE(ran.finished()) << ran.why();
    return ran;
  }

  RecordedBench bench;
};

}  // namespace probewright::testing_support
