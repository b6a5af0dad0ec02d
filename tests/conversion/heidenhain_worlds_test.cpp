#include "conversion/pattern_cases.hpp"
#include "conversion/settings.hpp"

/// Klartext programs with one touch probe cycle, their SINUMERIK twins and the twins' twins, in random worlds; on both
/// controls, in both units, with each tool axis.
namespace probewright::testing_support::heidenhain {
namespace {

/// The program without the parameters that the control does not have; there circles are touched four times. Empty if
/// the control lacks a cycle.
std::string forControl(const std::string& program, ControlKind control) {
  std::string text;
  const cycles::CycleDefinition* cycle = nullptr;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("TCH PROBE ")) cycle = cycles::heidenhainCycle(std::stoi(line.substr(10)));
    if (cycle != nullptr && !cycle->controls.contains(control)) return {};
    const bool continued = line.ends_with('~');
    if (line.starts_with("  Q") && cycle != nullptr) {
      const auto number = static_cast<std::uint32_t>(std::stoi(line.substr(3)));
      const cycles::Parameter* known = cycle->parameter(number);
      if (known != nullptr && !known->controls.contains(control)) {
        if (!continued) text.erase(text.rfind(" ~"), 2);  // it was the last one
        continue;
      }
      if (number == 247 && std::abs(std::stod(line.substr(7))) > 90)
        line = "  Q247=+80 ;STEP" + std::string(continued ? " ~" : "");
    }
    text += line + '\n';
  }
  return text;
}

/// The program in inches: all lengths, as the catalogue knows them, divided by 25.4.
std::string inInches(const std::string& program) {
  std::string text;
  const cycles::CycleDefinition* cycle = nullptr;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line); text += line + '\n') {
    if (line.starts_with("TCH PROBE ")) cycle = cycles::heidenhainCycle(std::stoi(line.substr(10)));
    const auto inch = [](const std::string& number) { return fmt::format("{:+.9f}", std::stod(number) / 25.4); };
    if (line.starts_with("  Q") && cycle != nullptr) {
      static const std::regex parameter(R"(^  Q(\d+)=([-+][\d.]+))");
      line = replaced(line, parameter, [&](const std::smatch& match) {
        const auto number = static_cast<std::uint32_t>(std::stoi(match[1]));
        const cycles::Parameter* known = cycle->parameter(number);
        const bool length =
            known != nullptr && (known->kind == cycles::ValueKind::Length || (number >= 1100 && number <= 1108));
        return length ? fmt::format("  Q{}={}", number, inch(match[2])) : match[0].str();
      });
    } else if (line.starts_with("L ")) {
      // Degrees are no inches: the program drives to fewer of them.
      static const std::regex angle(R"(Q(150|158|159|961|962|964|994)\b)");
      line = replaced(line, angle, [&](const std::smatch& match) {
        const std::string own = fmt::format("Q{}", 70 + std::stoi(match[1]) % 20);
        text += fmt::format("{} = {} / 25\n", own, match[0].str());
        return own;
      });
      static const std::regex word(R"(([XYZ])([-+][\d.]+))");
      line = replaced(line, word, [&](const std::smatch& match) { return match[1].str() + inch(match[2]); });
    } else if (line.starts_with("Q50 = 100")) {
      line = "Q50 = 4" + line.substr(9);
    } else if (line.starts_with("Q62 =")) {  // not several inches
      line = "Q62 = (" + line.substr(6) + ") / 25";
    }
  }
  return std::regex_replace(text, std::regex("BENCH MM"), "BENCH INCH");
}

/// X, Y, Z become the main, minor and tool axis of another tool axis: in the program, and in the world the probe stands
/// in an angle head.
std::string turned(const std::string& program, char toolAxis) {
  std::string text;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line); text += line + '\n') {
    if (line.starts_with("TOOL CALL")) line.back() = toolAxis;
    if (line.starts_with("L ")) {
      static const std::regex word(R"([XYZ](?=[-+]))");
      line = replaced(line, word, [&](const std::smatch& match) {
        return std::string(1, turnedAxis(match[0].str()[0], toolAxis));
      });
    }
  }
  return text;
}
std::string nameOf(const ::testing::TestParamInfo<std::tuple<Case, Setting>>& test) {
  return std::get<Case>(test.param).name + std::get<Setting>(test.param).name;
}

class AnyWorld : public ::testing::TestWithParam<std::tuple<Case, Setting>> {};

TEST_P(AnyWorld, MeasuresAndCorrectsTheSame) {
  const auto& [each, setting] = GetParam();
  // Space angles have no twin in other planes than that of X and Y.
  const bool comparable = setting.toolAxis == 'Z' || each.name != "Cycle1420";
  const auto reads = comparable ? each.reads : std::vector<std::string>();
  Dice dice(static_cast<unsigned>(std::hash<std::string>()(each.name)));
  for (int world = 0; world < setting.worlds; ++world) {
    PlantedPart part = plant(dice, setting.control, each.misplaced, each.skewed);
    const std::string block = each.block(dice, part);
    SCOPED_TRACE(fmt::format("world {}", world));
    part.bench.knows(5, "MILL", 80, 5);
    std::string program = klartextProgram(block + driveTo(reads) + (each.inspects ? driveByStatus : std::string()));
    program = forControl(program, setting.control);
    if (program.empty()) return;  // the control has no such cycle
    if (setting.inch) program = inInches(program);
    if (setting.toolAxis != 'Z') {
      program = turned(program, setting.toolAxis);
      turn(part, setting.toolAxis);
    }
    const Twin original = runKlartext(program, part);
    ASSERT_TRUE(ranWhole(original));

    const Twin there = withoutVerdict(runConverted(original, part));
    ASSERT_TRUE(ranWhole(there));
    if (comparable) {
      EXPECT_TRUE(sameResults(original, there, each.results));
    }
    EXPECT_TRUE(sameOrigin(original, there));
    EXPECT_TRUE(sameEnd(original, there));
    EXPECT_TRUE(sameTool(original, there));
    EXPECT_TRUE(touchesAgreeOrToldOf(original, there));

    const Twin back = withoutVerdict(runConverted(there, part));
    if (setting.control == ControlKind::iTNC530 && !back.lost.empty()) {
      // It cannot shift a preset by PRESET CORR, nor turn one that is not in effect: both are listed.
      for (const Diagnostic& lost : back.lost)
        EXPECT_NE(lost.message.find("iTNC530"), std::string::npos) << format(lost);
      continue;
    }
    ASSERT_TRUE(ranWhole(back));
    EXPECT_TRUE(sameOrigin(original, back));
    EXPECT_TRUE(sameTool(original, back));
    EXPECT_TRUE(sameEnd(original, back));
    if (::testing::Test::HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Convert, AnyWorld,
                         ::testing::Combine(::testing::ValuesIn(cases()), ::testing::ValuesIn(settings)), nameOf);
INSTANTIATE_TEST_SUITE_P(ConvertPatterns, AnyWorld,
                         ::testing::Combine(::testing::ValuesIn(patternCases()), ::testing::ValuesIn(settings)),
                         nameOf);

}  // namespace
}  // namespace probewright::testing_support::heidenhain
