#include "words/words.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cmath>
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
#include "words/cycle_words.hpp"

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

/// Descriptions of the catalogue that are names of axes and the like in every language.
const std::set<std::string, std::less<>> sameEverywhere = {"X", "Y", "Z", "D"};

TEST(Words, EveryDescriptionOfTheCatalogueHasItsWords) {
  std::set<std::string, std::less<>> all;
  for (const control::ControlKind kind : control::allControlKinds) {
    for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(kind)) {
      all.emplace(cycle->summary);
      all.emplace(cycles::nameOf(cycle->family));
      for (const cycles::Parameter& parameter : cycle->parameters) {
        all.emplace(parameter.meaning);
        for (const cycles::Choice& choice : parameter.choices)
          all.emplace(choice.meaning);
        for (const cycles::CodeDigit& digit : parameter.digits) {
          all.emplace(digit.meaning);
          for (const cycles::Choice& choice : digit.choices)
            all.emplace(choice.meaning);
        }
      }
    }
  }
  all.erase("");
  EXPECT_GT(all.size(), 600U);
  for (const std::string& english : all) {
    if (sameEverywhere.contains(english)) continue;
    const std::vector<std::string> words = inOtherLanguages(english);
    ASSERT_EQ(words.size(), others.size()) << english;
    for (std::size_t i = 0; i < words.size(); ++i) {
      EXPECT_NE(words[i], "") << english;
      EXPECT_EQ(words[i], ofCatalogue(others[i], english));
    }
    // Russian and Chinese have letters of their own.
    const auto foreign = [](const std::string& text) {
      return std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
    };
    EXPECT_TRUE(foreign(words[1])) << words[1];
    EXPECT_TRUE(foreign(words[3])) << words[3];
  }
  // Of what the digits of a code choose a report holds the words as well.
  int codes = 0;
  for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(control::ControlKind::Sinumerik840Dsl)) {
    for (const cycles::Parameter& parameter : cycle->parameters) {
      for (const cycles::CodeDigit& digit : parameter.digits) {
        for (const cycles::Choice& choice : digit.choices) {
          const std::string text = cycles::codeText(parameter, choice.value * std::pow(10, digit.place - 1));
          if (text.empty()) continue;
          const auto words = inOtherLanguages(fmt::format("{}: {}", parameter.meaning, text));
          ASSERT_EQ(words.size(), others.size()) << cycle->name << ' ' << parameter.name << ": " << text;
          EXPECT_THAT(words[0], ::testing::HasSubstr(ofCatalogue(others[0], choice.meaning))) << text;
          ++codes;
        }
      }
    }
  }
  EXPECT_GT(codes, 200);
  const auto variant =
      inOtherLanguages("measuring variant: outside diameter, correct the tool, with reversal of the turning spindle");
  EXPECT_EQ(variant.at(0), "Messvariante: Au\u00dfendurchmesser, Werkzeug korrigieren, mit Umschlag der Drehspindel");
  EXPECT_EQ(variant.at(3),
            "\u6d4b\u91cf\u53d8\u4f53\uff1a\u5916\u5f84\uff0c\u4fee\u6b63\u5200\u5177\uff0c\u8f66\u524a\u4e3b\u8f74"
            "\u53cd\u8f6c");
  EXPECT_EQ(inOtherLanguages("tool offset to correct: D 1, not inverted, length 1").at(0),
            "zu korrigierende Werkzeugkorrektur: D 1, nicht invertiert, L\u00e4nge 1");
  EXPECT_TRUE(inOtherLanguages("measuring variant: what nobody knows").empty());
  // Numbers and names of data are those of the English text.
  static const std::regex data(
      R"((S_[A-Z]+[0-9]*|_AMODE|MP[0-9]+(\.[0-9])?|SD [0-9]+|Q[0-9]{3}|QS[0-9]+|DATA450\.KD|TOOL\.T))");
  json table = tableFile("cycles.json");
  for (const std::string& english : all) {
    if (!table.contains(english) && !sameEverywhere.contains(english)) table[english] = inOtherLanguages(english);
  }
  for (const auto& [english, translations] : table.items()) {
    for (const json& translation : translations) {
      EXPECT_EQ(placesOf(translation), placesOf(english)) << translation;
      const std::string text = translation;
      for (std::sregex_iterator it(english.begin(), english.end(), data), end; it != end; ++it)
        EXPECT_THAT(text, ::testing::HasSubstr(it->str())) << english;
    }
  }
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

/// What alarms of the cycles say beyond their names and numbers, as it stands in the sources.
std::set<std::string> sentencesOfAlarms() {
  static const std::regex raised(
      R"re((?:\bAlarm\(\s*"[^"]*",\s*|\b(?:alarm|fail|refuse)\((?:[^"();]|\([^()]*\)){0,80}(?:"[A-Z][^"]*",\s*)?)(?:fmt::format\(\s*)?((?:"(?:[^"\\]|\\.)*"\s*)+))re");
  static const std::regex literal(R"re("((?:[^"\\]|\\.)*)")re"), value(R"(\{[^}]*\})"), quote(R"(\\")");
  std::set<std::string> sentences;
  for (const char* folder : {"src/cycles/heidenhain", "src/cycles/sinumerik", "src/probing"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(source / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = textOf(entry.path());
      for (std::sregex_iterator it(text.begin(), text.end(), raised), end; it != end; ++it) {
        const std::string pieces = (*it)[1];
        std::string sentence;
        for (std::sregex_iterator piece(pieces.begin(), pieces.end(), literal); piece != end; ++piece)
          sentence += (*piece)[1];
        sentence = std::regex_replace(sentence, quote, "\"");
        // Where the tip stopped is a sentence of its own.
        if (sentence.ends_with("the {}"))
          sentence.replace(sentence.size() - 2, 2,
                           "tool tip stopped at X+1.000 Y+2.000 Z+3.000 of the active workpiece system");
        if (sentence.ends_with(": ")) sentence += "7";
        if (std::regex_search(sentence, std::regex("[a-z]{3} ")))
          sentences.insert(std::regex_replace(sentence, value, "7"));
      }
    }
  }
  sentences.erase("not ready");  // a word for the record
  return sentences;
}

TEST(Words, WhatAlarmsOfTheCyclesSayHasItsWords) {
  const std::set<std::string> sentences = sentencesOfAlarms();
  EXPECT_GT(sentences.size(), 200U);
  EXPECT_TRUE(sentences.contains("The two centres coincide"));
  for (const std::string& english : sentences) {
    for (const DialogLanguage language : others) {
      const std::string text = translated(language, english);
      EXPECT_NE(text, english) << code(language);
      EXPECT_EQ(std::ranges::count(text, '{'), 0) << text;
    }
  }
  // Every entry has each of its places in each language.
  const json table = tableFile("alarms.json");
  for (const auto& [english, translations] : table.items()) {
    ASSERT_EQ(translations.size(), others.size()) << english;
    for (const json& translation : translations)
      EXPECT_EQ(placesOf(translation), placesOf(english)) << translation;
  }
}

/// What a cycle's file says of it in other languages: whoever asks finds it, and it contradicts nobody.
TEST(Words, ACyclesOwnWordsAreFound) {
  const json common = tableFile("cycles.json"), phrases = tableFile("phrases.json"), alarms = tableFile("alarms.json");
  std::map<std::string, std::array<std::string, others.size()>> all;
  for (const control::ControlKind kind : control::allControlKinds) {
    for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(kind)) {
      for (const cycles::OwnWords& own : cycle->words) {
        const std::string english(own.english);
        const std::array words{std::string(own.german), std::string(own.russian), std::string(own.swedish),
                               std::string(own.chinese), std::string(own.polish)};
        for (const json* table : {&common, &phrases, &alarms})
          EXPECT_FALSE(table->contains(english)) << "twice: " << english;
        EXPECT_EQ(all.emplace(english, words).first->second, words) << "two cycles differ: " << english;
        for (std::size_t i = 0; i < others.size(); ++i) {
          EXPECT_EQ(placesOf(words[i]), placesOf(english)) << words[i];
          EXPECT_EQ(ofCatalogue(others[i], english), words[i]);
          EXPECT_EQ(phrase(others[i], english), words[i]);
        }
      }
    }
  }
  EXPECT_GE(all.size(), 12U);
  EXPECT_EQ(phrase(DialogLanguage::German, "FAST PROBING"), "Schnelles Antasten");
  EXPECT_EQ(ofCatalogue(DialogLanguage::Swedish, "tracking of the probe"), "spårning av avkännaren");
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
        const std::string label(result.meaning.label);
        EXPECT_EQ(label, english) << "measured or attainable: two rows of a report differ by it";
        const std::string axis = english.substr(at + std::string("standard deviation of ").size(), 1);
        static const std::map<DialogLanguage, std::string> words = {{DialogLanguage::German, "Standardabweichung"},
                                                                    {DialogLanguage::Russian, "среднеквадратическое"},
                                                                    {DialogLanguage::Swedish, "standardavvikelse"},
                                                                    {DialogLanguage::Chinese, "标准偏差"},
                                                                    {DialogLanguage::Polish, "odchylenie standardowe"}};
        for (const auto& [language, word] : words) {
          for (const std::string& text :
               {meaning(language, result.kind, english), characteristic(language, result.kind.of, label)}) {
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
