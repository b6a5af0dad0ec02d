#include <gmock/gmock.h>

#include "camera/scenes.hpp"
#include "vision/png.hpp"

/// Cycles 600 and 601 through the front door: reference images, monitoring, what is found and what is not.
namespace probewright::testing_support {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double noError = 1, error = 2, notConfigured = 3, cameraFault = 10;

/// Teaches ten reference images of the bench and keeps them for the runs that follow.
class Taught {
public:
  explicit Taught(CameraBench& bench, int references = 10, const std::string& more = {}) {
    bench.answers({{"601 OS", teach(references, bench.camera()) + more}});
    const Ran ran = bench.run(local(1, references));
    EXPECT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.q(601), noError) << "the last of the reference images shows what they show";
    folder_.keep(ran);
    bench.setup.beliefs.tables = folder_.path();
    bench.setup.world.truth.seed = 77;  // other noise than that of the references
    bench.answer = nullptr;
  }
  const RunFolder& folder() const { return folder_; }

private:
  RunFolder folder_;
};

double stateOf(const CameraBench& bench) {
  const Ran ran = bench.run(local(0, 10));
  EXPECT_TRUE(ran.finished()) << ran.why();
  return ran.q(601);
}

/// The windows in the file of the point that belong to its last image.
std::vector<vision::Window> lastFound(const Ran& ran) {
  const std::string text = ran.log("BENCH.OS.VSC");
  const std::size_t image = text.rfind("[[image]]"), found = text.find("found = [", image);
  std::vector<vision::Window> windows;
  if (found == std::string::npos) return windows;
  std::string numbers = text.substr(found + 9, text.find(']', found) - found - 9);
  std::ranges::replace(numbers, ',', ' ');
  std::istringstream stream(numbers);
  for (vision::Window w; stream >> w.x >> w.y >> w.width >> w.height;)
    windows.push_back(w);
  return windows;
}

TEST(Cycle601, TakesReferencesAndThenMonitorsByItself) {
  CameraBench bench;
  const Taught taught(bench);
  const Ran ran = bench.run(local(1, 10));
  EXPECT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.q(601), noError);
  EXPECT_THAT(ran.screens(), IsEmpty()) << "the cycle runs through without a stop";
  for (const auto& event : ran.outcome.journal.events)
    EXPECT_NE(event.kind, control::EventKind::Stop);
  EXPECT_TRUE(ran.outcome.files.contains("BENCH.OS.0011.PNG")) << "the images of the run before, and this one";
}

TEST(Cycle601, FindsAForgottenClampWhereItLies) {
  CameraBench bench;
  const Taught taught(bench);
  const Vector3 place(-20, 20, plateTop);
  bench.put("forgotten clamp", SolidRole::Fixture, {box({40, 16, 12})}, place, 30);
  const Ran ran = bench.run(local(0, 10));
  EXPECT_EQ(ran.q(601), error);
  const Vector2 pixel = bench.pixel(place + Vector3(0, 0, 6));
  const vision::Window there{static_cast<int>(pixel.x()), static_cast<int>(pixel.y()), 1, 1};
  const auto found = lastFound(ran);
  EXPECT_TRUE(std::ranges::any_of(found, [&](const auto& each) { return vision::overlap(each, there); }))
      << "nothing at " << pixel.transpose();
}

TEST(Cycle601, FindsAChipOfSomePixelsAndNoSmallerOne) {
  CameraBench bench;
  const Taught taught(bench);
  const auto with = [&](double size) {
    CameraBench other = bench;
    other.put("chip", SolidRole::Fixture, {box({size, size * 0.8, size / 3})}, {15, -20, plateTop}, 20);
    other.camera().finishes["chip"] = {0.95, 0.3};
    return stateOf(other);
  };
  EXPECT_EQ(with(9), error) << "6 x 5 pixels";
  EXPECT_EQ(with(0.8), noError) << "half a pixel";
}

TEST(Cycle601, BearsAWeakerLampButNotOneElsewhere) {
  CameraBench bench;
  const Taught taught(bench);
  CameraBench weaker = bench;
  for (Lamp& lamp : weaker.camera().lamps)
    lamp.brightness *= 0.85;
  weaker.camera().ambient *= 0.85;
  EXPECT_EQ(stateOf(weaker), noError);
  CameraBench moved = bench;
  moved.camera().lamps[0].position = {300, 250, -300};
  EXPECT_EQ(stateOf(moved), error) << "the shadows lie elsewhere";
  CameraBench dead = bench;
  dead.camera().lamps[0].brightness = 0;
  EXPECT_EQ(stateOf(dead), error);
}

TEST(Cycle601, FindsAPartThatIsShiftedOrTurned) {
  CameraBench bench;
  const Taught taught(bench);
  const auto shifted = [&](double x) {
    CameraBench other = bench;
    other.solid("plate").tableFromSolid = translation({x, 0, tableSurface});
    return stateOf(other);
  };
  EXPECT_EQ(shifted(0.15), noError) << "a tenth of a pixel";
  EXPECT_EQ(shifted(4), error);
  CameraBench turned = bench;
  turned.solid("plate").tableFromSolid = translation({0, 0, tableSurface}) * rotation(Vector3::UnitZ(), 180);
  const Ran ran = turned.run(local(0, 10));
  EXPECT_EQ(ran.q(601), error) << "the hole is at the lower left instead of the upper right";
}

TEST(Cycle601, LooksWithinItsAreasOnly) {
  CameraBench bench;
  const Vector2 from = bench.pixel({-60, 40, plateTop}), to = bench.pixel({0, -40, plateTop});
  RunFolder folder;
  const std::string area =
      fmt::format("DRAW AREA {:.0f} {:.0f} {:.0f} {:.0f}", from.x(), from.y(), to.x() - from.x(), to.y() - from.y());
  bench.answers({{"601 OS", "REFERENCE IMAGE; CONFIGURE; " + area + "; SAVE AND BACK; REPEAT; REFERENCE IMAGE"}});
  folder.keep(bench.run(local(1, 2)));
  bench.setup.beliefs.tables = folder.path();
  const auto with = [&](double x) {
    CameraBench other = bench;
    other.put("chip", SolidRole::Fixture, {box({15, 15, 8})}, {x, -15, plateTop});
    return other.run(local(0, 2)).q(601);
  };
  EXPECT_EQ(with(-30), error);
  EXPECT_EQ(with(35), noError);
}

TEST(Cycle601, StopsAndShowsTheImageWithQ309) {
  CameraBench bench;
  const Taught taught(bench);
  bench.put("forgotten clamp", SolidRole::Fixture, {box({40, 16, 12})}, {-20, 20, plateTop});
  const Ran shown = bench.run(local(1, 10) + "Q1=1\n");
  EXPECT_EQ(shown.q(601), error);
  EXPECT_EQ(shown.q(1), 1) << "NC start goes on";
  EXPECT_THAT(shown.screens(), Contains(HasSubstr("deviates from the reference images")));
  EXPECT_TRUE(vision::fromPng(shown.log("BENCH.OS.SCREEN.PNG"), "screen"));
  bench.onStop = control::OnStop::Abort;
  const Ran aborted = bench.run(local(1, 10) + "Q1=1\n");
  EXPECT_EQ(aborted.outcome.result.end, execution::RunEnd::Cancelled);
  EXPECT_EQ(aborted.q(1), 0);
  EXPECT_EQ(aborted.q(601), error);
  const Ran unseen = bench.run(local(0, 10) + "Q1=1\n");
  EXPECT_EQ(unseen.q(1), 1) << "Q309 = 0 does not stop";
  EXPECT_FALSE(unseen.outcome.files.contains("BENCH.OS.SCREEN.PNG"));
}

TEST(Cycle601, SaysThreeWhileAreasOrReferencesAreMissing) {
  CameraBench bench;
  EXPECT_EQ(bench.run(local(0, 2)).q(601), notConfigured);
  EXPECT_EQ(bench.run(local(0, 0)).q(601), notConfigured) << "nothing to compare with";
  bench.answers({{"601 OS", "REFERENCE IMAGE; BACK"}});
  const Ran without = bench.run(local(1, 1));
  EXPECT_EQ(without.q(601), notConfigured) << "no area";
  EXPECT_THAT(without.screens(), Contains(HasSubstr("No reference image is available")));
  bench.answers({{"601 OS", "REFERENCE IMAGE; CONFIGURE; DRAW AREA 5 5 100 80; SAVE AND BACK; BACK"}});
  EXPECT_EQ(bench.run(local(1, 2)).q(601), notConfigured) << "one of two references";
  EXPECT_EQ(bench.run(local(1, 1)).q(601), noError);
}

/// An error that the program does not stop at is one all the same; what is not monitored is neither good nor bad.
TEST(Cycle601, JudgesTheWorkingSpace) {
  using control::Verdict;
  const auto ends = [](const Ran& ran, double state, Verdict verdict, records::ExitState exit) {
    EXPECT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.q(601), state);
    const control::CycleRecord& cycle = ran.outcome.journal.cycles.back();
    EXPECT_EQ(cycle.verdict, verdict);
    EXPECT_EQ(cycle.results.back().verdict, verdict);
    EXPECT_EQ(ran.outcome.info.exit, exit);
  };
  CameraBench bench;
  ends(bench.run(local(0, 10)), notConfigured, Verdict::None, records::ExitState::Good);
  const Taught taught(bench);
  ends(bench.run(local(0, 10)), noError, Verdict::Good, records::ExitState::Good);
  CameraBench failing = bench;
  failing.camera().fault = camera::CameraFault::NoSignal;
  ends(failing.run(local(0, 10)), cameraFault, Verdict::None, records::ExitState::Good);
  bench.put("forgotten clamp", SolidRole::Fixture, {box({40, 16, 12})}, {-20, 20, plateTop});
  ends(bench.run(local(0, 10)), error, Verdict::Rework, records::ExitState::OutOfTolerance);
}

/// Whoever expects reference images must see that there are none.
TEST(Cycle601, SaysThatAMonitoringPointIsNew) {
  const auto saysSo = [](const Ran& ran, const std::string& cycle = "601") {
    return std::ranges::any_of(ran.outcome.journal.events, [&](const control::EventRecord& event) {
      return event.kind == control::EventKind::Warning &&
             event.text == cycle + " OS: there is no monitoring file BENCH.OS.VSC: this image begins a new one";
    });
  };
  CameraBench bench;
  EXPECT_TRUE(saysSo(bench.run(local(0, 10))));
  EXPECT_TRUE(saysSo(bench.run(global(0, 10)), "600"));
  const Taught taught(bench);
  EXPECT_FALSE(saysSo(bench.run(local(0, 10))));
  std::filesystem::remove(taught.folder().path() / "BENCH.OS.VSC");
  EXPECT_TRUE(saysSo(bench.run(local(0, 10))));
  std::filesystem::create_directory(taught.folder().path() / "BENCH.OS.VSC");
  EXPECT_THAT(bench.run(local(0, 10)).why(), HasSubstr("has the name of a table, but it is a folder"));
}

TEST(Cycle601, TellsTheOperatorWhatIsMissing) {
  CameraBench bench;
  std::vector<std::string> asked;
  bench.answer = [&](const std::string& question) -> std::optional<std::string> {
    asked.push_back(question);
    if (asked.size() == 1) return "REFERENCE IMAGE";
    if (asked.size() == 2) return "CONFIGURE; DRAW AREA 5 5 100 80; SAVE AND BACK";
    return "REFERENCE IMAGE";
  };
  const Ran ran = bench.run(local(1, 2) + local(1, 2) + local(1, 2) + local(1, 2));
  EXPECT_TRUE(ran.finished()) << ran.why();
  EXPECT_THAT(asked, ElementsAre("601 OS", "601 OS", "601 OS")) << "the fourth call runs through";
  EXPECT_THAT(ran.screens(), ElementsAre(HasSubstr("No reference image"), HasSubstr("Draw areas!"),
                                         HasSubstr("Too few reference images")));
  EXPECT_THAT(ran.screens()[2], HasSubstr("reference images: 1 of 2"));
  EXPECT_EQ(ran.q(601), noError);
  bench.language = control::DialogLanguage::Swedish;
  asked.clear();
  EXPECT_THAT(bench.run(local(1, 2) + local(1, 2)).screens()[1], HasSubstr("Rita områden!"));
}

TEST(Cycle601, MarksAnImageAsOneThingOnly) {
  CameraBench bench;
  bench.answers({{"601 OS",
                  "REFERENCE IMAGE; ERROR IMAGE; REPEAT; ERROR IMAGE; REFERENCE IMAGE; REPEAT; "
                  "ERROR IMAGE; ERROR IMAGE"}});
  const Ran ran = bench.run(local(1, 9));
  const std::string file = ran.log("BENCH.OS.VSC");
  EXPECT_THAT(file, HasSubstr("number = 1\nkind = \"reference\""));
  EXPECT_THAT(file, HasSubstr("number = 2\nkind = \"error\""));
  EXPECT_THAT(file, HasSubstr("number = 3\nkind = \"plain\"")) << "pressed again, the mark goes";
  int inactive = 0;
  for (const auto& event : ran.outcome.journal.events)
    inactive += event.text.find("is inactive") != std::string::npos ? 1 : 0;
  EXPECT_EQ(inactive, 2);
}

/// What the reference images show is no error; when one of them is none any more, the others are compared anew.
TEST(Cycle601, ComparesAnewWhenAReferenceImageGoesOrComes) {
  CameraBench bench;
  const Taught taught(bench);
  bench.put("forgotten clamp", SolidRole::Fixture, {box({40, 16, 12})}, {-20, 20, plateTop});
  const auto operated = [&](const std::string& question, const std::string& keys, int references = 10) {
    bench.answers({{question, keys}});
    Ran ran = bench.run(local(1, references));
    EXPECT_TRUE(ran.finished()) << ran.why();
    return ran;
  };
  EXPECT_THAT(lastFound(operated("601 OS error", "BACK")), Not(IsEmpty()));
  const Ran more = operated("601 OS error", "REFERENCE IMAGE; REPEAT; BACK");
  EXPECT_THAT(lastFound(more), IsEmpty()) << "it has come";
  RunFolder folder;
  folder.keep(more);
  bench.setup.beliefs.tables = folder.path();
  EXPECT_THAT(lastFound(operated("601 OS", "BACK", 12)), IsEmpty());
  EXPECT_THAT(lastFound(operated("601 OS", "SELECT IMAGE 11; REFERENCE IMAGE; BACK", 12)), Not(IsEmpty()))
      << "its mark is gone";
  EXPECT_THAT(lastFound(operated("601 OS", "SELECT IMAGE 11; DELETE IMAGE; BACK", 12)), Not(IsEmpty())) << "it is gone";
  EXPECT_THAT(lastFound(operated("601 OS", "SELECT IMAGE 12; DELETE IMAGE; BACK", 12)), IsEmpty()) << "another is gone";
}

TEST(Cycle601, KeepsNewSettingsOnlyWhenTheyAreConfirmed) {
  CameraBench bench;
  const Taught taught(bench);
  bench.put("forgotten clamp", SolidRole::Fixture, {box({40, 16, 12})}, {-20, 20, plateTop});
  const std::string smaller = "ERROR IMAGE; CONFIGURE; DELETE AREA 1; DRAW AREA 100 90 20 20; SAVE AND BACK";
  const auto areas = [&](const std::string& keys) {
    bench.answers({{"601 OS error", keys}});
    const Ran ran = bench.run(local(1, 10));
    EXPECT_TRUE(ran.finished()) << ran.why();
    const std::string file = ran.log("BENCH.OS.VSC");
    return std::pair(file.substr(file.find("areas"), file.find('\n', file.find("areas")) - file.find("areas")),
                     ran.q(601));
  };
  EXPECT_EQ(areas(smaller + "; BACK"), std::pair(std::string("areas = [2, 2, 156, 116]"), error));
  EXPECT_EQ(areas(smaller + "; CONFIRM; BACK"), std::pair(std::string("areas = [100, 90, 20, 20]"), noError))
      << "less sensitive: the clamp is found no longer";
  EXPECT_EQ(areas("CONFIGURE; DELETE AREA 1; DISCARD AND BACK").first, "areas = [2, 2, 156, 116]");
  EXPECT_EQ(areas("CONFIGURE; DELETE AREA 1").first, "areas = [2, 2, 156, 116]") << "not saved";
}

TEST(Cycle601, TestsSettingsBeforeTheyCount) {
  CameraBench bench;
  const Taught taught(bench);
  bench.put("forgotten clamp", SolidRole::Fixture, {box({40, 16, 12})}, {-20, 20, plateTop});
  bench.answers({{"601 OS error",
                  "CONFIGURE; SHOW AREAS; SHOW AVERAGE; DELETE AREA 1; DRAW AREA 100 90 20 20; TEST IMAGE; TEST ALL; "
                  "DISCARD AND BACK"}});
  const Ran ran = bench.run(local(1, 10));
  EXPECT_THAT(ran.screens(), Contains(HasSubstr("Monitoring area 1: 2 2 156 116")));
  EXPECT_THAT(ran.screens(),
              Contains(HasSubstr("Image 11: 0 errors; errors stored with the image are found no longer")));
  EXPECT_THAT(ran.screens(), Contains(HasSubstr("Image 3: 0 errors; no change")));
  EXPECT_TRUE(vision::fromPng(ran.log("BENCH.OS.AVERAGE.PNG"), "average"));
}

TEST(Cycle601, ForgetsTheOldestPlainImages) {
  CameraBench bench;
  std::string keys = "REFERENCE IMAGE";
  for (int i = 0; i < 25; ++i)
    keys += "; REPEAT";
  bench.answers({{"601 OS", keys}});
  const Ran ran = bench.run(local(1, 9));
  int pictures = 0;
  for (const auto& [name, bytes] : ran.outcome.files)
    pictures += name.starts_with("BENCH.OS.00") ? 1 : 0;
  EXPECT_EQ(pictures, 1 + 20);
  EXPECT_TRUE(ran.outcome.files.contains("BENCH.OS.0001.PNG")) << "the reference stays";
  EXPECT_FALSE(ran.outcome.files.contains("BENCH.OS.0002.PNG"));
  EXPECT_TRUE(ran.outcome.files.contains("BENCH.OS.0026.PNG"));
}

TEST(Cycle601, LeavesTheCoverOpenForAnotherImage) {
  CameraBench bench;
  const Ran open = bench.run(local(0, 1, 1));
  EXPECT_TRUE(open.machine->camera()->coverOpen());
  const Ran closed = bench.run(local(0, 1, 1) + "L X+50 R0 FMAX\n" + local(0, 1, 0, "SIDE"));
  EXPECT_FALSE(closed.machine->camera()->coverOpen());
  EXPECT_TRUE(closed.outcome.files.contains("BENCH.OS.VSC") && closed.outcome.files.contains("BENCH.SIDE.VSC"));
  EXPECT_NE(closed.log("BENCH.OS.0001.PNG"), closed.log("BENCH.SIDE.0001.PNG")) << "from another place";
}

TEST(Cycle601, KeepsEachProgramsPointsApart) {
  CameraBench bench;
  const Taught taught(bench);
  bench.program = "OTHER.H";
  const Ran ran = bench.run(local(0, 10));
  EXPECT_EQ(ran.q(601), notConfigured);
  EXPECT_TRUE(ran.outcome.files.contains("OTHER.OS.VSC"));
  EXPECT_TRUE(ran.outcome.files.contains("BENCH.OS.0010.PNG")) << "those of other programs are carried on";
}

TEST(Cycle600, GoesToThePositionOfTheBuilder) {
  CameraBench bench;
  bench.setup.world.truth.start[0] = 120;
  bench.setup.world.truth.start[2] = -380;
  const Ran ran = bench.runBare(global(0, 10, 1000));
  EXPECT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.machine->position()[0], 0, 1e-9);
  EXPECT_NEAR(ran.machine->position()[2], -300, 1e-9);
  EXPECT_FALSE(ran.machine->camera()->coverOpen());
  EXPECT_EQ(ran.q(601), notConfigured);
  // 80 mm up, then 120 mm aside: at 1000 mm/min that takes 12 s.
  EXPECT_NEAR(ran.outcome.info.totalSeconds, 12, 0.2);
}

TEST(Cycle600, ComparesAsCycle601) {
  CameraBench bench;
  RunFolder folder;
  bench.answers({{"600 OS", teach(3, bench.camera())}});
  const Ran ran = bench.run("FUNCTION MODE TURN\n" + global(1, 3));
  EXPECT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.q(601), noError);
  folder.keep(ran);
  bench.setup.beliefs.tables = folder.path();
  EXPECT_EQ(bench.run(global(1, 3)).q(601), noError);
  bench.put("forgotten clamp", SolidRole::Fixture, {box({40, 16, 12})}, {-20, 20, plateTop});
  EXPECT_EQ(bench.run(global(0, 3)).q(601), error);
}

TEST(CameraFaults, GiveTenAndTheReason) {
  for (const auto& [fault, why] : {std::pair(camera::CameraFault::NoSignal, "no signal"),
                                   std::pair(camera::CameraFault::CoverStuck, "cover of the camera does not move")}) {
    CameraBench bench;
    bench.camera().fault = fault;
    for (const int stops : {0, 1}) {
      const Ran ran = bench.run(local(stops, 10) + "Q1=1\n");
      EXPECT_TRUE(ran.finished()) << ran.why();
      EXPECT_EQ(ran.q(601), 10);
      const auto& events = ran.outcome.journal.events;
      EXPECT_TRUE(std::any_of(events.begin(), events.end(),
                              [&, why = why](const auto& event) {
                                const bool stopped = event.kind == control::EventKind::Stop;
                                return event.text.find(why) != std::string::npos && stopped == (stops == 1);
                              }))
          << why << stops;
    }
  }
}

TEST(CameraFaults, IncludeAnotherCameraThanBefore) {
  CameraBench bench;
  const Taught taught(bench);
  bench.camera().width = 200;
  const Ran ran = bench.run(local(0, 10));
  EXPECT_EQ(ran.q(601), 10);
  EXPECT_FALSE(ran.outcome.files.contains("BENCH.OS.0011.PNG"));
}

}  // namespace
}  // namespace probewright::testing_support
