#include "base/number_text.hpp"
#include "cycles/catalogue.hpp"
#include "cycles_heidenhain/inspected_parts.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// What holds for all inspection cycles alike: tolerances, tools, units, coordinate systems, errors of the probe.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

Bench levelBench(ControlKind kind) {
  Bench bench(kind);
  bench.preset(1, {0, 0, -400});
  return bench;
}

/// Measured values in mm and degrees, by parameter.
std::map<std::string, double> resultsOf(const Ran& ran) {
  std::map<std::string, double> results;
  for (const auto& result : ran.cycle().results)
    results[result.name] = result.value;
  return results;
}

int statusOf(const Ran& ran) { return static_cast<int>(ran.q(180) + 2 * ran.q(181) + 4 * ran.q(182)); }

void expectSame(const Ran& ran, const Ran& reference) {
  ASSERT_TRUE(ran.finished()) << ran.why();
  ASSERT_TRUE(reference.finished()) << reference.why();
  const auto found = resultsOf(ran), expected = resultsOf(reference);
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_FALSE(expected.empty());
  for (const auto& [name, value] : expected)
    EXPECT_NEAR(found.at(name), value, exact) << name;
  EXPECT_EQ(statusOf(ran), statusOf(reference));
}

TEST(EveryInspection, StopsOutOfToleranceAndLocksBrokenTools) {
  for (InspectedPart& part : inspectedParts(levelBench(ControlKind::TNC640), pose({0, 0, -400}))) {
    SCOPED_TRACE(fmt::format("cycle {}", part.cycle));
    const Ran going = part.bench.run(probe(part.cycle, part.words));
    ASSERT_TRUE(going.finished()) << going.why();
    EXPECT_EQ(going.q(181) + going.q(182), 1);
    const Ran stopped = part.bench.run(probe(part.cycle, with(part.words, {{309, 1}})));
    EXPECT_EQ(stopped.alarm(), "Tolerance exceeded") << stopped.why();
    EXPECT_NE(stopped.why().find(going.q(182) == 1 ? "Scrap" : "Rework"), std::string::npos) << stopped.why();

    const TableFolder folder(part.bench);
    const auto withBreakage = [&](double breakage) {
      control::heidenhain::TypedTable tools = control::heidenhain::defaultToolTable(ControlKind::TNC640);
      EXPECT_TRUE(tools.setText("5", "NAME", "MILL"));
      EXPECT_TRUE(tools.setNumber("5", "RBREAK", breakage));
      EXPECT_TRUE(tools.setText("5.2", "NAME", "STEP"));
      folder.put("TOOL.T", tools);
      return part.bench.run(probe(part.cycle, with(part.words, {{330, 5}})));
    };
    const Ran broken = withBreakage(0.2);
    EXPECT_EQ(broken.alarm(), "Tool breakage") << broken.why();
    EXPECT_NE(broken.why().find("RBREAK"), std::string::npos) << broken.why();
    EXPECT_EQ(broken.table("TOOL.T").text("5", "TL"), "L");
    EXPECT_EQ(broken.cell("TOOL.T", "5", "DR"), 0);
    const Ran worn = withBreakage(0.31);
    EXPECT_TRUE(worn.finished()) << worn.why();
    EXPECT_EQ(worn.table("TOOL.T").text("5", "TL"), "");
    EXPECT_EQ(std::abs(worn.cell("TOOL.T", "5", "DR")) > 0.1, part.cycle != 430);
    // An index behind the number names the step.
    const Ran step = part.bench.run(probe(part.cycle, with(part.words, {{330, 5.2}})));
    EXPECT_TRUE(step.finished()) << step.why();
    EXPECT_EQ(std::abs(step.cell("TOOL.T", "5.2", "DR")) > 0.1, part.cycle != 430);
    EXPECT_EQ(step.cell("TOOL.T", "5", "DR"), 0);
  }
}

/// The cycle of the part with a log, for a program in inches.
std::string inInches(const InspectedPart& part) {
  std::string text = fmt::format("TCH PROBE {} MEASURE", part.cycle);
  for (auto [number, value] : with(part.words, {{281, 1}})) {
    const auto* parameter = cycles::heidenhainCycle(part.cycle)->parameter(static_cast<std::uint32_t>(number));
    if (parameter->kind == cycles::ValueKind::Length) value = written(value / 25.4, 7);
    text += fmt::format(" ~\n  Q{}={:+.9f} ;VALUE", number, value);
  }
  return text + "\n";
}

TEST(EveryInspection, TakesTheSameValuesInInch) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (InspectedPart& part : inspectedParts(levelBench(kind), pose({0, 0, -400}))) {
      SCOPED_TRACE(fmt::format("cycle {}", part.cycle));
      const Ran ran = part.bench.run(inInches(part), "INCH");
      const Ran millimetres = part.bench.run(probe(part.cycle, part.words));
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_EQ(statusOf(ran), statusOf(millimetres));
      const std::string log = ran.log(fmt::format("TCHPR{}.TXT", part.cycle));
      for (const auto& [name, value] : resultsOf(millimetres)) {
        const int number = std::stoi(name.substr(1));
        EXPECT_NEAR(ran.q(number) * 25.4, value, 5e-6) << name;
        EXPECT_NE(log.find(formatFixed(ran.q(number), 5)), std::string::npos) << name << "\n" << log;
      }
    }
  }
}

/// Parameters count in the unit of the program that they stand in, return parameters and logs in that of the main
/// program.
TEST(EveryInspection, AnswersInTheUnitOfTheMainProgram) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (InspectedPart& part : inspectedParts(levelBench(kind), pose({0, 0, -400}))) {
      for (const bool inchMain : {false, true}) {
        SCOPED_TRACE(fmt::format("{} cycle {} called by a program in {}", control::name(kind), part.cycle,
                                 inchMain ? "inches" : "mm"));
        const TableFolder folder(part.bench);
        part.bench.program = (part.bench.setup.beliefs.tables / "MAIN.H").string();
        const std::string unit = inchMain ? "MM" : "INCH";
        const std::string block = inchMain ? probe(part.cycle, with(part.words, {{281, 1}})) : inInches(part);
        folder.put("SUB.H", "BEGIN PGM SUB " + unit + "\n" + block + "Q50 = Q113\nEND PGM SUB " + unit + "\n");
        const Ran ran = part.bench.run("CALL PGM SUB.H\n", inchMain ? "INCH" : "MM");
        ASSERT_TRUE(ran.finished()) << ran.why();
        EXPECT_EQ(ran.q(50), inchMain ? 1 : 0);
        const Ran millimetres = part.bench.run(probe(part.cycle, part.words));
        EXPECT_EQ(statusOf(ran), statusOf(millimetres));
        const std::string log = ran.log(fmt::format("TCHPR{}.TXT", part.cycle));
        for (const auto& [name, value] : resultsOf(millimetres)) {
          const int number = std::stoi(name.substr(1));
          EXPECT_NEAR(ran.q(number) * (inchMain ? 25.4 : 1), value, 5e-6) << name;
          EXPECT_NE(log.find(" " + formatFixed(ran.q(number), inchMain ? 5 : 4) + "\n"), std::string::npos)
              << name << log;
        }
      }
    }
  }
}

TEST(EveryInspection, FollowsShiftRotationAndMirrorOnTheITNC530) {
  const std::string shift = "CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 X+12.5\nCYCL DEF 7.2 Y-7\nCYCL DEF 7.3 Z+3\n",
                    turn = "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+25\n",
                    mirror = "CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X\n";
  const Pose level = pose({0, 0, -400}), shifted = pose({12.5, -7, -397}), turned = pose({12.5, -7, -397}, {0, 0, 25});
  const Bench bench = levelBench(ControlKind::iTNC530);
  const auto references = inspectedParts(bench, level);
  for (const auto& [before, at, side] :
       {std::tuple(shift, shifted, 1), std::tuple(shift + turn, turned, 1), std::tuple(shift + mirror, shifted, -1)}) {
    const auto parts = inspectedParts(bench, at, side);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      SCOPED_TRACE(fmt::format("cycle {} after {}", parts[i].cycle, before));
      const std::string block = probe(parts[i].cycle, parts[i].words);
      expectSame(parts[i].bench.run(before + block), references[i].bench.run(block));
      Bench newer = parts[i].bench;
      newer.control = ControlKind::TNC640;
      EXPECT_EQ(newer.run(before + block).alarm(), "Coordinate transformation not permitted");
    }
  }
}

/// The plane is tilted and the rotary axes turned to it: what is measured in it is as on a level part.
TEST(EveryInspection, MeasuresInAnyTiltedPlane) {
  Dice dice(4200);
  for (int at = 0; at < 24; ++at) {
    static constexpr const char* machines[] = {"mill5-table-table", "mill5-head-table", "mill5-head-head"};
    Bench bench(controlOf(at), machines[at % 3]);
    const Vector3 origin(written(dice.between(-20, 20)), written(dice.between(-20, 20)), -430);
    const double rotation = written(dice.between(-15, 15));
    bench.preset(1, origin, rotation);
    const Vector3 angles(written(dice.between(-15, 15)), written(dice.between(-15, 15)),
                         written(dice.between(-30, 30)));
    const Pose plane = pose(origin, {0, 0, rotation}) * pose(Vector3::Zero(), angles);
    const std::string tilt =
        fmt::format("L Z-1 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC{:+.3f} TURN FMAX\nL Z+100 R0 FMAX\n",
                    angles.x(), angles.y(), angles.z());
    const auto parts = inspectedParts(bench, plane),
               references = inspectedParts(levelBench(bench.control), pose({0, 0, -400}));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      SCOPED_TRACE(fmt::format("world {}, cycle {}", at, parts[i].cycle));
      const std::string block = probe(parts[i].cycle, parts[i].words);
      expectSame(parts[i].bench.run(tilt + block), references[i].bench.run(block));
    }
  }
}

/// M128 holds the tip while the rotary axes make the stylus lean: the plane is not tilted, the results stay.
TEST(EveryInspection, MeasuresWithALeaningStylusUnderTcpm) {
  Dice dice(4202);
  for (int at = 0; at < 12; ++at) {
    const std::pair<const char*, const char*> machines[] = {
        {"mill5-table-table", "A"}, {"mill5-head-table", "B"}, {"mill5-head-head", "A"}};
    const auto& [machine, swivel] = machines[at % 3];
    Bench bench(controlOf(at), machine);
    const Vector3 origin(written(dice.between(-20, 20)), written(dice.between(-20, 20)), -430);
    bench.preset(1, origin);
    const std::string lean = fmt::format("L Z-1 R0 FMAX M91\nM128\nL {}{:+.3f} C{:+.3f} F2000\n", swivel,
                                         dice.between(-3, 3), dice.between(-60, 60));
    const auto parts = inspectedParts(bench, pose(origin)),
               references = inspectedParts(levelBench(bench.control), pose({0, 0, -400}));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      SCOPED_TRACE(fmt::format("world {}, cycle {}", at, parts[i].cycle));
      const std::string block = probe(parts[i].cycle, parts[i].words);
      expectSame(parts[i].bench.run(lean + block), references[i].bench.run(block));
    }
  }
}

/// A ball that is larger than believed, beside where it is believed, with a signal that comes late.
TEST(EveryInspection, IsWrongByWhatTheControlDoesNotKnow) {
  Dice dice(4201);
  for (int at = 0; at < 20; ++at) {
    const ControlKind kind = controlOf(at);
    Bench bench = levelBench(kind);
    const Vector2 beside(written(dice.between(-0.15, 0.15), 4), written(dice.between(-0.15, 0.15), 4));
    const double larger = written(dice.between(-0.05, 0.05), 4), late = dice.between(0, 0.02);
    for (InspectedPart& part : inspectedParts(bench, pose({0, 0, -400}))) {
      SCOPED_TRACE(fmt::format("world {}, cycle {}", at, part.cycle));
      const Ran ideal = part.bench.run(probe(part.cycle, part.words));
      ASSERT_TRUE(ideal.finished()) << ideal.why();
      part.bench.trueProbe().tipOffset = beside;
      part.bench.trueProbe().pretravel = late;
      part.bench.believedProbe().tipOffset = {0, 0};
      part.bench.believedProbe().radius += larger;
      const Ran ran = part.bench.run(probe(part.cycle, part.words));
      ASSERT_TRUE(ran.finished()) << ran.why();
      const bool inside = part.cycle % 2 == 1;
      const double size = (inside ? 2 : -2) * (larger + late);
      // Beside the middle the ball meets round walls at a slant.
      const double near = part.cycle <= 422 ? 3e-5 : exact;
      std::map<std::string, double> wrong = {{"Q151", -beside.x()}, {"Q152", -beside.y()},
                                             {"Q161", -beside.x()}, {"Q162", -beside.y()},
                                             {"Q153", size},        {"Q163", size},
                                             {"Q154", size},        {"Q155", size},
                                             {"Q164", size},        {"Q165", size},
                                             {"Q156", size},        {"Q166", size},
                                             {"Q157", -beside.x()}, {"Q160", -beside.x() - larger - late}};
      if (part.cycle == 430) wrong["Q153"] = wrong["Q163"] = 0;
      for (const auto& [name, value] : resultsOf(ideal))
        EXPECT_NEAR(resultsOf(ran).at(name), value + wrong.at(name), near) << name;
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
