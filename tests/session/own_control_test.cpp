#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "machine/machine_file.hpp"
#include "machine/own_control.hpp"
#include "session/run.hpp"
#include "support/willing_machine.hpp"

/// A machine with a control of its own: whose zero offsets and tools count, and what becomes of them.
namespace probewright::session {
namespace {

using machine::OwnOffset;
using machine::OwnTables;
using machine::OwnTool;
using testing::HasSubstr;

/// A willing machine whose own control has tables and a screen.
class MillWithTables : public testing_support::WillingMachine, public machine::OwnControl {
public:
  MillWithTables() : WillingMachine(*machine::readMachine("mill3")) {
    for (int number = 1; number <= 9; ++number)
      own.offsets.push_back({number, {}, 0});
  }
  const OwnTables* tables() const override { return &own; }
  std::optional<std::string> keep(const OwnTables& tables) override {
    kept = tables;
    return refuses;
  }
  void accompany(std::function<machine::OrderPlace()> place) override { place_ = std::move(place); }
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override {
    if (place_) places.push_back(place_());
    if (touchedOff) own.offsets[4].origin = {{7, 8, -9}};
    return WillingMachine::move(target, feed);
  }

  OwnTables own, kept;
  std::optional<std::string> refuses;
  bool touchedOff = false;  ///< the operator sets offset 5 while the program runs
  std::vector<machine::OrderPlace> places;

private:
  std::function<machine::OrderPlace()> place_;
};

control::BelievedTool tool(int number, const char* kind, double length, double radius) {
  control::BelievedTool tool;
  tool.number = number;
  tool.name = "T" + std::to_string(number);
  tool.kind = kind;
  tool.length = length;
  tool.radius = tool.axialRadius = radius;
  return tool;
}

control::Beliefs beliefsOf(control::ControlKind kind) {
  control::Beliefs beliefs;
  beliefs.control = kind;
  beliefs.tools = {tool(1, "probe", 100, 2.9), tool(2, "mill", 80, 5)};
  control::BelievedFrame frame;
  frame.index = 1;
  frame.origin = {10, 20, -400};
  frame.active = true;
  (kind == control::ControlKind::TNC640 ? beliefs.presets : beliefs.zeroOffsets).push_back(frame);
  return beliefs;
}

const char* const klartext = "0 BEGIN PGM P MM\n1 TOOL CALL 2 Z\n2 L X+1 Y+2 Z+3 R0 FMAX\n3 END PGM P MM\n";
const char* const sinumerik = "G17 G54 G90\nT2 M6 D1\nG0 X1 Y2 Z3\nM30\n";

struct Vendor {
  control::ControlKind kind;
  const char* name;
  const char* program;
};
void PrintTo(const Vendor& vendor, std::ostream* out) { *out << control::name(vendor.kind); }
class TablesAsOne : public testing::TestWithParam<Vendor> {
protected:
  RunOutcome run() {
    const control::Beliefs beliefs = beliefsOf(GetParam().kind);
    return runText(GetParam().name, GetParam().program, beliefs, mill, {});
  }
  MillWithTables mill;
};

TEST_P(TablesAsOne, WhatTheMachineHasGoesBeforeWhatTheSetupSays) {
  mill.own.offsets[0].origin = {{-5, 7, -300}};
  mill.own.tools = {{1, 0, 6}, {2, 81.5, 12}};
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  EXPECT_NEAR(mill.position()[0], -5 + 1, 1e-9);
  EXPECT_NEAR(mill.position()[1], 7 + 2, 1e-9);
  EXPECT_NEAR(mill.position()[2], -300 + 3 + 81.5, 1e-9);
  // The length of the probe was not set: it is now. Its radius is the control's alone.
  EXPECT_TRUE(mill.kept.offsets.empty());
  ASSERT_EQ(mill.kept.tools.size(), 1U);
  EXPECT_EQ(mill.kept.tools[0].number, 1);
  EXPECT_NEAR(mill.kept.tools[0].length, 100, 1e-9);
  EXPECT_EQ(mill.kept.tools[0].diameter, 6);
}

TEST_P(TablesAsOne, WhatTheMachineHasNotSetComesFromTheControl) {
  mill.own.tools = {{2, 0, 0}};
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.info.exit, records::ExitState::Good);
  EXPECT_NEAR(mill.position()[2], -400 + 3 + 80, 1e-9);
  ASSERT_EQ(mill.kept.offsets.size(), 1U);
  EXPECT_EQ(mill.kept.offsets[0].number, 1);
  EXPECT_NEAR(mill.kept.offsets[0].origin[0], 10, 1e-9);
  EXPECT_NEAR(mill.kept.offsets[0].origin[2], -400, 1e-9);
  ASSERT_EQ(mill.kept.tools.size(), 1U);
  EXPECT_NEAR(mill.kept.tools[0].diameter, 10, 1e-9);
}

TEST_P(TablesAsOne, WhatTheMachineLearnsDuringTheRunStays) {
  mill.touchedOff = true;
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  ASSERT_EQ(mill.kept.offsets.size(), 1U) << "the control knows nothing of offset 5, so it has nothing to say of it";
  EXPECT_EQ(mill.kept.offsets[0].number, 1);
}

TEST_P(TablesAsOne, ATurnedOffsetTurnsTheProgram) {
  mill.own.offsets[0] = {1, {{100, 50, -300}}, 90};
  run();
  EXPECT_NEAR(mill.position()[0], 100 - 2, 1e-9);
  EXPECT_NEAR(mill.position()[1], 50 + 1, 1e-9);
  EXPECT_TRUE(mill.kept.offsets.empty());
}

TEST_P(TablesAsOne, TablesThatCannotBeChangedAreAWarning) {
  mill.refuses = "it is in emergency stop";
  const RunOutcome outcome = run();
  bool warned = false;
  for (const control::EventRecord event : outcome.journal.events)
    warned = warned || (event.kind == control::EventKind::Warning &&
                        event.text.find("it is in emergency stop") != std::string::npos);
  EXPECT_TRUE(warned);
}

TEST_P(TablesAsOne, TheScreenFollowsTheProgram) {
  mill.own.offsets[0].origin = {{-5, 7, -300}};
  run();
  ASSERT_FALSE(mill.places.empty());
  EXPECT_EQ(mill.places.back().line, 3U);
  EXPECT_NEAR(mill.places.back().toolVector.z(), 80, 1e-9);
  ASSERT_FALSE(mill.places.front().messages.empty());
  EXPECT_THAT(mill.places.front().messages.front(), HasSubstr("G54: X-5.0000 Y7.0000 Z-300.0000"));
}

/// The machine's table has one number for geometry and wear together.
TEST(OwnTools, HoldTheWearOfSinumerikTools) {
  MillWithTables mill;
  mill.own.tools = {{1, 100, 5.8}, {2, 81.5, 12}};
  const control::Beliefs beliefs = beliefsOf(control::ControlKind::Sinumerik840Dsl);
  const RunOutcome outcome = runText(
      "P.MPF", "G17 G54 G90\n$TC_DP12[2,1]=0.25\n$TC_DP15[2,1]=-0.1\nT2 M6 D1\nG0 X1 Y2 Z3\nM30\n", beliefs, mill, {});
  EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  EXPECT_NEAR(mill.position()[2], -400 + 3 + 81.5 + 0.25, 1e-9);
  ASSERT_EQ(mill.kept.tools.size(), 1U);
  EXPECT_EQ(mill.kept.tools[0].number, 2);
  EXPECT_NEAR(mill.kept.tools[0].length, 81.75, 1e-9);
  EXPECT_NEAR(mill.kept.tools[0].diameter, 2 * (6 - 0.1), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Vendors, TablesAsOne,
                         testing::Values(Vendor{control::ControlKind::TNC640, "P.H", klartext},
                                         Vendor{control::ControlKind::Sinumerik840Dsl, "P.MPF", sinumerik}),
                         [](const auto& test) { return std::string(test.param.name).substr(2); });

}  // namespace
}  // namespace probewright::session
