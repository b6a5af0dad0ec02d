#include "cycles_kinematics/sphere_worlds.hpp"
#include "geometry/decompositions.hpp"

/// The programs that the manuals print for cycles 450 to 453, in worlds in which they find their way.
namespace probewright::testing_support {
namespace {

/// "Q411=-90 Q412=+90" as a block of the control.
std::string block(int cycle, const std::string& words) {
  std::istringstream parts(words);
  std::string text = fmt::format("TCH PROBE {} KINEMATICS", cycle);
  for (std::string word; parts >> word;)
    text += " ~\n  " + word + " ;VALUE";
  return text + "\n";
}

const std::string call = "TOOL CALL \"TASTER\" Z\n", save = block(450, "Q410=0 Q409=5");
const std::string common = "Q407=12.5 Q320=0 Q408=0 ";
const std::string reset = "PLANE RESET STAY\n";

/// A thin stem that leads along `stem` away from the sphere.
SphereWorld world(const Build& build, const Vector3& stem, ControlKind control = ControlKind::TNC640) {
  SphereWorld made(build, control);
  made.bench.setup.world.truth.solids.pop_back();
  Pose along = pose(build.sphere);
  along.linear() = shortestTurn(-Vector3::UnitZ(), stem).toRotationMatrix();
  made.bench.part(simulation::RoundBar(1, -60, -sphereRadius + 1), along);
  made.bench.setup.world.truth.tools.front().name = made.bench.believedProbe().name = "TASTER";
  return made;
}

void expectFound(const SphereWorld& world, const Ran& ran) {
  ASSERT_TRUE(ended(ran)) << ran.why();
  EXPECT_LT(apart(machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes), world.truth()).place, 1e-6);
}

TEST(PrintedPrograms, OfCycle450) {
  const SphereWorld made = world(builds()[1], -Vector3::UnitZ());
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench = made.bench;
    bench.control = control;
    const bool newer = control == ControlKind::TNC640;
    const Ran ran = bench.runBare(call + block(450, newer ? "Q410=0 Q409=948" : "Q410=0 Q409=1") +
                                  block(450, newer ? "Q410=1 Q409=948" : "Q410=1 Q409=1") +
                                  block(450, newer ? "Q410=2 Q409=949" : "Q410=2 Q409=9") +
                                  (newer ? block(450, "Q410=3 Q409=948") : ""));
    EXPECT_TRUE(ended(ran)) << ran.why();
  }
}

/// B in the head and C in the table: saved and tested; then optimised from beside the sphere, with the backlash.
TEST(PrintedPrograms, OfCycle451) {
  Dice dice(4540);
  const Vector3 stem(0, 0.5, -std::sqrt(0.75));
  const std::string angles = "Q411=-90 Q412=+90 Q413=0 Q414=0 Q415=-90 Q416=+90 Q417=0 ";
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    SphereWorld made = world(builds()[1], stem, control);
    made.plant(dice, 0.1, 0);
    const Ran test = made.bench.runBare(call + save +
                                        block(451, "Q406=0 " + common + "Q253=750 Q380=0 " + angles +
                                                       "Q418=2 Q419=-90 Q420=+90 Q421=0 Q422=2 Q423=4 Q431=0 Q432=0"));
    ASSERT_TRUE(ended(test)) << test.why();
    EXPECT_GT(test.q(142), 1e-3);
    EXPECT_EQ(test.q(141), -1);
    const std::string optimise = angles + "Q418=4 Q419=+90 Q420=+270 Q421=0 Q422=3 Q423=3 Q431=1 ";
    expectFound(made, made.bench.runBare(call + "L X0 Y0 R0 FMAX\nL Z+14.5 R0 FMAX\n" +
                                         block(451, "Q406=1 " + common + "Q253=750 Q380=0 " + optimise + "Q432=0.5")));
    if (control == ControlKind::TNC640) continue;
    expectFound(made, made.bench.runBare(call + "L X0 Y0 R0 FMAX\nL Z+14.5 R0 FMAX\n" +
                                         block(451, "Q406=2 " + common + "Q253=750 Q380=0 " + optimise + "Q432=0")));
  }
}

/// A and C in a fork head; the control ignores B. The reference head, then another one.
TEST(PrintedPrograms, OfChangingHeads) {
  Dice dice(4541);
  const std::string head =
      "Q253=2000 Q380=45 Q411=-90 Q412=+90 Q413=45 Q414=4 Q415=-90 Q416=+90 Q417=0 Q418=2 "
      "Q419=+90 Q420=+270 Q421=0 ";
  SphereWorld made = world(builds()[2], -Vector3::UnitZ());
  made.plant(dice, 0.1, 0);
  const std::string reference = block(451, "Q406=1 " + common + head + "Q422=3 Q423=4 Q431=3 Q432=0");
  const std::string changed = block(452, common + head + "Q422=0 Q423=4 Q432=0");
  const Ran ran = made.bench.runBare(call + "L X0 Y0 R0 FMAX\nL Z+14.5 R0 FMAX\n" + reference + reset + changed);
  expectFound(made, ran);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(ran.q(147 + i), 0, 1e-6) << "the head is the same one";
}

/// The drift: measured from the preset in row 1, compensated later. A turns the table over.
TEST(PrintedPrograms, OfADrift) {
  Dice dice(4542);
  SphereWorld made = world(builds()[0], Vector3(std::cos(radians(25)), 0, -std::sin(radians(25))));
  machine::MachineDescription& machine = made.bench.setup.world.truth.machine;
  for (machine::Axis& axis : machine.axes) {
    axis.minimum = axis.kind == machine::AxisKind::Rotary ? -360 : -2000;
    axis.maximum = -axis.minimum;
  }
  made.plant(dice, 0.1, 0);
  const std::string rest = "Q413=45 Q414=4 Q415=-90 Q416=+90 Q417=0 Q418=2 Q419=+90 Q420=+270 Q421=0 Q422=3 ";
  const Ran ran = made.bench.runBare(
      call + "CYCL DEF 247 PRESET ~\n  Q339=+1 ;NUMBER\nL X0 Y0 R0 FMAX\nL Z+14.5 R0 FMAX\n" +
      block(451, "Q406=1 " + common + "Q253=750 Q380=45 Q411=+90 Q412=+270 " + rest + "Q423=4 Q431=3 Q432=0") + reset +
      "L Z+300 R0 FMAX\nL A0 C0 R0 FMAX\n" + call +
      block(452, common + "Q253=99999 Q380=45 Q411=-90 Q412=+90 " + rest + "Q423=3 Q432=0"));
  expectFound(made, ran);
  EXPECT_NEAR(ran.q(147), 0, 1e-6);
}

TEST(PrintedPrograms, OfCycle453) {
  SphereWorld made = world(builds()[1], Vector3(0, 0.5, -std::sqrt(0.75)));
  const TableFolder folder(made.bench);
  folder.put("GRID.KCO",
             "BEGIN GRID.KCO MM\n"
             "NR    B         C         DX        DY        DZ\n"
             "0     -45       0         0         0         0\n"
             "1     45        0         0         0         0\n"
             "[END]\n");
  const Ran ran = made.bench.runBare(call + block(453, "Q406=0 " + common + "Q253=750 Q380=0 Q423=4 Q431=0"));
  EXPECT_TRUE(ended(ran)) << ran.why();
  EXPECT_EQ(ran.touches(), 10u);
}

}  // namespace
}  // namespace probewright::testing_support
