#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/heidenhain/datum_table.hpp"
#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"

/// What FN 18 reads and FN 17 writes, datum by datum: every number has a value of its own, so that none can stand for
/// another.
namespace probewright::language::klartext::testing {
namespace {

using control::ControlKind;
using control::heidenhain::NumberColumn;

struct Datum {
  int id, number;
  double index;
  double value;
};

std::string block(const Datum& datum, std::size_t q) {
  return fmt::format("FN 18: SYSREAD Q{} = ID{} NR{} IDX{}\n", q, datum.id, datum.number, datum.index);
}

/// What a program reads after these blocks.
void expectData(World& world, const std::string& blocks, const std::vector<Datum>& data) {
  std::string program = blocks;
  for (std::size_t i = 0; i < data.size(); ++i)
    program += block(data[i], i + 1);
  ASSERT_LT(data.size(), 100U);
  expectFinished(world.run(program));
  for (std::size_t i = 0; i < data.size(); ++i)
    EXPECT_NEAR(world.q(static_cast<int>(i) + 1), data[i].value, 1e-9) << block(data[i], i + 1);
}

std::string messageOf(const RunResult& result) {
  return result.diagnostics.empty() ? std::string("none") : result.diagnostics.front().message;
}

struct ToolColumn {
  int number;
  NumberColumn column;
  double value;
};

const std::vector<ToolColumn>& toolColumns() {
  static const std::vector<ToolColumn> columns = {
      {1, "L", 61.5},       {2, "R", 7.25},      {3, "R2", 1.5},      {4, "DL", 0.125},      {5, "DR", -0.25},
      {6, "DR2", 0.375},    {9, "TIME1", 41},    {10, "TIME2", 37},   {11, "CUR.TIME", 8.5}, {13, "LCUTS", 23.5},
      {14, "ANGLE", 4.5},   {15, "CUT", 3},      {16, "LTOL", 0.02},  {17, "RTOL", 0.03},    {19, "R-OFFS", 2.25},
      {20, "L-OFFS", 1.75}, {21, "LBREAK", 0.4}, {22, "RBREAK", 0.5}, {28, "NMAX", 9000},    {32, "T-ANGLE", 118},
      {40, "PITCH", 1.25}};
  return columns;
}

TEST(EverySystemDatum, OfAToolIsThatOfItsColumn) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const bool writes : {false, true}) {
      SCOPED_TRACE(fmt::format("{} {}", control::name(kind), writes));
      World world("mill3", kind);
      auto& tools = world.control->tables.tools;
      std::string blocks = "TOOL CALL 1 Z\n";
      std::vector<Datum> data;
      for (const ToolColumn& each : toolColumns()) {
        if (!tools.hasColumn(each.column)) continue;
        if (writes)
          blocks += fmt::format("FN 17: SYSWRITE ID50 NR{} IDX5 = {:+}\n", each.number, each.value);
        else
          ASSERT_TRUE(tools.setNumber("5", each.column, each.value)) << each.number;
        data.push_back({50, each.number, 5, each.value});
      }
      EXPECT_GT(data.size(), 15U);
      expectData(world, blocks, data);
      for (Datum& each : data)
        each.id = 950;
      expectData(world, "TOOL CALL 5 Z\n", data);
      EXPECT_EQ(tools.number("1", "L"), 100);
    }
  }
}

TEST(EverySystemDatum, OfAToolInTextIsANumber) {
  World world;
  auto& tools = world.control->tables.tools;
  const std::string call = "TOOL CALL 1 Z\n";
  expectData(world, call,
             {{50, 7, 5, 0},
              {50, 8, 5, 0},
              {50, 18, 5, 0},
              {50, 34, 5, 0},
              {50, 36, 5, 0},
              {50, 36, 1, 21},
              {50, 19, 5, 99999.9999},
              {50, 37, 1, 1}});
  ASSERT_TRUE(tools.setText("5", "TL", "L"));
  ASSERT_TRUE(tools.setText("5", "RT", "1"));
  ASSERT_TRUE(tools.setText("5", "DIRECT", "-"));
  ASSERT_TRUE(tools.setText("5", "LIFTOFF", "Y"));
  expectData(world, call, {{50, 7, 5, 1}, {50, 8, 5, 1}, {50, 18, 5, -1}, {50, 34, 5, 1}});
  ASSERT_TRUE(tools.setText("5", "DIRECT", "+"));
  ASSERT_TRUE(tools.setText("5", "LIFTOFF", "N"));
  expectData(world, call + "FN 17: SYSWRITE ID50 NR36 IDX5 = +21\n", {{50, 18, 5, 0}, {50, 34, 5, 0}, {50, 36, 5, 21}});
  expectData(world, call + "FN 17: SYSWRITE ID50 NR36 IDX5 = +0\n", {{50, 36, 5, 0}});
  EXPECT_THAT(messageOf(world.run(call + "FN 17: SYSWRITE ID50 NR36 IDX5 = +4\n")), ::testing::HasSubstr("not as 4"));
}

/// The tool of the call, with its steps and in every axis.
TEST(EverySystemDatum, OfTheToolInTheSpindle) {
  for (const std::string axis : {"X", "Y", "Z"}) {
    SCOPED_TRACE(axis);
    World world;
    auto& tools = world.control->tables.tools;
    ASSERT_TRUE(tools.ensureRow("5.1"));
    ASSERT_TRUE(tools.setNumber("5.1", "L", 45));
    ASSERT_TRUE(tools.setNumber("5.1", "R", 3));
    ASSERT_TRUE(tools.setNumber("5.1", "R2", 1));
    ASSERT_TRUE(tools.setNumber("5.1", "DL", 0.5));
    ASSERT_TRUE(tools.setNumber("5.1", "DR", 0.25));
    ASSERT_TRUE(tools.setNumber("5.1", "DR2", 0.125));
    const double number = axis[0] - 'X';
    expectData(world,
               "TOOL DEF 1\nTOOL CALL 5.1 " + axis + " S1200 F350 DL+0.01 DR+0.02 DR2+0.03\nTOOL DEF 1\nM8\nM13\n",
               {{20, 1, 0, 5},      {20, 2, 0, 1},      {20, 3, 0, number}, {20, 4, 0, 1200},   {20, 5, 0, 0},
                {20, 8, 0, 1},      {20, 9, 0, 350},    {20, 10, 0, 0},     {20, 11, 0, 1},     {60, 1, 0, 5},
                {60, 2, 0, number}, {60, 3, 0, 1200},   {60, 4, 0, 0.01},   {60, 5, 0, 0.02},   {60, 6, 0, 0},
                {60, 7, 0, 0.03},   {60, 8, 0, 1},      {60, 9, 0, 350},    {200, 1, 1, 3},     {200, 1, 2, 3.25},
                {200, 1, 3, 3.27},  {200, 2, 1, 45},    {200, 2, 2, 45.5},  {200, 2, 3, 45.51}, {200, 3, 1, 1},
                {200, 3, 2, 1.125}, {200, 3, 3, 1.155}, {200, 6, 1, 100},   {200, 6, 5.1, 45},  {200, 6, 5, 50},
                {50, 1, 5.1, 45},   {50, 1, 5, 50},     {50, 5, 0, 0.25},   {950, 6, 0, 0.125}});
  }
}

TEST(EverySystemDatum, OfTheTouchProbe) {
  for (const ControlKind kind : {ControlKind::TNC640}) {
    World world("mill3", kind);
    auto& probes = world.control->tables.probes;
    ASSERT_TRUE(probes.setText("1", "TYPE", "TS640"));
    ASSERT_TRUE(probes.setNumber("1", "CAL_OF1", 0.03));
    ASSERT_TRUE(probes.setNumber("1", "CAL_OF2", -0.04));
    ASSERT_TRUE(probes.setNumber("1", "CAL_ANG", 25));
    ASSERT_TRUE(probes.setNumber("1", "F", 330));
    ASSERT_TRUE(probes.setNumber("1", "FMAX", 2200));
    ASSERT_TRUE(probes.setNumber("1", "DIST", 14));
    ASSERT_TRUE(probes.setNumber("1", "SET_UP", 3));
    ASSERT_TRUE(world.control->tables.tools.setNumber("1", "R2", 2));
    for (const bool byMachine : {false, true}) {
      ASSERT_TRUE(probes.setText("1", "F_PREPOS", byMachine ? "FMAX_MACHINE" : "FMAX_PROBE"));
      expectData(world, "TOOL CALL 1 Z DL+0.5\n",
                 {{350, 50, 1, 5},
                  {350, 50, 2, 1},
                  {350, 51, 0, 100.5},
                  {350, 52, 1, 2},
                  {350, 52, 2, 2},
                  {350, 53, 1, 0.03},
                  {350, 53, 2, -0.04},
                  {350, 54, 0, 25},
                  {350, 55, 1, 2200},
                  {350, 55, 2, 330},
                  {350, 55, 3, byMachine ? 1.0 : 0.0},
                  {350, 56, 1, 14},
                  {350, 56, 2, 3},
                  {350, 57, 1, 1},
                  {50, 24, 1, 0.03},
                  {50, 25, 1, -0.04},
                  {50, 26, 1, 25}});
    }
  }
}

TEST(EverySystemDatum, OfTheTiltedAndShiftedPlane) {
  World world("mill5-table-table");
  ASSERT_TRUE(world.control->tables.presets.ensureRow("3"));
  ASSERT_TRUE(world.control->tables.presets.setNumber("3", "SPC", 12));
  expectData(world,
             "PRESET SELECT #3\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y-20\nCYCL DEF 7.3 Z+5\n"
             "CYCL DEF 7.4 A+40\nCYCL DEF 7.5 C+30\nCYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+33\n"
             "CYCL DEF 26.0 AXIS-SPEC. SCALING\nCYCL DEF 26.1 X0.5 Y1.5 Z2.5\n",
             {{210, 1, 0, 12},
              {210, 2, 0, 33},
              {210, 4, 1, 0.5},
              {210, 4, 2, 1.5},
              {210, 4, 3, 2.5},
              {210, 5, 1, 0},
              {210, 5, 2, 0},
              {210, 5, 3, 0},
              {210, 6, 0, 0},
              {210, 7, 0, 0},
              {210, 10, 0, 0},
              {220, 2, 1, 10},
              {220, 2, 2, -20},
              {220, 2, 3, 5},
              {220, 2, 4, 40},
              {220, 2, 5, 0},
              {220, 2, 6, 30},
              {530, 1, 0, 3},
              {211, 1, 0, 1}});
  World tilted("mill5-table-table");
  expectData(tilted, "PLANE SPATIAL SPA+10 SPB+20 SPC+30 STAY\n",
             {{210, 5, 1, 10}, {210, 5, 2, 20}, {210, 5, 3, 30}, {210, 6, 0, -1}, {210, 7, 0, -1}, {210, 10, 0, 2}});
  expectData(tilted, "PLANE AXIAL A+15 STAY\n",
             {{210, 5, 1, 15}, {210, 5, 2, 0}, {210, 5, 3, 0}, {210, 6, 0, -1}, {210, 7, 0, -1}, {210, 10, 0, 1}});
  EXPECT_THAT(messageOf(tilted.run("FN 18: SYSREAD Q1 = ID210 NR5 IDX4\n")), ::testing::HasSubstr("ID210 NR5"));
  EXPECT_THAT(messageOf(tilted.run("FN 18: SYSREAD Q1 = ID210 NR5 IDX0\n")), ::testing::HasSubstr("ID210 NR5"));
}

/// Axes X Y Z A B C are the bits 0 to 5.
TEST(EverySystemDatum, OfMirroredAxesIsABitEach) {
  const std::vector<std::pair<std::string, double>> cases = {
      {"X", 1}, {"Y", 2}, {"Z", 4}, {"A", 8}, {"C", 32}, {"X Y", 3}, {"Y Z", 6}, {"Z C", 36}, {"X Y Z A C", 47}};
  for (const auto& [axes, bits] : cases) {
    SCOPED_TRACE(axes);
    World world("mill5-table-table");
    expectData(world, "CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 " + axes + "\n", {{210, 3, 0, bits}});
  }
}

TEST(EverySystemDatum, OfTheAxes) {
  for (const std::string machine : {"mill3", "mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    SCOPED_TRACE(machine);
    World world(machine);
    const auto& axes = world.machine->description().axes;
    std::string blocks = "TOOL CALL 5 Z\n";
    std::vector<Datum> data;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const double index = static_cast<double>(std::string("XYZABCUVW").find(axes[i].name)) + 1;
      const double at = i == 2 ? -180 : 10 + static_cast<double>(i);
      blocks += fmt::format("L {}{:+} R0 FMAX\n", axes[i].name, at);
      data.push_back({230, 2, index, axes[i].minimum});
      data.push_back({230, 3, index, axes[i].maximum});
      data.push_back({240, 1, index, at + (i == 2 ? 50 : 0)});
      data.push_back({270, 1, index, at});
    }
    // The length of the tool lies along Z as long as no rotary axis of a head turns it.
    if (machine.find("head") != std::string::npos) std::erase_if(data, [](const Datum& d) { return d.id >= 240; });
    data.push_back({230, 5, 1, 0});
    expectData(world, blocks, data);
    EXPECT_THAT(messageOf(world.run("FN 18: SYSREAD Q1 = ID230 NR2 IDX9\n")), ::testing::HasSubstr("ID230"));
  }
}

TEST(EverySystemDatum, OfTheTables) {
  World world("mill5-table-table");
  auto& presets = world.control->tables.presets;
  ASSERT_TRUE(presets.ensureRow("4"));
  const std::vector<std::string> columns = {"X", "Y", "Z", "SPA", "SPB", "SPC", "A_OFFS", "C_OFFS"};
  for (std::size_t i = 0; i < columns.size(); ++i)
    ASSERT_TRUE(presets.setNumber("4", NumberColumn::named(columns[i]), 11 + static_cast<double>(i)));
  auto datums = control::heidenhain::defaultDatumTable(ControlKind::TNC640);
  ASSERT_TRUE(datums.ensureRow("2"));
  const std::string axes = "XYZABCUVW";
  std::vector<Datum> data = {{505, 0, 0, 0},  {507, 4, 1, 11}, {507, 4, 2, 12}, {507, 4, 3, 13},
                             {507, 4, 4, 14}, {507, 4, 5, 15}, {507, 4, 6, 16}, {508, 4, 4, 17},
                             {508, 4, 6, 18}, {530, 1, 0, 0},  {530, 2, 4, 0}};
  expectData(world, "", data);
  ASSERT_TRUE(presets.setText("4", "LOCKED", "L"));
  data = {{505, 0, 0, 1}, {530, 2, 4, 1}};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double value = 21.5 + static_cast<double>(i);
    if (datums.hasColumn(NumberColumn::named(axes.substr(i, 1)))) {
      ASSERT_TRUE(datums.setNumber("2", NumberColumn::named(axes.substr(i, 1)), value));
      data.push_back({500, 2, static_cast<double>(i) + 1, value});
    }
  }
  EXPECT_GE(data.size(), 8U);
  world.control->tables.datums.emplace("D.D", datums);
  world.control->activeDatumTable = "D.D";
  expectData(world, "", data);
  for (const std::string refused : {"ID507 NR4 IDX0", "ID507 NR4 IDX7", "ID508 NR4 IDX5", "ID507 NR99 IDX1",
                                    "ID500 NR2 IDX0", "ID500 NR2 IDX10", "ID500 NR77 IDX1"})
    EXPECT_THAT(messageOf(world.run("FN 18: SYSREAD Q1 = " + refused + "\n")),
                ::testing::HasSubstr(refused.substr(0, 5)));
}

/// What FN 17 writes into the tables is what FN 18 reads there, and nothing beside it changes.
TEST(EverySystemDatum, OfTheTablesCanBeWritten) {
  World world("mill5-table-table");
  auto& presets = world.control->tables.presets;
  ASSERT_TRUE(presets.ensureRow("4"));
  ASSERT_TRUE(presets.ensureRow("6"));
  auto datums = control::heidenhain::defaultDatumTable(ControlKind::TNC640);
  ASSERT_TRUE(datums.ensureRow("2"));
  world.control->tables.datums.emplace("D.D", datums);
  world.control->activeDatumTable = "D.D";
  std::vector<Datum> data;
  for (int i = 1; i <= 6; ++i)
    data.push_back({507, 4, static_cast<double>(i), 31.5 + i});
  data.push_back({508, 4, 4, 44});
  data.push_back({508, 4, 6, 46});
  for (int i = 1; i <= 9; ++i) {
    if (datums.hasColumn(NumberColumn::named(std::string("XYZABCUVW").substr(static_cast<std::size_t>(i - 1), 1))))
      data.push_back({500, 2, static_cast<double>(i), 51.5 + i});
  }
  std::string blocks;
  for (const Datum& each : data)
    blocks += fmt::format("FN 17: SYSWRITE ID{} NR{} IDX{} = {:+}\n", each.id, each.number, each.index, each.value);
  expectData(world, blocks, data);
  for (int i = 1; i <= 6; ++i)
    expectData(world, "", {{507, 6, static_cast<double>(i), 0}});
  for (const std::string refused :
       {"ID507 NR4 IDX0", "ID507 NR4 IDX7", "ID507 NR-1 IDX1", "ID508 NR4 IDX3", "ID508 NR4 IDX5", "ID508 NR4 IDX7",
        "ID508 NR-1 IDX4", "ID500 NR2 IDX0", "ID500 NR2 IDX10", "ID500 NR-1 IDX1", "ID503 NR4 IDX1", "ID210 NR1 IDX0"})
    EXPECT_THAT(messageOf(world.run("FN 17: SYSWRITE " + refused + " = +1\n")), ::testing::HasSubstr("cannot write"))
        << refused;
}

TEST(EverySystemDatum, OfTheLastTouch) {
  for (const std::string outcome : {"touched", "deflected", "missed"}) {
    World world("mill5-head-table");
    control::TouchRecord touch;
    touch.outcome = outcome;
    touch.surface = {1.5, 2.5, 3.5};
    touch.ballCentre = {4.5, 5.5, 6.5};
    touch.spindle = {7.5, 8.5, 9.5};
    touch.latched[0] = 11;
    touch.latched[1] = -12;
    touch.latched[2] = -130.5;
    const auto c = world.machine->description().axisIndex("C");
    ASSERT_TRUE(c);
    touch.latched[*c] = 40;
    world.control->journal.cycles.emplace_back().touches = {touch};
    expectData(world, "TOOL CALL 5 Z\n",
               {{360, 1, 1, 1.5},
                {360, 1, 2, 2.5},
                {360, 1, 3, 3.5},
                {360, 1, 6, 40},
                {360, 2, 1, 11},
                {360, 2, 2, -12},
                {360, 2, 3, -130.5},
                {360, 2, 6, 40},
                {360, 3, 1, 7.5},
                {360, 3, 2, 8.5},
                {360, 3, 3, 9.5},
                {360, 4, 1, 4.5},
                {360, 4, 2, 5.5},
                {360, 4, 3, 6.5},
                {360, 11, 0,
                 outcome == "touched"     ? 0.0
                 : outcome == "deflected" ? -2.0
                                          : -1.0}});
  }
}

TEST(EverySystemDatum, OfTheRun) {
  World world;
  world.control->wallClockStart = 1'700'000'000;
  expectData(world, "TOOL CALL 1 Z\n",
             {{25, 1, 0, 1},
              {35, 1, 0, 0},
              {310, 116, 0, 0},
              {310, 126, 0, 0},
              {310, 128, 0, 0},
              {310, 144, 0, 0},
              {320, 1, 0, 1'700'000'000},
              {990, 1, 0, 0},
              {990, 2, 0, 0},
              {990, 4, 0, 0},
              {990, 6, 0, 0},
              {992, 10, 0, 0},
              {992, 11, 0, 0},
              {992, 14, 0, 0},
              {992, 16, 0, 1},
              {10, 7, 0, -1},
              {10, 8, 1, -1},
              {10, 8, 2, 0},
              {10, 3, 0, -1},
              {10, 6, 0, -1},
              {10, 111, 1, 0},
              {280, 1, 0, 0},
              {20, 8, 0, 0}});
  World turning("mill5-head-table");
  expectData(turning, "TOOL CALL 1 Z\nM126\nM144\n", {{310, 126, 0, -1}, {310, 144, 0, -1}, {310, 128, 0, 0}});
  expectData(turning, "TOOL CALL 1 Z\nM128\n", {{310, 126, 0, 0}, {310, 128, 0, -1}, {280, 1, 0, -1}});
  World calls;
  calls.library.texts["SUB.H"] =
      "BEGIN PGM SUB INCH\nFN 18: SYSREAD Q1 = ID10 NR7\nFN 18: SYSREAD Q2 = ID10 NR8 IDX1\n"
      "FN 18: SYSREAD Q3 = ID10 NR8 IDX2\nEND PGM SUB INCH\n";
  expectFinished(calls.run("BEGIN PGM A MM\nCALL PGM SUB.H\nEND PGM A MM\n"));
  EXPECT_EQ(calls.q(1), 0);
  EXPECT_EQ(calls.q(2), 0);
  EXPECT_EQ(calls.q(3), 1);
}

}  // namespace
}  // namespace probewright::language::klartext::testing
