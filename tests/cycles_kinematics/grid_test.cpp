#include "control/heidenhain/compensation_grid.hpp"
#include "cycles_kinematics/sphere_worlds.hpp"

/// Cycle 453 and the compensation table.
namespace probewright::testing_support {
namespace {

using control::heidenhain::CompensationGrid;
using control::heidenhain::TypedTable;

/// Every combination of the nodes, values 0.
TypedTable gridTable(const std::vector<double>& b, const std::vector<double>& c) {
  TypedTable table = TypedTable::create("MACHINE.KCO", control::heidenhain::TableUnit::Millimetre,
                                        control::heidenhain::gridColumns(), ControlKind::TNC640, 0);
  int row = 0;
  for (const double first : b) {
    for (const double second : c) {
      const std::string key = std::to_string(row++);
      EXPECT_TRUE(table.setNumber(key, "B", first) && table.setNumber(key, "C", second));
      for (const control::heidenhain::NumberColumn column :
           {control::heidenhain::NumberColumn("DX"), control::heidenhain::NumberColumn("DY"),
            control::heidenhain::NumberColumn("DZ")})
        EXPECT_TRUE(table.setNumber(key, column, 0));
    }
  }
  return table;
}

Words words453(int mode, const Words& changes = {}) {
  return with({{406, mode}, {407, sphereRadius}, {320, 0}, {408, 0}, {253, 5000}, {380, 45}, {423, 4}, {431, 0}},
              changes);
}

TEST(Grid, IsLinearBetweenItsNodes) {
  const machine::MachineDescription machine = *machine::readMachine("mill5-head-table");
  const std::size_t b = *machine.axisIndex("B"), c = *machine.axisIndex("C");
  auto grid = CompensationGrid::of(gridTable({-60, 0, 60}, {0, 90, 180, 270}), machine);
  ASSERT_TRUE(grid) << format(grid.error());
  // A plane in B and C is met everywhere between.
  const auto plane = [](double first, double second) { return Vector3(first / 10, second / 100, first - second); };
  for (std::size_t i = 0; i < grid->size(); ++i)
    grid->setValue(i, plane(grid->node(i)[b], grid->node(i)[c]));
  const auto at = [&](double first, double second) {
    machine::AxisPositions axes;
    axes[b] = first;
    axes[c] = second;
    return grid->at(axes);
  };
  EXPECT_LT((at(-60, 0) - plane(-60, 0)).norm(), 1e-12);
  EXPECT_LT((at(17, 200) - plane(17, 200)).norm(), 1e-12);
  EXPECT_LT((at(60, 270) - plane(60, 270)).norm(), 1e-12);
  EXPECT_LT((at(17, 200 - 360) - plane(17, 200)).norm(), 1e-12);  // a full turn
  EXPECT_LT((at(80, 300) - plane(60, 270)).norm(), 1e-12);        // beyond the border
  EXPECT_LT((at(-80, 350) - plane(-60, 0)).norm(), 1e-12);        // nearer to 360
}

TEST(Grid, MustBeComplete) {
  const machine::MachineDescription machine = *machine::readMachine("mill5-head-table");
  TypedTable table = gridTable({-60, 60}, {0, 90});
  EXPECT_TRUE(table.setNumber("3", "C", 45));
  EXPECT_EQ(CompensationGrid::of(table, machine).error().message, "4 rows are not a grid of 6 positions");
  EXPECT_TRUE(table.setNumber("3", "C", 0));
  EXPECT_EQ(CompensationGrid::of(table, machine).error().message, "this grid position is there twice");
  EXPECT_EQ(CompensationGrid::of(table, *machine::readMachine("mill4-table")).error().message,
            "the machine has no rotary axis C");
}

/// Rotary axes that wander with their angle: what no kinematics can tell, the grid does at its nodes.
TEST(Cycle453, CompensatesWhatTheKinematicsCannot) {
  SphereWorld world(builds()[1]);
  Dice dice(4530);
  world.plant(dice, 0.03, 0.003);
  auto& errors = world.bench.setup.world.truth.errors;
  errors.axes.resize(world.built().axes.size());
  errors.axes[*world.built().axisIndex("C")].deviations.push_back({{}, {}, 0.004, 120, 20});
  errors.axes[*world.built().axisIndex("B")].deviations.push_back({{}, {}, 0.003, 90, 50});
  const TableFolder folder(world.bench);
  folder.put("MACHINE.KCO", gridTable({-60, 0, 60}, {0, 90, 180, 270}));
  const Ran ran = world.bench.run(probe(453, words453(1)) + "PLANE RESET STAY\n" + probe(453, words453(0)));
  ASSERT_TRUE(ended(ran)) << ran.why();
  EXPECT_EQ(ran.touches(), 12U * 5);
  const std::string log = ran.log("TCHPR453.html");
  EXPECT_NE(log.find("<td>Number of measuring positions</td><td>12</td>"), std::string::npos) << log;
  // The first time there is a deviation, the second time none.
  EXPECT_EQ(log.find("<td>Standard deviation</td><td>0.0000</td>"), log.rfind("<td>Standard deviation</td>"));
  EXPECT_EQ(log.find("<td>Maximum deviation</td><td>0.0000</td>"), log.rfind("<td>Maximum deviation</td>"));
  EXPECT_NE(log.find("Position of the maximum deviation"), std::string::npos);
  coverage::writesRead(ran.outcome.control, ran.outcome.journal,
                       [](const control::WriteRecord& write) { return write.table == "MACHINE.KCO"; });

  // The table acts in the next run as well, until it is cleared; clearing moves nothing.
  folder.put("MACHINE.KCO", ran.outcome.files.at("MACHINE.KCO"));
  const Ran again = world.bench.run(probe(453, words453(0)));
  ASSERT_TRUE(ended(again)) << again.why();
  EXPECT_NE(again.log("TCHPR453.html").find("<td>Maximum deviation</td><td>0.0000</td>"), std::string::npos);
  const Ran cleared = world.bench.run(probe(453, words453(-1)));
  ASSERT_TRUE(ended(cleared)) << cleared.why();
  EXPECT_EQ(cleared.touches(), 0u);
  EXPECT_EQ(cleared.outcome.files.at("MACHINE.KCO"), gridTable({-60, 0, 60}, {0, 90, 180, 270}).table().bytes());
}

/// On the way to the first position the axes turn one after the other about the sphere, the second of them with the
/// tool already leaning.
TEST(Cycle453, TurnsEveryAxisAboutTheSphere) {
  for (const auto& [build, tilting] : {std::pair(0, 'A'), std::pair(1, 'B'), std::pair(2, 'A')}) {
    SCOPED_TRACE(builds()[static_cast<std::size_t>(build)].machine);
    SphereWorld world(builds()[static_cast<std::size_t>(build)]);
    const TableFolder folder(world.bench);
    folder.put("MACHINE.KCO", fmt::format("BEGIN MACHINE.KCO MM\n"
                                          "NR    {}         C         DX        DY        DZ\n"
                                          "0     -50       200       0         0         0\n"
                                          "[END]\n",
                                          tilting));
    const Ran ran = world.bench.run(probe(453, words453(0)));
    EXPECT_TRUE(ended(ran)) << ran.why();
  }
}

TEST(Cycle453, SetsThePreset) {
  SphereWorld world(builds()[1]);
  world.bench.setup.beliefs.presets.front().origin += Vector3(0.3, 0.2, -0.1);
  const TableFolder folder(world.bench);
  folder.put("MACHINE.KCO", gridTable({0, 30}, {0, 180}));
  for (const int preset : {1, 3}) {
    const Ran ran =
        world.bench.run("L X-0.5 Y+0.3 R0 FMAX\nL Z+14.9 R0 FMAX\n" + probe(453, words453(0, {{431, preset}})));
    ASSERT_TRUE(ended(ran)) << ran.why();
    EXPECT_LT((ran.preset().translation() - world.build.sphere).norm(), 1e-6);
  }
}

TEST(Cycle453, RefusesWhatItCannotDo) {
  SphereWorld world(builds()[1]);
  EXPECT_EQ(world.bench.run(probe(453, words453(0))).alarm(), "Compensation table missing");
  const TableFolder folder(world.bench);
  folder.put("MACHINE.KCO", gridTable({0, 30}, {0, 180}));
  EXPECT_EQ(world.bench.run(probe(453, words453(0, {{407, 12.6}}))).alarm(), "Calibration sphere radius wrong");
  EXPECT_EQ(world.bench.run(probe(453, words453(0, {{407, 12.6}}))).touches(), 10u) << "measured once more";
  world.bench.setup.beliefs.parameters["option52"] = {0.0, {}};
  EXPECT_EQ(world.bench.run(probe(453, words453(0))).alarm(), "Function not enabled");
}

}  // namespace
}  // namespace probewright::testing_support
