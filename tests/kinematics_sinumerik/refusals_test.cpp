#include <gmock/gmock.h>

#include "control/alarm.hpp"
#include "kinematics_sinumerik/scene.hpp"
#include "language/sinumerik/check.hpp"

/// What CYCLE996 refuses, and that nothing is entered then.
namespace probewright {
namespace {

using namespace testing_support;
using ::testing::HasSubstr;

constexpr double calculate = 1000, atOnce = 10;

/// A measured table/table machine; nothing is calculated yet.
class KinematicsRefusals : public testing::Test {
protected:
  KinematicsScene measured(double position = 0.4) {
    Planter plant(99601);
    simulation::Truth truth = perfectWorld(tableTable.machine);
    plantAxisErrors(truth, plant, position);
    return {tableTable, truth};
  }

  /// The call ends with this alarm, its text tells `detail`, and the data set is what it was.
  static void refused(KinematicsScene& scene, const char* code, const NamedNumbers& call, const std::string& detail,
                      const std::string& before = {}) {
    const Vector3 i2 = scene.datum(4), i4 = scene.datum(18);
    const auto result = scene.bench.tryRun("CYCLE996", call, {}, before);
    ASSERT_FALSE(result.diagnostics.empty()) << detail;
    EXPECT_EQ(result.diagnostics[0].code, code) << result.diagnostics[0].message;
    EXPECT_THAT(result.diagnostics[0].message, HasSubstr(detail));
    EXPECT_FALSE(result.diagnostics[0].advice.empty());
    if (!scene.bench.control.journal.cycles.empty()) {
      EXPECT_EQ(scene.bench.ovi(9), std::stoi(code));
    }
    EXPECT_EQ(scene.datum(4), i2);
    EXPECT_EQ(scene.datum(18), i4);
    coverage::note(SinumerikBench::controlKind, "CYCLE996", "refusals");
  }

  static NamedNumbers evaluation(const NamedNumbers& more = {}) {
    return with({{"S_MVAR", calculate}, {"S_TC", 1}, {"_AMODE", atOnce}}, more);
  }
};

TEST_F(KinematicsRefusals, WrongVariants) {
  KinematicsScene scene = measured();
  for (const double code : {1.0, 30001.0, 101001.0, 110001.0, 4.0, 10004.0, 10301.0, 2000.0, 11000.0, 21000.0, 100.0,
                            31100.0, 410001.0, 20000000.0})
    refused(scene, "61307", with(scene.call(0, 0), {{"S_MVAR", code}}), "S_MVAR", scene.placeFor(0, 0));
}

TEST_F(KinematicsRefusals, DataSetsThatAreNotThere) {
  KinematicsScene scene = measured();
  refused(scene, "61319", with(scene.call(0, 0), {{"S_TC", 0}}), "S_TC = 0", scene.placeFor(0, 0));
  refused(scene, "61319", evaluation({{"S_TC", 2}}), "$TC_CARR23[2]");
  scene.bench.set("$MN_MM_NUM_TOOL_CARRIER", {}, 1);
  refused(scene, "61319", evaluation({{"S_TC", 2}}), "MD 18088");
  refused(scene, "61319", with(scene.call(0, 0), {{"S_SETV", 0}}), "S_SETV", scene.placeFor(0, 0));
  refused(scene, "61319", evaluation({{"S_TNVL", 61}}), "S_TNVL");
  refused(scene, "61319", evaluation({{"_AMODE", 2}}), "_AMODE");
}

TEST_F(KinematicsRefusals, AnAxisThatTheDataSetDoesNotHave) {
  KinematicsScene scene(oneAxis, perfectWorld(oneAxis.machine));
  NamedNumbers call = scene.call(0, 0);
  refused(scene, "61307", with(call, {{"S_MVAR", 20101}}), "no rotary axis 2", scene.placeFor(0, 0));
}

TEST_F(KinematicsRefusals, MeasurementsThatAreMissing) {
  KinematicsScene scene = measured();
  refused(scene, "61430", scene.call(0, 1), "measurement 1 of rotary axis 1 is missing", scene.placeFor(0, 1));
  refused(scene, "61430", evaluation(), "0 of the three measurements of rotary axis 1 are there");
  scene.measure(0);
  EXPECT_EQ(scene.bench.ovr(40), 3);
  refused(scene, "61430", evaluation(), "0 of the three measurements of rotary axis 2 are there");
  refused(scene, "61430", scene.call(1, 2), "measurement 2 of rotary axis 2 is missing", scene.placeFor(1, 2));
  // The first measurement of an axis begins anew.
  scene.bench.run("CYCLE996", scene.call(0, 0), {}, scene.placeFor(0, 0));
  EXPECT_EQ(scene.bench.ovr(40), 1);
  EXPECT_EQ(scene.bench.ovr(44), 0);
  refused(scene, "61430", evaluation(), "1 of the three measurements of rotary axis 1 is there");
}

TEST_F(KinematicsRefusals, PlacesThatTellNoAxis) {
  KinematicsScene scene = measured();
  scene.measureAll();
  // By the inscribed angle the least angle of the triangle is half of the least step: 25 degrees of 0, 50, -50.
  refused(scene, "61430", evaluation({{"S_TNVL", 25.5}}), "rotary axis 1 has an angle of 25.0");
  scene.bench.run("CYCLE996", evaluation({{"S_TNVL", 24.5}}));
  // The ball in one place thrice: the probe is brought to the same posture.
  for (int i = 0; i < 3; ++i)
    scene.bench.run("CYCLE996", scene.call(0, i == 2 ? 1 : i), {}, scene.placeFor(0, 0));
  refused(scene, "61430", scene.call(0, 2), "lie on one line: the positions of the axis were 0, 0 and 0 degrees",
          scene.placeFor(0, 0));
}

TEST_F(KinematicsRefusals, NormalisationAcrossTheAxis) {
  KinematicsScene scene = measured();
  scene.measureAll();
  refused(scene, "61430", evaluation({{"S_MVAR", 301000}}), "cannot be normalised");
}

TEST_F(KinematicsRefusals, Tolerances) {
  KinematicsScene scene = measured();
  scene.measureAll();
  refused(scene, "61430", evaluation({{"_AMODE", 11}, {"S_SETV4", 0.01}, {"S_SETV5", 1}}), "I2 differs by");
  refused(scene, "61430", evaluation({{"_AMODE", 11}, {"S_SETV4", 1000}, {"S_SETV5", 0.0001}}), "V1 differs by");
  // What was calculated is there to be looked at.
  EXPECT_GT((scene.found(4) - scene.datum(4)).norm(), 0.01);
  scene.bench.run("CYCLE996", evaluation({{"_AMODE", 11}, {"S_SETV4", 1000}, {"S_SETV5", 1}}));
}

TEST_F(KinematicsRefusals, TheProbeAndTheBall) {
  KinematicsScene scene = measured();
  refused(scene, "61303", with(scene.call(0, 0), {{"S_TSA", 0.5}}), "Safe area", scene.approach(0, 0, 4));
  refused(scene, "61301", with(scene.call(0, 0), {{"S_FA", 1}}), "does not switch", scene.approach(0, 0, 30));
  refused(scene, "61308", with(scene.call(0, 0), {{"S_FA", 0}}), "DFA", scene.placeFor(0, 0));
  refused(scene, "61313", with(scene.call(0, 0), {{"S_PRNUM", 13}}), "", scene.placeFor(0, 0));
  refused(scene, "61341", with(scene.call(0, 0), {{"S_PRNUM", 2}}), "not calibrated", scene.placeFor(0, 0));
  refused(scene, "61311", scene.call(0, 0), "D number", scene.placeFor(0, 0) + "D0\n");
  scene.bench.set("$TC_DP1", {1, 1}, 120);
  refused(scene, "61309", scene.call(0, 0), "probe", scene.placeFor(0, 0));
  scene.bench.set("$TC_DP1", {1, 1}, 710);
  // A wrong ball is told by its diameter.
  refused(scene, "61303", with(scene.call(0, 0), {{"S_SETV", 24}, {"S_TSA", 0.6}}), "difference 0.98",
          scene.approach(0, 0, 3.5));
}

/// What the other measuring cycles refuse, and ranges that only the run knows.
TEST_F(KinematicsRefusals, WhatEveryCycleRefuses) {
  const auto refusedCall = [&](const char* code, const NamedNumbers& more, const std::string& before = {}) {
    SCOPED_TRACE(code + before);
    KinematicsScene fresh = measured();
    refused(fresh, code, with(fresh.call(0, 0), more), "", fresh.placeFor(0, 0) + before);
  };
  refusedCall("61300", {}, "G41\n");
  refusedCall("61310", {}, "SCALE X2\n");
  refusedCall("61319", {{"S_NMSP", 10}});
  refusedCall("61319", {{"_DMODE", 4}});
  refusedCall("61319", {{"S_STA1", 400}});
  refusedCall("61319", {{"S_STA1", -1}});
  KinematicsScene scene = measured();
  scene.measureAll();
  refused(scene, "61319", evaluation({{"S_TNVL", 0.5}}), "S_TNVL");
  refused(scene, "61319", evaluation({{"S_TNVL", -20}}), "S_TNVL");
  refused(scene, "61319", evaluation({{"_DMODE", 4}}), "_DMODE");
  // A ball beside the one that is meant.
  simulation::Truth crowded = perfectWorld(tableTable.machine);
  place(crowded, simulation::SolidSphere(Vector3::Zero(), 12.5), translation(tableTable.ball + Vector3(28, 0, 0)),
        "other", simulation::SolidRole::Sphere);
  KinematicsScene beside(tableTable, crowded);
  refused(beside, "61302", beside.call(0, 0), "", beside.placeFor(0, 0));
  simulation::Truth truth = perfectWorld(tableTable.machine);
  truth.machine.spindleOrients = false;
  KinematicsScene stiff(tableTable, truth);
  refused(stiff, "61372", stiff.call(0, 0, 2), "", stiff.placeFor(0, 0));
}

/// What is wrong with a call is known before it runs; the calculation needs no measuring path.
TEST(KinematicsCheck, NamesCallsThatCannotBeMeant) {
  const auto said = [](const std::string& call) {
    const auto program = language::sinumerik::SinumerikProgram::fromText("C.MPF", call + "\nM30\n");
    const Diagnostics found = language::sinumerik::check(*program);
    coverage::note(SinumerikBench::controlKind, "CYCLE996", "parsed");
    return found.empty() ? std::string() : found.front().message;
  };
  EXPECT_EQ(said("CYCLE996(10101,1,1,25,0,,,,,,,,3,4,1,,1,)"), "");
  EXPECT_EQ(said("CYCLE996(13001000,1,,,,,,,,0.02,0.001,22,,,,,1,11)"), "");
  EXPECT_THAT(said("CYCLE996(1,1,1,25,0,,,,,,,,3,4)"), HasSubstr("the rotary axis"));
  EXPECT_THAT(said("CYCLE996(10101,1,1,25)"), HasSubstr("S_FA"));
  EXPECT_THAT(said("CYCLE996(10101,1,1,0,0,,,,,,,,3,4)"), HasSubstr("S_SETV"));
  EXPECT_THAT(said("CYCLE996(10101,1,1,25,400,,,,,,,,3,4)"), HasSubstr("S_STA1"));
  EXPECT_THAT(said("CYCLE996(1000,1,,,,,,,,,,70)"), HasSubstr("S_TNVL"));
  EXPECT_THAT(said("CYCLE996(1000,1,,,,,,,,,,0.5)"), HasSubstr("between 1 and 60"));
  EXPECT_THAT(said("CYCLE996(1000,1,,,,,,,,,,19)"), HasSubstr("below 20 degrees"));
  EXPECT_EQ(said("CYCLE996(1000,1,,,,,,,,,,0)") + said("CYCLE996(1000,1,,,,,,,,,,20)"), "");
  EXPECT_THAT(said("CYCLE996(1000)"), HasSubstr("S_TC"));
  EXPECT_THAT(said("CYCLE996(1000,1,,,,,,,,,,,,,,,,110)"), HasSubstr("asked all the same"));
  EXPECT_THAT(said("CYCLE996(1000,1,,,,,,,,,,,,,,,,1000)"), HasSubstr("cannot be edited"));
}

TEST_F(KinematicsRefusals, AnOperatorWhoDoesNotAgree) {
  KinematicsScene scene = measured();
  scene.measureAll();
  const Vector3 before = scene.datum(4);
  scene.bench.control.panel.onStop = control::OnStop::Abort;
  const auto result = scene.bench.tryRun("CYCLE996", {{"S_MVAR", calculate}, {"S_TC", 1}});
  EXPECT_EQ(result.end, execution::RunEnd::Cancelled);
  EXPECT_EQ(scene.datum(4), before);
  EXPECT_GT((scene.found(4) - before).norm(), 0.01);
  // At once asks nobody, but only where nothing is shown.
  scene.bench.run("CYCLE996", evaluation());
  EXPECT_EQ(scene.datum(4), scene.found(4));
  EXPECT_EQ(scene.bench.tryRun("CYCLE996", evaluation({{"_AMODE", 110}})).end, execution::RunEnd::Cancelled);
}

}  // namespace
}  // namespace probewright
