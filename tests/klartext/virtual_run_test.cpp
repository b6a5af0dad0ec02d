#include <gtest/gtest.h>

#include <cmath>

#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "klartext/host_world.hpp"
#include "simulation/analytic_solids.hpp"
#include "support/virtual_world.hpp"

namespace probewright::language::klartext::testing {
namespace {

namespace hh = control::heidenhain;

/// A ring of 40 mm bore that truly lies at (30.25, -12.5, -300); preset 1 believes (30, -12, -300).
struct RingWorld {
  RingWorld() {
    auto truth = testing_support::perfectWorld();
    testing_support::place(truth, simulation::Ring(20, 200, -40), translation({30.25, -12.5, -300}));
    machine = std::make_unique<simulation::VirtualMachine>(truth);
    const auto kind = control::ControlKind::TNC640;
    hh::Tables tables{
        hh::defaultToolTable(kind), hh::defaultProbeTable(kind), hh::defaultPresetTable(kind), {}, {}, {}, {}};
    EXPECT_TRUE(tables.tools.ensureRow("1"));
    EXPECT_TRUE(tables.tools.setText("1", "NAME", "PROBE"));
    EXPECT_TRUE(tables.tools.setNumber("1", "L", 100));
    EXPECT_TRUE(tables.tools.setNumber("1", "R", 2));
    EXPECT_TRUE(tables.tools.setText("1", "TP_NO", "1"));
    EXPECT_TRUE(tables.presets.setNumber("1", "X", 30));
    EXPECT_TRUE(tables.presets.setNumber("1", "Y", -12));
    EXPECT_TRUE(tables.presets.setNumber("1", "Z", -300));
    control = std::make_unique<hh::Control>(kind, *machine, std::move(tables));
  }
  RunResult run(const std::string& text) {
    KlartextHost host(*control);
    MemoryLibrary library;
    return Interpreter(library, host).run(std::make_shared<KlartextProgram>("ring.h", text));
  }
  std::unique_ptr<simulation::VirtualMachine> machine;
  std::unique_ptr<hh::Control> control;
};

constexpr const char* ringProgram =
    "0 BEGIN PGM RING MM\n1 TOOL CALL \"PROBE\" Z\n2 CYCL DEF 247 PRESET ~\n  Q339=+1\n3 L Z+50 R0 FMAX\n"
    "4 L X+0 Y+0 R0 FMAX\n5 LBL 1\n6 TCH PROBE 412 PRESET INSIDE CIRCLE ~\n  Q321=+0 ~\n  Q322=+0 ~\n  Q262=+39 ~\n"
    "  Q325=+0 ~\n  Q247=+90 ~\n  Q261=-10 ~\n  Q320=+0 ~\n  Q260=+20 ~\n  Q301=+0 ~\n  Q305=+1 ~\n  Q331=+0 ~\n"
    "  Q332=+0 ~\n  Q303=+1\n7 CALL LBL 1 REP1\n8 L Z+50 R0 FMAX\n9 END PGM RING MM\n";

TEST(VirtualRun, TheProgramFindsThePresetOfTheRing) {
  RingWorld world;
  const RunResult result = world.run(ringProgram);
  for (const Diagnostic& diagnostic : result.diagnostics)
    ADD_FAILURE() << format(diagnostic);
  ASSERT_EQ(world.control->journal.cycles.size(), 2U);
  EXPECT_NEAR(world.control->coordinates.preset.origin.x(), 30.25, 1e-6);
  EXPECT_NEAR(world.control->coordinates.preset.origin.y(), -12.5, 1e-6);
  EXPECT_NEAR(world.control->q.q(153), 40, 1e-6);
  EXPECT_EQ(world.control->journal.cycles[0].place.line, 8U);
}

TEST(VirtualRun, OldFormCyclesMeasureOnePoint) {
  RingWorld world;
  const RunResult result = world.run(
      "1 TOOL CALL 1 Z\n2 CYCL DEF 247 P ~\n  Q339=1\n3 L X+0 Y+0 Z+50 R0 FMAX\n4 L Z-5 R0 FMAX\n"
      "5 TCH PROBE 0.0 BEZUGSEBENE Q5 X-\n6 TCH PROBE 0.1 X-9 IY+0 Z-10\n7 Q6 = Q115\n8 Q7 = Q117\n"
      "9 TCH PROBE 1.0 POLAR\n10 TCH PROBE 1.1 X WINKEL: +90\n11 TCH PROBE 1.2 X+0 Y+9 Z-10\n");
  for (const Diagnostic& diagnostic : result.diagnostics)
    ADD_FAILURE() << format(diagnostic);
  // The ball's centre stops 18 mm from the axis of the ring, which lies 0.25 and -0.5 mm from the origin.
  const double x = 0.25 - std::sqrt(18 * 18 - 0.5 * 0.5);
  EXPECT_NEAR(world.control->q.q(5), x - 2, 1e-6);
  EXPECT_NEAR(world.control->q.q(6), x, 1e-6);
  EXPECT_NEAR(world.control->q.q(7), -10 + 100, 1e-6);
  EXPECT_NEAR(world.control->q.q(116), -0.5 + std::sqrt(18 * 18 - 0.25 * 0.25), 1e-6);
  EXPECT_TRUE((world.control->channel.position() - ProgramPlace(0, 9, -10)).norm() < 1e-9);
}

/// What a touch has found stays as the cycle found it, whatever the program does to its coordinates and tool
/// afterwards.
TEST(VirtualRun, TheLastTouchOutlivesItsCoordinates) {
  RingWorld world;
  const RunResult result = world.run(
      "1 TOOL CALL 1 Z\n2 CYCL DEF 247 P ~\n  Q339=1\n3 L X+0 Y+0 Z+50 R0 FMAX\n4 L Z-5 R0 FMAX\n"
      "5 TCH PROBE 0.0 BEZUGSEBENE Q5 X-\n6 TCH PROBE 0.1 X-9 IY+0 Z-10\n"
      "7 CYCL DEF 7.0 DATUM SHIFT\n8 CYCL DEF 7.1 X+3\n9 CYCL DEF 7.2 Z-7\n"
      "10 CYCL DEF 10.0 ROTATION\n11 CYCL DEF 10.1 ROT+40\n12 TOOL CALL 1 Z DL+1\n"
      "13 FN 18: SYSREAD Q20 = ID360 NR1 IDX1\n14 FN 18: SYSREAD Q21 = ID360 NR3 IDX1\n"
      "15 FN 18: SYSREAD Q22 = ID360 NR3 IDX2\n16 FN 18: SYSREAD Q23 = ID360 NR3 IDX3\n"
      "17 FN 18: SYSREAD Q24 = ID360 NR4 IDX1\n");
  for (const Diagnostic& diagnostic : result.diagnostics)
    ADD_FAILURE() << format(diagnostic);
  const double x = 0.25 - std::sqrt(18 * 18 - 0.5 * 0.5);
  EXPECT_NEAR(world.control->q.q(20), x - 2, 1e-6);
  EXPECT_NEAR(world.control->q.q(21), x, 1e-6);
  EXPECT_NEAR(world.control->q.q(22), 0, 1e-6);
  EXPECT_NEAR(world.control->q.q(23), -10 + 100, 1e-6);
  EXPECT_NEAR(world.control->q.q(24), x, 1e-6);
}

TEST(VirtualRun, ACollisionNamesItsBlock) {
  RingWorld world;
  const RunResult result = world.run(
      "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 CYCL DEF 247 P ~\n  Q339=1\n"
      "3 L X+30 Y+0 Z+50 R0 FMAX\n4 L Z-30 F1000\n5 END PGM A MM\n");
  ASSERT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(result.diagnostics.front().place.line, 6U);
}

TEST(VirtualRun, WordsOutsideOfACyclesRangeStopIt) {
  RingWorld world;
  const RunResult result = world.run("1 TOOL CALL 1 Z\n2 TCH PROBE 412 X ~\n Q321=+0 ~\n Q262=-5\n");
  ASSERT_EQ(result.end, RunEnd::Alarm);
  EXPECT_NE(result.diagnostics.front().message.find("Q"), std::string::npos);
}

}  // namespace
}  // namespace probewright::language::klartext::testing
