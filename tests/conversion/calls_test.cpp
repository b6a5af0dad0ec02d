#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "conversion/sinumerik_cases.hpp"
#include "session/check.hpp"

/// Calls of all cycles of the catalogue, complete or not, and what the page about conversion says of them.
namespace probewright::testing_support {
namespace {

using cycles::CycleDefinition;
using cycles::Parameter;
using cycles::ValueKind;

std::vector<const CycleDefinition*> allCycles() {
  std::vector<const CycleDefinition*> all = cycles::cyclesOf(ControlKind::TNC640);
  for (const ControlKind control : {ControlKind::iTNC530, ControlKind::Sinumerik840Dsl}) {
    for (const CycleDefinition* each : cycles::cyclesOf(control))
      if (std::ranges::find(all, each) == all.end()) all.push_back(each);
  }
  return all;
}

std::string valueOf(const Parameter& parameter) {
  if (parameter.kind == ValueKind::Text) return "\"A\"";
  if (!parameter.choices.empty()) return fmt::format("{}", parameter.choices.front().value);
  if (parameter.standard) return fmt::format("{}", *parameter.standard);
  return fmt::format("{}", std::clamp(1.0, parameter.minimum, parameter.maximum));
}

/// The call with `value` in place of that of the parameter `changed`; an empty one leaves it out.
std::string klartextCall(const CycleDefinition& cycle, const Parameter* changed = nullptr,
                         const std::string& value = {}) {
  std::vector<std::string> lines = {fmt::format("TCH PROBE {} X", cycle.number)};
  for (const Parameter& each : cycle.parameters) {
    if (&each == changed && value.empty()) continue;
    const std::string text = &each == changed ? value : valueOf(each);
    lines.push_back(
        fmt::format("  Q{}={}", each.address, text.front() == '"' || text.front() == '-' ? text : "+" + text));
  }
  return fmt::format("{}\n", fmt::join(lines, " ~\n"));
}

std::string sinumerikCallOf(const CycleDefinition& cycle, const Parameter* changed = nullptr,
                            const std::string& value = {}) {
  std::vector<std::string> places(cycle.parameters.size());
  for (const Parameter& each : cycle.parameters)
    places[each.address] = &each == changed ? value : valueOf(each);
  return fmt::format("{}({})\n", cycle.name, fmt::join(places, ","));
}

/// What `check` finds in the program; what it accepts is converted to something that its control accepts, or listed.
bool accepted(const std::string& text, ProgramLanguage from) {
  const bool sinumerik = from == ProgramLanguage::Sinumerik;
  const std::string name = sinumerik ? "BENCH.MPF" : "BENCH.H";
  const auto program = session::programOf(name, text, from);
  if (hasErrors(session::mistakesOf(*program, name, from))) return false;
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    const conversion::Conversion there = converted(text, from, control);
    EXPECT_FALSE(hasErrors(there.mistakes)) << text;
    const auto written = session::programOf("OUT", there.text, otherLanguage(from));
    const Diagnostics mistakes = session::checkProgram(*written, sinumerik ? control : ControlKind::Sinumerik840Dsl);
    EXPECT_TRUE(!hasErrors(mistakes) || !there.notCarriedOver.empty()) << format(mistakes.front()) << "\n"
                                                                       << text << there.text;
  }
  return true;
}

TEST(ConvertCalls, IncompleteAndWrongOnesAreMistakes) {
  int calls = 0, good = 0;
  for (const CycleDefinition* cycle : allCycles()) {
    const bool sinumerik = cycle->name.starts_with("CYCLE");
    const ProgramLanguage from = sinumerik ? ProgramLanguage::Sinumerik : ProgramLanguage::Klartext;
    if (!sinumerik && (cycle->number < 400 || cycle->family == cycles::CycleFamily::Tool))
      continue;  // words of their own
    const auto text = [&](const Parameter* changed, const std::string& value) {
      return sinumerik ? "G17 G90 G710\nT1 M6 D1\n" + sinumerikCallOf(*cycle, changed, value) + "M30\n"
                       : klartextProgram(klartextCall(*cycle, changed, value));
    };
    good += accepted(text(nullptr, {}), from) ? 1 : 0;
    for (const Parameter& each : cycle->parameters) {
      SCOPED_TRACE(fmt::format("{} {}", cycle->name, each.name));
      for (const char* value : {"", "\"WRONG\"", "+", "-99999999", "99999999"}) {
        ++calls;
        const bool taken = accepted(text(&each, value), from);
        const std::string_view wrong = value;
        const bool words = each.kind == ValueKind::Text || each.kind == ValueKind::NumberOrText ||
                           each.kind == ValueKind::Feed;  // FMAX
        if (wrong == "\"WRONG\"" && !words) {
          EXPECT_FALSE(taken);
        }
        if (wrong == "+") {
          EXPECT_FALSE(taken);
        }
        if (wrong.empty() && !sinumerik && each.required() && each.controls.contains(ControlKind::TNC640)) {
          EXPECT_FALSE(taken);
        }
      }
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(calls, 3000);
  EXPECT_GT(good, 20);
}

/// What is written for the iTNC 530 has nothing but what that control knows.
/// Older programs and posts give them in variables.
TEST(ConvertCalls, CallsWithoutArgumentsAreNotGuessed) {
  for (const std::string cycle : {"CYCLE977", "CYCLE978", "CYCLE979", "CYCLE998", "CYCLE961", "CYCLE976", "CYCLE971"}) {
    SCOPED_TRACE(cycle);
    const conversion::Conversion conversion = toKlartext("T1 M6 D1\n_MVAR=1 _SETVAL=32 _KNUM=1\n" + cycle + "\nM30\n");
    EXPECT_THAT(conversion.text, ::testing::Not(::testing::HasSubstr("TCH PROBE")));
    EXPECT_THAT(conversion.text, ::testing::HasSubstr("; NOT CARRIED OVER: " + cycle + "\n"));
    const auto lost =
        std::ranges::find(conversion.notCarriedOver, 3U, [](const Diagnostic& each) { return each.place.line; });
    ASSERT_NE(lost, conversion.notCarriedOver.end());
    EXPECT_THAT(lost->message, ::testing::HasSubstr(cycle + " without arguments takes them from _MVAR"));
  }
}

TEST(ConvertCalls, AllSinumerikCasesPassTheCheckOfTheElderControl) {
  Dice dice(771);
  for (const sinumerik_programs::Case& each : sinumerik_programs::cases()) {
    SCOPED_TRACE(each.name);
    for (int world = 0; world < 8; ++world) {
      PlantedPart part = plant(dice, ControlKind::iTNC530, each.misplaced, each.skewed);
      const std::string text = "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + each.blocks(dice, part) + "M30\n";
      const conversion::Conversion there = converted(text, ProgramLanguage::Sinumerik, ControlKind::iTNC530);
      const auto written = session::programOf("OUT.H", there.text, ProgramLanguage::Klartext);
      const Diagnostics mistakes = session::checkProgram(*written, ControlKind::iTNC530);
      EXPECT_FALSE(hasErrors(mistakes)) << format(mistakes.front()) << there.text;
      for (const Diagnostic& listed : there.notCarriedOver)
        EXPECT_EQ(listed.message.find("is refused by"), std::string::npos) << listed.message;
    }
  }
}

// ---- docs/conversion.md ----

std::string page() {
  std::ifstream file(PROBEWRIGHT_SOURCE_DIR "/docs/conversion.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The lines of the page that contain the text.
std::string rowWith(const std::string& text) {
  std::istringstream lines(page());
  for (std::string line; std::getline(lines, line);)
    if (line.find(text) != std::string::npos) return line;
  ADD_FAILURE() << "docs/conversion.md does not say: " << text;
  return {};
}

/// The numbers behind `letter`, with those in between where the text says "M0 to M9".
std::set<int> numbersIn(const std::string& text, const std::string& letter) {
  std::set<int> numbers;
  const std::regex range(letter + R"((\d+)(?: to )" + letter + R"((\d+))?)");
  for (std::sregex_iterator match(text.begin(), text.end(), range), end; match != end; ++match) {
    const int first = std::stoi((*match)[1]), last = (*match)[2].matched ? std::stoi((*match)[2]) : first;
    for (int number = first; number <= last; ++number)
      numbers.insert(number);
  }
  return numbers;
}

TEST(ConvertPage, NamesTheMFunctionsThatAreCarriedOver) {
  for (const bool heidenhain : {true, false}) {
    const std::string begin = heidenhain ? "M functions but for M0 to M9, M13" : "M functions but for M0 to M9, M19";
    std::string row = rowWith(begin);
    row = row.substr(0, row.find(heidenhain ? "M126" : ";"));
    const std::set<int> carried = numbersIn(row, "M");
    ASSERT_GT(carried.size(), 10U);
    for (int number = 0; number < 200; ++number) {
      SCOPED_TRACE(fmt::format("M{}", number));
      const std::string text = heidenhain ? klartextProgram(fmt::format("L X+1 R0 FMAX M{}\n", number))
                                          : fmt::format("G17 G90\nT1\nM{}\nM30\n", number);
      const ProgramLanguage from = heidenhain ? ProgramLanguage::Klartext : ProgramLanguage::Sinumerik;
      const auto program = session::programOf("BENCH.H", text, from);
      if (hasErrors(session::mistakesOf(*program, "BENCH.H", from))) continue;
      const conversion::Conversion there = converted(text, from);
      EXPECT_EQ(there.notCarriedOver.empty(), carried.contains(number)) << there.text;
    }
  }
}

TEST(ConvertPage, NamesTheFunctionsThatAreLeftOut) {
  const std::string row = rowWith("say how a path is travelled");
  std::istringstream words(std::regex_replace(row, std::regex(","), " "));
  int functions = 0;
  for (std::string word; words >> word;) {
    if (word == "say") break;
    if (word == "and") continue;
    ++functions;
    const conversion::Conversion there = toKlartext("G17 G90\n" + word + "\nG0 X1\nM30\n");
    EXPECT_TRUE(there.notCarriedOver.empty()) << word;
  }
  EXPECT_GT(functions, 5);
}

/// Each touch probe cycle stands on the page; those without a twin are listed.
TEST(ConvertPage, NamesAllTouchProbeCycles) {
  const std::string text = page();
  const std::size_t without = text.find("### Without a twin"), statements = text.find("These statements have no twin");
  ASSERT_LT(without, statements);
  std::string twins = text.substr(text.find("## Measuring tasks"), without - text.find("## Measuring tasks"));
  std::string lost;
  std::istringstream rows(text.substr(without, statements - without));
  for (std::string row; std::getline(rows, row);)
    if (row.starts_with("| ")) lost += row.substr(0, row.find('|', 2)) + "\n";
  const std::set<int> lostCycles = numbersIn(lost, "");
  for (const CycleDefinition* cycle : allCycles()) {
    if (cycle->name.starts_with("CYCLE") || cycle->family == cycles::CycleFamily::Tool) continue;
    SCOPED_TRACE(cycle->name);
    const bool named = std::regex_search(twins, std::regex(fmt::format("\\b{}\\b", cycle->number)));
    EXPECT_TRUE(named || lostCycles.contains(cycle->number));
    if (cycle->number < 400 || named) continue;
    const std::string call = klartextProgram(klartextCall(*cycle));
    const conversion::Conversion there = toSinumerik(call);
    EXPECT_FALSE(there.notCarriedOver.empty()) << there.text;
    EXPECT_NE(there.text.find("; NOT CARRIED OVER: TCH PROBE"), std::string::npos) << there.text;
  }
}

TEST(ConvertPage, TellsTheRowsOfPresetsAndErrors) {
  rowWith("| row 1 to 4 of the preset table, Q339, Q305 | G54 to G57, S_KNUM = 10001 to 10004 |");
  rowWith("| row 5 to 99 | G505 to G599, S_KNUM = 10005 to 10099 |");
  for (int row = 0; row <= 99; ++row) {
    const conversion::Conversion there =
        toSinumerik(klartextProgram(fmt::format("CYCL DEF 247 PRESET ~\n  Q339=+{}\n", row)));
    const std::string code = row == 0 ? "G599" : row < 5 ? fmt::format("G{}", 53 + row) : fmt::format("G{}", 500 + row);
    EXPECT_NE(there.text.find("\n" + code + "\n"), std::string::npos) << there.text;
    EXPECT_TRUE(there.notCarriedOver.empty());
    const conversion::Conversion back = toKlartext("G17 G90\n" + code + "\nG0 X1\nM30\n");
    EXPECT_NE(back.text.find(fmt::format("Q339=+{} ", row == 99 ? 0 : row)), std::string::npos) << back.text;
  }
  rowWith("SETAL: 1000 is 65000");
  for (const int error : {0, 17, 299, 1000, 1303, 1999}) {
    const int alarm = error < 1000 ? error + 65000 : error + 64000;
    const conversion::Conversion there = toSinumerik(klartextProgram(fmt::format("FN 14: ERROR = {}\n", error)));
    EXPECT_NE(there.text.find(fmt::format("SETAL({})", alarm)), std::string::npos) << there.text;
  }
  rowWith("| `ID50 NR1` to `NR6`: L, R, R2, DL, DR, DR2 | `$TC_DP3`, `6`, `7`, `12`, `15`, `16` of the first edge |");
  const int data[] = {3, 6, 7, 12, 15, 16};
  for (int number = 1; number <= 6; ++number) {
    const conversion::Conversion there =
        toSinumerik(klartextProgram(fmt::format("FN 18: SYSREAD Q1 = ID50 NR{} IDX5\n", number)));
    EXPECT_NE(there.text.find(fmt::format("R1=$TC_DP{}[5,1]", data[number - 1])), std::string::npos) << there.text;
    const conversion::Conversion back = toKlartext(fmt::format("G17 G90\nR1=$TC_DP{}[5,1]\nM30\n", data[number - 1]));
    EXPECT_NE(back.text.find(fmt::format("ID50 NR{} IDX5", number)), std::string::npos) << back.text;
  }
}

}  // namespace
}  // namespace probewright::testing_support
