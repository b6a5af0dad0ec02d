#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "machine/description.hpp"
#include "manual_programs/part.hpp"

/// The whole programs of the manuals' example chapters: their sequence and values in programs of our own, run on parts
/// that give the printed results.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

class PrintedProgram : public ::testing::TestWithParam<ControlKind> {};

/// The line of a log that ends with `value`, without the blanks between label and value.
bool hasLine(const std::string& log, const std::string& label, const std::string& value) {
  std::size_t at = log.find(label + ":");
  for (; at != std::string::npos; at = log.find(label + ":", at + 1)) {
    const std::size_t number = log.find_first_not_of(' ', at + label.size() + 1);
    if (log.compare(number, value.size() + 1, value + "\n") == 0) return true;
  }
  return false;
}

/// A pocket of 90 x 70 mm with limits, logged: BSMEAS. The printed log has 69.9500 as least second side, although its
/// program has 69.9; the program counts.
TEST_P(PrintedProgram, MeasuresAndLogsAPocket) {
  Part part(GetParam());
  part.pocket({50.0905, 39.9347}, {90.12, 69.992});
  const Ran ran = part.bench.run("L Z+100 R0 FMAX\n" +
                                 probe(423, {{273, 50},
                                             {274, 40},
                                             {282, 90},
                                             {283, 70},
                                             {261, -5},
                                             {320, 0},
                                             {260, 20},
                                             {301, 0},
                                             {284, 90.15},
                                             {285, 89.95},
                                             {286, 70.1},
                                             {287, 69.9},
                                             {279, 0.15},
                                             {280, 0.1},
                                             {281, 1},
                                             {309, 0},
                                             {330, 0}}) +
                                 "L Z+100 R0 FMAX M2\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.q(180), 1);
  const std::string log = ran.log("TCHPR423.TXT");
  // The two manuals word and lay out the log differently.
  const bool newer = GetParam() == ControlKind::TNC640;
  struct Printed {
    std::string newer, older;
    std::vector<std::string> values;
  };
  for (const Printed& line : std::vector<Printed>{
           {"Center in reference axis", "CENTER IN REF. AXIS", {"50.0000", "50.0905", "0.0905"}},
           {"Center in minor axis", "CENTER IN MINOR AXIS", {"40.0000", "39.9347", "-0.0653"}},
           {"Side length in reference axis", "SIDE LENGTH IN REF. AXIS", {"90.0000", "90.1200", "0.1200"}},
           {"Side length in minor axis", "SIDE LENGTH IN MINOR AXIS", {"70.0000", "69.9920", "-0.0080"}},
           {"Maximum limit for center in reference axis", "MAX. FOR CENTER IN REF. AXIS", {"50.1500"}},
           {"Minimum limit for center in reference axis", "MIN. FOR CENTER IN REF. AXIS", {"49.8500"}},
           {"Maximum limit for center in minor axis", "MAX. FOR CENTER IN MINOR AXIS", {"40.1000"}},
           {"Minimum limit for center in minor axis", "MIN. FOR CENTER IN MINOR AXIS", {"39.9000"}},
           {"Maximum dimension for side length in reference axis", "MAX. IN REFERENCE AXIS", {"90.1500"}},
           {"Minimum dimension for side length in reference axis", "MINIMUM DIMENSION IN REFERENCE AXIS", {"89.9500"}},
           {"Maximum dimension for side length in minor axis", "MAXIMUM SIDE LENGTH IN MINOR AXIS", {"70.1000"}},
           {"Minimum dimension for side length in minor axis", "MINIMUM SIDE LENGTH IN MINOR AXIS", {"69.9000"}},
           {"Measuring height", "MEASURING HEIGHT", {"-5.0000"}}}) {
    const std::string& label = newer ? line.newer : line.older;
    for (const std::string& value : line.values)
      EXPECT_TRUE(hasLine(log, label, value)) << label << ' ' << value << '\n' << log;
  }
  if (newer) return;
  const std::string stars(18, '*');
  EXPECT_TRUE(log.starts_with(std::string(104, '-') + "\n" + stars +
                              " MEASURING LOG FOR PROBING CYCLE 423: RECTANGULAR POCKET MEASURING " + stars +
                              "*\nDATE: "))
      << log;
  for (const char* heading : {"NOML. VALUES:", "GIVEN LIMIT VALUES:", "ACTUAL VALUES:", "DEVIATIONS:",
                              "FURTHER MEASURING RESULTS:", " END OF MEASURING LOG "})
    EXPECT_NE(log.find(heading), std::string::npos) << heading;
}

/// A stud roughed to 81 x 61 mm is measured against 80 x 60, and the finishing size corrected by the deviation: BEAMS.
TEST_P(PrintedProgram, ReworksAStudByWhatWasMeasured) {
  Part part(GetParam());
  part.block({50, 50}, {81.02, 60.97});
  for (const auto& [number, name] : {std::pair(69, "ROUGHER"), std::pair(2, "FINISHER")}) {
    part.bench.knows(number, name, 60, 10);
    simulation::TrueTool mill = idealProbe(60, 10);
    mill.number = number;
    mill.name = name;
    part.bench.setup.world.truth.tools.push_back(mill);
  }
  const Ran ran = part.bench.runBare(
      "TOOL CALL 69 Z\nL Z+100 R0 FMAX\nFN 0: Q1 = +81\nFN 0: Q2 = +61\nCALL LBL 1\nL Z+100 R0 FMAX\n"
      "TOOL CALL 1 Z\n" +
      probe(424, {{273, 50},
                  {274, 50},
                  {282, 80},
                  {283, 60},
                  {261, -5},
                  {320, 0},
                  {260, 30},
                  {301, 0},
                  {284, 0},
                  {285, 0},
                  {286, 0},
                  {287, 0},
                  {279, 0},
                  {280, 0},
                  {281, 0},
                  {309, 0},
                  {330, 0}}) +
      "FN 2: Q1 = +Q1 - +Q164\nFN 2: Q2 = +Q2 - +Q165\nL Z+100 R0 FMAX\nTOOL CALL 2 Z S5000\nCALL LBL 1\n"
      "L Z+100 R0 FMAX M2\n"
      "LBL 1\nCYCL DEF 256 RECTANGULAR STUD\nQ218=+Q1 ;L1\nQ424=+81 ;BLANK\nQ219=+Q2 ;L2\nQ425=+61 ;BLANK\n"
      "Q220=+0 ;RADIUS\nQ368=+0.1 ;LEFT\nQ224=+0 ;ANGLE\nQ367=+0 ;PLACE\nQ207=AUTO ;FEED\nQ351=+1 ;CLIMB\nQ201=-10 "
      ";DEEP\n"
      "Q202=+5 ;STEP\nQ206=+3000 ;FEED\nQ200=+2 ;CLEAR\nQ203=+10 ;TOP\nQ204=20 ;HEIGHT\nQ370=+1 ;OVERLAP\nQ437=+0 "
      ";FROM\n"
      "Q215=+2 ;PART\nQ369=+0 ;LEFT\nQ338=+20 ;STEP\nQ385=AUTO ;FEED\nL X+50 Y+50 R0 FMAX M99\nLBL 0\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(164), 1.02, 1e-6);
  EXPECT_NEAR(ran.q(165), 0.97, 1e-6);
  EXPECT_NEAR(ran.q(1), 79.98, 1e-6);
  EXPECT_NEAR(ran.q(2), 60.03, 1e-6);
  // The stud is milled twice, which the virtual machine skips and says so once.
  EXPECT_EQ(std::ranges::count(ran.outcome.journal.events, control::EventKind::Skipped, &control::EventRecord::kind),
            1);
}

/// The rotary table is turned until the line through two holes lies along X, and shows zero then: CYC401.
TEST_P(PrintedProgram, TurnsTheTableByTwoHoles) {
  Part part(GetParam(), "mill5-table-table");
  const Vector2 first(25.1, 14.9), second(80.05, 35.2);
  part.hole(first, 14);
  part.hole(second, 14);
  const Ran ran = part.printed(probe(
      401, {{268, 25}, {269, 15}, {270, 80}, {271, 35}, {261, -5}, {260, 20}, {307, 0}, {305, 0}, {402, 1}, {337, 1}}));
  ASSERT_TRUE(ran.finished()) << ran.why();
  const auto& machine = part.bench.setup.world.truth.machine;
  const Vector3 along(second.x() - first.x(), second.y() - first.y(), 0);
  const Vector3 turned = machine::baseFromTable(machine, ran.machine->position()).linear() * along.normalized();
  EXPECT_NEAR(std::abs(degrees(std::atan2(turned.y(), turned.x()))), 0, 1e-6);
}

/// The preset in the centre of a segment of a circle of 30 mm and on its top, found at 90 to 225 degrees: CYC413.
TEST_P(PrintedProgram, PresetsASegment) {
  Part part(GetParam());
  part.bench.believedProbe().maximumTravel = 40;  // the top lies 25 mm below where the program expects it
  part.stud({25.15, 24.9}, 30.02, 0.05);
  const Ran ran = part.printed(probe(413, {{321, 25},
                                           {322, 25},
                                           {262, 30},
                                           {325, 90},
                                           {247, 45},
                                           {261, -5},
                                           {320, 2},
                                           {260, 10},
                                           {301, 0},
                                           {305, 0},
                                           {331, 0},
                                           {332, 10},
                                           {303, 0},
                                           {381, 1},
                                           {382, 25},
                                           {383, 25},
                                           {384, 25},
                                           {333, 0}}));
  const Vector3 origin = ran.preset().translation() - Vector3(0, 0, tableHeight);
  EXPECT_TRUE(origin.isApprox(Vector3(25.15, 24.9 - 10, 0.05), 1e-6)) << origin.transpose();
}

/// The top and the centre of a bolt hole circle go into one row, which is activated then: CYC416. Printed is a
/// clearance height of 10 mm for the holes, below the measuring height of 15 and inside the plate; 50 is meant, as for
/// the top.
TEST_P(PrintedProgram, PresetsABoltHoleCircleInARow) {
  Part part(GetParam());
  for (auto& preset : part.bench.setup.beliefs.presets)
    preset.index = 2;
  const double top = 25.1;
  const Vector2 middle(35.2, 34.85);
  for (const double angle : {90, 180, 270})
    part.hole(middle + 25.03 * Vector2(std::cos(radians(angle)), std::sin(radians(angle))), 12, top);
  part.box({2, 2, -15}, {13, 13, top});
  const Ran ran =
      part.printed(probe(417, {{263, 7.5}, {264, 7.5}, {294, 25}, {320, 0}, {260, 50}, {305, 1}, {333, 0}, {303, 1}}) +
                   probe(416, {{273, 35},
                               {274, 35},
                               {262, 50},
                               {291, 90},
                               {292, 180},
                               {293, 270},
                               {261, 15},
                               {260, 50},
                               {305, 1},
                               {331, 0},
                               {332, 0},
                               {303, 1},
                               {381, 0},
                               {382, 0},
                               {383, 0},
                               {384, 0},
                               {333, 0}}) +
                   "CYCL DEF 247 PRESET ~\n  Q339=+1 ;NUMBER\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  const Vector3 origin = ran.preset().translation() - Vector3(0, 0, tableHeight);
  EXPECT_TRUE(origin.isApprox(Vector3(middle.x(), middle.y(), top), 1e-6)) << origin.transpose();
  EXPECT_NEAR(ran.cell("PRESET.PR", "1", "X"), middle.x(), 6e-5);
  EXPECT_NEAR(ran.cell("PRESET.PR", "1", "Z"), tableHeight + top, 6e-5);
}

INSTANTIATE_TEST_SUITE_P(Controls, PrintedProgram, ::testing::Values(ControlKind::TNC640, ControlKind::iTNC530),
                         [](const auto& tested) { return std::string(control::name(tested.param)); });

}  // namespace
}  // namespace probewright::testing_support
