#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
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
  EXPECT_EQ(messages(answer.errors), 0U) << answer.errors;
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

/// What cycle number `index` of the run left in table entries, the last value of each.
std::map<std::string, double> writtenBy(const Folder& folder, std::size_t index) {
  std::map<std::string, double> written;
  const json cycle = json::parse(textOf(folder / "out/results.json"))["cycles"].at(index);
  for (const json& write : cycle["writes"]) {
    written[write["table"].get<std::string>() + " " + write["entry"].get<std::string>()] =
        std::stod(write["after"].get<std::string>());
  }
  return written;
}

TEST(Run, SaysWhereTheTipStoppedInTheActiveWorkpieceSystem) {
  const Folder folder;
  // The preset lies 5 mm beside the middle of the block in X, so the ball of 3 mm meets the side at 20 + 3 - 5.
  std::string world = blockSetup();
  world.replace(world.find("[0, 0, -480]"), 12, "[5, -2, -480]");
  const std::string path = folder.file("s.toml", world);
  const std::string way = folder.file("p.h",
                                      "0 BEGIN PGM P MM\n1 TOOL CALL 1 Z\n2 L X+40 Y+4 R0 FMAX\n3 L Z-8 R0 FMAX\n"
                                      "4 L X+0 R0 F100\n5 END PGM P MM\n");
  const Answer answer = probewright({"run", way, "--setup", path, "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 3) << answer.errors;
  double x = 0, y = 0, z = 0;
  const std::size_t at = answer.errors.find("the tool tip stopped at X");
  ASSERT_NE(at, std::string::npos) << answer.errors;
  ASSERT_EQ(std::sscanf(answer.errors.c_str() + at, "the tool tip stopped at X%lf Y%lf Z%lf of the active", &x, &y, &z),
            3)
      << answer.errors;
  EXPECT_NEAR(x, 18, 0.01);
  EXPECT_EQ(y, 4);
  EXPECT_EQ(z, -8);
}

TEST(Run, SetsACornerByADinIsoProgram) {
  const Folder folder;
  const Answer answer =
      probewright({"run", "examples/programs/corner.i", "--setup", setup, "--out", (folder / "out").string()});
  ASSERT_EQ(answer.exit, 0) << answer.errors;
  // Where the setup clamps the corner, with the errors of its probe.
  std::map<std::string, double> written = writtenBy(folder, 0);
  EXPECT_NEAR(written["PRESET.PR row 3, column X"], -58.65, 0.002);
  EXPECT_NEAR(written["PRESET.PR row 3, column Y"], -40.82, 0.002);
  EXPECT_NEAR(written["PRESET.PR row 3, column Z"], -469.59, 0.002);
  EXPECT_NEAR(written["PRESET.PR row 3, column SPC"], 0.8, 0.002);
}

TEST(Run, CorrectsTheToolThatTurnedAShaft) {
  const Folder folder;
  const Answer answer = probewright({"run", "examples/programs/shaft.mpf", "--setup",
                                     "examples/setups/shaft-lathe.toml", "--out", (folder / "out").string()});
  EXPECT_EQ(answer.exit, 1) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("OUT OF TOLERANCE: 1 of 1 toleranced value"));
  EXPECT_NEAR(writtenBy(folder, 0)["$P_UIFR [1,Z,TR]"], 180.18, 0.002);
  // The shoulder has 40.014 mm; 40 h7 lies in the middle at 39.9875 mm.
  EXPECT_NEAR(writtenBy(folder, 1)["$TC_DP12 [3,1]"], -(40.014 - 39.9875) / 2, 0.001);
}

TEST(Run, MeasuresTheToolsOfALathe) {
  const Folder folder;
  const Answer answer = probewright({"run", "examples/programs/tools-lathe.mpf", "--setup",
                                     "examples/setups/tools-lathe.toml", "--out", (folder / "out").string()});
  ASSERT_EQ(answer.exit, 0) << answer.errors;
  // The contact is 0.12 and 0.08 mm aside; each side signals 0.004 mm late.
  EXPECT_NEAR(writtenBy(folder, 0)["$SNS_MEA_TP_TRIG_MINUS_DIR_AX1 [0]"], 260.076, 0.001);
  EXPECT_NEAR(writtenBy(folder, 3)["$SNS_MEA_TP_TRIG_PLUS_DIR_AX2 [0]"], 140.124, 0.001);
  EXPECT_NEAR(writtenBy(folder, 4)["$TC_DP3 [3,1]"], 80.043, 0.001);
  std::map<std::string, double> mill = writtenBy(folder, 5);
  EXPECT_NEAR(mill["$TC_DP4 [7,1]"], 85.02, 0.001);
  EXPECT_NEAR(mill["$TC_DP6 [7,1]"], (5.988 + 5.998) / 2, 0.001);
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
  const json results = json::parse(textOf(folder / "out/results.json"));
  EXPECT_EQ(complaints(results), "");

  // The bore that is inspected has its limits in the report, and what it is called.
  int bores = 0;
  for (const json& cycle : results.at("cycles")) {
    if (cycle.at("title") != "Hole 40") continue;
    for (const json& result : cycle.at("results")) {
      if (result.at("name") != "_OVR[4]" || result.value("verdict", "") != "good") continue;
      ++bores;
      EXPECT_NEAR(result.at("lowerLimit").get<double>(), 40, 1e-9);
      EXPECT_NEAR(result.at("upperLimit").get<double>(), 40.025, 1e-9);
    }
  }
  EXPECT_EQ(bores, 1);

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
  EXPECT_THAT(binary.errors, HasSubstr("a.h: error: this is not a text file"));
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

/// The machine builder's program runs before each measuring cycle and is told which one.
TEST(Run, CallsTheMachineBuildersProgramBeforeMeasuring) {
  const Folder folder;
  const std::string hook = folder.file("CUST_MEACYC.SPF",
                                       "PROC CUST_MEACYC(INT CYCLE_1) SAVE\n"
                                       "CASE CYCLE_1 OF 977 GOTOF _M977 978 GOTOF _M978 DEFAULT GOTOF _MEND\n"
                                       "_M977: ; before CYCLE977\n"
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

/// A stylus with a long arm is an L on a SINUMERIK: type 713, whose arm the cycles turn to +X and which can pull.
TEST(Run, MeasuresUnderAnOverhangWithABentStylus) {
  const Folder folder;
  const std::string world = folder.file("bent.toml",
                                        "[control]\ntype = \"840Dsl\"\n[part]\npose = { z = -420 }\n"
                                        "[[part.feature]]\nshape = \"box\"\nsize = [60, 60, 20]\ncentre = [0, 0, 40]\n"
                                        "[[tool]]\nnumber = 1\nname = \"HOOK\"\nkind = \"probe\"\nlength = 150\n"
                                        "ball_radius = 2\nstylus_radius = 1\nstylus_length = 90\nbody_radius = 20\n"
                                        "tip_offset = [0, 40]\n"
                                        "[[zero_offset]]\nname = \"G54\"\norigin = [0, 0, -380.3]\nactive = true\n");
  // From the side below the plate, whose lower face lies at Z 0.3 of G54; the hook reaches 40 mm in +X.
  const std::string pull = folder.file("pull.mpf",
                                       "G17 G54 G90\nT1 M6\nD1\nG0 X-120 Y0 Z-20\nSPOS=270\nG1 X-60 F2000\n"
                                       "R1=$TC_DP1[1,1] R2=$TC_DP10[1,1]\nCYCLE978(0,,,1,0,12,2,3,1,1)\n"
                                       "MSG(\"type \"<<R1<<\" at \"<<R2<<\" face \"<<ROUND(_OVR[4]*1000))\nM30\n");
  const Answer ran = probewright({"run", pull, "--setup", world, "--out", (folder / "out").string()});
  EXPECT_EQ(ran.exit, 0) << ran.errors;
  EXPECT_THAT(ran.output, HasSubstr("type 713 at 270 face 300"));
}

/// With a second INT in its PROC line the machine builder's program is called on every occasion.
TEST(Run, CallsTheMachineBuildersProgramOnEveryOccasion) {
  const Folder folder;
  const std::string housing = "examples/setups/housing-840dsl.toml";
  const auto run = [&](const std::string& mask) {
    const std::string reversed = folder.file("reversed.mpf", "G17 G54 G90\nT1 M6\nD1\nG0 X60 Y40 Z50\nG1 Z-13 F2000\n" +
                                                                 mask + "CYCLE977(10001,,,1,40,,,8,4)\nM30\n");
    return probewright({"run", reversed, "--setup", housing, "--out", (folder / "out").string()});
  };
  const std::string told = "MSG(\"told \"<<CYCLE_NO<<\" \"<<OCCASION<<\" at \"<<R1<<\" deviation \"<<_OVR[4])\n";
  folder.file("CUST_MEACYC.SPF", "PROC CUST_MEACYC(INT CYCLE_NO, INT OCCASION) SAVE\nR1=R1+1\n" + told + "M17\n");
  const auto calls = [](const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
      ++count;
    return count;
  };
  const Answer around = run("");
  ASSERT_EQ(around.exit, 0) << around.errors;
  EXPECT_THAT(around.output, HasSubstr("told 977 0 at 1 deviation 0"));
  EXPECT_THAT(around.output, HasSubstr("told 977 1 at 2 deviation 40.0")) << "after the cycle it reads the results";
  EXPECT_EQ(calls(around.output, "told 977 2"), 0U);
  const Answer turning = run("$SCS_MEA_FUNCTION_MASK=$SCS_MEA_FUNCTION_MASK B_OR 64\n");
  ASSERT_EQ(turning.exit, 0) << turning.errors;
  // In both axes: turned round, back for the second touch, and as it stood when the axis is done.
  EXPECT_EQ(calls(turning.output, "told 977 2"), 6U) << turning.output;
  EXPECT_THAT(turning.output, HasSubstr("told 977 1 at 8"));

  // Without the second parameter it cannot tell what it is called for.
  folder.file("CUST_MEACYC.SPF", "PROC CUST_MEACYC(INT CYCLE_NO) SAVE\nR1=R1+1\nMSG(\"call \"<<R1)\nM17\n");
  EXPECT_EQ(calls(run("").output, "call "), 1U);
  EXPECT_EQ(calls(run("$SCS_MEA_FUNCTION_MASK=$SCS_MEA_FUNCTION_MASK B_OR 64\n").output, "call "), 7U);

  // What goes wrong in it between two touches ends the cycle.
  folder.file("CUST_MEACYC.SPF",
              "PROC CUST_MEACYC(INT CYCLE_NO, INT OCCASION) SAVE\n"
              "IF OCCASION==2\nSETAL(66002,\"the probe is off\")\nENDIF\nM17\n");
  const Answer stopped = run("$SCS_MEA_FUNCTION_MASK=$SCS_MEA_FUNCTION_MASK B_OR 64\n");
  EXPECT_EQ(stopped.exit, 3);
  EXPECT_THAT(stopped.errors, HasSubstr("CUST_MEACYC.SPF:3"));
  EXPECT_THAT(stopped.errors, HasSubstr("66002"));

  // A cycle in it measures without calling it again.
  folder.file("CUST_MEACYC.SPF", "PROC CUST_MEACYC SAVE\nR1=R1+1\nMSG(\"call \"<<R1)\nCYCLE977(1,,,1,40,,,8,4)\nM17\n");
  const Answer nested = run("");
  EXPECT_EQ(nested.exit, 0) << nested.errors;
  EXPECT_EQ(calls(nested.output, "call "), 1U);
}

}  // namespace
}  // namespace probewright::app::testing
