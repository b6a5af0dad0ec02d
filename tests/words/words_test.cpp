#include "words/words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cycles/catalogue.hpp"
#include "cycles/sinumerik/alarms.hpp"
#include "cycles/sinumerik/context.hpp"

/// What people read in six languages: nothing that a control shows is left out, and no value is lost in a sentence.
namespace probewright::words {
namespace {

namespace fs = std::filesystem;
using control::DialogLanguage;
using nlohmann::json;

constexpr std::array others = {DialogLanguage::German, DialogLanguage::Russian, DialogLanguage::Swedish,
                               DialogLanguage::Chinese, DialogLanguage::Polish};

const fs::path source = PROBEWRIGHT_SOURCE_DIR;

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

json tableFile(const std::string& name) { return json::parse(textOf(source / "web/src/texts" / name)); }

/// {0}, {name}.. with how often each stands in the text.
std::map<std::string, int> placesOf(const std::string& text) {
  static const std::regex place(R"(\{\w+\})");
  std::map<std::string, int> places;
  for (std::sregex_iterator it(text.begin(), text.end(), place), end; it != end; ++it)
    ++places[it->str()];
  return places;
}

TEST(Words, EveryTitleOfACycleHasItsWords) {
  for (const control::ControlKind kind : control::allControlKinds) {
    for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(kind)) {
      for (const DialogLanguage language : others)
        EXPECT_NE(phrase(language, cycle->title), cycle->title) << code(language);
    }
  }
}

TEST(Words, TheFeaturesOfSinumerikCyclesHaveTheirWords) {
  int features = 0;
  for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(control::ControlKind::Sinumerik840Dsl)) {
    if (cycle->parameters.empty() || cycle->parameters.front().digits.empty()) continue;
    const cycles::CodeDigit& digit = cycle->parameters.front().digits.front();
    if (digit.meaning != "feature") continue;
    for (const cycles::Choice& choice : digit.choices) {
      ++features;
      std::string title(choice.meaning);
      title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
      for (const DialogLanguage language : others) {
        EXPECT_NE(translated(language, title), title) << code(language);
        EXPECT_NE(translated(language, title + " 30 x 20"), title + " 30 x 20") << code(language);
      }
    }
  }
  EXPECT_GT(features, 10);
  EXPECT_EQ(translated(DialogLanguage::German, "Rectangular pocket 30 x 20"), "Rechtecktasche 30 x 20");
  EXPECT_EQ(phrase(DialogLanguage::German, "Hole 40"), "Hole 40") << "a program may say so";
}

/// What a result is, where no quantity says it: an own phrase in each language.
TEST(Words, EveryResultOfACycleHasItsWords) {
  int without = 0;
  for (const control::ControlKind kind :
       {control::ControlKind::TNC640, control::ControlKind::iTNC530, control::ControlKind::Sinumerik840Dsl}) {
    for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(kind)) {
      for (const cycles::ResultDefinition& result : cycle->results) {
        if (result.kind.of.quantity != control::Quantity::None) continue;
        const std::string english = result.meaning.whole();
        if (english.empty()) continue;
        ++without;
        for (const DialogLanguage language : others)
          EXPECT_NE(meaning(language, result.kind, english), english) << code(language);
      }
    }
  }
  EXPECT_GT(without, 30);
}

/// Tasks that title a call, the ready-made machines, and what stands before the values of entries.
TEST(Words, WhatTitlesACallAndNamesAnEntryHasItsWords) {
  std::vector<std::string> all = {"row 1, column X",   "calibration data", "TT centre, X", "TT radius, minor axis",
                                  "effective length",  "axis C",           "probe data 1", "tool probe data 2",
                                  "datum 3 of ZERO.D", "length 2",         "record 4",     "image 7"};
  for (const char* name : {"CYCLE971", "CYCLE982", "CYCLE996"}) {
    for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(control::ControlKind::Sinumerik840Dsl)) {
      if (cycle->name != name) continue;
      for (const cycles::Choice& choice : cycle->parameters.front().digits.front().choices) {
        all.emplace_back(choice.meaning);
        all.back().front() = static_cast<char>(std::toupper(static_cast<unsigned char>(all.back().front())));
      }
    }
  }
  for (const fs::directory_entry& file : fs::directory_iterator(source / "machines")) {
    const std::string text = textOf(file.path());
    const std::size_t begin = text.find("\nname = \"") + 9;
    all.push_back(text.substr(begin, text.find('"', begin) - begin));
  }
  EXPECT_GT(all.size(), 25U);
  for (const std::string& english : all)
    for (const DialogLanguage language : others)
      EXPECT_NE(phrase(language, english), english) << code(language);
}

TEST(Words, EveryAlarmOfTheMeasuringCyclesHasItsWords) {
  EXPECT_GT(cycles::sinumerik::alarmNumbers().size(), 30U);
  for (const int number : cycles::sinumerik::alarmNumbers()) {
    const std::string_view text = cycles::sinumerik::alarmText(number);
    for (const DialogLanguage language : others)
      EXPECT_NE(phrase(language, text), text) << number << " " << code(language);
  }
  // A HEIDENHAIN alarm has its name where it is raised.
  static const std::regex raised(R"re((?:Alarm\(|fail\([^;]{0,40}?)\s*"([A-Z][^"]*)",)re");
  std::set<std::string> names;
  for (const char* folder : {"src/cycles/heidenhain", "src/probing", "src/control/heidenhain"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source / folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string text = textOf(entry.path());
      for (std::sregex_iterator it(text.begin(), text.end(), raised), end; it != end; ++it)
        names.insert((*it)[1]);
    }
  }
  EXPECT_GT(names.size(), 50U);
  EXPECT_TRUE(names.contains("Touch point inaccessible"));
  for (const std::string& name : names) {
    for (const DialogLanguage language : others)
      EXPECT_NE(phrase(language, name), name) << code(language);
  }
}

TEST(Words, EveryLanguageHasTheSamePlacesForValues) {
  const json english = tableFile("en.json");
  const auto anyForm = [](const json& entry) { return entry.is_string() ? entry : entry.at("other"); };
  for (const char* name : {"de.json", "ru.json", "sv.json", "zh.json", "pl.json"}) {
    const json table = tableFile(name);
    EXPECT_EQ(table.size(), english.size());
    for (const auto& [key, entry] : english.items()) {
      ASSERT_TRUE(table.contains(key)) << name << " " << key;
      EXPECT_EQ(table.at(key).is_string(), entry.is_string()) << name << " " << key;
      EXPECT_EQ(placesOf(anyForm(table.at(key))), placesOf(anyForm(entry))) << name << " " << key;
    }
  }
  const json phrases = tableFile("phrases.json");
  for (const auto& [phrase, translations] : phrases.items()) {
    ASSERT_EQ(translations.size(), others.size()) << phrase;
    for (const json& translation : translations)
      EXPECT_EQ(placesOf(translation), placesOf(phrase)) << translation;
  }
}

TEST(Words, SentencesKeepTheirValues) {
  const std::string message =
      "Touch point inaccessible: The stylus was not deflected within 10.000 mm; the tool tip stopped at X+50.000 "
      "Y+0.000 "
      "Z-27.000 of the active workpiece system";
  for (const DialogLanguage language : others) {
    const std::string text = translated(language, message);
    EXPECT_THAT(text, ::testing::HasSubstr("10.000 "));
    EXPECT_THAT(text, ::testing::HasSubstr("X+50.000 Y+0.000 Z-27.000"));
    EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("stopped")));
    EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("Touch point")));
  }
  const std::string german = translated(
      DialogLanguage::German,
      "Touch probe deflected: the stylus tip of tool 1 \"PROBE\" touched the fixture \"support plate\" at X-0.000 "
      "Y-35.000 Z-462.000 on the table; the tool tip stopped at X+59.988 Y+5.007 Z+7.778 of the active workpiece "
      "system");
  for (const char* words : {" the ", "touched", "stopped", " of "})
    EXPECT_THAT(german, ::testing::Not(::testing::HasSubstr(words)));
  EXPECT_EQ(translated(DialogLanguage::German, "Preset 3 activated"), "Bezugspunkt 3 aktiviert");
  EXPECT_EQ(translated(DialogLanguage::Swedish, "Tolerance exceeded: Scrap: diameter 40.1000 (+0.1000)"),
            "Tolerans överskriden: Skrot: diameter 40.1000 (+0.1000)");
  EXPECT_EQ(translated(DialogLanguage::English, message), message);
}

TEST(Words, WhatNoTableKnowsStays) {
  for (const DialogLanguage language : others) {
    EXPECT_EQ(translated(language, "my own words"), "my own words");
    EXPECT_EQ(translated(language, ": "), ": ");
    EXPECT_EQ(translated(language, "a: b: {0}"), "a: b: {0}");
    EXPECT_EQ(phrase(language, "Collision: a word of mine"), "Collision: a word of mine");
    EXPECT_EQ(translated(language, ""), "");
  }
}

TEST(Words, CountAsTheLanguageCounts) {
  const auto cycles = [](DialogLanguage language, std::size_t n) { return counted(language, "cycles", n); };
  EXPECT_EQ(cycles(DialogLanguage::English, 1), "1 cycle");
  EXPECT_EQ(cycles(DialogLanguage::English, 0), "0 cycles");
  EXPECT_EQ(cycles(DialogLanguage::German, 2), "2 Zyklen");
  EXPECT_EQ(cycles(DialogLanguage::Russian, 1), "1 цикл");
  EXPECT_EQ(cycles(DialogLanguage::Russian, 3), "3 цикла");
  EXPECT_EQ(cycles(DialogLanguage::Russian, 5), "5 циклов");
  EXPECT_EQ(cycles(DialogLanguage::Russian, 11), "11 циклов");
  EXPECT_EQ(cycles(DialogLanguage::Russian, 21), "21 цикл");
  EXPECT_EQ(cycles(DialogLanguage::Polish, 21), "21 cykli");
  EXPECT_EQ(cycles(DialogLanguage::Polish, 22), "22 cykle");
  EXPECT_EQ(cycles(DialogLanguage::Chinese, 1), "1 个循环");
}

TEST(Words, SayWhatWasMeasured) {
  using control::Along;
  using control::Quantity;
  using control::Role;
  const control::Characteristic centre{Quantity::Centre, Along::First};
  EXPECT_EQ(characteristic(DialogLanguage::English, centre, "centre, main axis"), "centre, main axis");
  EXPECT_EQ(characteristic(DialogLanguage::German, centre, "centre, main axis"), "Mitte, Hauptachse");
  EXPECT_EQ(meaning(DialogLanguage::German, {Role::Actual, {Quantity::Diameter}}, "actual diameter"),
            "Istwert, Durchmesser");
  EXPECT_EQ(meaning(DialogLanguage::German, {Role::Status, {}}, "status of the tool"), "status of the tool");
}

/// The rotary axes of cycles 450 to 453: each number says of which axis it is and what.
TEST(Words, StandardDeviationsOfRotaryAxesSayTheirAxis) {
  int checked = 0;
  for (const control::ControlKind kind : {control::ControlKind::TNC640, control::ControlKind::iTNC530}) {
    for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(kind)) {
      for (const cycles::ResultDefinition& result : cycle->results) {
        const std::string english = result.meaning.whole();
        const std::size_t at = english.find("standard deviation of ");
        if (at == std::string::npos) continue;
        ++checked;
        const std::string axis = english.substr(at + std::string("standard deviation of ").size(), 1);
        static const std::map<DialogLanguage, std::string> words = {{DialogLanguage::German, "Standardabweichung"},
                                                                    {DialogLanguage::Russian, "среднеквадратическое"},
                                                                    {DialogLanguage::Swedish, "standardavvikelse"},
                                                                    {DialogLanguage::Chinese, "标准偏差"},
                                                                    {DialogLanguage::Polish, "odchylenie standardowe"}};
        for (const auto& [language, word] : words) {
          for (const std::string& text : {meaning(language, result.kind, english),
                                          characteristic(language, result.kind.of, english.substr(at))}) {
            EXPECT_NE(text.find(word), std::string::npos) << text;
            EXPECT_NE(text.find(axis), std::string::npos) << text;
            EXPECT_NE(text.find("-1"), std::string::npos) << text;
          }
        }
      }
    }
  }
  EXPECT_GE(checked, 12);
}

}  // namespace
}  // namespace probewright::words
