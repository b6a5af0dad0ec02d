#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "meant.hpp"
#include "written_step.hpp"

/// One wrong letter in what is no shape itself, but says how large shapes are and where they stand.
namespace probewright::simulation {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

/// With the letter at `offset` in the last `word` of the text put wrong.
std::string damaged(std::string text, const std::string& word, std::size_t offset) {
  const std::size_t at = text.rfind(word);
  EXPECT_NE(at, std::string::npos) << word;
  text[at + offset] = text[at + offset] == '6' ? '7' : '6';
  return text;
}

Meridian pin() { return {{{0, -10}, {8, -10}, {8, 10}, {0, 10}}}; }

int bodyOf(StepFile& file, const Pose& pose) {
  const std::vector<int> faces = revolvedFaces(file, pin(), pose, {});
  return file.solid(faces);
}

TEST(DamagedStructure, OfUnitsIsNamed) {
  for (const double unit : {1.0, 1000.0}) {
    StepFile file({unit, false});
    const std::string good = file.withItems({bodyOf(file, Pose::Identity())});
    EXPECT_EQ(saidOf(good), "");
    for (const std::string word : {"GLOBAL_UNIT_ASSIGNED_CONTEXT", "REPRESENTATION_CONTEXT(''", "GEOMETRIC_REP"})
      EXPECT_THAT(saidOf(damaged(good, word, 3)), HasSubstr("its lengths have no unit that can be read")) << word;
    const std::string metre = unit == 1 ? ".MILLI.,.METRE." : "$,.METRE.";
    EXPECT_THAT(saidOf(damaged(good, metre, metre.size() - 2)), HasSubstr("SHAPE_REPRESENTATION: its lengths have no"));
    EXPECT_NE(saidOf(damaged(good, "(LENGTH_UNIT", 4)), "");
    // A unit that no length needs.
    EXPECT_EQ(saidOf(damaged(good, ".STERADIAN.", 3)), "");
  }
}

/// A body twice in an assembly.
std::string assembly() {
  StepFile file;
  const int part = file.product("part"), whole = file.product("whole");
  const int origin = file.axes(Pose::Identity());
  const int body = bodyOf(file, Pose::Identity());
  const int partShape = file.represent(part, {origin, body}, "ADVANCED_BREP_SHAPE_REPRESENTATION");
  const int here = file.axes(Pose(translation({30, 0, 0}))), there = file.axes(Pose(translation({0, 50, 0})));
  const int wholeShape = file.represent(whole, {origin, here, there});
  for (const int place : {here, there})
    file.put({part, partShape, origin}, {whole, wholeShape, origin}, place);
  return file.text();
}

TEST(DamagedStructure, OfAssembliesIsNamed) {
  const std::string good = assembly();
  EXPECT_EQ(saidOf(good), "");
  for (const std::string type : {"NEXT_ASSEMBLY_USAGE_OCCURRENCE('", "ITEM_DEFINED_TRANSFORMATION('',",
                                 "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#"}) {
    const std::size_t at = good.rfind(type), end = good.find(';', at);
    ASSERT_LT(at, end) << type;
    // A comma less is an argument less.
    const std::size_t comma = good.rfind(',', end);
    EXPECT_THAT(saidOf(std::string(good).replace(comma, 1, "1")), ::testing::Not(::testing::IsEmpty())) << type;
    // A wrong letter in the name of its type.
    EXPECT_THAT(saidOf(damaged(good, type, 5)), ::testing::Not(::testing::IsEmpty())) << type;
  }
}

/// Some systems leave names out that the standard demands: nothing stands elsewhere for that.
TEST(DamagedStructure, OfNamesAloneIsNotWorthAWord) {
  std::string text = assembly();
  for (const std::string type :
       {"ITEM_DEFINED_TRANSFORMATION(", "(REPRESENTATION_RELATIONSHIP(", "PRODUCT_DEFINITION_SHAPE("}) {
    const std::string names = "'','',", none = "$,$,";
    std::size_t at = text.find(type + names);
    EXPECT_NE(at, std::string::npos) << type;
    for (; at != std::string::npos; at = text.find(type + names, at))
      text.replace(at + type.size(), names.size(), none);
  }
  EXPECT_EQ(saidOf(text), "");
}

/// All texts of a file left out.
std::string withoutTexts(const std::string& text) {
  const std::size_t data = text.find("DATA;");
  return text.substr(0, data) + std::regex_replace(text.substr(data), std::regex("'[^']*'"), "$$");
}

TEST(DamagedStructure, OfAllTextsLeavesThePartAsItIs) {
  const std::string text = withoutTexts(assembly());
  EXPECT_EQ(text.find('\'', text.find("DATA;")), std::string::npos);
  EXPECT_EQ(saidOf(text), "");
}

/// What must be refused or corrected is not passed over because it has no name.
TEST(DamagedStructure, OfTextsHidesNoOtherMistake) {
  std::string text = assembly();
  const std::string plane = "PLANE('',#";
  const std::size_t at = text.find(plane);
  ASSERT_NE(at, std::string::npos);
  text[at + plane.size() - 1] = 'x';
  EXPECT_NE(saidOf(withoutTexts(text)), "");
}

/// A patch on a cylinder whose border also runs once round it, which no face can have as its only border.
TEST(DamagedStructure, OfABorderThatOnlyRunsRoundItsSurfaceIsNamed) {
  for (const bool alsoRound : {false, true}) {
    StepFile file;
    const auto at = [](double angle, double z) { return Vector3(7 * std::cos(angle), 7 * std::sin(angle), z); };
    const auto circle = [&](double z) {
      const int axes = file.axes({0, 0, z}, Vector3::UnitZ(), Vector3::UnitX());
      return file.add(fmt::format("CIRCLE('',#{},7.)", axes));
    };
    const auto up = [&](double angle) {
      const int vector = file.add(fmt::format("VECTOR('',#{},1.)", file.direction(Vector3::UnitZ())));
      return file.add(fmt::format("LINE('',#{},#{})", file.point(at(angle, 0)), vector));
    };
    std::vector<int> uses;
    const auto use = [&](int from, int to, int curve, bool forwards) {
      const int edge = file.add(fmt::format("EDGE_CURVE('',#{},#{},#{},.T.)", from, to, curve));
      uses.push_back(file.add(fmt::format("ORIENTED_EDGE('',*,*,#{},{})", edge, forwards ? ".T." : ".F.")));
    };
    const int a = file.vertex(at(0, 0)), b = file.vertex(at(0.4, 0)), c = file.vertex(at(0.4, 5)),
              d = file.vertex(at(0, 5)), beyond = file.vertex(at(2, 0));
    if (alsoRound) {
      use(a, beyond, circle(0), true);
      use(beyond, a, circle(0), true);
    }
    use(a, b, circle(0), true);
    use(b, c, up(0.4), true);
    use(d, c, circle(5), false);
    use(a, d, up(0), false);
    const int bound = file.add(
        fmt::format("FACE_OUTER_BOUND('',#{},.T.)", file.add(fmt::format("EDGE_LOOP('',({}))", listOf(uses)))));
    const int surface = file.add(
        fmt::format("CYLINDRICAL_SURFACE('',#{},7.)", file.axes(Vector3::Zero(), Vector3::UnitZ(), Vector3::UnitX())));
    const int face = file.add(fmt::format("ADVANCED_FACE('',(#{}),#{},.T.)", bound, surface));
    const int shell = file.add(fmt::format("OPEN_SHELL('',(#{}))", face));
    file.represent(file.product("skin"), {file.add(fmt::format("SHELL_BASED_SURFACE_MODEL('',(#{}))", shell))},
                   "MANIFOLD_SURFACE_SHAPE_REPRESENTATION");
    const std::string said = saidOf(file.text());
    const std::string expected =
        fmt::format("#{} ADVANCED_FACE does not fit its edges: they run round its surface", face);
    if (alsoRound)
      EXPECT_THAT(said, HasSubstr(expected));
    else
      EXPECT_THAT(said, Not(HasSubstr("does not fit")));
  }
}

}  // namespace
}  // namespace probewright::simulation
