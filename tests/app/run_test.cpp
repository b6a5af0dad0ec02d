#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "app/block_world.hpp"
#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

const std::string program = "examples/programs/housing.h";
const std::string setup = "examples/setups/housing-tnc640.toml";

/// Everything the schema of docs/ has against a results.json.
std::string complaints(const json& document) {
  const json file = json::parse(std::ifstream(PROBEWRIGHT_SOURCE_DIR "/docs/results.schema.json"));
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(file), schema);
  valijson::Validator validator;
  valijson::ValidationResults results;
  validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &results);
  std::string text;
  for (const auto& error : results) {
    for (const auto& part : error.context)
      text += part;
    text += ": " + error.description + "\n";
  }
  return text;
}

/// A message, exit code 2, and nothing written.
void expectRefused(const Answer& answer, const Folder& folder, const std::string& message) {
  EXPECT_EQ(answer.exit, 2) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr(message));
  EXPECT_EQ(messages(answer.errors), 1U) << answer.errors;
  EXPECT_THAT(namesIn(folder / "out"), IsEmpty());
}

TEST(Run, MeasuresTheHousingOfTheExamplesAndCorrectsThePreset) {
  const Folder folder;
  const Answer answer = probewright({"run", program, "--setup", setup, "--out", (folder / "out").string()});
  ASSERT_EQ(answer.exit, 0) << answer.errors << answer.output;
  EXPECT_EQ(answer.errors, "");
  EXPECT_THAT(answer.output, HasSubstr("OK: all 16 toleranced values are within the limits"));
  EXPECT_THAT(answer.output, HasSubstr((folder / "out/report.html").string()));
  EXPECT_THAT(namesIn(folder / "out"),
              IsSupersetOf({"PRESET.PR", "TCHPR421.TXT", "TCHPR422.TXT", "TCHPR423.TXT", "TCHPR424.TXT", "TCHPR427.TXT",
                            "TCHPR431.TXT", "TCHPROBE.TP", "TOOL.T", "report.html", "results.json"}));

  const json results = json::parse(textOf(folder / "out/results.json"));
  EXPECT_EQ(complaints(results), "");

  // The setup's pose of the part, against what the last correction of each column left: the probe repeats to 0.0003 mm
  // and its lobing is 0.0005 mm, so 0.002 mm is what the preset can be trusted to.
  const std::map<std::string, double> truth = {{"X", -58.65}, {"Y", -40.82}, {"Z", -469.59}, {"SPC", 0.8}};
  std::map<std::string, double> found;
  std::istringstream table(textOf(folder / "out/PRESET.PR"));
  std::string line;
  std::vector<std::string> columns;
  std::getline(table, line);
  std::getline(table, line);
  std::vector<std::size_t> begins;
  for (const auto& [name, value] : truth) {
    const std::size_t at = line.find(" " + name + " ");
    ASSERT_NE(at, std::string::npos) << name;
    columns.push_back(name);
    begins.push_back(at + 1);
  }
  while (std::getline(table, line) && line.rfind("1 ", 0) != 0) {
  }
  for (std::size_t i = 0; i < columns.size(); ++i)
    found[columns[i]] = std::stod(line.substr(begins[i]));
  EXPECT_NEAR(found["X"], truth.at("X"), 0.002);
  EXPECT_NEAR(found["Y"], truth.at("Y"), 0.002);
  EXPECT_NEAR(found["Z"], truth.at("Z"), 0.002);
  // Two touches 100 mm apart.
  EXPECT_NEAR(found["SPC"], truth.at("SPC"), 0.002 / 100 * 180 / std::numbers::pi);

  // The report is one file: nothing in it is fetched from elsewhere.
  const std::string report = textOf(folder / "out/report.html");
  EXPECT_THAT(report, HasSubstr("</html>"));
  EXPECT_THAT(report, Not(HasSubstr("<script src")));
  EXPECT_THAT(report, Not(HasSubstr("<link rel=\"stylesheet\"")));
}

TEST(Run, PutsAPresetIntoTheBoreOnAnITNC530) {
  const Folder folder;
  const Answer answer = probewright({"run", "examples/programs/bore-itnc530.h", "--setup",
                                     "examples/setups/housing-itnc530.toml", "--out", (folder / "out").string()});
  ASSERT_EQ(answer.exit, 0) << answer.errors;
  // Where the setup puts the bore at X60 Y40 of the part, with the errors of its probe.
  const double turn = 0.8 * std::numbers::pi / 180;
  const double truth[] = {-58.65 + 60 * std::cos(turn) - 40 * std::sin(turn),
                          -40.82 + 60 * std::sin(turn) + 40 * std::cos(turn), -469.59};
  std::istringstream table(textOf(folder / "out/PRESET.PR"));
  std::string line;
  for (int i = 0; i < 5; ++i)
    std::getline(table, line);
  std::istringstream row(line);
  double number = 0, rotation = 0;
  row >> number >> rotation;
  EXPECT_EQ(number, 2);
  for (const double expected : truth) {
    double found = 0;
    row >> found;
    EXPECT_NEAR(found, expected, 0.002);
  }
}

TEST(Run, MeasuresTheHousingOfTheExamplesAndCorrectsTheZeroOffset) {
  const Folder folder;
  const Answer answer = probewright({"run", "examples/programs/housing.mpf", "--setup",
                                     "examples/setups/housing-840dsl.toml", "--out", (folder / "out").string()});
  ASSERT_EQ(answer.exit, 0) << answer.errors << answer.output;
  EXPECT_EQ(complaints(json::parse(textOf(folder / "out/results.json"))), "");

  // The pose of the part in the setup; 0.002 mm as above.
  const std::string frames = textOf(folder / "out/FRAMES.UFR");
  const auto value = [&frames](const std::string& key) {
    const std::size_t at = frames.find(key + "=");
    return at == std::string::npos ? NAN : std::stod(frames.substr(at + key.size() + 1));
  };
  EXPECT_NEAR(value("$P_UIFR[1,X,TR]"), -58.65, 0.002);
  EXPECT_NEAR(value("$P_UIFR[1,Y,TR]"), -40.82, 0.002);
  EXPECT_NEAR(value("$P_UIFR[1,Z,TR]"), -469.59, 0.002);
  EXPECT_NEAR(value("$P_UIFR[1,Z,RT]"), 0.8, 0.002 / 100 * 180 / std::numbers::pi);

  // The program calibrates first: a ball of 6 mm with 0.006 mm of pretravel on each side.
  const std::string calibration = textOf(folder / "out/DATA.INI");
  const std::string diameter = "$SNS_MEA_WP_BALL_DIAM[0]=";
  ASSERT_THAT(calibration, HasSubstr(diameter));
  EXPECT_NEAR(std::stod(calibration.substr(calibration.find(diameter) + diameter.size())), 5.988, 0.002);
}

// The first program of the README: the hole is good, its place is not.
TEST(Run, FindsThePlateOfTheReadmeClampedBesideItsPlace) {
  const Folder folder;
  const std::string out = (folder / "out").string();
  const Answer answer =
      probewright({"run", "examples/first/plate.h", "--setup", "examples/first/plate.toml", "--out", out});
  EXPECT_EQ(answer.exit, 1) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("30.0100 mm"));
  EXPECT_THAT(answer.output, HasSubstr("OUT OF TOLERANCE: 1 of 3 toleranced values"));
}

TEST(Run, GivesTheSameResultsForTheSameSeedAndOthersForAnother) {
  const Folder folder;
  const auto touchesWith = [&](const std::string& seed, const std::string& out) {
    const Answer answer =
        probewright({"run", program, "--setup", setup, "--seed", seed, "--quiet", "--out", (folder / out).string()});
    EXPECT_EQ(answer.exit, 0);
    EXPECT_EQ(answer.output, "");
    return json::parse(textOf(folder / out / "results.json")).at("cycles").dump();
  };
  const std::string first = touchesWith("5", "a");
  EXPECT_EQ(first, touchesWith("5", "b"));
  EXPECT_NE(first, touchesWith("6", "c"));
}

TEST(Run, TellsByItsExitCodeThatThePartIsOutOfTolerance) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  const std::string out = (folder / "out").string();
  const std::string good = folder.file("good.h", blockProgram("+20.1", "+19.9"));
  EXPECT_EQ(probewright({"run", good, "--setup", world, "--out", out}).exit, 0);
  const std::string bad = folder.file("bad.h", blockProgram("+19.95", "+19.9"));
  const Answer answer = probewright({"run", bad, "--setup", world, "--out", out});
  EXPECT_EQ(answer.exit, 1) << answer.errors;
  EXPECT_EQ(complaints(json::parse(textOf(folder / "out/results.json"))), "");
}

TEST(Run, TellsByItsExitCodeThatAnAlarmStoppedTheProgram) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  const std::string crash = folder.file("crash.h",
                                        "0 BEGIN PGM CRASH MM\n1 TOOL CALL 1 Z\n2 L X+0 Y+0 R0 FMAX\n"
                                        "3 L Z-10 R0 FMAX\n4 END PGM CRASH MM\n");
  const Answer answer = probewright({"run", crash, "--setup", world, "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 3);
  EXPECT_THAT(answer.errors, HasSubstr("crash.h:4:"));
  const json results = json::parse(textOf(folder / "out/results.json"));
  EXPECT_EQ(complaints(results), "");
  EXPECT_THAT(namesIn(folder / "out"), IsSupersetOf({"report.html"}));
}

TEST(Run, StopsAnEndlessLoop) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  const std::string loop =
      folder.file("loop.h", "0 BEGIN PGM LOOP MM\n1 LBL 1\n2 FN 9: IF +1 EQU +1 GOTO LBL 1\n3 END PGM LOOP MM\n");
  const Answer answer =
      probewright({"run", loop, "--setup", world, "--step-limit", "1000", "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 3) << answer.errors;
}

TEST(Run, WarnsOfAPartThatIsNoClosedBody) {
  const Folder folder;
  const std::string sheet =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex -50 -50 0\nvertex 50 -50 0\nvertex 0 50 0\nendloop\nendfacet\n"
      "endsolid\n";
  folder.file("sheet.stl", sheet);
  const std::string own =
      folder.file("s.toml",
                  "[control]\ntype = \"TNC640\"\n[part]\nfile = \"sheet.stl\"\npose = { z = -500 }\n"
                  "[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 50\nradius = 5\n");
  const std::string path = folder.file("a.h", "BEGIN PGM A MM\nL Z-10 R0 FMAX M30\nEND PGM A MM\n");
  const Answer answer = probewright({"run", path, "--setup", own, "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr(own + ": warning: the surface of \"part\" is not closed"));
}

TEST(Run, RefusesWhatItCannotRead) {
  const Folder folder;
  const std::string out = (folder / "out").string();
  const auto run = [&](const std::string& what, const std::string& world) {
    return probewright({"run", what, "--setup", world, "--out", out});
  };
  expectRefused(run((folder / "none.h").string(), setup), folder, "none.h: error: cannot open");
  expectRefused(run(program, (folder / "none.toml").string()), folder, "none.toml: error: cannot open");
  expectRefused(run(program, folder.file("broken.toml", "[part\nfile = 3\n")), folder, "broken.toml:1:6: error:");
  expectRefused(run(program, folder.file("unknown.toml", blockSetup("[machine]\nnaem = \"mill3\"\n"))), folder, "naem");
  const std::string noPart = "[control]\ntype = \"TNC640\"\n[part]\nfile = \"none.step\"\n";
  expectRefused(run(program, folder.file("nopart.toml", noPart)), folder, "none.step");
  folder.file("torn.step", textOf(PROBEWRIGHT_SOURCE_DIR "/examples/parts/housing.step").substr(0, 4000));
  const std::string torn = "[control]\ntype = \"TNC640\"\n[part]\nfile = \"torn.step\"\n";
  expectRefused(run(program, folder.file("torn.toml", torn)), folder, "torn.step");
  expectRefused(run(folder.file("empty.txt", "hello\n"), folder.file("any.toml", "seed = 1\n")), folder, "--control");
  expectRefused(run(folder.file("wrong.mpf", "G0 X1\nM30\n"), setup), folder, "SINUMERIK program");
}

TEST(Run, TellsWhereEachCycleStands) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  const std::string out = (folder / "out").string();
  ASSERT_EQ(probewright({"run", folder.file("a.h", blockProgram("+0", "+0", 1)), "--setup", world, "--out", out}).exit,
            0);
  const json place = json::parse(textOf(folder / "out/results.json"))["cycles"][0]["place"];
  EXPECT_EQ(place["line"], 4);
  EXPECT_EQ(place["column"], 3) << "3 TCH PROBE 427";
}

TEST(Run, KeepsEveryTouchOfAPointThatIsMeasuredSeveralTimes) {
  const Folder folder;
  std::string text = blockSetup("[parameters]\nMP6170 = 3\nMP6171 = 0.05\n");
  text.replace(text.find("TNC640"), 6, "iTNC530");
  text.insert(text.find("ball_radius"), "repeatability = 0.002\n");
  const std::string out = (folder / "out").string();
  const Answer answer = probewright({"run", folder.file("a.h", blockProgram("+0", "+0", 1)), "--setup",
                                     folder.file("block.toml", text), "--out", out});
  ASSERT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("1 cycle, 3 touches, "));
  const json cycle = json::parse(textOf(folder / "out/results.json"))["cycles"][0];
  ASSERT_EQ(cycle["touches"].size(), 3U);
  double mean = 0;
  for (const json& touch : cycle["touches"]) {
    EXPECT_EQ(touch["outcome"], "touched");
    mean += touch["surface"][0].get<double>() / 3;
  }
  EXPECT_NE(cycle["touches"][0]["surface"], cycle["touches"][1]["surface"]) << "each has its own scatter";
  EXPECT_NEAR(cycle["results"][0]["value"].get<double>(), mean, 1e-9);
}

TEST(Run, PrintsNoControlCharactersOfAProgram) {
  const Folder folder;
  const std::string world = folder.file("block.toml", blockSetup());
  const auto run = [&](const std::string& text) {
    return probewright({"run", folder.file("a.h", text), "--setup", world, "--out", (folder / "out").string()});
  };
  const Answer binary = run(std::string("BEGIN PGM A MM\n\x01\x02\x1B[2J\0\x7F\nEND PGM A MM\n", 37));
  EXPECT_EQ(binary.exit, 2);
  EXPECT_THAT(binary.errors, HasSubstr("a.h: error: this is no text"));
  EXPECT_EQ(messages(binary.errors), 1U) << binary.errors;
  const Answer oldMac = run("BEGIN PGM A MM\rL X+1\rEND PGM A MM\r");
  EXPECT_EQ(oldMac.exit, 2);
  EXPECT_THAT(oldMac.errors, HasSubstr("the lines of this file end with CR alone"));
  EXPECT_EQ(oldMac.errors.find('\r'), std::string::npos);
  // "Gr\xF6\xDF" in CP1252.
  const Answer old =
      run("BEGIN PGM A MM\n; Gr\xF6\xDF"
          "e\nGR\xD6SSE\nEND PGM A MM\n");
  EXPECT_EQ(old.exit, 2);
  EXPECT_THAT(old.errors, HasSubstr("GR\xC3\x96SSE"));
}

/// The machine builder's program runs in front of each measuring cycle and is told which one.
TEST(Run, CallsTheMachineBuildersProgramBeforeMeasuring) {
  const Folder folder;
  const std::string hook = folder.file("CUST_MEACYC.SPF",
                                       "PROC CUST_MEACYC(INT CYCLE_1) SAVE\n"
                                       "CASE CYCLE_1 OF 977 GOTOF _M977 978 GOTOF _M978 DEFAULT GOTOF _MEND\n"
                                       "_M977: ; in front of CYCLE977\n"
                                       "MSG(\"probe on for \"<<_OVI[2])\nR10=R10+1\nM17\n"
                                       "_M978:\nSETAL(66001,\"no probe\")\nM17\n_MEND:\nM17\n");
  const std::string bore =
      "G17 G54 G90\nT1 M6\nD1\nG0 X60 Y40 Z50\nG1 Z-13 F2000\nCYCLE977(1,,,1,40,,,8,4)\nMSG(\"count \"<<R10)\n"
      "R11=_OVR[4]\n";
  const std::string housing = "examples/setups/housing-840dsl.toml";
  const std::string good = folder.file("good.mpf", bore + "CYCLE977(1,,,1,40,,,8,4)\nMSG(\"again \"<<R10)\nM30\n");
  const Answer ran = probewright({"run", good, "--setup", housing, "--out", (folder / "out").string()});
  EXPECT_EQ(ran.exit, 0) << ran.errors;
  EXPECT_THAT(ran.output, HasSubstr("probe on for 977"));
  EXPECT_THAT(ran.output, HasSubstr("count 1"));
  EXPECT_THAT(ran.output, HasSubstr("again 2"));
  const Answer tested =
      probewright({"run", good, "--setup", housing, "--out", (folder / "out").string(), "--program-test"});
  EXPECT_THAT(tested.output, Not(HasSubstr("probe on"))) << "a cycle that is skipped calls nothing";
  const std::string bad = folder.file("bad.mpf", bore + "CYCLE978(0,,,1,0,26,3,3,2,1)\nM30\n");
  const Answer stopped = probewright({"run", bad, "--setup", housing, "--out", (folder / "out").string()});
  EXPECT_EQ(stopped.exit, 3);
  EXPECT_THAT(stopped.errors, HasSubstr(hook + ":8"));
  EXPECT_THAT(stopped.errors, HasSubstr("66001"));
}

}  // namespace
}  // namespace probewright::app::testing
