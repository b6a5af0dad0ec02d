#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/program.hpp"
#include "support/page_data.hpp"

/// --language, as people meet it who read a run in their own language.
namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string klartext = "examples/programs/housing.h", klartextSetup = "examples/setups/housing-tnc640.toml";

struct Case {
  const char *language, *within, *cycle, *diameter, *totals, *report;
};
void PrintTo(const Case& each, std::ostream* out) { *out << each.language; }

class InLanguage : public ::testing::TestWithParam<Case> {};

TEST_P(InLanguage, TheSummaryIsReadable) {
  const Case& expected = GetParam();
  const Folder folder;
  const Answer answer = probewright(
      {"run", klartext, "--setup", klartextSetup, "--out", (folder / "out").string(), "--language", expected.language});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  for (const char* words : {expected.within, expected.cycle, expected.diameter, expected.totals, expected.report})
    EXPECT_THAT(answer.output, HasSubstr(words));
  for (const char* english : {"deviation", "toleranced", "line ", "MEASURE HOLE", "actual", "error", "truth", "truly",
                              "no alarms", "activated", "Report:"})
    EXPECT_THAT(answer.output, Not(HasSubstr(english)));
  // Other programs read the same whatever the language.
  const json results = json::parse(textOf(folder / "out/results.json"));
  EXPECT_THAT(results.dump(), HasSubstr("MEASURE HOLE"));
}

INSTANTIATE_TEST_SUITE_P(Languages, InLanguage,
                         ::testing::Values(Case{"de", "tolerierten Werte liegen innerhalb der Grenzen",
                                                "Bohrung messen", "Istwert, Durchmesser", "Zyklen, ", "Bericht: "},
                                           Case{"ru", "значений с допуском в пределах", "Измерение отверстия",
                                                "диаметр", "касан", "Отчёт: "},
                                           Case{"sv", "tolererade värden är inom gränserna", "Mätning hål", "diameter",
                                                "cykler, ", "Rapport: "},
                                           Case{"zh", "个有公差的值都在极限内", "测量孔", "直径", "个循环", "报告："},
                                           Case{"pl", "wartości z tolerancją mieszczą się w granicach",
                                                "Pomiar odwiertu", "średnica", "cykli, ", "Raport: "}),
                         [](const auto& each) { return std::string(each.param.language); });

struct AlarmCase {
  const char *language, *name, *sentence, *stopped, *truth;
};
void PrintTo(const AlarmCase& each, std::ostream* out) { *out << each.language; }

class AlarmInLanguage : public ::testing::TestWithParam<AlarmCase> {};

TEST_P(AlarmInLanguage, IsReadableOnTheTerminalWithItsValues) {
  const AlarmCase& expected = GetParam();
  const Folder folder;
  // A face that lies 20 mm further than the touch of 10 mm reaches.
  const std::string program =
      folder.file("far.h",
                  "0 BEGIN PGM FAR MM\n"
                  "1 TOOL CALL 1 Z\n"
                  "2 TCH PROBE 427 MEASURE COORDINATE ~\n"
                  "    Q263=+25 ~\n    Q264=+20 ~\n    Q261=+0 ~\n    Q320=+0 ~\n    Q272=+3 ~\n    Q267=-1 ~\n"
                  "    Q260=+60 ~\n    Q281=+0 ~\n    Q288=+1 ~\n    Q289=-1 ~\n    Q309=+0 ~\n    Q330=+0\n"
                  "3 END PGM FAR MM\n");
  const std::string setup = folder.file("far.toml",
                                        "[control]\ntype = \"TNC640\"\n[part]\nname = \"plate\"\npose = { z = -520 }\n"
                                        "[[part.feature]]\nshape = \"box\"\nsize = [80, 60, 20]\n"
                                        "[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 150\nball_radius = 3\n"
                                        "[[preset]]\nrow = 1\norigin = [0, 0, -480]\nactive = true\n");
  const Answer answer = probewright(
      {"run", program, "--setup", setup, "--out", (folder / "out").string(), "--language", expected.language});
  EXPECT_EQ(answer.exit, 3) << answer.errors << answer.output;
  EXPECT_THAT(answer.errors, HasSubstr("error: "));
  EXPECT_THAT(answer.errors, HasSubstr(expected.name));
  EXPECT_THAT(answer.errors, HasSubstr(expected.sentence));
  EXPECT_THAT(answer.output, HasSubstr(expected.stopped));
  EXPECT_THAT(answer.output, HasSubstr(expected.truth));
  EXPECT_THAT(answer.output + answer.errors, Not(HasSubstr("further in")));
  EXPECT_THAT(answer.output + answer.errors, Not(HasSubstr("stopped at")));
}

INSTANTIATE_TEST_SUITE_P(
    Languages, AlarmInLanguage,
    ::testing::Values(AlarmCase{"de", "Antastpunkt nicht erreichbar", "nicht ausgelenkt", "GESTOPPT", "mm weiter in"},
                      AlarmCase{"ru", "Точка касания недоступна", "не отклонился", "ОСТАНОВЛЕНО", "мм дальше в"},
                      AlarmCase{"sv", "Avkänningspunkt kan ej nås", "påverkades inte", "STOPPAD", "mm längre bort i"},
                      AlarmCase{"zh", "触点不可达", "未偏转", "已停止", "方向还有"},
                      AlarmCase{"pl", "Punkt próbkowania nieosiągalny", "nie wychylił się", "ZATRZYMANO",
                                "mm dalej w"}),
    [](const auto& each) { return std::string(each.param.language); });

/// Every line of a summary that has words is in the language.
TEST(SummaryInLanguage, HasNoLineOfTheEnglishOne) {
  const std::string examples = PROBEWRIGHT_SOURCE_DIR "/examples/";
  static const std::regex words("[a-z]{4,}");
  const auto linesWithWords = [](const std::string& text) {
    std::set<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
      if (std::regex_search(line, words)) lines.insert(line);
    return lines;
  };
  for (const auto& [program, setup] : {std::pair("programs/tool.h", "setups/tool-tnc640.toml"),
                                       std::pair("programs/tools-lathe.mpf", "setups/tools-lathe.toml"),
                                       std::pair("programs/kinematics.h", "setups/kinematics-tnc640.toml"),
                                       std::pair("programs/camera.h", "setups/camera-tnc640.toml"),
                                       std::pair("cookbook/calibrate.h", "cookbook/calibrate.toml")}) {
    const Folder folder;
    const auto summary = [&](const std::string& language) {
      return linesWithWords(probewright({"run", examples + program, "--setup", examples + setup, "--out",
                                         (folder / "out").string(), "--language", language})
                                .output);
    };
    const auto english = summary("en");
    EXPECT_GT(english.size(), 3U) << program;
    for (const char* language : {"de", "ru", "sv", "zh", "pl"}) {
      std::vector<std::string> left;
      std::ranges::set_intersection(english, summary(language), std::back_inserter(left));
      EXPECT_THAT(left, ::testing::IsEmpty()) << program << " in " << language;
    }
  }
}

/// Of the English page of a cycle no line with words is left in another language.
TEST(CycleTexts, DescribeEachCycleInTheLanguage) {
  static const std::regex words("[a-z]{5,}");
  for (const char* cycle : {"421", "451", "1410", "CYCLE977", "CYCLE996"}) {
    std::set<std::string> english;
    std::istringstream page(probewright({"cycles", cycle}).output);
    for (std::string line; std::getline(page, line);)
      if (std::regex_search(line, words)) english.insert(line);
    EXPECT_GT(english.size(), 20U);
    for (const char* language : {"de", "ru", "sv", "zh", "pl"}) {
      std::istringstream other(probewright({"cycles", cycle, "--language", language}).output);
      for (std::string line; std::getline(other, line);)
        EXPECT_FALSE(english.contains(line)) << cycle << " " << language << ": " << line;
    }
  }
}

TEST(CycleTexts, AreThoseOfTheControlInItsLanguage) {
  const auto block = [](const char* cycle, const char* language) {
    return probewright({"cycles", cycle, "--template", "--language", language}).output;
  };
  EXPECT_THAT(block("421", "en"), HasSubstr(";SET-UP CLEARANCE"));
  EXPECT_THAT(block("421", "de"), HasSubstr(";SICHERHEITS-ABST."));
  EXPECT_THAT(block("421", "ru"), HasSubstr(";BEZOPASN.RASSTOYANIE"));
  EXPECT_THAT(block("421", "sv"), HasSubstr(";SAEKERHETSAVSTAAND"));
  EXPECT_THAT(block("421", "zh"), HasSubstr(";安全高度"));
  EXPECT_THAT(block("451", "pl"), HasSubstr(";PUNKTY POMIAROWE OSI A"));
  EXPECT_THAT(block("451", "en"), Not(HasSubstr("PARAMETER")));
  EXPECT_THAT(probewright({"cycles", "412", "--language", "de"}).output, HasSubstr("Bezugspunkt Kreis innen"));
  EXPECT_THAT(probewright({"cycles", "Sicherheitsabstand"}).output, HasSubstr("412"));
  // Of a title and of a summary, which stand in the cycle's own file.
  EXPECT_THAT(probewright({"cycles", "Schnelles Antasten"}).output, StartsWith("441 "));
  EXPECT_THAT(probewright({"cycles", "Szybkie próbkowanie"}).output, StartsWith("441 "));
  EXPECT_THAT(probewright({"cycles", "Nachführung"}).output, HasSubstr("FAST PROBING"));
}

}  // namespace
}  // namespace probewright::app::testing
