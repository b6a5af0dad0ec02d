#include <map>

#include "cycles_sinumerik/milling_variants.hpp"

/// Calls whose parameters are global user data: they measure and write what the call with arguments does.
namespace probewright {
namespace {

using namespace testing_support;

/// The assignments that older programs have for the arguments of `call`.
std::string variables(const NamedNumbers& call) {
  std::string text;
  for (const auto& [name, value] : call) {
    std::string old = "_" + name.substr(2);
    if (name == "S_MD" && text.find("_MVAR") != std::string::npos) continue;  // they had none in these cycles
    if (name == "S_SETV") old = "_SETVAL";
    if (name.starts_with("S_SETV") && name.size() == 7) old = fmt::format("_SETV[{}]", name.substr(6));
    text += fmt::format("{}={:.12f}\n", old, value);
  }
  return text;
}

/// What the last cycle wrote: data and new values.
std::string writes(const SinumerikBench& bench) {
  std::string text;
  for (const auto& write : bench.control.journal.cycles.back().writes)
    text += fmt::format("{}{}={}\n", write.table, write.entry, write.after);
  return text;
}

TEST(OldForm, MeasuresAndCorrectsAsTheCallWithArguments) {
  const struct {
    int knum, old;
    bool coarse;
  } targets[] = {{1, 1, false},       {1001, 1000, false}, {1001, 1011, false}, {2000, 2000, false},
                 {9000, 9999, false}, {10001, 1, true},    {19000, 9999, true}};
  Planter plant(601);
  int world = 0;
  for (int round = 0; round < 3; ++round) {
    for (const Variant& variant : variants()) {
      if (std::string_view(variant.cycle) == "CYCLE961") continue;
      const auto& [knum, old, coarse] = targets[++world % 7];
      SCOPED_TRACE(fmt::format("{} into {} in world {}", variant.name, knum, world));
      const Pose believed = translation(origin) * rotation(Vector3::UnitZ(), plant.number(-30, 30));
      const Matrix3 linear = believed.linear();
      const Vector3 turn(0, 0, degreesFromRadians(std::atan2(linear(1, 0), linear(0, 0))));
      const Pose part = displaced(variant, believed, plant);
      simulation::Truth truth = perfectWorld();
      variant.part(truth, part);
      SinumerikBench today(truth), before(truth);
      for (SinumerikBench* bench : {&today, &before}) {
        plantFrame(*bench, "$P_UIFR", 1, origin, turn);
        bench->start(variant.start);
      }
      if (coarse) before.set("_CHBIT", {21}, 1);
      today.run(variant.cycle, with(variant.call, {{"S_KNUM", static_cast<double>(knum)}}));
      before.run(variant.cycle, {}, {},
                 variables(with(variant.call, {{"S_KNUM", static_cast<double>(old)}, {"S_PRNUM", 101}})));
      expectInPlace(today, variant, part);
      expectInPlace(before, variant, part);
      EXPECT_EQ(writes(today), writes(before));
      for (int i = 0; i < 32; ++i)
        EXPECT_EQ(today.ovr(i), before.ovr(i)) << i;
      EXPECT_LT((today.control.channel.position() - before.control.channel.position()).norm(), 1e-9);
    }
  }
}

/// _KNUM 1011 to 1026 are the basic frames of the channel, 1051 to 1066 those of all channels, in their order from 0.
TEST(OldForm, NamesBasicFramesByTheirNumber) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 60, -60), translation(origin + Vector3(0.3, 0.2, 0)));
  for (const auto& [number, table, index] : {std::tuple(1011, "$P_CHBFR", 0),
                                             {1012, "$P_CHBFR", 1},
                                             {1026, "$P_CHBFR", 15},
                                             {1051, "$P_NCBFR", 0},
                                             {1052, "$P_NCBFR", 1},
                                             {1066, "$P_NCBFR", 15}}) {
    SCOPED_TRACE(number);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.start({0, 0, -10});
    bench.run("CYCLE977", {}, {}, fmt::format("_MVAR=101 _SETVAL=40 _FA=6 _TSA=2 _KNUM={}\n", number));
    ASSERT_FALSE(bench.control.journal.cycles.empty());
    const auto& writes = bench.control.journal.cycles.back().writes;
    ASSERT_FALSE(writes.empty());
    for (const auto& write : writes) {
      EXPECT_EQ(write.table, table);
      EXPECT_TRUE(write.entry.starts_with(fmt::format("[{},", index))) << write.entry;
    }
  }
}

TEST(OldForm, FindsACornerByDistancesAndByCoordinates) {
  Planter plant(602);
  for (int world = 0; world < 24; ++world) {
    const double turn = plant.number(-3, 3);
    const Vector3 error(plant.number(-0.8, 0.8), plant.number(-0.8, 0.8), 0);
    const Pose part = translation(origin + error) * rotation(Vector3::UnitZ(), turn);
    simulation::Truth truth = perfectWorld();
    const bool inside = world % 2 == 0;
    if (inside) {
      place(truth, simulation::Box({-40, -60, -60}, {150, 0, 0}), part);
      place(truth, simulation::Box({-60, -60, -60}, {0, 150, 0}), part);
    } else {
      place(truth, simulation::Box({0, 0, -60}, {120, 120, 0}), part);
    }
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    const double side = inside ? 15 : -15;
    const bool zone = world % 3 != 0 && world % 4 >= 2;  // above the corner, and down at each point
    std::string call;
    if (world % 3 == 0) {  // coordinates of four points
      call = fmt::format(
          "_MVAR={}\n_SETV[0]=30 _SETV[1]={} _SETV[2]=80 _SETV[3]={}\n"
          "_SETV[4]={} _SETV[5]=30 _SETV[6]={} _SETV[7]=80\n",
          inside ? 117 : 118, side, side, side, side);
    } else {  // distances, three points or four
      call = fmt::format("_MVAR={}\n_SETV[0]=80 _SETV[1]=80 _SETV[4]=1\n_STA1=0 _INCA=90 _ID={}\n",
                         (inside ? 105 : 106) + (world % 3 == 2 ? 2 : 0), zone ? -20 : 0);
    }
    bench.start({side, side, zone ? 10.0 : -10.0});
    bench.run("CYCLE961", {}, {}, call + "_KNUM=1 _FA=20 _TSA=8\n");
    EXPECT_NEAR(inWorkpiece(bench, part.translation()).head<2>().norm(), 0, 1e-6) << world;
    EXPECT_NEAR(bench.data("$P_UIFR", {1, "Z", "RT"}), turn, 1e-6) << world;
  }
}

TEST(OldForm, CorrectsTheToolThatItNamesByNumberOrName) {
  for (const bool byName : {false, true}) {
    for (const bool measureOnly : {false, true}) {
      simulation::Truth truth = perfectWorld();
      place(truth, simulation::Ring(20.03, 60, -60), translation(origin));
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_UIFR", 1, origin);
      bench.control.data.set("$TC_TP2", {7}, std::string("MILL_20"));
      bench.set("$TC_DP1", {7, 1}, 120);
      bench.set("$TC_DP6", {7, 1}, 10);
      bench.start({0, 0, -10});
      const std::string tool = measureOnly ? "_KNUM=0 _TNUM=7\n"
                               : byName    ? "_KNUM=1 _TNAME=\"MILL_20\"\n"
                                           : "_KNUM=1 _TNUM=7\n";
      bench.run("CYCLE977", {}, {}, "_MVAR=1 _SETVAL=40 _FA=6 _TSA=2 _TUL=0.1 _TLL=-0.1 _TDIF=0.3 _TZL=0.001\n" + tool);
      EXPECT_NEAR(bench.ovr(4), 40.06, 1e-6);
      // The bore is too large by 0.06: the mill is larger than its data by the half.
      EXPECT_NEAR(bench.data("$TC_DP15", {7, 1}), measureOnly ? 0 : 0.03, 1e-6);
      if (!measureOnly) {
        EXPECT_NEAR(bench.ovr(8), 0.1, 1e-12) << "the tolerance is observed";
      }
    }
  }
}

TEST(OldForm, CalibratesInARingAndOnASurface) {
  Planter plant(603);
  for (int world = 0; world < 12; ++world) {
    const double radius = plant.number(1.9, 2.1), length = plant.number(99.7, 100.3);
    const bool unknown = world % 2 == 1;
    simulation::Truth truth = perfectWorld();
    truth.tools[0].probe.ballRadius = radius;
    truth.tools[0].length = length;
    place(truth, simulation::Ring(25, 60, -30), translation(origin));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.start(unknown ? Vector3(0.6, -0.4, -10) : Vector3(0, 0, -10));
    bench.run("CYCLE976", {}, {}, fmt::format("_MVAR={} _SETVAL=50 _FA=6 _TSA=3 _VMS=200\n", unknown ? 8 : 1));
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 2 * radius, 1e-6);
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", {0}), -radius, 1e-6);
    bench.start({40, 0, 8});
    bench.run("CYCLE976", {}, {}, "_MVAR=10000 _SETVAL=0 _MA=3 _MD=1 _FA=6 _TSA=3\n");
    EXPECT_NEAR(bench.data("$TC_DP3", {1, 1}), length, 1e-6);
  }
}

/// 1 in the thousands: in the direction of _MA and _MD alone.
TEST(OldForm, CalibratesInOneDirection) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.ballRadius = 1.95;
  place(truth, simulation::Ring(25, 60, -30), translation(origin));
  for (const int axis : {1, 2})
    for (const bool minus : {false, true}) {
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_UIFR", 1, origin);
      bench.start({0, 0, -10});
      const auto trigger = [&](int each, bool down) {
        const std::string name = fmt::format("$SNS_MEA_WP_TRIG_{}_DIR_AX{}", down ? "MINUS" : "PLUS", each);
        return bench.data(name.c_str(), {0});
      };
      std::map<std::pair<int, bool>, double> expected;
      for (const int each : {1, 2})
        for (const bool down : {false, true})
          expected[{each, down}] = trigger(each, down);
      expected[{axis, minus}] = minus ? -1.95 : 1.95;
      bench.run("CYCLE976", {}, {},
                fmt::format("_MVAR=1001 _SETVAL=50 _MA={} _MD={} _FA=6 _TSA=3\n", axis, minus ? 1 : 0));
      for (const auto& [which, value] : expected)
        EXPECT_NEAR(trigger(which.first, which.second), value, 1e-6) << which.first << which.second;
    }
}

/// 1 in the thousands: the spindle turns by half a turn between two touches, so that a ball beside its axis does no
/// harm.
TEST(OldForm, MeasuresASurfaceWithSpindleReversal) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.tipOffset = {0.08, -0.05};
  place(truth, simulation::Box({0, 0, -60}, {120, 100, 0}), translation(origin + Vector3(0.5, -0.25, 0)));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  const auto measured = [&](int variant, int axis) {
    bench.start(axis == 1 ? Vector3(-12, 20, -10) : Vector3(20, -12, -10));
    bench.run("CYCLE978", {}, {}, fmt::format("_MVAR={} _SETVAL=0 _MA={} _FA=9 _TSA=9\n", variant, axis));
    return bench.ovr(4);
  };
  EXPECT_NEAR(measured(0, 1), 0.5 - 0.08, 1e-9);
  EXPECT_NEAR(measured(0, 2), -0.25 + 0.05, 1e-9);
  EXPECT_NEAR(measured(1000, 1), 0.5, 1e-9);
  EXPECT_NEAR(measured(1000, 2), -0.25, 1e-9);
  bench.start({-12, 20, -10});
  bench.run("CYCLE998", {}, {}, "_MVAR=1005 _SETVAL=0 _MA=201 _ID=40 _FA=9 _TSA=9\n");
  EXPECT_NEAR(bench.ovr(4), 0, 1e-9);
}

TEST(OldForm, MeasuresWithItsOwnFeed) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 60, -60), translation(origin));
  const auto seconds = [&](double feed) {
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.start({0, 0, -10});
    bench.run("CYCLE977", {}, {}, fmt::format("_MVAR=1 _SETVAL=40 _FA=6 _TSA=2 _VMS={}\n", feed));
    EXPECT_EQ(bench.data("$SNS_MEA_WP_FEED", {0}), 0) << "the data set keeps its feed";
    const auto& cycle = bench.control.journal.cycles.back();
    return cycle.endSeconds - cycle.startSeconds;
  };
  EXPECT_GT(seconds(50), seconds(0) + 1);
}

TEST(OldForm, MeasuresGroovesAndRibsAtAnAngle) {
  Planter plant(604);
  for (int world = 0; world < 24; ++world) {
    SCOPED_TRACE(world);
    const bool inside = world % 2 == 0, corrects = world % 4 < 2, inches = world % 3 == 0;
    const double width = plant.number(20, 40), angle = plant.number(-80, 80), error = plant.number(-1, 1);
    // A groove or rib along Y of its own frame, displaced across itself.
    const Vector3 middle(plant.number(-30, 30), plant.number(-30, 30), 0);
    const Pose along = rotation(Vector3::UnitZ(), angle);
    const Pose part = translation(origin + middle) * along * translation({error, 0, 0});
    simulation::Truth truth = perfectWorld();
    if (inside) {
      place(truth, simulation::Box({width / 2, -200, -60}, {200, 200, 0}), part);
      place(truth, simulation::Box({-200, -200, -60}, {-width / 2, 200, 0}), part);
    } else {
      place(truth, simulation::Box({-width / 2, -100, -60}, {width / 2, 100, 0}), part);
    }
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.start(middle + Vector3(0, 0, inside ? -10 : 10));
    const double unit = inches ? 25.4 : 1;
    bench.run("CYCLE979", {}, {},
              fmt::format("{}\n_MVAR={} _KNUM=1 _SETVAL={:.12f} _CPA={:.12f} _CPO={:.12f}\n"
                          "_STA1={:.12f} _ID={:.12f} _FA=4 _TSA={:.12f}\n",
                          inches ? "G700" : "G710", (inside ? 3 : 4) + (corrects ? 100 : 0), (width - 0.2) / unit,
                          middle.x() / unit, middle.y() / unit, angle, inside ? 0 : -20 / unit, 2 / unit));
    EXPECT_NEAR(bench.ovr(4) * unit, width, 1e-8);
    const Vector3 found = middle + along * Vector3(error, 0, 0);
    EXPECT_NEAR(bench.ovr(5) * unit, found.x(), 1e-8);
    EXPECT_NEAR(bench.ovr(6) * unit, found.y(), 1e-8);
    if (corrects)
      EXPECT_NEAR((along.inverse() * (inWorkpiece(bench, part.translation()) - middle)).x(), 0, 1e-8);
    else
      EXPECT_EQ(bench.data("$P_UIFR", {1, "X", "FI"}), 0);
  }
}

TEST(OldForm, SaysWhatItCannotCarryOut) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 60, -60), translation(origin));
  const struct {
    const char* cycle;
    const char* variables;
    const char* code;
    const char* text;
  } rows[] = {
      {"CYCLE994", "_MVAR=101 _SETVAL=40 _MA=2 _FA=6 _TSA=2", "61307", "1 and 2 are"},
      {"CYCLE994", "_MVAR=1 _SETVAL=40 _MA=3 _FA=6 _TSA=2", "61325", "_MA = 3"},
      {"CYCLE979", "_MVAR=3 _SETVAL=40 _CPA=0.5 _FA=6 _TSA=2", "61307", "that is 0.0000 0.0000, not _CPA, _CPO"},
      {"CYCLE979", "_MVAR=1003 _SETVAL=40 _FA=6 _TSA=2", "61307", "_MVAR = 1003"},
      {"CYCLE973", "_MVAR=12 _FA=6 _TSA=2", "61307", "13, in a groove"},
      {"CYCLE973", "_MVAR=3013 _FA=6 _TSA=2", "61307", "13, in a groove"},
      {"CYCLE973", "_MVAR=2013 _MA=2 _FA=6 _TSA=2", "61307", "touched in one direction"},
      {"CYCLE978", "_MVAR=10 _SETVAL=0 _MA=1 _FA=6 _TSA=2", "61307", "_MVAR = 10"},
      {"CYCLE978", "_MVAR=1 _SETVAL=0 _MA=1 _FA=6 _TSA=2", "61307", "_MVAR = 1"},
      {"CYCLE978", "_MVAR=2000 _SETVAL=0 _MA=1 _FA=6 _TSA=2", "61307", "_MVAR = 2000"},
      {"CYCLE998", "_MVAR=15 _SETVAL=0 _MA=201 _ID=40 _FA=6 _TSA=2", "61307", "_MVAR = 15"},
      {"CYCLE998", "_MVAR=2005 _SETVAL=0 _MA=201 _ID=40 _FA=6 _TSA=2", "61307", "_MVAR = 2005"},
      {"CYCLE998", "_MVAR=10005 _SETVAL=0 _MA=201 _ID=40 _FA=6 _TSA=2", "61307", "_MVAR = 10005"},
      {"CYCLE998", "_MVAR=200005 _SETVAL=0 _MA=201 _ID=40 _FA=6 _TSA=2", "61307", "_MVAR = 200005"},
      {"CYCLE976", "_MVAR=10101 _SETVAL=40 _FA=6 _TSA=2", "61307", "_MVAR = 10101"},
      {"CYCLE977", "_MVAR=201 _SETVAL=40 _FA=6 _TSA=2", "61307", "_MVAR = 201"},
      {"CYCLE977", "_MVAR=101 _SETVAL=40 _FA=6 _TSA=2 _KNUM=1099", "61321", "_KNUM = 1099"},
      {"CYCLE977", "_MVAR=1 _SETVAL=40 _FA=6 _TSA=2 _KNUM=1001 _TNUM=7", "61328", "_KNUM = 1001"},
      {"CYCLE977", "_MVAR=1 _SETVAL=40 _FA=6 _TSA=2 _TENV=\"ENV1\"", "61319", "_TENV"},
      {"CYCLE961", "_MVAR=105 _SETV[0]=80 _SETV[1]=80 _SETV[4]=2 _FA=6 _TSA=2", "61319", "_SETV[2] and _SETV[3]"},
      {"CYCLE977", "_MVAR=1 _SETVAL=40 _TSA=2", "61308", "DFA"},
  };
  for (const auto& [cycle, assigned, code, text] : rows) {
    SCOPED_TRACE(assigned);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.start({0, 0, -10});
    const execution::RunResult result = bench.tryRun(cycle, {}, {}, std::string(assigned) + "\n");
    ASSERT_FALSE(result.diagnostics.empty());
    EXPECT_EQ(result.diagnostics[0].code, code);
    EXPECT_NE(result.diagnostics[0].message.find(text), std::string::npos) << result.diagnostics[0].message;
    EXPECT_FALSE(result.diagnostics[0].advice.empty());
  }
}

}  // namespace
}  // namespace probewright
