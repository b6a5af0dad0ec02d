#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/program.hpp"

/// Runs on a machine that another program plays: the example of a machine adapter, whose plane the ball of a probe of
/// length 100 meets at Z-400.
namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

const std::string adapter = "python3 examples/adapters/plane.py";

const std::string setup = R"([control]
type = "TNC640"
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 100
ball_radius = 2
[[preset]]
row = 1
origin = [5, 6, -401.5]
active = true
)";

/// Probes the plane from `start` (over the preset) and makes it Z0 of preset 1.
std::string program(const std::string& start, int tool = 1) {
  return "0 BEGIN PGM PLANE MM\n1 TOOL CALL " + std::to_string(tool) + " Z\n2 L X+0 Y+0 Z" + start +
         " R0 FMAX\n"
         "3 TCH PROBE 417 PRESET IN TS AXIS ~\n Q263=+0 ~\n Q264=+0 ~\n Q294=+0 ~\n Q320=+2 ~\n Q260=+20 ~\n Q305=+1 "
         "~\n"
         " Q333=+0 ~\n Q303=+1\n4 L Z+50 R0 FMAX\n5 END PGM PLANE MM\n";
}

Answer runOn(const Folder& folder, const std::string& machine, const std::string& text) {
  return probewright({"run", folder.file("plane.h", text), "--setup", folder.file("setup.toml", setup), "--machine",
                      machine, "--out", (folder / "out").string()});
}

TEST(RealMachine, CorrectsThePresetByWhatTheAdapterTouches) {
  const Folder folder;
  const Answer answer = runOn(folder, adapter, program("+50"));
  ASSERT_EQ(answer.exit, 0) << answer.errors << answer.output;
  EXPECT_THAT(namesIn(folder / "out"), IsSupersetOf({"PRESET.PR", "report.html", "results.json"}));
  const json results = json::parse(textOf(folder / "out/results.json"));
  EXPECT_THAT(results.at("run").dump(), HasSubstr("\"plane\""));
  EXPECT_THAT(results.at("cycles").at(0).at("touches").at(0).at("axes").at("Z"), -300.0);
  EXPECT_THAT(textOf(folder / "out/PRESET.PR"), HasSubstr("+6.0000       -400.0000"));
}

TEST(RealMachine, ASignalOnTheWayIsTheAlarmOfTheControl) {
  const Folder folder;
  const Answer answer = runOn(folder, adapter, program("-5"));
  EXPECT_EQ(answer.exit, 3) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr("Touch probe deflected"));
}

TEST(RealMachine, TheEndOfTheTravelIsTheAlarmOfTheControl) {
  const Folder folder;
  const Answer limit = runOn(folder, adapter, program("+900"));
  EXPECT_EQ(limit.exit, 3);
  EXPECT_THAT(limit.errors, HasSubstr("software limit of Z"));
}

TEST(RealMachine, AnAdapterThatDiesStopsTheProgramWithAnAlarm) {
  const Folder folder;
  // Answers the greeting and the first orders of the example, then is killed at the measuring move.
  const std::string dying = folder.file("dying.py",
                                        "import os, runpy, json\n"
                                        "loads = json.loads\n"
                                        "def watched(text):\n"
                                        "    order = loads(text)\n"
                                        "    if order['do'] == 'measure': os._exit(1)\n"
                                        "    return order\n"
                                        "json.loads = watched\n"
                                        "runpy.run_path('examples/adapters/plane.py', run_name='__main__')\n");
  const Answer answer = runOn(folder, "python3 " + dying, program("+50"));
  EXPECT_EQ(answer.exit, 3) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr("the connection to the machine adapter is lost"));
  EXPECT_THAT(textOf(folder / "out/PRESET.PR"), Not(HasSubstr("-400.0000"))) << "as it was before";
}

TEST(RealMachine, WithoutAnAdapterNothingRuns) {
  const Folder folder;
  const Answer answer = runOn(folder, "no-such-adapter", program("+50"));
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, HasSubstr("the machine adapter no-such-adapter cannot be started"));
  EXPECT_THAT(namesIn(folder / "out"), IsEmpty());
  EXPECT_EQ(probewright({"run", "x.h", "--setup", "y.toml", "--machine", "z", "--seed", "1"}).exit, 2)
      << "nothing is random about a real machine";
}

}  // namespace
}  // namespace probewright::app::testing
