#include "conversion/settings.hpp"
#include "conversion/sinumerik_cases.hpp"

/// SINUMERIK programs and their Klartext twins, in random worlds; for both HEIDENHAIN controls, in both units, in each
/// plane.
namespace probewright::testing_support::sinumerik_programs {
namespace {

/// The program in inches: all lengths, as the catalogue knows them, divided by 25.4.
std::string inInches(const std::string& program) {
  std::string text;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line); text += line + '\n') {
    const auto inch = [](const std::string& number) { return fmt::format("{:.9f}", std::stod(number) / 25.4); };
    if (line.starts_with("CYCLE")) {
      const std::size_t open = line.find('(');
      const cycles::CycleDefinition* cycle = cycles::sinumerikCycle(line.substr(0, open));
      std::string call = line.substr(0, open + 1);
      std::istringstream arguments(line.substr(open + 1, line.size() - open - 2));
      std::uint32_t place = 0;
      for (std::string argument; std::getline(arguments, argument, ','); ++place) {
        const cycles::Parameter* known = cycle->parameter(place);
        const bool length = known != nullptr && known->kind == cycles::ValueKind::Length && !argument.empty();
        call += fmt::format("{}{}", place == 0 ? "" : ",", length ? inch(argument) : argument);
      }
      line = call + ")";
    } else if (line.starts_with("G0 ") || line.starts_with("G1 ")) {
      static const std::regex number(R"(([^RFG\d.])(-?\d+(\.\d+)?))");
      line = replaced(line, number, [&](const std::smatch& match) { return match[1].str() + inch(match[2]); });
    }
  }
  return std::regex_replace(text, std::regex("G710"), "G700");
}

std::string turned(const std::string& program, char toolAxis) {
  std::string text;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line); text += line + '\n') {
    if (!line.starts_with("G0 ") && !line.starts_with("G1 ")) continue;
    for (char& c : line)
      if (c >= 'X' && c <= 'Z') c = turnedAxis(c, toolAxis);
  }
  return std::regex_replace(text, std::regex("G17"), toolAxis == 'X' ? "G19" : "G18");
}

class AnyWorldOfSinumerik : public ::testing::TestWithParam<std::tuple<Case, Setting>> {};

TEST_P(AnyWorldOfSinumerik, MeasuresAndCorrectsTheSame) {
  const auto& [each, setting] = GetParam();
  // Space angles have no twin in other planes than that of X and Y.
  const bool comparable = setting.toolAxis == 'Z' || each.name != "Cycle998PlaneAligned";
  const auto reads = comparable ? each.reads : std::vector<int>();
  Dice dice(static_cast<unsigned>(std::hash<std::string>()(each.name)));
  for (int world = 0; world < setting.worlds; ++world) {
    const bool older = setting.control == ControlKind::iTNC530;
    PlantedPart part = plant(dice, setting.control, each.misplaced, each.skewed);
    part.bench.preset(2, part.machineFromPreset.translation() + Vector3(3, 4, 5), 10, false);
    part.bench.knows(5, "MILL", 80, 5);
    const std::string blocks = each.blocks(dice, part);
    SCOPED_TRACE(fmt::format("world {}", world));
    std::string program = "G17 G90 G710\nT1\nM6 D1\nG55\nG54\nG0 Z120\n" + blocks + driveTo(reads) +
                          (comparable ? "" : "G0 X0 Y0\n") + "M30\n";
    if (setting.inch) program = inInches(program);
    if (setting.toolAxis != 'Z') {
      program = turned(program, setting.toolAxis);
      turn(part, setting.toolAxis);
    }
    const Twin original = runSinumerik(program, part);
    ASSERT_TRUE(ranWhole(original));

    const Twin there = runConverted(original, part);
    if (older && !there.lost.empty()) {  // cycles and functions that came later
      EXPECT_NE(there.lost.front().message.find("iTNC530"), std::string::npos) << format(there.lost.front());
      continue;
    }
    ASSERT_TRUE(ranWhole(there));
    if (comparable) {
      EXPECT_TRUE(sameResults(original, there, each.results));
    }
    EXPECT_TRUE(sameOrigin(original, there));
    EXPECT_TRUE(sameEnd(original, there));
    EXPECT_TRUE(sameTool(original, there));
    EXPECT_TRUE(touchesAgreeOrToldOf(original, there));
    if (::testing::Test::HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Convert, AnyWorldOfSinumerik,
                         ::testing::Combine(::testing::ValuesIn(cases()), ::testing::ValuesIn(settings)),
                         [](const auto& test) {
                           return std::get<Case>(test.param).name + std::get<Setting>(test.param).name;
                         });

/// What a cycle was called with stands in its results, too: sizes, centres, coordinates.
TEST(ConvertSetValues, AreThoseOfTheCall) {
  for (const Case& each : cases()) {
    const bool surface = each.name.starts_with("Cycle978");
    if (!surface && !each.name.starts_with("Cycle977") && !each.name.starts_with("Cycle979")) continue;
    const std::vector<int> reads = surface ? std::vector<int>{0, each.name.back() - '0'} : std::vector<int>{0, 1, 2};
    Dice dice(static_cast<unsigned>(std::hash<std::string>()(each.name)));
    for (int world = 0; world < 20; ++world) {
      SCOPED_TRACE(fmt::format("{} world {}", each.name, world));
      PlantedPart part = plant(dice, ControlKind::TNC640, each.misplaced, each.skewed);
      part.bench.preset(2, part.machineFromPreset.translation() + Vector3(3, 4, 5), 10, false);
      part.bench.knows(5, "MILL", 80, 5);
      const std::string blocks = each.blocks(dice, part);
      const Twin original =
          runSinumerik("G17 G90 G710\nT1\nM6 D1\nG55\nG54\nG0 Z120\n" + blocks + driveTo(reads) + "M30\n", part);
      const Twin there = runConverted(original, part);
      ASSERT_TRUE(ranWhole(original));
      ASSERT_TRUE(ranWhole(there));
      EXPECT_TRUE(sameEnd(original, there));
    }
  }
}

/// The text without straight moves, comments and the height that the probe goes to between points.
std::string withoutMoves(const std::string& klartext) {
  std::string rest, line;
  for (std::istringstream lines(klartext); std::getline(lines, line);) {
    line.erase(0, std::min(line.find_first_not_of("0123456789 "), line.size()));
    const bool left = line.starts_with("L ") || line.starts_with(";") || line.starts_with("Q260=");
    if (!left) rest += line + '\n';
  }
  return rest;
}

TEST(ConvertProtectionZones, OfEdgeAndPlaneLeadToTheSamePoints) {
  // S_SETV leads from further away to where the call without a zone begins, whatever its sign.
  const auto edge = [](int x, const char* call) {
    return withoutMoves(
        toKlartext(fmt::format("G17 G90 G71 G54\nT1 D1 M6\nG0 X{} Y0\nG0 Z-10\nCYCLE998({},,,10,5,201,1,40)\n"
                               "M30\n",
                               x, call))
            .text);
  };
  const auto plane = [](int z, const char* call) {
    return withoutMoves(
        toKlartext(fmt::format("G17 G90 G71 G54\nT1 D1 M6\nG0 X0 Y0\nG0 Z{}\nCYCLE998({},,,8,5,,,,40,,10,40)\n"
                               "M30\n",
                               z, call))
            .text);
  };
  for (const char* call : {"101005,,,1,20", "101005,,,1,-20"})
    EXPECT_EQ(edge(-82, call), edge(-62, "100005,,,1,"));
  for (const char* call : {"101006,,,1,20", "101006,,,1,-20"})
    EXPECT_EQ(plane(28, call), plane(8, "100006,,,1,"));
  EXPECT_NE(edge(-82, "101005,,,1,19"), edge(-62, "100005,,,1,"));
}

TEST(ConvertDirections, ThatACallLeavesOpenLeadToTheSetValue) {
  const auto converted = [](int x, const char* call) {
    return toKlartext(fmt::format("G17 G90 G71 G54\nT1 D1 M6\nG0 X{} Y-10\nG0 Z-10\n{}\nM30\n", x, call)).text;
  };
  const auto body = [&](int x, const char* call) {
    std::string rest, line;
    for (std::istringstream lines(converted(x, call)); std::getline(lines, line);)
      if (line.find(';') == std::string::npos || line.find('Q') != std::string::npos) rest += line + '\n';
    return rest;
  };
  EXPECT_EQ(body(-60, "CYCLE978(0,,,1,-45,10,5,1,,1)"), body(-60, "CYCLE978(0,,,1,-45,10,5,1,1,1)"));
  EXPECT_EQ(body(60, "CYCLE978(0,,,1,45,10,5,1,0,1)"), body(60, "CYCLE978(0,,,1,45,10,5,1,2,1)"));
  EXPECT_NE(body(-60, "CYCLE978(0,,,1,-45,10,5,1,,1)"), body(-60, "CYCLE978(0,,,1,-45,10,5,1,2,1)"));
  EXPECT_EQ(body(-60, "CYCLE998(5,,,1,-45,,,10,5,201,,20)"), body(-60, "CYCLE998(5,,,1,-45,,,10,5,201,1,20)"));
  EXPECT_EQ(body(60, "CYCLE998(5,,,1,45,,,10,5,201,,20)"), body(60, "CYCLE998(5,,,1,45,,,10,5,201,2,20)"));
}

}  // namespace
}  // namespace probewright::testing_support::sinumerik_programs
