#include <gmock/gmock.h>

#include "kinematics_sinumerik/scene.hpp"

/// What a swivel data set says of where its axes may stand: limits and Hirth couplings.
namespace probewright {
namespace {

using namespace testing_support;
using ::testing::HasSubstr;

/// CYCLE800 axis by axis (mode 57: about X, Y, Z of the workpiece), and where the rotary axes then stand.
struct Swivelled {
  explicit Swivelled(const std::string& machine) : bench(perfectWorld(machine)) {}

  /// The code of the alarm; empty where there was none.
  std::string swivel(double a, double b, double c, int mode = 57, int direction = -1) {
    const std::string call = fmt::format("SUPA G0 Z-200\nCYCLE800(0,\"\",0,{},0,0,0,{:.6f},{:.6f},{:.6f},0,0,0,{})\n",
                                         mode, a, b, c, direction);
    const auto result = bench.tryRun("CYCLE150", {}, {}, call);
    return result.diagnostics.empty() ? std::string() : result.diagnostics.front().code;
  }
  double at(const char* axis) const {
    const auto& channel = bench.control.channel;
    return channel.axes()[*channel.description().axisIndex(axis)];
  }
  std::string lastWarning() const {
    std::string text;
    for (const auto& event : bench.control.journal.events)
      if (event.kind == control::EventKind::Warning) text = event.text;
    return text;
  }

  SinumerikBench bench;
};

TEST(SwivelTravel, ALimitOfTheDataSetPicksTheOtherPosture) {
  Swivelled on("mill5-head-table");
  // Tilted by 30 degrees about X: B stands at +30 or -30, C at -90 or +90.
  EXPECT_EQ(on.swivel(30, 0, 0), "");
  const double b = on.at("B"), c = on.at("C");
  EXPECT_NEAR(std::abs(b), 30, 1e-9);
  EXPECT_NEAR(std::abs(c), 90, 1e-9);
  on.bench.set(b > 0 ? "$TC_CARR32" : "$TC_CARR30", {1}, b > 0 ? 10 : -10);
  on.bench.set(b > 0 ? "$TC_CARR30" : "$TC_CARR32", {1}, b > 0 ? -92 : 92);
  EXPECT_EQ(on.swivel(30, 0, 0), "");
  EXPECT_NEAR(on.at("B"), -b, 1e-9) << "the posture that the limits leave";
  EXPECT_NEAR(on.at("C"), -c, 1e-9);
  on.bench.set("$TC_CARR30", {1}, -10);
  on.bench.set("$TC_CARR32", {1}, 10);
  EXPECT_EQ(on.swivel(30, 0, 0), "62201");
}

TEST(SwivelTravel, AnAxisWithoutEndIsTurnedIntoItsLimits) {
  Swivelled on("mill5-head-table");
  on.bench.set("$TC_CARR30", {1}, 0);  // B in plus only: C must turn
  on.bench.set("$TC_CARR32", {1}, 92);
  EXPECT_EQ(on.swivel(30, 0, 0), "");
  const double c = on.at("C");
  on.bench.set("$TC_CARR31", {1}, 180);
  on.bench.set("$TC_CARR33", {1}, 540);
  EXPECT_EQ(on.swivel(30, 0, 0), "");
  EXPECT_NEAR(std::remainder(on.at("C") - c, 360), 0, 1e-9);
  EXPECT_GE(on.at("C"), 180 - 1e-9);
  EXPECT_LE(on.at("C"), 540 + 1e-9);
}

TEST(SwivelTravel, AHirthCouplingTakesTheNearestPositionAndSaysByHowMuchTheToolLeans) {
  for (const char* machine : {"mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    SCOPED_TRACE(machine);
    Swivelled on(machine);
    EXPECT_EQ(on.swivel(0, 20, 0), "");
    const char* tilting = std::string(machine) == "mill5-head-table" ? "B" : "A";
    const double exact = on.at(tilting);
    EXPECT_NEAR(std::abs(exact), 20, 1e-9);
    EXPECT_EQ(on.lastWarning(), "");
    const bool first = on.bench.control.data.text("$TC_CARR35", {1}) == tilting;
    on.bench.set(first ? "$TC_CARR28" : "$TC_CARR29", {1}, 3);
    on.bench.set(first ? "$TC_CARR26" : "$TC_CARR27", {1}, 0.5);
    EXPECT_EQ(on.swivel(0, 20, 0), "");
    // 0.5 + 3 k: 18.5 and 21.5, or -20.5 and -17.5.
    EXPECT_NEAR(on.at(tilting), exact > 0 ? 21.5 - (21.5 - 20 < 20 - 18.5 ? 0 : 3) : -20.5, 3.001);
    EXPECT_NEAR(std::remainder(on.at(tilting) - 0.5, 3), 0, 1e-9);
    EXPECT_LE(std::abs(on.at(tilting) - exact), 1.5 + 1e-9);
    EXPECT_THAT(on.lastWarning(),
                HasSubstr(fmt::format("leans {:.4f} degrees beside", std::abs(on.at(tilting) - exact))));
  }
}

/// Directly in angles of the axes the plane is that in which they stand.
TEST(SwivelTravel, SwivelledAxisByAxisThePlaneIsWhereTheAxesStand) {
  Swivelled on("mill5-table-table");
  on.bench.set("$TC_CARR28", {1}, 5);
  EXPECT_EQ(on.swivel(21, 40, 0, 192), "");
  EXPECT_NEAR(on.at("A"), 20, 1e-9);
  EXPECT_NEAR(on.at("C"), 40, 1e-9);
  EXPECT_EQ(on.lastWarning(), "");
  // The tool stands upright in the plane.
  const auto& control = on.bench.control;
  const Vector3 normal = control.machineFromWorkpiece().linear() * Vector3::UnitZ();
  const Vector3 tool =
      machine::baseFromTable(control.channel.description(), control.channel.axes()).linear().transpose() *
      machine::baseFromSpindle(control.channel.description(), control.channel.axes()).linear() * Vector3::UnitZ();
  EXPECT_LT((normal.normalized() - tool).norm(), 1e-9);
}

}  // namespace
}  // namespace probewright
