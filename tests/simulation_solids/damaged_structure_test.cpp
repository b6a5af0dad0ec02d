#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meant.hpp"
#include "written_step.hpp"

/// One wrong letter in what is no shape itself, but says how large shapes are and where they stand.
namespace probewright::simulation {
namespace {

using namespace testing;
using ::testing::HasSubstr;

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

}  // namespace
}  // namespace probewright::simulation
