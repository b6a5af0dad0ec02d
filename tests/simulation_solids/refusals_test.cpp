#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeSphere.hxx>
#include <algorithm>
#include <random>
#include <sstream>

#include "meant.hpp"
#include "simulation/cad_solid.hpp"
#include "simulation/step_text.hpp"
#include "written_iges.hpp"
#include "written_step.hpp"

/// Files of other systems that were refused although they hold a part, or with words that did not help.
namespace probewright::simulation {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Meridian pin() { return {{{0, -10}, {8, -10}, {8, 10}, {0, 10}}}; }

std::string pinFile() {
  StepFile file;
  return file.withItems({file.solid(revolvedFaces(file, pin(), Pose::Identity(), {}))});
}

std::string igesSaid(const std::string& text) {
  const ScratchFolder folder;
  const auto solid = readIges(folder.write("part.igs", text));
  return solid ? "" : format(solid.error());
}

TEST(Refusals, AreNotForCommentsBeforeAFile) {
  std::mt19937_64 random(1);
  const std::string text = "/* made by\n   hand */\n/**/ " + pinFile();
  EXPECT_EQ(saidOf(text), "");
  const Meridian meridian = pin();
  expectStepAsMeant(
      "pin", text, [&](const Vector3& p) { return meridian.distance(p); }, 20, Vector3::Zero(), random, 60);
  EXPECT_THAT(saidOf("/* ISO-10303-21; */\nsolid part\nendsolid part\n"), HasSubstr("not a STEP file"));
  EXPECT_THAT(saidOf("/* no end\n" + pinFile()), HasSubstr("not a STEP file"));
}

/// The shape of the product, an axis, tied to the body by `type`.
std::string tiedBy(const std::string& type, bool bodyFirst) {
  StepFile file;
  const int origin = file.axes(Pose::Identity());
  const int body = file.solid(revolvedFaces(file, pin(), Pose::Identity(), {}));
  const int shape = file.represent(file.product("part"), {origin});
  const int bodies =
      file.add(fmt::format("ADVANCED_BREP_SHAPE_REPRESENTATION('',(#{},#{}),#{})", origin, body, file.context()));
  file.add(bodyFirst ? fmt::format("{}('','',#{},#{})", type, bodies, shape)
                     : fmt::format("{}('','',#{},#{})", type, shape, bodies));
  return file.text();
}

TEST(Refusals, AreNotForBodiesThatARelationshipOfDrawingsTiesToTheirProduct) {
  std::mt19937_64 random(2);
  const Meridian meridian = pin();
  for (const std::string type :
       {"SHAPE_REPRESENTATION_RELATIONSHIP", "MECHANICAL_DESIGN_AND_DRAUGHTING_RELATIONSHIP"}) {
    for (const bool bodyFirst : {false, true}) {
      const std::string text = tiedBy(type, bodyFirst);
      EXPECT_EQ(saidOf(text), "") << type;
      expectStepAsMeant(
          type, text, [&](const Vector3& p) { return meridian.distance(p); }, 20, Vector3::Zero(), random, 40);
    }
  }
}

TEST(Refusals, SayThatThereIsNoFaceBeforeTheyFindFaultWithWhatNeedsNone) {
  // Finite elements: nodes with a unit that no reader of shapes knows.
  StepFile elements;
  const int definition = elements.product("mesh");
  const int context = elements.add(
      "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#99))"
      "REPRESENTATION_CONTEXT('',''))");
  const int node = elements.point({1, 2, 3});
  elements.represent(definition, {node}, "POINT_REPRESENTATION");
  elements.add(fmt::format("NODE('1',(#{}),#{},#{})", node, context, context));
  EXPECT_THAT(saidOf(elements.text()),
              AllOf(HasSubstr("the file holds no body and no face"), Not(HasSubstr("damaged"))));

  StepFile assembly;
  assembly.represent(assembly.product("assembly"), {assembly.axes(Pose::Identity())});
  const int type = assembly.add("DOCUMENT_TYPE('geometry')");
  for (const std::string part : {"nut.stp", "", "bolt.stp"})
    assembly.add(fmt::format("DOCUMENT_FILE('{}','','',#{},'',$)", part, type));
  EXPECT_THAT(saidOf(assembly.text()), AllOf(HasSubstr("its parts are in other files: \"nut.stp\", \"bolt.stp\""),
                                             HasSubstr("name the file of a part")));

  StepFile cut;
  const int block = cut.add(fmt::format("BLOCK('',#{},10.,20.,30.)", cut.axes(Pose::Identity())));
  const int ball = cut.add(fmt::format("SPHERE('',5.,#{})", cut.point({0, 0, 0})));
  const int result = cut.add(fmt::format("BOOLEAN_RESULT('',.DIFFERENCE.,#{},#{})", block, ball));
  EXPECT_THAT(saidOf(cut.withItems({cut.add(fmt::format("CSG_SOLID('',#{})", result))})),
              AllOf(HasSubstr("put together of simple solids (CSG)"), HasSubstr("exact faces")));

  EXPECT_THAT(saidOf("ISO-10303-21;HEADER;ENDSEC;DATA;ENDSEC;END-ISO-10303-21;"), HasSubstr("no body and no face"));
}

TEST(Refusals, AreInWordsThatCanBeRead) {
  std::string text = pinFile();
  const std::size_t face = text.find("ADVANCED_FACE('',(#") + 18;
  text.replace(face, text.find_first_of(",)", face) - face, "#99999");
  EXPECT_THAT(saidOf(text), AllOf(HasSubstr("what it refers to is missing or of another type"), Not(HasSubstr("n0."))));
  EXPECT_THAT(saidOf(text), HasSubstr("ADVANCED_FACE: parameter 1 (face_bound): "));
}

/// OpenCASCADE goes round in an endless number for ever, as it seems.
TEST(Refusals, NameNumbersThatAreTooLarge) {
  std::string large = pinFile();
  const std::size_t point = large.find("CARTESIAN_POINT('',(") + 20;
  large.replace(point, large.find(',', point) - point, "1.E400");
  const auto line = 1 + std::count(large.begin(), large.begin() + static_cast<std::ptrdiff_t>(point), '\n');
  EXPECT_THAT(saidOf(large), AllOf(HasSubstr(fmt::format("part.step:{}: error", line)),
                                   HasSubstr("the number 1.E400 is too large"), HasSubstr("damaged there")));
  IgesFile file;
  file.cylinder(Pose::Identity(), 10, 0, 20, 0, 3);
  std::string wide = file.text();
  const std::size_t height = wide.find(",20.,");
  ASSERT_NE(height, std::string::npos);
  wide.replace(height, 5, ",9D999,").erase(wide.find("  ", height), 2);
  EXPECT_THAT(igesSaid(wide), HasSubstr("the number 9D999 is too large"));
  // In a name, below the limit, and small ones.
  std::string named = pinFile();
  named.replace(named.find("PRODUCT('part'"), 14, "PRODUCT('p1E400'");
  EXPECT_EQ(saidOf(named), "");
  for (const std::string end : {"\n", "\r\n", "\r"})
    EXPECT_FALSE(endlessNumber(end + fmt::format("{:>64}00010000D0000307{}", "", end)));
  for (const std::string fine : {"1.E308", "1.E-400", "-2.D+300", "1E", "E400", "#1E999x"})
    EXPECT_FALSE(endlessNumber("(" + fine + ")")) << fine;
  for (const std::string endless : {"1.E309", "-1.5E+400", "2D1000", "+1E99999999999"})
    EXPECT_TRUE(endlessNumber("(1.,\n" + endless + ")")) << endless;
}

/// With the parameters of all lines set so that each line ends with a comma in column 65.
std::string overlong(const std::string& iges) {
  std::istringstream lines(iges);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line[72] == 'P') {
      const std::size_t size = line.find_last_not_of(' ', 63) + 1;
      line = fmt::format("{:>65}{}", line.substr(0, size), line.substr(65));
    }
    text += line + "\n";
  }
  return text;
}

TEST(Refusals, OfIgesNameTheLineThatDoesNotKeepToTheStandard) {
  IgesFile file;
  file.cylinder(Pose::Identity(), 10, 0, 20, 0, 3);
  EXPECT_EQ(igesSaid(file.text()), "");
  EXPECT_THAT(igesSaid(overlong(file.text())),
              AllOf(HasSubstr("part.igs:6: error"), HasSubstr("its parameters go beyond column 64"),
                    HasSubstr("export the part as STEP")));
  IgesFile points;
  points.add(116, "1.,2.,3.,0");
  EXPECT_THAT(igesSaid(points.text()), HasSubstr("the file holds no body and no face"));
  // A letter in place of a number.
  std::string wrong = file.text();
  wrong[wrong.rfind(",0.,1.;") + 4] = 'x';
  EXPECT_THAT(igesSaid(wrong), AllOf(HasSubstr("the directory entry D1: its parameter"), Not(HasSubstr("%d"))));
}

/// A drawing is for eyes: a ball of 200 m need not be drawn to 0.05 mm, which took half a minute.
TEST(Drawings, OfHugeFacesAreBounded) {
  const auto ball = cadSolid(BRepPrimAPI_MakeSphere(1e5).Shape());
  ASSERT_TRUE(ball) << format(ball.error());
  EXPECT_LT(dynamic_cast<const CadSolid&>(**ball).drawing().indices.size() / 3, 400'000U);
}

}  // namespace
}  // namespace probewright::simulation
