#include "reports/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "records/results.hpp"
#include "reports/sample_scene.hpp"
#include "support/page_data.hpp"

namespace probewright::reports {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

using testing_support::decoded;

json dataOf(const std::string& html) { return json::parse(testing_support::pageData(html)); }

template <class T>
std::vector<T> arrayOf(const json& text) {
  const std::string bytes = decoded(text.get<std::string>());
  std::vector<T> values(bytes.size() / sizeof(T));
  EXPECT_EQ(values.size() * sizeof(T), bytes.size());
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::string sampleHtml() {
  const auto journal = sample::journal();
  return reportHtml(journal, sample::runInfo(), sample::scene(journal));
}

TEST(Report, HoldsTheResultsAndTheProgram) {
  const json data = dataOf(sampleHtml());
  EXPECT_EQ(data["results"], records::resultsJson(sample::journal(), sample::runInfo()));
  ASSERT_EQ(data["programs"].size(), 1U);
  ASSERT_EQ(data["programs"][0]["pieces"].size(), 1U);
  const json& lines = data["programs"][0]["pieces"][0]["lines"];
  EXPECT_EQ(lines[0], "0 BEGIN PGM BEARING_BLOCK MM");
  EXPECT_EQ(lines[sample::lineOf("12 TCH PROBE 421") - 1], "12 TCH PROBE 421 MEASURE HOLE ~");
}

TEST(Report, HoldsTheSceneToTheBit) {
  const auto journal = sample::journal();
  const Scene scene = sample::scene(journal);
  const json data = dataOf(reportHtml(journal, sample::runInfo(), scene))["scene"];
  const json& block = data["meshes"][0];
  const auto positions = arrayOf<float>(block["positions"]);
  ASSERT_EQ(positions.size(), 3 * scene.meshes[0].positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    ASSERT_EQ(positions[i], scene.meshes[0].positions[i / 3][static_cast<Eigen::Index>(i % 3)]);
  EXPECT_EQ(arrayOf<std::uint32_t>(block["triangles"]), scene.meshes[0].triangles);
  const auto normals = arrayOf<std::int8_t>(block["normals"]);
  ASSERT_EQ(normals.size(), 4 * scene.meshes[0].normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (i % 4 == 3) continue;
    const double truth = scene.meshes[0].normals[i / 4][static_cast<Eigen::Index>(i % 4)];
    ASSERT_NEAR(normals[i] / 127.0, truth, 0.5 / 127 + 1e-6);
  }
  const auto kinds = arrayOf<std::uint8_t>(data["path"]["kinds"]);
  ASSERT_EQ(kinds.size() + 1, scene.path.points.size());
  EXPECT_EQ(kinds[0], 0);
  EXPECT_EQ(kinds[2], 2);
  EXPECT_EQ(arrayOf<float>(data["path"]["seconds"]), scene.path.seconds);
  EXPECT_EQ(arrayOf<std::uint32_t>(data["touches"]["indices"]).size(), 30U);
  // Column by column: the shift stands in the last four.
  EXPECT_DOUBLE_EQ(block["pose"][12].get<double>(), 251.437);
  EXPECT_DOUBLE_EQ(block["pose"][1].get<double>(), std::sin(1.5 * std::numbers::pi / 180));
}

TEST(Report, HoldsThePlaceOfACollision) {
  Scene scene;
  scene.collisions = {{{1.5F, -2, 3}, "stylus", "Fixed jaw"}};
  const json data = dataOf(reportHtml({}, {}, scene))["scene"];
  EXPECT_EQ(data["collisions"], json::parse(R"([{"at": [1.5, -2.0, 3.0], "what": "stylus", "solid": "Fixed jaw"}])"));
}

TEST(Report, EncodesArraysOfEveryLength) {
  for (std::size_t length = 0; length < 10; ++length) {
    Scene scene;
    for (std::size_t i = 0; i < length; ++i)
      scene.path.kinds.push_back(i % 2 == 0 ? MoveKind::Measure : MoveKind::Feed);
    const auto kinds = arrayOf<std::uint8_t>(dataOf(reportHtml({}, {}, scene))["scene"]["path"]["kinds"]);
    ASSERT_EQ(kinds.size(), length);
    for (std::size_t i = 0; i < length; ++i)
      EXPECT_EQ(kinds[i], i % 2 == 0 ? 2 : 1);
  }
}

TEST(Report, StandsAloneAndAsksForNothing) {
  const std::string html = sampleHtml();
  EXPECT_THAT(html, Not(HasSubstr("src=\"")));
  EXPECT_THAT(html, Not(HasSubstr("<link")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_GT(html.size(), 400000U) << "the 3D engine is inside";
}

TEST(Report, LetsNoTextBecomeMarkup) {
  const std::string evil = "</script><script>alert(1)</script><!-- <img src=x onerror=alert(2)> & \" ' \\ \xE2\x80\xA8";
  auto journal = sample::journal();
  journal.cycles[0].title = evil;
  const auto changed = [&](control::EventRecord event) {
    event.text = evil;
    return event;
  };
  journal.events = {journal.events[0], changed(journal.events[1])};
  journal.cycles[1].writes[0].after = evil;
  auto run = sample::runInfo();
  run.programs = {{"a/</title><script>x.H", evil + "\n" + evil}};
  run.partName = evil;
  Scene scene = sample::scene(journal);
  scene.meshes[0].name = evil;
  const std::string html = reportHtml(journal, run, scene);
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<!-- <img")));
  EXPECT_THAT(html, Not(HasSubstr("</title><script>")));
  // The page's three scripts-and-data elements and nothing more.
  std::size_t tags = 0;
  for (auto at = html.find("<script"); at != std::string::npos; at = html.find("<script", at + 1))
    ++tags;
  std::size_t inBundle = 0;
  const std::string plain = reportHtml({}, {}, {});
  for (auto at = plain.find("<script"); at != std::string::npos; at = plain.find("<script", at + 1))
    ++inBundle;
  EXPECT_EQ(tags, inBundle);
  const json data = dataOf(html);
  EXPECT_EQ(data["programs"][0]["pieces"][0]["lines"][1], evil);
  EXPECT_EQ(data["results"]["events"][1]["text"], evil);
  EXPECT_EQ(data["scene"]["meshes"][0]["name"], evil);
}

TEST(Report, EndsEveryElementOnce) {
  // The bundle must not hold the end tag of the element it stands in.
  const std::string html = reportHtml({}, {}, {});
  std::size_t ends = 0;
  for (auto at = html.find("</script"); at != std::string::npos; at = html.find("</script", at + 1))
    ++ends;
  EXPECT_EQ(ends, 2U);
  std::size_t styles = 0;
  for (auto at = html.find("</style"); at != std::string::npos; at = html.find("</style", at + 1))
    ++styles;
  EXPECT_EQ(styles, 1U);
}

TEST(Report, ShowsTheSurroundingsOfCyclesInALongProgram) {
  auto run = sample::runInfo();
  run.programs[0].text.clear();
  for (int i = 1; i <= 1000; ++i)
    run.programs[0].text += std::to_string(i) + " L X+" + std::to_string(i) + "\r\n";
  control::Journal journal;
  journal.cycles.resize(2);
  journal.cycles[0].place = {run.programs[0].path, 100, 1};
  journal.cycles[1].place = {run.programs[0].path, 998, 1};
  const json program = dataOf(reportHtml(journal, run, {}, {.longestProgram = 500}))["programs"][0];
  EXPECT_EQ(program["lineCount"], 1000);
  ASSERT_EQ(program["pieces"].size(), 2U);
  EXPECT_EQ(program["pieces"][0]["first"], 90);
  EXPECT_EQ(program["pieces"][0]["lines"].size(), 41U);
  EXPECT_EQ(program["pieces"][0]["lines"][10], "100 L X+100");
  EXPECT_EQ(program["pieces"][1]["first"], 988);
  EXPECT_EQ(program["pieces"][1]["lines"].size(), 13U);
  EXPECT_EQ(dataOf(reportHtml(journal, run, {}, {.longestProgram = 1000}))["programs"][0]["pieces"].size(), 1U);
}

TEST(Report, ReadsProgramsOfOldEditors) {
  auto run = sample::runInfo();
  // "Bohrung prüfen" in CP1252, as a control writes it.
  run.programs[0].text =
      "1 ;Bohrung pr\xFC"
      "fen\n2 ;L\xE4nge und H\xF6he\n";
  control::Journal journal;
  journal.events = {{control::EventKind::Message,
                     {run.programs[0].path, 1, 1},
                     "",
                     "pr\xFC"
                     "fen",
                     0}};
  const json data = dataOf(reportHtml(journal, run, {}));
  EXPECT_EQ(data["programs"][0]["pieces"][0]["lines"][0],
            "1 ;Bohrung pr\xC3\xBC"
            "fen");
  EXPECT_EQ(data["results"]["events"][0]["text"],
            "pr\xC3\xBC"
            "fen");
}

/// A picture of 3 x 2 pixels as a PNG file.
std::string smallPicture() {
  constexpr unsigned char bytes[] = {
      0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00,
      0x03, 0x00, 0x00, 0x00, 0x02, 0x08, 0x00, 0x00, 0x00, 0x00, 0xB8, 0x1F, 0x39, 0xC6, 0x00, 0x00, 0x00, 0x10, 0x49,
      0x44, 0x41, 0x54, 0x78, 0xDA, 0x63, 0xD0, 0x08, 0xA8, 0x60, 0x08, 0xA8, 0x58, 0x00, 0x00, 0x07, 0xD8, 0x02, 0x59,
      0x28, 0xDA, 0xD0, 0xAE, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
  return {bytes, bytes + sizeof bytes};
}

/// A cycle 601 that found two errors.
control::Journal cameraJournal() {
  control::Journal journal;
  journal.cycles.resize(1);
  journal.cycles[0].name = "601";
  journal.cycles[0].title = "LOCAL WORKING SPACE";
  journal.cycles[0].results.push_back(sample::plain("Q601", "state of the monitoring", 2, ""));
  return journal;
}

Scene cameraScene() {
  Scene scene;
  scene.camera = {{.cycle = 0,
                   .point = "PLATE.OS",
                   .number = 11,
                   .references = 10,
                   .errors = 2,
                   .reference = smallPicture(),
                   .taken = smallPicture(),
                   .evaluated = {}}};
  return scene;
}

TEST(Report, HoldsThePicturesOfTheCamera) {
  const json data = dataOf(reportHtml(cameraJournal(), {}, cameraScene()))["scene"]["camera"];
  ASSERT_EQ(data.size(), 1U);
  EXPECT_EQ(data[0]["point"], "PLATE.OS");
  EXPECT_EQ(data[0]["errors"], 2);
  EXPECT_EQ(decoded(data[0]["taken"].get<std::string>()), smallPicture());
  EXPECT_EQ(data[0]["evaluated"], "");
}

/// Cycle 441, whose words in other languages stand in its own file.
control::Journal settingsJournal() {
  control::Journal journal;
  journal.cycles.resize(1);
  journal.cycles[0].name = "441";
  journal.cycles[0].title = "FAST PROBING";
  return journal;
}

TEST(Report, HoldsWhatItsCyclesAloneSay) {
  const json data = dataOf(reportHtml(settingsJournal(), {}, {}));
  EXPECT_EQ(data["phrases"]["FAST PROBING"],
            json({"Schnelles Antasten", "Быстрое измерение", "Snabb avkänning", "快速探测", "Szybkie próbkowanie"}));
  EXPECT_FALSE(dataOf(reportHtml(cameraJournal(), {}, {})).contains("phrases")) << "the page has these";
}

TEST(Report, SaysAlarmsInEachLanguageAndLeavesAProgramsOwnWords) {
  control::Journal journal = settingsJournal();
  journal.cycles[0].alarm = "Touch probe not ready";
  const auto alarm = [](const char* text) {
    return control::EventRecord{control::EventKind::Alarm, {"A.H", 1, 1}, "", text, 0};
  };
  journal.events = {alarm("Circle not determined"), alarm("Ask the foreman")};
  const json words = dataOf(reportHtml(journal, {}, {}))["words"];
  EXPECT_EQ(words["Touch probe not ready"], json({"Tastsystem nicht bereit", "Щуп не готов", "Avkännarsystem ej klart",
                                                  "测头未就绪", "Sonda niegotowa"}));
  EXPECT_EQ(words["Circle not determined"], json({"Kreis nicht bestimmt", "Окружность не определяется",
                                                  "Cirkel ej bestämd", "圆未确定", "Okrąg nieokreślony"}));
  EXPECT_FALSE(words.contains("Ask the foreman"));
}

TEST(Report, HoldsWhatAReplayFollows) {
  records::RunTrace trace;
  trace.files = {"A.H"};
  trace.states.resize(2);
  trace.states[1].tool = "5 PROBE";
  trace.states[1].preset = "3";
  trace.states[1].programFrom = translation({10, 20, -400.5});
  trace.states[1].follows = records::RunTrace::State::Follows::LinearAxes;
  trace.states[1].diameter = true;
  trace.blocks = {{0, 0, 1, 0, {0, 0, 0}, {}}, {1.25, 0, 17, 1, {-12.34567, 0.00004, 1000}, {}}};
  trace.blocks[1].axes[0] = -2.34567;
  trace.blocks[1].axes[1] = 359.99996;
  records::RunInfo run;
  run.axes.resize(2);
  run.axes[0].name = "X";
  run.axes[1].name = "C";
  const json data = dataOf(reportHtml({}, run, {}, {.trace = &trace, .language = "pl"}));
  EXPECT_EQ(data["language"], "pl");
  const json& replay = data["trace"];
  EXPECT_EQ(replay["axes"], json::parse(R"(["X", "C"])"));
  EXPECT_EQ(replay["states"][1]["tool"], "5 PROBE");
  EXPECT_EQ(replay["states"][1]["preset"], "3");
  EXPECT_EQ(replay["states"][1]["frame"][14], -400.5);
  EXPECT_EQ(replay["states"][0]["follows"], "table");
  EXPECT_EQ(replay["states"][0]["diameter"], false);
  EXPECT_EQ(replay["states"][1]["follows"], "axes");
  EXPECT_EQ(replay["states"][1]["diameter"], true);
  EXPECT_EQ(arrayOf<float>(replay["seconds"]), (std::vector<float>{0, 1.25}));
  EXPECT_EQ(arrayOf<std::uint32_t>(replay["places"]), (std::vector<std::uint32_t>{0, 1, 0, 0, 17, 1}));
  EXPECT_EQ(arrayOf<std::int32_t>(replay["positions"]), (std::vector<std::int32_t>{0, 0, 0, -123457, 0, 10000000}));
  EXPECT_EQ(arrayOf<std::int32_t>(replay["readings"]), (std::vector<std::int32_t>{0, 0, -23457, 3600000}));
  EXPECT_TRUE(dataOf(reportHtml({}, run, {}))["trace"].is_null());
}

TEST(Report, HoldsWhatTheAxesReadOnThePath) {
  records::RunInfo run;
  run.axes.resize(3);
  Scene scene;
  scene.path.points = {{0, 0, 0}, {50, 0, -100}};
  scene.path.axes.resize(2);
  scene.path.axes[1].values = {50, 0, -100.25};
  const json axes = dataOf(reportHtml({}, run, scene))["scene"]["path"]["axes"];
  ASSERT_EQ(axes.size(), 3U);
  EXPECT_EQ(arrayOf<float>(axes[0]), (std::vector<float>{0, 50}));
  EXPECT_EQ(axes[1], 0) << "what stands all the time is one number";
  EXPECT_EQ(arrayOf<float>(axes[2]), (std::vector<float>{0, -100.25F}));
  EXPECT_TRUE(dataOf(reportHtml({}, run, {}))["scene"]["path"]["axes"].empty()) << "nobody knows";
}

TEST(Report, PacksTextsOfEveryLength) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{49'151}, std::size_t{300'000}}) {
    auto run = sample::runInfo();
    run.programs[0].text.clear();
    std::uint32_t random = 1;
    for (std::size_t i = 0; i < length; ++i)
      run.programs[0].text += static_cast<char>('a' + (random = random * 1664525 + 1013904223) / 0x10000000);
    const json lines = dataOf(reportHtml({}, run, {}))["programs"][0]["pieces"];
    EXPECT_EQ(length == 0 ? "" : lines[0]["lines"][0], run.programs[0].text);
  }
}

// The pages that the browser test opens.
TEST(Report, IsWrittenForTheBrowser) {
  const std::filesystem::path folder = PROBEWRIGHT_SAMPLE_DIR;
  const auto write = [&](const char* name, const std::string& html) {
    const auto written = writeFileAtomically(folder / name, html);
    ASSERT_TRUE(written) << format(written.error());
  };
  auto bore = sample::journal();
  control::CycleRecord& hole = bore.cycles[3];
  hole.fits.push_back({.shape = "circle",
                       .touches = {0, 1, 2, 3},
                       .residuals = {0.001, -0.001, 0.002, -0.002},
                       .formDeviation = 0.004,
                       .degreesOfFreedom = 1,
                       .members = {},
                       .cofactors = {}});
  hole.results[0].kind.of = {.quantity = control::Quantity::Centre, .along = control::Along::First};
  hole.results[1].kind.of = {.quantity = control::Quantity::Centre, .along = control::Along::Second};
  write("rework.html", reportHtml(bore, sample::runInfo(), sample::scene(bore)));
  const auto alarm = sample::alarmJournal();
  Scene alarmScene = sample::scene(alarm);
  const Vector3 jaw(0, -sample::blockWidth / 2, -10);
  alarmScene.collisions = {{(sample::blockPose() * jaw).cast<float>(), "stylus", "Fixed jaw"}};
  // A gauge far beside the part, with a touch on it: the first view must hold it.
  alarmScene.meshes.push_back(sample::box("Ring", {600, 200, 32}, {640, 240, 60}));
  alarmScene.touches.push_back({0, 0, {620, 220, 63}, {620, 220, 60}});
  write("alarm.html", reportHtml(alarm, sample::alarmRunInfo(), alarmScene));
  auto good = sample::journal();
  good.cycles.pop_back();
  good.cycles.back().results.push_back(sample::plain("Q180", "1: good", 1, ""));
  auto goodRun = sample::runInfo();
  goodRun.exit = records::ExitState::Good;
  goodRun.exitText.clear();
  write("good.html", reportHtml(good, goodRun, sample::scene(good)));
  write("empty.html", reportHtml({}, {}, {}));
  write("settings.html", reportHtml(settingsJournal(), {}, {}));
  write("camera.html", reportHtml(cameraJournal(), {}, cameraScene()));
  auto hostile = sample::journal();
  hostile.cycles[0].title =
      "</script><script>window.broken = true</script><img src=x onerror=\"window.broken = true\">";
  auto hostileRun = sample::runInfo();
  hostileRun.programs[0].text =
      "; </script><script>window.broken = true</script> \xE6\xB5\x8B\xE9\x87\x8F\n" + hostileRun.programs[0].text;
  write("hostile.html", reportHtml(hostile, hostileRun, sample::scene(hostile)));
}

}  // namespace
}  // namespace probewright::reports
