#include <gmock/gmock.h>

#include "control/sinumerik/tool_carrier.hpp"
#include "kinematics_sinumerik/scene.hpp"

/// Where CYCLE996 puts what it finds: data set, machine data, log, screen; and what reads them.
namespace probewright {
namespace {

using namespace testing_support;
using control::sinumerik::carrierOf;
using control::sinumerik::withCarrier;
using ::testing::HasSubstr;
using ::testing::StartsWith;

simulation::Truth planted(const Build& build, std::uint64_t seed) {
  Planter plant(seed);
  simulation::Truth truth = perfectWorld(build.machine);
  plantAxisErrors(truth, plant);
  return truth;
}

/// The vectors of the ready-made machines, by their drawings.
TEST(SwivelDataSet, IsTheMachineAsItWasCommissioned) {
  KinematicsScene table(tableTable, perfectWorld(tableTable.machine));
  EXPECT_EQ(table.bench.control.data.text("$TC_CARR23", {1}), "P");
  EXPECT_EQ(table.bench.control.data.text("$TC_CARR34", {1}), "TABLE_AC");
  EXPECT_EQ(table.datum(4), Vector3(0, 0, -550));
  EXPECT_EQ(table.datum(15), Vector3(0, 0, 550));
  EXPECT_EQ(table.datum(18), Vector3(0, 0, 0));
  EXPECT_EQ(table.datum(7), Vector3(-1, 0, 0));
  EXPECT_EQ(table.datum(10), Vector3(0, 0, -1));
  KinematicsScene mixed(headTable, perfectWorld(headTable.machine));
  EXPECT_EQ(mixed.bench.control.data.text("$TC_CARR23", {1}), "M");
  EXPECT_EQ(mixed.datum(1), Vector3(0, 0, -150));
  EXPECT_EQ(mixed.datum(4), Vector3(0, 0, 150));
  KinematicsScene head(headHead, perfectWorld(headHead.machine));
  EXPECT_EQ(head.bench.control.data.text("$TC_CARR23", {1}), "T");
  EXPECT_EQ(head.bench.control.data.text("$TC_CARR36", {1}), "A");
  EXPECT_EQ(head.datum(15), Vector3(0, 0, 200));
  EXPECT_EQ(head.datum(4), Vector3(0, 0, -200));
  EXPECT_FALSE(carrierOf(*machine::readMachine("mill3")));
  EXPECT_FALSE(carrierOf(*machine::readMachine("lathe2c")));
  Planter plant(1);
  for (const Build* build : builds) {
    KinematicsScene scene(*build, perfectWorld(build->machine));
    EXPECT_LT(scene.errorOfDataSet(plant), 1e-9) << build->machine;
  }
}

/// Any data set, closed or not, is what its formulas say.
TEST(SwivelDataSet, IsWhatTheControlCalculatesWith) {
  Planter plant(99610);
  for (const Build* build : builds) {
    KinematicsScene scene(*build, perfectWorld(build->machine));
    for (int world = 0; world < 5; ++world) {
      for (const int first : {1, 4, 15, 18}) {
        const std::string kind = scene.bench.control.data.text("$TC_CARR23", {1});
        if ((kind == "T" && first == 18) || (kind == "P" && first == 1)) continue;
        const Vector3 offset = plant.within(300);
        for (int i = 0; i < 3; ++i)
          scene.bench.set(fmt::format("$TC_CARR{}", first + i).c_str(), {1}, offset[i]);
      }
      const auto carrier = control::sinumerik::toolCarrier(scene.bench.control.data, 1);
      ASSERT_TRUE(carrier);
      const auto described = withCarrier(scene.bench.control.told(), *carrier);
      ASSERT_TRUE(described);
      for (int i = 0; i < 10; ++i) {
        machine::AxisPositions axes = scene.turned(plant.number(-90, 90), plant.number(-180, 180));
        for (std::size_t linear = 0; linear < 3; ++linear)
          axes[linear] = plant.number(-300, 300);
        const Vector3 tool(0, 0, plant.number(0, 200));
        const Vector3 tip = machine::baseFromTable(*described, axes).inverse() *
                            (machine::baseFromSpindle(*described, axes) * Vector3(-tool));
        EXPECT_LT((tip - scene.tipOfDataSet(axes, tool)).norm(), 1e-9) << build->machine;
      }
    }
  }
}

/// TRAORI reads the data set that MD 24582 names, or vectors of its own.
TEST(SwivelDataSet, TraoriHasItsMachineData) {
  struct Case {
    const Build* build;
    double type;
    std::array<const char*, 4> names;  ///< of I1 to I4
  };
  for (const Case& each :
       {Case{&headHead, 24, {"$MC_TRAFO5_PART_OFFSET_1", "$MC_TRAFO5_JOINT_OFFSET_1", "$MC_TRAFO5_BASE_TOOL_1", ""}},
        Case{&tableTable,
             40,
             {"", "$MC_TRAFO5_BASE_TOOL_1", "$MC_TRAFO5_JOINT_OFFSET_PART_1", "$MC_TRAFO5_PART_OFFSET_1"}},
        Case{&headTable,
             56,
             {"$MC_TRAFO5_JOINT_OFFSET_1", "$MC_TRAFO5_BASE_TOOL_1", "$MC_TRAFO5_JOINT_OFFSET_PART_1",
              "$MC_TRAFO5_PART_OFFSET_1"}}}) {
    Planter plant(99611);
    KinematicsScene scene(*each.build, planted(*each.build, 99612));
    SinumerikBench& bench = scene.bench;
    for (int axis = 0; axis < 2; ++axis) {
      for (int i = 0; i < 3; ++i)
        bench.set(axis == 0 ? "$MC_TRAFO5_AXIS1_1" : "$MC_TRAFO5_AXIS2_1", {i}, scene.datum(7 + 3 * axis)[i]);
    }
    bench.set("$MC_TRAFO_TYPE_1", {}, each.type);
    scene.measureAll();
    scene.calculate({{"S_MVAR", 10001000}});
    constexpr std::array<int, 4> first = {1, 4, 15, 18};
    const std::string& log = bench.log(bench.control.data.text("$TC_CARR34", {1}) + "_M1.SPF");
    for (std::size_t v = 0; v < 4; ++v) {
      if (*each.names[v] == 0) continue;
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(bench.data(each.names[v], {i}), scene.datum(first[v])[i]) << each.names[v];
        EXPECT_THAT(log, HasSubstr(fmt::format(" {}[{}]=", each.names[v], i)));
      }
    }
    // TRAORI puts the tip where the data set's formulas do; a type that says nothing leaves the machine as it was told.
    const auto tip = [&](double type) {
      bench.set("$MC_TRAFO_TYPE_1", {}, type);
      bench.run("CYCLE996", {{"S_MVAR", 0}, {"S_TC", 1}}, {},
                fmt::format("TRAFOOF\nSUPA G0 Z-100\nSUPA G0 {}=20 {}=30\nSUPA G0 X10 Y20\nTRAORI\n",
                            each.build->axes[0], each.build->axes[1]));
      return bench.control.channel.machineFromAxes(bench.control.channel.axes()).vector();
    };
    const Vector3 ofMachineData = tip(each.type);
    machine::AxisPositions axes = bench.control.channel.axes();
    EXPECT_LT((ofMachineData - scene.tipOfDataSet(axes, {0, 0, 100})).norm(), 1e-9);
    EXPECT_LT((tip(72) - ofMachineData).norm(), 1e-9);
    EXPECT_GT((tip(16) - ofMachineData).norm(), 1e-3);
    const Vector3 onlyData = bench.control.channel.machineFromAxes(axes).vector();
    bench.control.data.set("$TC_CARR4", {2}, 1.0);
    bench.set("$MC_TRAFO5_TCARR_NO_1", {}, 2);  // there is no kind in it: as told
    EXPECT_LT((tip(72) - onlyData).norm(), 1e-9);
  }
}

TEST(SwivelDataSet, MachinesThatAreNotAsItSaysAreRefused) {
  SinumerikBench bench(perfectWorld("mill5-table-table"));
  bench.control.data.set("$TC_CARR23", {1}, std::string("T"));
  const std::string swivel = "CYCLE800(0,\"\",0,57,0,0,0,10,0,0,0,0,0,-1)\n";
  auto result = bench.tryRun("CYCLE150", {}, {}, swivel);
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_EQ(result.diagnostics[0].code, "62181");
  EXPECT_THAT(result.diagnostics[0].message, HasSubstr("it is of kind \"T\" with 2 rotary axes"));
  bench.control.swivelled = false;
  result = bench.tryRun("CYCLE150", {}, {}, "TRAORI\n");
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_EQ(result.diagnostics[0].code, "4342");
}

/// A log is a program that enters what was found; what was there before stands in it as comments.
TEST(KinematicsLog, EntersTheVectors) {
  KinematicsScene scene(headTable, planted(headTable, 99613));
  scene.measureAll();
  const Vector3 before = scene.datum(4);
  scene.bench.run("CYCLE996", {{"S_MVAR", 10000000}, {"S_TC", 1}});
  scene.bench.run("CYCLE996", {{"S_MVAR", 10000000}, {"S_TC", 1}});
  EXPECT_EQ(scene.datum(4), before) << "only measured";
  const std::string log = scene.bench.log("MIXED_BC_M1.SPF");
  EXPECT_EQ(scene.bench.log("MIXED_BC_M2.SPF"), log);
  EXPECT_THAT(log, HasSubstr("\n;$TC_CARR4[1]=0.000000 $TC_CARR5[1]=0.000000 $TC_CARR6[1]=150.000000 ;I2xyz\n"));
  const Vector3 found = scene.found(4), direction = scene.found(10);
  EXPECT_THAT(log, HasSubstr(fmt::format("\n$TC_CARR4[1]={:.6f} $TC_CARR5[1]={:.6f} $TC_CARR6[1]={:.6f} ;I2xyz\n",
                                         found.x(), found.y(), found.z())));
  scene.bench.run("CYCLE996", {{"S_MVAR", 0}, {"S_TC", 1}}, {}, log.substr(0, log.find("M17")));
  EXPECT_LT((scene.datum(4) - found).norm(), 1e-5);
  EXPECT_LT((scene.datum(10) - direction).norm(), 1e-5);
}

TEST(KinematicsScreen, ShowsTheDataSet) {
  KinematicsScene scene(headTable, planted(headTable, 99614));
  scene.measureAll();
  scene.bench.run("CYCLE996", {{"S_MVAR", 1000}, {"S_TC", 1}, {"_AMODE", 100}});
  const auto& screens = scene.bench.control.journal.cycles.back().screens;
  ASSERT_FALSE(screens.empty());
  EXPECT_THAT(screens.front(), StartsWith("Swivel data set 1 MIXED_BC\n"));
  EXPECT_THAT(scene.bench.screen(), HasSubstr(fmt::format("{:.6f}", scene.found(4).x())));
  const auto& events = scene.bench.control.journal.events;
  EXPECT_EQ(std::ranges::count(events, control::EventKind::Stop, &control::EventRecord::kind), 1);
}

/// The operator may change the data set shown, and only the operator enters V1 and V2.
TEST(KinematicsScreen, IsEdited) {
  KinematicsScene scene(headTable, planted(headTable, 99615));
  Planter plant(2);
  scene.measureAll();
  std::vector<control::Question> asked;
  std::optional<std::string> reply = "V1 v2";
  scene.bench.control.panel.answer = [&](const control::Question& question) {
    asked.push_back(question);
    return reply;
  };
  scene.calculate({{"_AMODE", 1100}});
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].name, "996 swivel data set");
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
  reply = "$TC_CARR4=25.5 $TC_CARR20=-1";
  EXPECT_TRUE(asked[0].understood(*reply));
  scene.calculate({{"_AMODE", 1100}});
  EXPECT_EQ(scene.datum(4).x(), 25.5);
  EXPECT_EQ(scene.datum(18).z(), -1);
  for (const char* nonsense : {"$TC_CARR13=1", "X", "$TC_CARR4=", "$TC_CARR4", "V3"}) {
    EXPECT_FALSE(asked[0].understood(nonsense)) << nonsense;
    reply = nonsense;
    EXPECT_EQ(scene.bench.alarmOf("CYCLE996", {{"S_MVAR", 1000}, {"S_TC", 1}, {"_AMODE", 1100}}), "61319");
  }
  EXPECT_EQ(scene.datum(4).x(), 25.5);
  scene.calculate({{"_AMODE", 1000}});  // not shown, so not edited
  EXPECT_EQ(asked.size(), 7U);
}

/// An open chain keeps the vector that would close it; the control computes with the rest.
TEST(OpenChain, KeepsItsEnd) {
  for (const Build* build : {&tableTable, &headTable, &headHead}) {
    Planter plant(99616);
    KinematicsScene scene(*build, planted(*build, 99617));
    const std::array before = {scene.datum(1), scene.datum(18)};
    scene.measureAll();
    scene.calculate({{"S_MVAR", 31000}});
    EXPECT_EQ(scene.datum(1), before[0]);
    EXPECT_EQ(scene.datum(18), before[1]);
    scene.enterDirections();
    // What is left is where the chain would close: the same way in every position, seen from its end.
    const Vector3 gap = scene.datum(1) + scene.datum(4) + scene.datum(15) + scene.datum(18);
    EXPECT_GT(gap.norm(), 1e-3);
    const std::string kind = scene.bench.control.data.text("$TC_CARR23", {1});
    for (int i = 0; kind != "M" && i < 20; ++i) {
      const machine::AxisPositions axes = scene.turned(plant.number(-90, 90), plant.number(-90, 90));
      const Vector3 tool(0, 0, 100);
      EXPECT_LT((scene.trueTip(axes, tool) - scene.tipOfDataSet(axes, tool) - gap).norm(), 1e-6) << build->machine;
    }
  }
}

/// The digits of the normalisation count the axes of the plane: in G18 Y is the third.
TEST(Normalisation, CountsTheAxesOfThePlane) {
  Planter plant(99630);
  KinematicsScene scene(headTable, planted(headTable, 99630));
  scene.measureAll();
  scene.calculate({{"S_MVAR", 1301000}, {"S_SETV2", 5}, {"S_SETV3", -40}, {"_DMODE", 2}});
  EXPECT_NEAR(scene.datum(4).y(), 5, 1e-9);
  EXPECT_NEAR(scene.datum(15).z(), -40, 1e-9);
  scene.enterDirections();
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
}

TEST(FineOffsets, CountOnMachinesThatHaveThem) {
  control::sinumerik::DataStore store;
  store.load({"$TC_CARR23", {1}}, std::string("P"));
  store.load({"$TC_CARR4", {1}}, 10.0);
  store.load({"$TC_CARR44", {1}}, 0.75);
  EXPECT_EQ(control::sinumerik::toolCarrier(store, 1).value().offset[1], Vector3(10, 0, 0));
  store.load({"$SC_TOCARR_FINE_CORRECTION", {}}, 1.0);
  EXPECT_EQ(control::sinumerik::toolCarrier(store, 1).value().offset[1], Vector3(10.75, 0, 0));
}

/// Fine offsets that count are left alone, and the sum is what was measured.
TEST(FineOffsets, Stay) {
  Planter plant(99618);
  KinematicsScene scene(tableTable, planted(tableTable, 99619));
  scene.bench.set("$SC_TOCARR_FINE_CORRECTION", {}, 1);
  scene.bench.set("$TC_CARR44", {1}, 0.75);
  scene.measureAll();
  scene.calculate();
  scene.enterDirections();
  EXPECT_NEAR(scene.datum(4).x(), scene.bench.ovr(4) - 0.75, 1e-12);
  scene.bench.set("$TC_CARR4", {1}, scene.bench.ovr(4));
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
}

}  // namespace
}  // namespace probewright
