#include "cycles_kinematics/sphere_worlds.hpp"
#include "session/check.hpp"
#include "session/source.hpp"

/// Cycle 450: the active kinematics is saved, put back, shown and deleted.
namespace probewright::testing_support {
namespace {

std::string cycle450(int mode, const std::string& record) {
  return fmt::format("TCH PROBE 450 SAVE KINEMATICS ~\n  Q410={} ;MODE ~\n  {} ;MEMORY DESIGNATION\n", mode, record);
}

std::vector<control::heidenhain::SavedKinematics> records(const Ran& ran) {
  coverage::writesRead(ran.outcome.control, ran.outcome.journal,
                       [](const control::WriteRecord& write) { return write.table == "DATA450.KD"; });
  const auto found = ran.outcome.files.find("DATA450.KD");
  if (found == ran.outcome.files.end()) return {};
  Diagnostics diagnostics;
  const auto table = control::heidenhain::TypedTable::parse(found->second, found->first,
                                                            control::heidenhain::savedKinematicColumns(), diagnostics);
  EXPECT_TRUE(table && diagnostics.empty());
  return control::heidenhain::savedKinematicsOf(*table);
}

TEST(Cycle450, PutsBackWhatItSaved) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Dice dice(450);
    SphereWorld world(builds()[0], control);
    world.plant(dice, 0.2, 0);
    world.bench.wallClock = 1'700'000'000;
    // Optimised in between; after restoring, a test measures what it did before.
    const std::string test = probe(451, words451(world.build, 0)), reset = "PLANE RESET STAY\n";
    const Ran plain = world.bench.run(test);
    const Ran ran = world.bench.run(cycle450(0, "Q409=5") + probe(451, words451(world.build, 1)) + reset +
                                    cycle450(1, "Q409=5") + test);
    ASSERT_TRUE(ended(ran)) << ran.why();
    EXPECT_NEAR(ran.q(141), plain.q(141), 1e-9);
    EXPECT_NEAR(ran.q(143), plain.q(143), 1e-9);
    EXPECT_EQ(kinematicsOf(ran, world.built()), Kinematics(world.built()).data());
    ASSERT_EQ(records(ran).size(), 1u);
    EXPECT_EQ(records(ran)[0].name, "5");
    EXPECT_EQ(records(ran)[0].identifier, "AC");
    const bool html = control == ControlKind::TNC640;
    const std::string log = ran.log(html ? "TCHPRAUTO.html" : "TCHPR450.TXT");
    EXPECT_NE(log.find("restore a record"), std::string::npos) << log;
    EXPECT_NE(log.find(html ? "<td>TRANS</td>" : "TRANS"), std::string::npos) << log;
  }
}

TEST(Cycle450, RestoresTheMeanOfAllThatAWildcardFits) {
  SphereWorld world(builds()[1]);
  world.bench.setup.beliefs.kinematics["C"].position = {0.1, 0.2, 0};
  const Ran first = world.bench.run(cycle450(0, "QS409=\"HEAD1\""));
  ASSERT_TRUE(ended(first)) << first.why();
  const TableFolder folder(world.bench);
  folder.put("DATA450.KD", first.outcome.files.at("DATA450.KD"));
  world.bench.setup.beliefs.kinematics["C"].position = {0.3, -0.4, 0};
  const Ran ran =
      world.bench.run(cycle450(0, "QS409=\"HEAD2\"") + cycle450(0, "QS409=\"OTHER\"") + cycle450(1, "QS409=\"HEAD#\""));
  ASSERT_TRUE(ended(ran)) << ran.why();
  const auto data = kinematicsOf(ran, world.built());
  const std::size_t c = *world.built().axisIndex("C");
  for (const machine::RotaryCorrection& axis : data.axes) {
    if (axis.axis != c) continue;
    EXPECT_LT((axis.position - Vector3(0.2, -0.1, 0)).norm(), 1e-8) << axis.position.transpose();
  }
  EXPECT_EQ(records(ran).size(), 3u);
}

TEST(Cycle450, ShowsAndDeletes) {
  SphereWorld world(builds()[1]);
  const Ran ran = world.bench.run(cycle450(0, "QS409=\"HEAD1\"") + cycle450(0, "QS409=\"HEAD2\"") +
                                  cycle450(0, "Q409=947") + cycle450(2, "Q409=0") + cycle450(3, "QS409=\"H*$#\""));
  ASSERT_TRUE(ended(ran)) << ran.why();
  ASSERT_GE(ran.screens().size(), 2u);
  for (const char* name : {"HEAD1", "HEAD2", "947"})
    EXPECT_NE(ran.screens()[0].find(name), std::string::npos) << ran.screens()[0];
  EXPECT_NE(ran.screens()[1].find("Delete 2 records"), std::string::npos);
  ASSERT_EQ(records(ran).size(), 1u);
  EXPECT_EQ(records(ran)[0].name, "947");
  // The operator says no.
  world.bench.onStop = control::OnStop::Abort;
  const Ran stopped = world.bench.run(cycle450(0, "QS409=\"HEAD1\"") + cycle450(3, "QS409=\"H*\""));
  EXPECT_EQ(records(stopped).size(), 1u);
}

TEST(Cycle450, RefusesWhatItCannotDo) {
  SphereWorld world(builds()[1]);
  const auto alarm = [&](const std::string& blocks) { return world.bench.run(blocks).alarm(); };
  EXPECT_EQ(alarm(cycle450(1, "Q409=3")), "Kinematics record not found");
  std::string many;
  for (int i = 0; i < 17; ++i)
    many += cycle450(0, fmt::format("Q409={}", i));
  EXPECT_EQ(alarm(many), "Kinematics memory full");
  EXPECT_NE(world.bench.run(cycle450(0, "QS409=\"HEAD*\"")).why().find("wildcard"), std::string::npos);
  EXPECT_NE(world.bench.run(cycle450(0, "QS409=\"ABCDEFGHIJKLMNOPQ\"")).why().find("more than 16 characters"),
            std::string::npos);
  world.bench.setup.beliefs.parameters["option48"] = {0.0, {}};
  EXPECT_EQ(alarm(cycle450(0, "Q409=3")), "Function not enabled");
  world.bench.setup.beliefs.parameters.clear();
  const TableFolder folder(world.bench);
  folder.put("DATA450.KD", control::heidenhain::emptySavedKinematics(ControlKind::TNC640));
  EXPECT_EQ(alarm(cycle450(0, "Q409=3")), "Kinematics memory empty");
  SphereWorld other(builds()[0]);
  folder.put("DATA450.KD", other.bench.run(cycle450(0, "Q409=3")).outcome.files.at("DATA450.KD"));
  EXPECT_EQ(alarm(cycle450(1, "Q409=3")), "Kinematics not identical");
}

/// What is wrong with the name of a record is said before the program runs, where the cycle uses the name.
TEST(Cycle450, NamesAreChecked) {
  const auto told = [](const std::string& mode, const std::string& record) {
    const auto program = session::programOf(
        "A.H",
        "BEGIN PGM A MM\nTOOL CALL 1 Z\n" +
            fmt::format("TCH PROBE 450 SAVE KINEMATICS ~\n  Q410={} ;MODE ~\n  {} ;MEMORY DESIGNATION\n", mode,
                        record) +
            "END PGM A MM\n",
        language::ProgramLanguage::Klartext);
    const Diagnostics found = session::checkProgram(*program, ControlKind::TNC640);
    return found.empty() ? std::string() : found.front().message;
  };
  const std::string tooLong = "QS409=\"ABCDEFGHIJKLMNOPQ\"";
  for (const char* mode : {"+0", "+1", "+3"})
    EXPECT_NE(told(mode, tooLong).find("more than 16 characters"), std::string::npos)
        << mode << ": " << told(mode, tooLong);
  EXPECT_EQ(told("+2", tooLong), "");
  EXPECT_EQ(told("+Q1", tooLong), "") << "only the running program knows";
  EXPECT_EQ(told("+0", "QS409=\"ABCDEFGHIJKLMNOP\""), "");
  EXPECT_EQ(told("+0", "Q409=5"), "");
}

/// The memory places of the iTNC 530 are kept by the code number with which they were saved.
TEST(Cycle450, KeepsPlacesOfTheOlderControlByTheirCodeNumber) {
  SphereWorld world(builds()[1], ControlKind::iTNC530);
  world.bench.setup.beliefs.parameters["codeNumber"] = {123.0, {}};
  const Ran first = world.bench.run(cycle450(0, "Q409=1"));
  ASSERT_TRUE(ended(first)) << first.why();
  EXPECT_EQ(records(first).at(0).code, 123);
  EXPECT_NE(first.log("TCHPR450.TXT").find("Code number  123"), std::string::npos) << first.log("TCHPR450.TXT");
  const TableFolder folder(world.bench);
  folder.put("DATA450.KD", first.outcome.files.at("DATA450.KD"));
  EXPECT_TRUE(ended(world.bench.run(cycle450(0, "Q409=1"))));
  world.bench.setup.beliefs.parameters["codeNumber"] = {124.0, {}};
  EXPECT_EQ(world.bench.run(cycle450(0, "Q409=1")).alarm(), "Memory place protected");
  EXPECT_NE(world.bench.run(cycle450(3, "Q409=1")).why().find("Q410 0 to 2"), std::string::npos);
  EXPECT_NE(world.bench.run(cycle450(0, "Q409=10")).why().find("0 to 9"), std::string::npos);
}

}  // namespace
}  // namespace probewright::testing_support
