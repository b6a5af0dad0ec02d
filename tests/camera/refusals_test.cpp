#include <gmock/gmock.h>

#include "camera/scenes.hpp"
#include "session/check.hpp"
#include "setup/setup.hpp"

/// Each refusal once: of the cycles, of answers, of stored data, of [camera] in a setup.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(CameraRefusals, OfAMachineWithoutACamera) {
  CameraBench bench;
  bench.setup.camera.reset();
  for (const std::string& block : {local(0, 10), global(0, 10)}) {
    const Ran ran = bench.run(block);
    EXPECT_EQ(ran.alarm(), "Function not enabled");
    EXPECT_THAT(ran.why(), HasSubstr("not prepared for monitoring with a camera (option 136"));
  }
}

TEST(CameraRefusals, OfTheOlderControl) {
  CameraBench bench;
  bench.control = ControlKind::iTNC530;
  for (const std::string& block : {local(0, 10), global(0, 10)})
    EXPECT_THAT(bench.run(block).why(), HasSubstr("iTNC530"));
}

TEST(CameraRefusals, OfAMachineWithoutAPositionForTheWholeWorkingSpace) {
  CameraBench bench;
  bench.camera().overview.reset();
  const Ran ran = bench.run(global(0, 10));
  EXPECT_EQ(ran.alarm(), "Function not enabled");
  EXPECT_THAT(ran.why(), HasSubstr("has fixed no position of the camera"));
  EXPECT_TRUE(bench.run(local(0, 10)).finished());
}

TEST(CameraRefusals, OfAWayThatSomethingBlocks) {
  CameraBench bench;
  bench.put("column", SolidRole::Fixture, {box({60, 60, 200})}, {0, 0, tableSurface});
  (*bench.camera().overview)[2] = -400;
  const Ran ran = bench.run(global(0, 10));
  EXPECT_EQ(ran.outcome.result.end, execution::RunEnd::Alarm);
  EXPECT_THAT(ran.why(), HasSubstr("column"));
}

TEST(CameraRefusals, OfValuesOutOfRange) {
  CameraBench bench;
  const auto refused = [&](const std::string& block, const std::string& part) {
    EXPECT_THAT(bench.run(block).why(), HasSubstr(part)) << block;
  };
  refused(local(0, 201), "Q617");
  refused(local(2, 10), "Q309");
  refused(local(0, 10, 2), "Q613");
  refused(global(0, 10, 0), "Q616");
  // The manual knows a number only: FMAX would go in rapid traverse, FAUTO at the feed of TOOL CALL.
  for (const char* feed : {"FMAX", "FAUTO", "FU1", "FZ1"}) {
    std::string block = global(0, 10, 4711);
    block.replace(block.find("4711"), 4, feed);
    refused(block, "Q616");
    refused(block, "cannot be F");
  }
}

TEST(CameraRefusals, OfNamesThatNoFileCanHave) {
  CameraBench bench;
  const auto refused = [&](const std::string& name, const std::string& part) {
    EXPECT_THAT(bench.run(local(0, 10, 0, name)).why(), HasSubstr(part)) << name;
  };
  refused("A/B", "letters, digits, _ and - only");
  refused("A.B", "letters, digits, _ and - only");
  refused("", "it is empty");
  refused(std::string(33, 'A'), "more than 32 characters");
  EXPECT_THAT(bench.run("TCH PROBE 601 LOCAL ~\n  Q309=+0 ;S ~\n  Q613=+0 ;O ~\n  Q617=+10 ;I\n").why(),
              HasSubstr("QS600"));
  EXPECT_TRUE(bench.run(local(0, 10, 0, "os-1_2")).outcome.files.contains("BENCH.OS-1_2.VSC"));
  EXPECT_TRUE(bench
                  .run("QS5 = \"LEFT\"\nTCH PROBE 601 LOCAL ~\n  QS600=QS5 ;P ~\n  Q309=+0 ;S ~\n  Q613=+0 ;O ~\n"
                       "  Q617=+10 ;I\n")
                  .outcome.files.contains("BENCH.LEFT.VSC"));
}

TEST(CameraRefusals, OfSoftKeysThatThereAreNot) {
  CameraBench bench;
  const auto refused = [&](const std::string& keys, const std::string& alarm, const std::string& part) {
    bench.answers({{"601 OS", keys}});
    const Ran ran = bench.run(local(1, 10));
    EXPECT_EQ(ran.alarm(), alarm) << keys;
    EXPECT_THAT(ran.why(), HasSubstr(part)) << keys;
  };
  for (const char* keys : {"GO ON", "DRAW AREA 1 2 3", "SENSITIVITY", "BACK 3", "DRAW AREA 1.5 2 3 4", "4 BACK"})
    refused(keys, "Soft key unknown", keys);
  refused("CONFIGURE; DRAW AREA 100 100 61 10; SAVE AND BACK", "Window outside the image", "160 x 120");
  refused("CONFIGURE; DRAW ERROR -1 0 5 5; SAVE AND BACK", "Window outside the image", "-1 0 5 5");
}

TEST(CameraRefusals, OfNoSensitivityFromTheLeastToTheMost) {
  CameraBench bench;
  for (const char* sensitivity : {"0.1", "10"}) {
    bench.answers({{"601 OS", fmt::format("CONFIGURE; SENSITIVITY {}; SAVE AND BACK", sensitivity)}});
    const Ran ran = bench.run(local(1, 10));
    EXPECT_TRUE(ran.finished()) << ran.why();
    EXPECT_THAT(ran.log("BENCH.OS.VSC"), HasSubstr(fmt::format("sensitivity = {}", sensitivity)));
  }
}

TEST(CameraRefusals, OfSoftKeysThatAreInactive) {
  CameraBench bench;
  for (const char* keys : {"DRAW AREA 1 2 30 40", "CONFIRM", "SELECT IMAGE 7", "DELETE IMAGE", "CONFIGURE; BACK",
                           "CONFIGURE; SENSITIVITY 20", "CONFIGURE; SENSITIVITY 10.1", "CONFIGURE; SENSITIVITY 0.09",
                           "CONFIGURE; DELETE AREA 1", "CONFIGURE; CONFIGURE"}) {
    bench.answers({{"601 OS", keys}});
    const Ran ran = bench.run(local(1, 10));
    EXPECT_TRUE(ran.finished()) << keys;
    const auto& events = ran.outcome.journal.events;
    EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const auto& event) {
      return event.text.find("inactive") != std::string::npos;
    })) << keys;
  }
}

TEST(CameraRefusals, OfMonitoringDataThatAreDamaged) {
  CameraBench bench;
  RunFolder folder;
  folder.keep(bench.run(local(0, 10)));
  bench.setup.beliefs.tables = folder.path();
  const std::string file = bench.run(local(0, 10)).log("BENCH.OS.VSC");
  const auto refused = [&](const std::string& name, const std::string& bytes, const std::string& part) {
    RunFolder damaged;
    std::filesystem::copy(folder.path(), damaged.path(), std::filesystem::copy_options::recursive);
    damaged.put(name, bytes);
    CameraBench other = bench;
    other.setup.beliefs.tables = damaged.path();
    EXPECT_THAT(other.run(local(0, 10)).why(), HasSubstr(part)) << name;
  };
  refused("BENCH.OS.0001.PNG", "no picture", "cannot be read");
  refused("BENCH.OS.VSC", "program = ", "BENCH.OS.VSC:1");
  refused("BENCH.OS.VSC", "program = \"BENCH\"\npoint = \"OS\"\nareas = [1, 2, 3]\n", "four for each window");
  refused("BENCH.OS.VSC", "program = \"BENCH\"\npoint = \"SO\"\nareas = []\n", "BENCH.SO.VSC");
  refused("BENCH.OS.VSC", "program = \"BENCH\"\npoint = \"OS\"\nsensitivity = 0\n", "sensitivity");
  refused("BENCH.OS.VSC", "program = \"BENCH\"\npoint = \"OS\"\n[[image]]\nnumber = 9\n", "BENCH.OS.0009.PNG");
  refused("BENCH.OS.VSC", "program = \"BENCH\"\npoint = \"OS\"\n[[image]]\nnumber = 1\n[[image]]\nnumber = 1\n",
          "in the order");
}

TEST(CameraRefusals, BeforeTheRun) {
  Diagnostics mistakes;
  const auto check = [](const std::string& name) {
    const auto& families = session::knownFamilies();
    auto program = families.entry(language::ProgramLanguage::Klartext)
                       .fromText("A.H", "BEGIN PGM A MM\n" + local(0, 10, 0, name) + "END PGM A MM\n");
    return session::checkProgram(*program, ControlKind::TNC640);
  };
  EXPECT_THAT(check("OS"), IsEmpty());
  ASSERT_FALSE(check("A/B").empty());
  EXPECT_THAT(format(check("A/B").front()), HasSubstr("letters, digits, _ and - only"));
}

Diagnostics mistakesIn(const std::string& camera) {
  Diagnostics mistakes;
  setup::parseSetup("[camera]\n" + camera, "s.toml", mistakes);
  return mistakes;
}

TEST(CameraSetup, IsReadAsItIsWritten) {
  Diagnostics mistakes;
  const auto setup = setup::parseSetup(R"([camera]
position = [1, 2, 3]
direction = [0, 3, -4]
up = [1, 0, 0]
resolution = [64, 48]
field_of_view = 33
distortion = [-0.1, 0.02, 0.003, -0.004]
noise = 2.5
ambient = 0.4
flicker = 0.01
fault = "no signal"
overview = { X = 5, Z = -100 }
[[camera.lamp]]
position = [7, 8, 9]
on = "spindle"
brightness = 0.6
[[camera.surface]]
solid = "table"
reflectance = 0.2
gloss = 0.3
)",
                                       "s.toml", mistakes);
  ASSERT_TRUE(setup) << format(mistakes.front());
  const camera::TrueCamera& camera = *setup->camera;
  EXPECT_EQ(camera.position, Vector3(1, 2, 3));
  EXPECT_TRUE(camera.direction.isApprox(Vector3(0, 0.6, -0.8)));
  EXPECT_EQ(camera.up, Vector3(1, 0, 0));
  EXPECT_EQ(camera.width, 64);
  EXPECT_EQ(camera.height, 48);
  EXPECT_EQ(camera.fieldOfView, 33);
  EXPECT_EQ(camera.distortion[3], -0.004);
  EXPECT_EQ(camera.noise, 2.5);
  EXPECT_EQ(camera.ambient, 0.4);
  EXPECT_EQ(camera.flicker, 0.01);
  EXPECT_EQ(camera.fault, camera::CameraFault::NoSignal);
  ASSERT_TRUE(camera.overview);
  EXPECT_EQ((*camera.overview)[0], 5);
  EXPECT_EQ((*camera.overview)[2], -100);
  ASSERT_EQ(camera.lamps.size(), 1U);
  EXPECT_EQ(camera.lamps[0].on, Mounted::Spindle);
  EXPECT_EQ(camera.lamps[0].brightness, 0.6);
  EXPECT_EQ(camera.finishes.at("table").gloss, 0.3);
}

TEST(CameraSetup, RefusesWhatIsWrong) {
  const auto refused = [](const std::string& keys, const std::string& part) {
    const Diagnostics mistakes = mistakesIn(keys);
    ASSERT_FALSE(mistakes.empty()) << keys;
    EXPECT_THAT(format(mistakes.front()), HasSubstr(part)) << keys;
  };
  refused("direction = [0, 0, 0]", "a direction cannot be [0, 0, 0]");
  refused("up = [0, 0, 1]", "lies along the direction");
  refused("resolution = [64.5, 48]", "two whole numbers");
  refused("resolution = [4, 48]", "resolution");
  refused("field_of_view = 0", "field_of_view");
  refused("fault = \"old\"", "fault");
  refused("overview = { Q = 1 }", "Q");
  refused("overview = { X = 1000 }", "X");
  refused("[[camera.lamp]]\nbrightness = 1", "position");
  refused("[[camera.surface]]\nsolid = \"vice\"", "there is nothing called \"vice\"");
  refused("[[camera.surface]]\nsolid = \"table\"\n[[camera.surface]]\nsolid = \"table\"", "described twice");
}

}  // namespace
}  // namespace probewright::testing_support
