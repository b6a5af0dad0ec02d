#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "meant.hpp"
#include "oracle.hpp"
#include "simulation/cad_solid.hpp"
#include "simulation/cad_transfer.hpp"
#include "written_step.hpp"

/// Parts as files write them that OpenCASCADE did not write, met where the closed form of what they mean says.
namespace probewright::simulation {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
/// A turned part with a bore, a cone, a plane, a rounding, a throat and a spherical shoulder.
Meridian bush() {
  return {{{6, 0},
           {18, 0},
           {22, 6},                        // chamfer below
           {22, 14, true, 20, 14, true},   // cylinder, then a rounding of 2
           {20, 16},                       // plane
           {15, 16, true, 15, 19, false},  // throat of 3
           {12, 19},                       // neck
           {12, 24, true, 0, 15, true},    // ball of 15 about the axis
           {std::sqrt(225 - 169), 28},     // plane on top
           {6, 28}}};
}

/// A spindle: cone below from its apex, ball on top.
Meridian spindle() { return {{{0, -20}, {14, 0}, {14, 5, true, 0, 5, true}, {0, 19}}}; }

Meridian ring() { return {{{26, 3, true, 20, 3, true}}}; }
/// The same of three pieces, between which there is no corner.
Meridian ringOfThree() {
  return {{{26, 3, true, 20, 3, true}, {20, 9, true, 20, 3, true}, {20 - 6 * 0.6, 3 - 6 * 0.8, true, 20, 3, true}}};
}
Meridian ball() { return {{{0, -11, true, 0, 0, true}, {0, 11}}}; }
Meridian cap() { return {{{0, 4, false}, {9, 4, true, 0, 4, true}, {0, 13}}}; }

struct NamedMeridian {
  std::string name;
  Meridian meridian;
};
std::vector<NamedMeridian> meridians() {
  return {{"bush", bush()}, {"spindle", spindle()}, {"ring", ring()}, {"ring of three", ringOfThree()},
          {"ball", ball()}, {"cap", cap()}};
}

Distance distanceOf(const Meridian& meridian, const Pose& pose) {
  const Pose back = pose.inverse();
  return [meridian, back](const Vector3& p) { return meridian.distance(back * p); };
}

TEST(WrittenParts, OfAnyDialectAreMetWhereTheyAre) {
  std::mt19937_64 random(201);
  const auto how = [&](Dialect::Surfaces surfaces, Dialect::Loops loops) {
    Dialect dialect;
    dialect.surfaces = surfaces;
    dialect.loops = loops;
    dialect.sectors = 2 + static_cast<int>(random() % 3);
    dialect.seamAt = uniform(random, -7, 7);
    dialect.axesDown = random() % 2 == 0;
    dialect.loopsReversed = random() % 2 == 0;
    dialect.edgesReversed = random() % 2 == 0;
    dialect.firstEdge = static_cast<int>(random() % 4);
    return dialect;
  };
  int k = 0;
  for (int round = 0; round < campaignFactor(); ++round) {
    for (const auto& [body, meridian] : meridians()) {
      for (const auto surfaces : {Dialect::Surfaces::Own, Dialect::Surfaces::Revolution, Dialect::Surfaces::Offset,
                                  Dialect::Surfaces::Splines}) {
        for (const auto loops : {Dialect::Loops::Seam, Dialect::Loops::TwoCircles, Dialect::Loops::Sectors}) {
          const Dialect dialect = how(surfaces, loops);
          const std::array lengths{1.0, 25.4, 1000.0};
          StepFile file({lengths[static_cast<std::size_t>(k++ % 3)], random() % 2 == 0});
          const Pose pose = randomPose(random, 60);
          const std::vector<int> faces = revolvedFaces(file, meridian, pose, dialect);
          const std::string name = fmt::format(
              "{} surfaces {} loops {}/{} seam {:.2f} down {} loops {} edges {} first {} unit {} degrees {}", body,
              static_cast<int>(surfaces), static_cast<int>(loops), dialect.sectors, dialect.seamAt, dialect.axesDown,
              dialect.loopsReversed, dialect.edgesReversed, dialect.firstEdge, file.units().length,
              file.units().degrees);
          expectStepAsMeant(name, file.withItems({file.solid(faces)}), distanceOf(meridian, pose), 50,
                            pose.translation(), random, 30);
        }
      }
    }
  }
}

Dialect sectors(int count) {
  Dialect dialect;
  dialect.loops = Dialect::Loops::Sectors;
  dialect.sectors = count;
  dialect.seamAt = 0.3;
  return dialect;
}

TEST(WrittenParts, OfSeveralOpenSkinsAreMetWhereTheyAre) {
  std::mt19937_64 random(202);
  const Pose pose = randomPose(random, 40);
  StepFile file({25.4, true});
  const std::vector<int> faces = revolvedFaces(file, bush(), pose, sectors(3));
  std::vector<int> models;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<int> some;
    for (std::size_t i = k; i < faces.size(); i += 3)
      some.push_back(faces[i]);
    const int shell = file.add(fmt::format("OPEN_SHELL('',({}))", listOf(some)));
    models.push_back(file.add(fmt::format("SHELL_BASED_SURFACE_MODEL('',(#{}))", shell)));
  }
  file.represent(file.product("skins"), models, "MANIFOLD_SURFACE_SHAPE_REPRESENTATION");
  expectStepAsMeant("skins", file.text(), distanceOf(bush(), pose), 50, pose.translation(), random, 60);
}

TEST(WrittenParts, WithVoidsAreMetInsideAndOutside) {
  std::mt19937_64 random(203);
  const Pose pose = randomPose(random, 40);
  const Meridian outer{{{0, -20}, {30, -20}, {30, 20}, {0, 20}}};
  for (const auto loops : {Dialect::Loops::Seam, Dialect::Loops::TwoCircles, Dialect::Loops::Sectors}) {
    StepFile file;
    Dialect dialect = sectors(2);
    dialect.loops = loops;
    const auto shell = [&](const std::vector<int>& faces) {
      return file.add(fmt::format("CLOSED_SHELL('',({}))", listOf(faces)));
    };
    const int outside = shell(revolvedFaces(file, outer, pose, dialect));
    const int hollow = shell(revolvedFaces(file, ball(), pose, dialect));
    const int inside = file.add(fmt::format("ORIENTED_CLOSED_SHELL('',*,#{},.F.)", hollow));
    const std::string text = file.withItems({file.add(fmt::format("BREP_WITH_VOIDS('',#{},(#{}))", outside, inside))});
    expectStepAsMeant("outside", text, nearestOf({distanceOf(outer, pose), distanceOf(ball(), pose)}), 50,
                      pose.translation(), random, 20);
    const ScratchFolder folder;
    const auto solid = readStep(folder.write("part.step", text));
    ASSERT_TRUE(solid) << format(solid.error());
    for (int i = 0; i < 20; ++i) {
      const Vector3 from = pose * randomPoint(random, 4), to = from + 60 * randomDirection(random);
      const auto contact = (*solid)->firstContact(from, to, 2);
      ASSERT_TRUE(contact);
      EXPECT_GT(contact->fraction, 0) << "the void is free";
      EXPECT_NEAR((contact->ballCentre - pose.translation()).norm(), 9, 1e-6);
    }
    const Vector3 within = pose * Vector3(20, 3, 2);
    const auto contact = (*solid)->firstContact(within, pose * Vector3(50, 3, 2), 2);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->fraction, 0) << "between both shells is material";
  }
}

TEST(WrittenParts, OfFlatFacetsAreMetWhereTheyAre) {
  std::mt19937_64 random(204);
  const Vector3 size(50, 30, 20);
  {
    const Pose pose = randomPose(random, 40);
    StepFile file({1000, false});
    std::vector<int> points;
    for (int i = 0; i < 8; ++i)
      points.push_back(
          file.point(pose * Vector3(i % 2 == 0 ? -25 : 25, i / 2 % 2 == 0 ? -15 : 15, i / 4 == 0 ? -10 : 10)));
    const std::array<std::array<std::size_t, 4>, 6> corners{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    const std::array<Vector3, 6> normals{-Vector3::UnitZ(), Vector3::UnitZ(),  -Vector3::UnitY(),
                                         Vector3::UnitY(),  -Vector3::UnitX(), Vector3::UnitX()};
    std::vector<int> faces;
    for (std::size_t f = 0; f < 6; ++f) {
      std::vector<int> loop;
      for (const std::size_t c : corners[f])
        loop.push_back(points[c]);
      const int bound = file.add(
          fmt::format("FACE_OUTER_BOUND('',#{},.T.)", file.add(fmt::format("POLY_LOOP('',({}))", listOf(loop)))));
      const Vector3& n = normals[f];
      const int axes =
          file.axes(pose * (n.cwiseProduct(size) / 2), pose.linear() * n, pose.linear() * Vector3(n.y(), n.z(), n.x()));
      faces.push_back(
          file.add(fmt::format("FACE_SURFACE('',(#{}),#{},.T.)", bound, file.add(fmt::format("PLANE('',#{})", axes)))));
    }
    const int shell = file.add(fmt::format("CLOSED_SHELL('',({}))", listOf(faces)));
    expectStepAsMeant("facets", file.withItems({file.add(fmt::format("FACETED_BREP('',#{})", shell))}),
                      distanceOfBlock(size, pose), 50, pose.translation(), random, 40);
  }
}

TEST(WrittenParts, WithLooseLinesAndPointsAreMetWhereTheirBodiesAre) {
  std::mt19937_64 random(205);
  const Pose pose = randomPose(random, 40);
  StepFile file;
  const int body = file.solid(revolvedFaces(file, spindle(), pose, {}));
  const int vector = file.add(fmt::format("VECTOR('',#{},1.)", file.direction(Vector3::UnitX())));
  const int line = file.add(fmt::format("LINE('',#{},#{})", file.point(pose.translation()), vector));
  const int trimmed =
      file.add(fmt::format("TRIMMED_CURVE('',#{},(PARAMETER_VALUE(-80.)),(PARAMETER_VALUE(80.)),.T.,"
                           ".PARAMETER.)",
                           line));
  const int set = file.add(fmt::format("GEOMETRIC_CURVE_SET('',(#{},#{}))", trimmed, file.point({0, 0, 50})));
  const int definition = file.product("part");
  file.represent(definition, {body, set, file.axes(Vector3::Zero(), Vector3::UnitZ(), Vector3::UnitX())});
  expectStepAsMeant("lines", file.text(), distanceOf(spindle(), pose), 50, pose.translation(), random, 40);
}

/// A body as an instance of a representation, moved by an operator.
std::string mapped(const Pose& own, const Pose& target, double scale, bool mirrored) {
  StepFile file({mirrored ? 25.4 : 1.0, true});
  const int body = file.solid(revolvedFaces(file, bush(), own, {}));
  const int origin = file.axes(Vector3::Zero(), Vector3::UnitZ(), Vector3::UnitX());
  const int shape = file.add(fmt::format("SHAPE_REPRESENTATION('',(#{},#{}),#{})", origin, body, file.context()));
  const int map = file.add(fmt::format("REPRESENTATION_MAP(#{},#{})", origin, shape));
  const int x = file.direction(target.linear().col(0)), y = file.direction(target.linear().col(1));
  const int z = file.direction((mirrored ? -1 : 1) * target.linear().col(2));
  const int place = file.point(target.translation());
  const int transform = file.add(
      fmt::format("CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#{},#{},#{},{:.3f},#{})", x, y, place, scale, z));
  return file.withItems({file.add(fmt::format("MAPPED_ITEM('',#{},#{})", map, transform))});
}

TEST(WrittenParts, MappedAreMetWhereTheyAre) {
  std::mt19937_64 random(206);
  const Pose own = randomPose(random, 20), target = randomPose(random, 60);
  expectStepAsMeant("mapped", mapped(own, target, 1, false), distanceOf(bush(), target * own), 50,
                    target * own.translation(), random, 30);
}

TEST(WrittenParts, MappedScaledOrMirroredAreRefusedRatherThanPutElsewhere) {
  const ScratchFolder folder;
  for (const auto& [scale, mirrored] : {std::pair(2.0, false), std::pair(0.5, true), std::pair(1.0, true)}) {
    const std::string text = mapped(Pose::Identity(), translation({10, 0, 0}), scale, mirrored);
    // Some systems leave names out.
    const std::string nameless =
        std::regex_replace(text, std::regex("OPERATOR_3D\\('[^']*','[^']*'"), "OPERATOR_3D($$,$$");
    EXPECT_NE(nameless, text);
    for (const std::string& bytes : {text, nameless}) {
      const auto solid = readStep(folder.write("part.step", bytes));
      ASSERT_FALSE(solid);
      EXPECT_GT(solid.error().place.line, 0U);
      EXPECT_THAT(format(solid.error()), AllOf(HasSubstr("CARTESIAN_TRANSFORMATION_OPERATOR_3D: it mirrors or scales"),
                                               HasSubstr("bodies of their own")));
    }
  }
}

/// What an angle of a cone means is not known where the file has two units of angles.
TEST(WrittenParts, WithUncertainConesAreRefused) {
  const ScratchFolder folder;
  for (const bool offset : {true, false}) {
    StepFile file({1, true});
    file.use({1, false});
    Dialect dialect;
    dialect.surfaces = offset ? Dialect::Surfaces::Offset : Dialect::Surfaces::Revolution;
    dialect.loops = Dialect::Loops::TwoCircles;
    const std::string text = file.withItems({file.solid(revolvedFaces(file, spindle(), Pose::Identity(), dialect))});
    const auto solid = readStep(folder.write("part.step", text));
    ASSERT_FALSE(solid);
    EXPECT_GT(solid.error().place.line, 0U);
    EXPECT_THAT(format(solid.error()),
                HasSubstr(offset ? "OFFSET_SURFACE: it is the offset of a cone"
                                 : "ADVANCED_FACE: it is a cone as surface of revolution that ends at its apex "
                                   "without an edge"));
  }
}

TEST(DamagedParts, WhoseFacesBelongToNothingAreNamed) {
  const ScratchFolder folder;
  StepFile file;
  const std::vector<int> faces = revolvedFaces(file, bush(), Pose::Identity(), {});
  file.solid(faces);
  // The shape holds no more than a place.
  const int place = file.axes(Pose::Identity());
  const auto solid = readStep(folder.write("part.step", file.withItems({place})));
  ASSERT_FALSE(solid);
  EXPECT_GT(solid.error().place.line, 0U);
  EXPECT_THAT(format(solid.error()),
              AllOf(HasSubstr(fmt::format("of its {} faces, the first #{} ADVANCED_FACE", faces.size(), faces.front())),
                    HasSubstr("ADVANCED_FACE, none belongs to the shape of a product in a way that can be read")));
}

TEST(WrittenParts, WithExponentsInSmallLettersAreMetWhereTheyAre) {
  std::mt19937_64 random(210);
  for (const double length : {1.0, 1000.0}) {
    StepFile file({length, false});
    // A part of a few hundredths: nearly all its coordinates have exponents in metres.
    const Meridian pin{{{0, -0.02}, {0.03, -0.02}, {0.03, 0.02}, {0, 0.02}}};
    const Pose pose = randomPose(random, 0.05);
    std::string text = file.withItems({file.solid(revolvedFaces(file, pin, pose, {}))});
    std::size_t count = 0;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
      const bool number = std::isdigit(static_cast<unsigned char>(text[i - 1])) != 0 || text[i - 1] == '.';
      if (text[i] != 'E' || text[i + 1] != '-' || !number) continue;
      text[i] = 'e';
      ++count;
    }
    EXPECT_TRUE(length < 1000 || count > 20) << count;
    const ScratchFolder folder;
    const auto solid = readStep(folder.write("part.step", text));
    ASSERT_TRUE(solid) << format(solid.error());
    EXPECT_TRUE(dynamic_cast<const CadSolid&>(**solid).remarks().empty());
    const Distance distance = distanceOf(pin, pose);
    for (int i = 0; i < 20; ++i) {
      const Vector3 middle = pose.translation();
      const auto contact = (*solid)->firstContact(middle + randomDirection(random), middle, 0.01);
      ASSERT_TRUE(contact);
      EXPECT_NEAR(distance(contact->ballCentre), 0.01, 1e-6);
    }
  }
}

TEST(DamagedParts, WhoseFacesDoNotFitTheirEdgesAreNamed) {
  StepFile file;
  const std::string good = file.withItems({file.solid(revolvedFaces(file, bush(), Pose::Identity(), {}))});
  const auto changed = [&](const std::string& type, const std::string& from, const std::string& to) {
    std::string bad = good;
    const std::size_t at = bad.find(from, bad.find(type));
    EXPECT_LT(at, bad.find(';', bad.find(type))) << type;
    return bad.replace(at, from.size(), to);
  };
  EXPECT_EQ(saidOf(good), "");
  const std::string misfit = "ADVANCED_FACE does not fit its edges: they, their corners and its surface are up to ";
  EXPECT_THAT(saidOf(changed("=CYLINDRICAL_SURFACE", ",22.)", ",21.)")), HasSubstr(misfit + "1.000 mm"));
  EXPECT_THAT(saidOf(changed("=CYLINDRICAL_SURFACE", ",22.)", ",22.04)")), HasSubstr(misfit + "0.040 mm"));
  EXPECT_THAT(saidOf(changed("=TOROIDAL_SURFACE", ",20.,2.)", ",20.,2.5)")), HasSubstr(misfit + "0.500 mm"));
}

/// Where an import ends with a crash, the face that was named last is what it is about.
TEST(DamagedParts, AreSearchedFaceByFace) {
  StepFile file;
  const std::vector<int> faces = revolvedFaces(file, cap(), Pose::Identity(), {});
  const int damaged = file.add("ADVANCED_FACE('',$,$,.T.)");
  const std::vector<int> others = revolvedFaces(file, cap(), Pose(translation({0, 0, 40})), {});
  TransferOrder order;
  order.file = "part.step";
  order.bytes = file.withItems({file.solid(faces), file.solid(others)});
  std::vector<std::string> expected, said;
  for (const auto& some : {faces, others})
    for (const int face : some)
      expected.push_back(fmt::format("at #{}", face));
  inChild(
      [&](const ChildVoice& voice) {
        searchFaces(order, voice);
        return std::string();
      },
      {},
      [&](std::string_view line) {
        if (line.starts_with("at ")) said.emplace_back(line);
      },
      [](double) { return false; });
  EXPECT_EQ(said, expected) << damaged;
}

/// A damaged entity that no face needs may be why a body is not as it should be; a skin is just a skin.
TEST(DamagedParts, AreExplainedByWhatIsDamagedWhereSomethingIsWrong) {
  const std::string remark = "CIRCLE cannot be read", skin = "meets the faces from both sides";
  for (const bool closed : {true, false}) {
    StepFile file;
    file.add("CIRCLE('',$,$)");
    const std::vector<int> faces = revolvedFaces(file, cap(), Pose::Identity(), {});
    const std::string shell = fmt::format("OPEN_SHELL('',({}))", listOf(faces));
    const int body =
        closed ? file.solid(faces) : file.add(fmt::format("SHELL_BASED_SURFACE_MODEL('',(#{}))", file.add(shell)));
    const std::string good = file.withItems({body});
    EXPECT_EQ(saidOf(good).find(skin) == std::string::npos, closed);
    EXPECT_THAT(saidOf(good), ::testing::Not(HasSubstr(remark)));
    std::string bad = good;
    bad.replace(bad.find(",9.)", bad.find("=SPHERICAL_SURFACE")), 4, ",8.)");
    EXPECT_EQ(saidOf(bad).find(remark) != std::string::npos, closed) << saidOf(bad);
  }
}

/// A corner that lies beside the curves that should end there.
TEST(DamagedParts, WhoseCornersLieBesideTheirEdgesAreNamed) {
  for (const double aside : {0.004, 0.25, 0.8}) {
    StepFile file;
    const auto patch = [&](double off) {
      const std::array<Vector3, 4> corners{Vector3(0, 0, 0), Vector3(40, 0, 0), Vector3(40, 30, 0), Vector3(0, 30, 0)};
      std::array<int, 4> vertices{};
      for (std::size_t i = 0; i < 4; ++i)
        vertices[i] = file.vertex(i == 2 ? Vector3(corners[i] + Vector3(0, 0, off)) : corners[i]);
      std::vector<int> uses;
      for (std::size_t i = 0; i < 4; ++i) {
        const Vector3 along = (corners[(i + 1) % 4] - corners[i]).normalized();
        const int vector = file.add(fmt::format("VECTOR('',#{},1.)", file.direction(along)));
        const int line = file.add(fmt::format("LINE('',#{},#{})", file.point(corners[i]), vector));
        const int edge =
            file.add(fmt::format("EDGE_CURVE('',#{},#{},#{},.T.)", vertices[i], vertices[(i + 1) % 4], line));
        uses.push_back(file.add(fmt::format("ORIENTED_EDGE('',*,*,#{},.T.)", edge)));
      }
      const int bound = file.add(
          fmt::format("FACE_OUTER_BOUND('',#{},.T.)", file.add(fmt::format("EDGE_LOOP('',({}))", listOf(uses)))));
      const int plane = file.add(fmt::format("PLANE('',#{})", file.axes(Pose::Identity())));
      const int face = file.add(fmt::format("ADVANCED_FACE('',(#{}),#{},.T.)", bound, plane));
      return file.add(
          fmt::format("SHELL_BASED_SURFACE_MODEL('',(#{}))", file.add(fmt::format("OPEN_SHELL('',(#{}))", face))));
    };
    file.represent(file.product("skin"), {patch(aside)}, "MANIFOLD_SURFACE_SHAPE_REPRESENTATION");
    const std::string said = saidOf(file.text());
    const std::string misfit = "ADVANCED_FACE does not fit its edges: they, their corners and its surface are up to ";
    if (aside < 0.01)
      EXPECT_THAT(said, ::testing::Not(HasSubstr("does not fit")));
    else
      EXPECT_THAT(said, HasSubstr(fmt::format("{}{:.3f} mm", misfit, aside)));
  }
}

TEST(WrittenParts, OfNestedAssembliesInSeveralUnitsAreMetWhereTheyAre) {
  std::mt19937_64 random(207);
  for (int round = 0; round < 4; ++round) {
    StepFile file({round % 2 == 0 ? 25.4 : 1.0, round % 2 == 0});
    // A part, two of it in a group, two groups and a part in the whole; the part has units of its own.
    const Pose own = randomPose(random, 10);
    const int part = file.product("part");
    const int partOrigin = file.axes(Vector3::Zero(), Vector3::UnitZ(), Vector3::UnitX());
    const int body = file.solid(revolvedFaces(file, cap(), own, {}));
    const int partShape = file.represent(part, {partOrigin, body}, "ADVANCED_BREP_SHAPE_REPRESENTATION");
    file.use({round < 2 ? 1000.0 : 1.0, round % 2 == 1});
    const int group = file.product("group"), whole = file.product("whole");
    const std::array<Pose, 5> poses{randomPose(random, 30), randomPose(random, 30), randomPose(random, 90),
                                    randomPose(random, 90), randomPose(random, 90)};
    std::array<int, 5> places{};
    for (std::size_t i = 0; i < 5; ++i)
      places[i] = file.axes(poses[i]);
    const int origin = file.axes(Vector3::Zero(), Vector3::UnitZ(), Vector3::UnitX());
    const int groupShape = file.represent(group, {origin, places[0], places[1]});
    const int wholeShape = file.represent(whole, {origin, places[2], places[3], places[4]});
    const StepFile::Shape ofPart{part, partShape, partOrigin}, ofGroup{group, groupShape, origin},
        ofWhole{whole, wholeShape, origin};
    file.put(ofPart, ofGroup, places[0]);
    file.put(ofPart, ofGroup, places[1]);
    file.put(ofGroup, ofWhole, places[2]);
    file.put(ofGroup, ofWhole, places[3]);
    file.put(ofPart, ofWhole, places[4]);
    std::vector<Distance> all{distanceOf(cap(), poses[4] * own)};
    for (const std::size_t g : {2, 3}) {
      for (const std::size_t p : {0, 1})
        all.push_back(distanceOf(cap(), poses[g] * poses[p] * own));
    }
    expectStepAsMeant(fmt::format("assembly {}", round), file.text(), nearestOf(all), 160, Vector3::Zero(), random,
                      120);
  }
}

}  // namespace
}  // namespace probewright::simulation
