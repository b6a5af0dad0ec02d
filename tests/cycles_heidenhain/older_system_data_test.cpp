#include "control/heidenhain/datum_table.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// FN 18 ID 501 to 504 and 530 of the iTNC 530: datum and preset tables, in the machine and as the program sees them.
namespace probewright::testing_support {
namespace {

namespace hh = control::heidenhain;
constexpr double exact = 1e-9;
constexpr double tableDigits = 6e-5;

std::string read(int q, int id, int number, int index) {
  return fmt::format("FN 18: SYSREAD Q{} = ID{} NR{} IDX{}\n", q, id, number, index);
}

TEST(OlderSystemData, ReadsTablesInTheMachineAndInTheProgram) {
  Dice dice(501);
  for (int at = 0; at < 20; ++at) {
    SCOPED_TRACE(at);
    Bench bench(ControlKind::iTNC530, "mill5-table-table");
    TableFolder folder(bench);
    const Vector3 origin(written(dice.between(-90, 90)), written(dice.between(-90, 90)),
                         written(dice.between(-450, -400)));
    const Vector3 other =
        origin + Vector3(written(dice.between(-50, 50)), written(dice.between(-50, 50)), written(dice.between(-5, 5)));
    const double rotation = written(dice.between(-60, 60)), otherRotation = written(dice.between(-60, 60));
    bench.preset(1, origin, rotation);
    bench.preset(4, other, otherRotation, false);
    bench.setup.beliefs.presets[0].rotary["C"] = 10;
    bench.setup.beliefs.presets[1].rotary["C"] = 25;
    const Vector3 datum(written(dice.between(-50, 50)), written(dice.between(-50, 50)), written(dice.between(-5, 5)));
    hh::TypedTable zero = hh::defaultDatumTable(ControlKind::iTNC530, "ZERO.D");
    ASSERT_TRUE(zero.ensureRow("3"));
    ASSERT_TRUE(zero.setNumber("3", "X", datum.x()));
    ASSERT_TRUE(zero.setNumber("3", "Y", datum.y()));
    ASSERT_TRUE(zero.setNumber("3", "Z", datum.z()));
    ASSERT_TRUE(zero.setNumber("3", "C", 7));
    folder.put("ZERO.D", zero);
    std::string blocks = "SEL TABLE \"ZERO.D\"\n";
    for (int axis = 1; axis <= 3; ++axis) {
      blocks += read(10 + axis, 501, 3, axis);
      blocks += read(30 + axis, 503, 4, axis);
    }
    blocks += read(14, 501, 3, 6) + read(34, 503, 4, 6) + read(35, 502, 4, 6) + read(40, 504, 4, 0) +
              read(41, 504, 1, 0) + read(42, 530, 1, 0) + read(43, 530, 2, 4);
    // The datum becomes active: its place in the machine is that of the program's origin.
    blocks += "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 #3\n";
    for (int axis = 1; axis <= 3; ++axis)
      blocks += read(20 + axis, 502, 4, axis);
    const Ran ran = bench.run(blocks);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Pose workpiece = pose(origin, {0, 0, rotation});
    const Vector3 inMachine = workpiece * datum;
    const Vector3 seen = (workpiece * pose(datum)).inverse() * other;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(ran.q(11 + axis), inMachine[axis], tableDigits);
      EXPECT_NEAR(ran.q(21 + axis), seen[axis], tableDigits);
      EXPECT_NEAR(ran.q(31 + axis), other[axis], tableDigits);
    }
    EXPECT_NEAR(ran.q(14), 17, exact);
    EXPECT_NEAR(ran.q(34), 25, exact);
    EXPECT_NEAR(ran.q(35), 15, exact);
    EXPECT_NEAR(ran.q(40), otherRotation, exact);
    EXPECT_NEAR(ran.q(41), rotation, exact);
    EXPECT_EQ(ran.q(42), 1);
    EXPECT_EQ(ran.q(43), 0);
  }
}

TEST(OlderSystemData, KnowsTheToolTouchProbeAndNoCalibrationYet) {
  Bench bench(ControlKind::iTNC530);
  bench.preset(1, {0, 0, -400});
  bench.setup.beliefs.parameters["MP6580.0"] = {12.5, {}};
  bench.setup.beliefs.parameters["MP6580.1"] = {-30.25, {}};
  bench.setup.beliefs.parameters["MP6580.2"] = {-410.5, {}};
  bench.setup.beliefs.parameters["MP6531"] = {38.0, {}};
  const Ran ran = bench.run(read(1, 350, 20, 1) + read(2, 350, 20, 2) + read(3, 350, 20, 3) + read(4, 350, 21, 0) +
                            read(5, 350, 13, 0));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.q(1), 12.5);
  EXPECT_EQ(ran.q(2), -30.25);
  EXPECT_EQ(ran.q(3), -410.5);
  EXPECT_EQ(ran.q(4), 19);
  EXPECT_EQ(ran.q(5), 0);
}

/// ID 50 NR 24 to 26: in TOOL.T of the older control, in the touch probe table of the newer one.
TEST(SystemDataOfProbes, TellsTheCalibrationOfAnyTool) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench(kind);
    bench.preset(1, {0, 0, -400});
    bench.believedProbe().tipOffset = {0.0125, -0.034};
    bench.believedProbe().calibrationAngle = 30;
    bench.knows(7, "MILL", 80, 5);
    const Ran ran = bench.run(read(1, 50, 24, 1) + read(2, 50, 25, 1) + read(3, 50, 26, 1) + read(4, 50, 24, 7));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.q(1), 0.0125);
    EXPECT_EQ(ran.q(2), -0.034);
    EXPECT_EQ(ran.q(3), 30);
    EXPECT_EQ(ran.q(4), 0);
  }
}

TEST(OlderSystemData, IsNotThatOfTheNewerControl) {
  Bench newer;
  newer.preset(1, {0, 0, -400});
  for (const int id : {502, 503, 504}) {
    SCOPED_TRACE(id);
    const Ran ran = newer.run(read(1, id, 1, 1));
    EXPECT_EQ(ran.alarm(), "System datum not available");
    EXPECT_NE(ran.why().find(fmt::format("ID{}", id)), std::string::npos) << ran.why();
  }
  for (const int number : {13, 20, 21})
    EXPECT_EQ(newer.run(read(1, 350, number, 1)).alarm(), "System datum not available");
  // Rows that are not there, on the control that has the group.
  Bench older(ControlKind::iTNC530);
  older.preset(1, {0, 0, -400});
  for (const int id : {501, 502, 503, 504})
    EXPECT_EQ(older.run(read(1, id, 77, 1)).alarm(), "System datum not available") << id;
}

}  // namespace
}  // namespace probewright::testing_support
