#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "app/program.hpp"
#include "support/page_data.hpp"

/// Whoever is trained with --blind can look into every file that a run leaves: no true number of the world may be
/// there.
namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::IsEmpty;
using ::testing::Not;

/// Everything true is a number that nobody would come upon, and that the control believes otherwise.
const std::string truth = R"(
[part]
name = "blank"
pose = { x = 0.618034, y = -0.414214, z = -480.302776, c = 0.577216 }
[[part.feature]]
shape = "box"
centre = [0, 0, -20]
size = [80.123457, 60.271828, 20]
[[part.feature]]
shape = "hole"
diameter = 30.012346
[[fixture]]
name = "vice"
pose = { x = 71.234567, z = -500.987654 }
[[fixture.feature]]
shape = "box"
size = [20, 60, 90.765432]
[errors.axis.X]
scale_mm_per_m = 0.117321
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 150.083197
believed_length = 150
ball_radius = 3.004231
believed_radius = 3
tip_offset = [0.012717, -0.021931]
believed_tip_offset = [0, 0]
pretravel = 0.007349
axial_pretravel = 0.004157
lobing = 0.001373
lobing_phase = 21.972246
repeatability = 0.000919
[[tool]]
number = 2
name = "MILL"
kind = "mill"
length = 90.271839
radius = 5.031417
believed_length = 90
believed_radius = 5
)";

const std::string toolProbe = R"(
[tool_probe]
diameter = 20
thickness = 8
stem_diameter = 6
pose = { x = 250.312345, y = 120.045678, z = -560.056789 }
repeatability = 0.000713
[parameters]
"centerPos.0" = 250
"centerPos.1" = 120
"centerPos.2" = -560
calibratedContactX = 250.01
calibratedContactY = 120.02
calibratedContactZ = -560.03
)";

const std::vector<double> secrets = {
    0.618034,   0.414214,   480.302776, 0.302776,   0.577216, 80.123457,  60.271828, 30.012346,  15.006173,
    71.234567,  500.987654, 20.987654,  90.765432,  0.117321, 250.312345, 0.312345,  120.045678, 0.045678,
    560.056789, 0.056789,   0.000713,   150.083197, 0.083197, 3.004231,   0.004231,  0.012717,   0.021931,
    0.007349,   0.004157,   0.001373,   21.972246,  0.000919, 90.271839,  0.271839,  5.031417,   0.031417};

const std::string klartextSetup = "seed = 41\n[control]\ntype = \"TNC640\"\n[machine]\nname = \"mill3\"\n" + truth +
                                  "[[preset]]\nrow = 1\norigin = [0, 0, -480]\nactive = true\n" + toolProbe;
const std::string sinumerikSetup = "seed = 41\n[control]\ntype = \"840Dsl\"\n[machine]\nname = \"mill3\"\n" + truth +
                                   "[[zero_offset]]\nname = \"G54\"\norigin = [0, 0, -480]\nactive = true\n";

struct Case {
  const char* name;
  bool klartext;
  int exit;
  std::string program;  ///< without its first and last line
};

const std::string hole421 =
    "TCH PROBE 421 MEASURE HOLE ~\nQ273=+0 ~\nQ274=+0 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-8 ~\nQ320=+0 ~\n"
    "Q260=+20 ~\nQ301=+0 ~\nQ275=+30.1 ~\nQ276=+29.9 ~\nQ279=+2 ~\nQ280=+2 ~\nQ281=+1 ~\nQ309=+0 ~\nQ330=+0 ~\n"
    "Q423=+4 ~\nQ365=+1\n";
std::string side427(const char* place, const char* height, const char* axis, const char* direction) {
  return std::string("TCH PROBE 427 COORDINATE ~\nQ263=") + place + " ~\nQ264=+0 ~\nQ261=" + height +
         " ~\nQ320=+0 ~\nQ272=" + axis + " ~\nQ267=" + direction +
         " ~\nQ260=+60 ~\nQ281=+1 ~\nQ288=+99 ~\nQ289=-99 ~\nQ309=+0 ~\nQ330=+0\n";
}

const std::vector<Case> cases = {
    {"what is measured", true, 0,
     "TOOL CALL 1 Z\nL Z+60 R0 FMAX\n" + side427("+20", "+0", "+3", "-1") + hole421 +
         "TCH PROBE 412 PRESET ~\nQ321=+0 ~\nQ322=+0 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-8 ~\nQ320=+0 ~\n"
         "Q260=+20 ~\nQ301=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\n"
         "Q384=+0 ~\nQ333=+0\nL Z+200 FMAX\n"},
    {"a tool", true, 0, "TOOL CALL 2 Z S0\nTCH PROBE 481 CAL. TOOL LENGTH ~\nQ340=+1 ~\nQ260=+100 ~\nQ341=+0\n"},
    {"a collision", true, 3, "TOOL CALL 1 Z\nL X+0 Y+0 Z+60 R0 FMAX\nL X+90 FMAX\n"},
    {"a collision of a cutter", true, 3, "TOOL CALL 2 Z S0\nL X+0 Y+0 Z+40 R0 FMAX\nL X+90 FMAX\n"},
    {"a touch on the way", true, 3, "TOOL CALL 1 Z\nL X+30 Y+0 Z+20 R0 FMAX\nL Z-5 F2000\n"},
    {"a touch as a cycle positions", true, 3, "TOOL CALL 1 Z\nL Z+60 R0 FMAX\n" + side427("+70", "+20", "+1", "+1")},
    {"a miss", true, 3, "TOOL CALL 1 Z\nL Z+60 R0 FMAX\n" + side427("-60", "-8", "+1", "+1")},
    {"what a SINUMERIK measures", false, 0,
     "T1 D1\nM6\nG54 G17 G0 X20 Y0 Z20\nG0 Z6\nCYCLE978(100,10001,,1,0,6,3,3,2,1,\"\",,0,,0,0,,,,,1,)\nG0 Z20\nX0 Y0\n"
     "G1 Z-8 F3000\nCYCLE977(101,10001,,1,30,,,3,3,0,,,,1,1,\"\",,0,,0,0,,,,,1,)\nG0 Z60\n"},
    {"a collision of a SINUMERIK", false, 3, "T1 D1\nM6\nG54 G17 G0 X0 Y0 Z60\nG0 X90\n"},
    {"a miss of a SINUMERIK", false, 3,
     "T1 D1\nM6\nG54 G17 G0 X0 Y0 Z60\nCYCLE978(100,10001,,1,0,6,3,3,2,1,\"\",,0,,0,0,,,,,1,)\n"},
};

/// All numbers with a point that stand in a text.
void addNumbers(const std::string& text, std::vector<double>& numbers) {
  for (const char* at = text.c_str(); *at != 0;) {
    if (std::isdigit(static_cast<unsigned char>(*at)) == 0) {
      ++at;
      continue;
    }
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (std::memchr(at, '.', static_cast<std::size_t>(end - at)) != nullptr) numbers.push_back(number);
    at = end;
  }
}

/// All numbers of the data of a report, and those that its texts hold as packed floats.
void addNumbers(const json& data, std::vector<double>& numbers) {
  if (data.is_number_float()) {
    numbers.push_back(data.get<double>());
  } else if (data.is_structured()) {
    for (const json& each : data)
      addNumbers(each, numbers);
  } else if (data.is_string()) {
    const auto& text = data.get_ref<const std::string&>();
    addNumbers(text, numbers);
    const bool packed = text.size() % 4 == 0 && text.size() >= 12 &&
                        text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=") ==
                            std::string::npos;
    if (!packed) return;
    const std::string bytes = testing_support::decoded(text);
    const auto scan = [&]<class Float>(Float number) {
      for (std::size_t i = 0; i + sizeof number <= bytes.size(); i += 4) {
        std::memcpy(&number, bytes.data() + i, sizeof number);
        if (std::isfinite(number)) numbers.push_back(number);
      }
    };
    scan(float{});
    scan(double{});
  }
}

std::string unzipped(const std::string& path) {
  const std::string command =
      "python3 -c 'import sys, zipfile\nwith zipfile.ZipFile(sys.argv[1]) as file:\n"
      "  for name in file.namelist(): sys.stdout.buffer.write(file.read(name))' '" +
      path + "'";
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  char part[4096];
  for (std::size_t read = 0; (read = fread(part, 1, sizeof part, pipe)) > 0;)
    text.append(part, read);
  EXPECT_EQ(pclose(pipe), 0);
  return text;
}

/// The secrets that stand in what a run has printed and left: "FILE: NUMBER".
std::vector<std::string> toldBy(const Answer& answer, const std::filesystem::path& folder) {
  std::vector<std::string> told;
  const auto look = [&](const std::string& where, const std::vector<double>& numbers) {
    for (const double secret : secrets) {
      const bool there = std::ranges::any_of(
          numbers, [&](double number) { return std::abs(std::abs(number) - secret) < std::max(6e-7, 1e-7 * secret); });
      if (there) told.push_back(where + ": " + std::to_string(secret));
    }
  };
  std::vector<double> printed;
  addNumbers(answer.output + " " + answer.errors, printed);
  look("the terminal", printed);
  for (const std::string& name : namesIn(folder)) {
    std::vector<double> numbers;
    const std::string text = textOf(folder / name);
    if (name == "report.html") {
      addNumbers(json::parse(testing_support::pageData(text)), numbers);
    } else if (name.ends_with(".xlsx")) {
      addNumbers(unzipped((folder / name).string()), numbers);
    } else {
      addNumbers(text, numbers);
    }
    look(name, numbers);
  }
  return told;
}

TEST(Blind, NoFileHoldsATrueNumber) {
  for (const Case& each : cases) {
    SCOPED_TRACE(each.name);
    const Folder folder;
    const std::string nc = each.klartext ? folder.file("a.h", "BEGIN PGM A MM\n" + each.program + "END PGM A MM\n")
                                         : folder.file("a.mpf", each.program + "M30\n");
    const std::string world = folder.file("s.toml", each.klartext ? klartextSetup : sinumerikSetup);
    const auto run = [&](const std::string& out, std::vector<std::string> more) {
      std::vector<std::string> words = {
          "run",      nc, "--setup", world, "--out", (folder / out).string(), "--export", "csv,xlsx,qif,dfq,dmis,junit",
          "--screens"};
      if (!each.klartext) words.insert(words.end(), {"--measuring-log", "ALL.csv"});
      words.insert(words.end(), more.begin(), more.end());
      return probewright(words);
    };
    const Answer open = run("open", {"--clearance"});
    EXPECT_EQ(open.exit, each.exit) << open.errors;
    EXPECT_THAT(toldBy(open, folder / "open"), Not(IsEmpty())) << "what the test would find";
    for (const std::string language : {"en", "ru"}) {
      const Answer blind = run(language, {"--blind", "--clearance", "--language", language});
      EXPECT_EQ(blind.exit, each.exit) << blind.errors;
      EXPECT_THAT(toldBy(blind, folder / language), IsEmpty()) << blind.errors;
      const std::string all = blind.output + blind.errors + textOf(folder / language / "results.json");
      for (const char* thing : {"\"vice\"", "\"blank\"", "\u00abvice\u00bb", "\u00abblank\u00bb"})
        EXPECT_THAT(all, Not(::testing::HasSubstr(std::string(thing) + " at"))) << thing;
      EXPECT_THAT(all, Not(::testing::HasSubstr("on the table")));
      EXPECT_THAT(all, Not(::testing::HasSubstr("vice")));
    }
  }
}

TEST(Blind, DoesNotGoWithWhatComesFromTheTruth) {
  const Folder folder;
  const Answer answer = probewright({"run", folder.file("a.h", "BEGIN PGM A MM\nEND PGM A MM\n"), "--setup",
                                     folder.file("s.toml", klartextSetup), "--blind", "--uncertainty"});
  EXPECT_EQ(answer.exit, 2);
  EXPECT_THAT(answer.errors, ::testing::HasSubstr("--uncertainty"));
}

}  // namespace
}  // namespace probewright::app::testing
