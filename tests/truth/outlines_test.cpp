#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "truth/told.hpp"

/// What is drawn of the truth: the feature that a cycle looked for, as it was expected and as it is.
namespace probewright::truth::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A box with its top at the part's Z0, and what is in or on it.
std::string boxWith(const std::string& features, const std::string& pose) {
  return "[part]\nname = \"box\"\npose = " + pose +
         "\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, -40]\nsize = [160, 140, 40]\n" + features;
}

std::string textsOf(const Told& told) {
  std::string text;
  for (const records::Diagnosis& known : told.truth().diagnoses)
    for (const std::string& sentence : known.texts)
      text += sentence + "\n";
  return text;
}

void expectOutline(const records::Ghost& ghost, const std::vector<Vector3>& corners) {
  EXPECT_EQ(ghost.shape, "outline");
  ASSERT_EQ(ghost.outline.size(), corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    EXPECT_LT((ghost.outline[i] - corners[i]).norm(), 1e-3) << i << ": " << ghost.outline[i].transpose();
}

/// Expected 20 mm further out; each side reaches as far as its second touch, 50 mm along the first and 55 along the
/// other.
TEST(Outlines, OfACornerRunAlongItsSides) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480, c = 2 }");
  const Told told = run(world, probeAbove +
                                   "TCH PROBE 414 PRESET OUTSIDE CORNER ~\nQ263=-40 ~\nQ264=-50 ~\nQ326=+30 ~\n"
                                   "Q296=-60 ~\nQ297=-25 ~\nQ327=+30 ~\nQ261=-8 ~\nQ320=+0 ~\nQ260=+20 ~\nQ301=+0 ~\n"
                                   "Q304=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\n"
                                   "Q383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_FALSE(told.finished());
  ASSERT_FALSE(told.truth().diagnoses.empty());
  const records::Diagnosis& known = told.truth().diagnoses.back();
  ASSERT_TRUE(known.expected && known.found);
  expectOutline(*known.expected, {{-10, -50, -488}, {-60, -50, -488}, {-60, 5, -488}});
  const Pose turned = translation({0, 0, -488}) * probewright::rotation(Vector3::UnitZ(), 2);
  expectOutline(*known.found,
                {turned * Vector3(10, -30, 0), turned * Vector3(-40, -30, 0), turned * Vector3(-40, 25, 0)});
}

/// Expected at X10 Y-5, truly at X16 Y-9.
TEST(Outlines, OfAPocketAreClosed) {
  World world;
  world.origin = {0, 0, -480};
  world.part = boxWith("[[part.feature]]\nshape = \"pocket\"\nsize = [40, 30]\ndepth = 20\ncorner_radius = 3\n",
                       "{ x = 16, y = -9, z = -480 }");
  const Told told = run(world, probeAbove +
                                   "TCH PROBE 423 POCKET ~\nQ273=+10 ~\nQ274=-5 ~\nQ282=+40 ~\nQ283=+30 ~\nQ261=-8 ~\n"
                                   "Q320=+0 ~\nQ260=+20 ~\nQ301=+0 ~\nQ284=+41 ~\nQ285=+39 ~\nQ286=+31 ~\nQ287=+29 ~\n"
                                   "Q279=+1 ~\nQ280=+1 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n");
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(textsOf(told), HasSubstr("the pocket of 40.000 x 30.000 mm has its centre at X+16.000 Y-9.000 Z-8.000"));
  EXPECT_THAT(textsOf(told), HasSubstr(", 7.211 mm from Q273/Q274"));
  const records::Diagnosis& known = told.truth().diagnoses.back();
  ASSERT_TRUE(known.expected && known.found);
  for (const auto& [ghost, x, y] : {std::tuple(&*known.expected, 10, -5), {&*known.found, 16, -9}})
    expectOutline(*ghost, {{x + 20.0, y + 15.0, -488},
                           {x - 20.0, y + 15.0, -488},
                           {x - 20.0, y - 15.0, -488},
                           {x + 20.0, y - 15.0, -488},
                           {x + 20.0, y + 15.0, -488}});
}

/// Of two holes that one of about the expected size is meant, though it is further away.
TEST(Outlines, OfAHoleAreThoseOfTheOneOfThatSize) {
  World world;
  world.origin = {0, 0, -480};
  world.part = boxWith(
      "[[part.feature]]\nshape = \"hole\"\ndiameter = 12\ncentre = [-5, 0, 0]\n"
      "[[part.feature]]\nshape = \"hole\"\ndiameter = 30.01\ncentre = [50, 40, 0]\n",
      "{ z = -480 }");
  const Told told = run(world, probeAbove +
                                   "TCH PROBE 412 PRESET ~\nQ321=-10 ~\nQ322=-4 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\n"
                                   "Q261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\n"
                                   "Q303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(textsOf(told), HasSubstr("the hole of 30.010 mm has its centre at X+50.000 Y+40.000 Z-5.000 of the"));
  EXPECT_THAT(textsOf(told), HasSubstr("74.404 mm from Q321/Q322"));
}

/// Of holes and studs of one size the nearest is meant, of a ring the side that has the size.
TEST(Outlines, OfRoundFeaturesAreThoseThatAreMeant) {
  const auto told = [](const std::string& features, int cycle, double x, double y, double diameter) {
    World world;
    world.origin = {0, 0, -480};
    world.part = boxWith(features, "{ z = -480 }");
    return textsOf(run(
        world,
        probeAbove + fmt::format("TCH PROBE {} PRESET ~\nQ321={:+} ~\nQ322={:+} ~\nQ262={:+} ~\nQ325=+0 ~\nQ247=+90 ~\n"
                                 "Q261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\n"
                                 "Q303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n",
                                 cycle, x, y, diameter)));
  };
  const std::string hole = "[[part.feature]]\nshape = \"hole\"\ndiameter = 20\ncentre = [{}, {}, 0]\n";
  const std::string holes = fmt::format(fmt::runtime(hole + hole + hole), -50, 0, 40, 30, 45, -40);
  for (const auto& [x, y, dx, dy] :
       std::vector<std::array<double, 4>>{{-50, 0, 15, 0}, {40, 30, 0, -12}, {45, -40, -9, 8}}) {
    const std::string said = told(holes, 412, x + dx, y + dy, 20);
    EXPECT_THAT(said,
                HasSubstr(fmt::format("the hole of 20.000 mm has its centre at X{:+.3f} Y{:+.3f} Z-5.000", x, y)));
    EXPECT_THAT(said, HasSubstr(fmt::format("{:.3f} mm from Q321/Q322", std::hypot(dx, dy))));
  }
  const std::string ring =
      "[[part.feature]]\nshape = \"pocket\"\nsize = [150, 130]\ndepth = 30\ncorner_radius = 5\n"
      "[[part.feature]]\nshape = \"cylinder\"\ncentre = [0, 0, -30]\ndiameter = 60\nheight = 30\n"
      "[[part.feature]]\nshape = \"hole\"\ndiameter = 44\ndepth = 30\n";
  EXPECT_THAT(told(ring, 412, 21, 0, 44), HasSubstr("the hole of 44.000 mm has its centre at X+0.000 Y+0.000"));
  EXPECT_THAT(told(ring, 413, 27, 0, 60), HasSubstr("the stud of 60.000 mm has its centre at X+0.000 Y+0.000"));
}

/// A SINUMERIK tries five times; what is said of the alarm is said once.
TEST(Outlines, OfSeveralAttemptsAreToldOnce) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  const Told told =
      run(world, "T1 D1\nM6\nG54 G17 G0 X0 Y-57 Z20\nG1 Z-8 F2000\nCYCLE978(0,,,1,-45,6,9,2,1,1,,,,,,1)\n");
  ASSERT_FALSE(told.finished());
  ASSERT_EQ(told.truth().diagnoses.size(), 1U);
  EXPECT_THAT(textsOf(told), HasSubstr("mm further in +Y"));
}

/// A ball whose radius is believed 0.005 mm too large: the control sees the surface as much within the part.
TEST(TouchErrors, CountOutwards) {
  World world;
  world.origin = {0, 0, -480};
  world.believedRadius = 3.005;
  world.part = plate("{ z = -480 }");
  const std::string front =
      "TCH PROBE 427 COORDINATE ~\nQ263=+0 ~\nQ264=-30 ~\nQ261=-8 ~\nQ320=+2 ~\nQ272=+2 ~\nQ267=+1 ~\nQ260=+20 ~\n"
      "Q281=+0 ~\nQ288=+99 ~\nQ289=-99 ~\nQ309=+0 ~\nQ330=+0\n";
  const Told told = run(world, probeAbove + front);
  ASSERT_TRUE(told.finished()) << told.why();
  ASSERT_EQ(told.truth().cycles.back().touches.size(), 1U);
  EXPECT_NEAR(told.truth().cycles.back().touches.front()->error, -0.005, 1e-6);
}

/// The box lies 20 mm further out than expected: the probe comes down on it. The corner is felt from beside it, from
/// outside, and what stands behind the box does not count.
TEST(Outlines, OfACornerInTheMaterialAreFeltFromOutside) {
  World world;
  world.origin = {0, 0, -480};
  world.part = boxWith("", "{ x = 10, y = 10, z = -480 }");
  world.more =
      "[[fixture]]\nname = \"block\"\npose = { x = 120, y = 110, z = -500 }\n[[fixture.feature]]\nshape = \"box\"\n"
      "size = [20, 20, 20]\n";
  const Told told = run(world, probeAbove +
                                   "TCH PROBE 414 PRESET OUTSIDE CORNER ~\nQ263=-20 ~\nQ264=-40 ~\nQ326=+30 ~\n"
                                   "Q296=-50 ~\nQ297=-10 ~\nQ327=+40 ~\nQ261=-8 ~\nQ320=+0 ~\nQ260=+20 ~\nQ301=+1 ~\n"
                                   "Q304=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\n"
                                   "Q383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(textsOf(told), HasSubstr("the corner is at X-70.000 Y-60.000 Z-8.000"));
  EXPECT_THAT(textsOf(told), Not(HasSubstr("is turned by")));
}

/// Corners of a plate and of a pocket, by their numbers: the pole lies outside of the plate or within the pocket, and
/// S_FA is too short for the way to the faces.
TEST(Outlines, OfACornerOnASinumerikGoWithItsNumber) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  const auto texts = [&](const std::string& call, double x, double y) {
    const Told told = run(world, fmt::format("T1 D1\nM6\nG54 G17 G0 X{} Y{} Z20\nG1 Z-8 F2000\n{}\n", x, y, call));
    EXPECT_FALSE(told.finished()) << call;
    return textsOf(told);
  };
  world.part = plate("{ z = -480 }");
  for (const auto& [number, x, y] : {std::tuple(1, -1, -1), {2, 1, -1}, {3, 1, 1}, {4, -1, 1}}) {
    const std::string text =
        texts(fmt::format("CYCLE961({}0006,,1,30,60,25,,{},{},,,,,0,,0,3,20,1,,1,)", number, x * 60, y * 50), x * 60.0,
              y * 50.0);
    EXPECT_THAT(text, HasSubstr(fmt::format("the corner is at X{:+.3f} Y{:+.3f} Z-5.000", x * 40.0, y * 30.0)))
        << number;
    EXPECT_THAT(text, Not(HasSubstr("is turned by"))) << number;
  }
  // Points by coordinates: two at the side towards -Y, one at that towards -X.
  EXPECT_THAT(texts("CYCLE961(16,,1,-20,-50,20,-50,-60,10,,,,,0,,0,3,20,1,,1,)", -60, -50),
              AllOf(HasSubstr("the corner is at X-40.000 Y-30.000 Z-5.000"), HasSubstr(", 28.284 mm from the pole")));
  // Four points are searched over 20 mm before and behind their places at least.
  EXPECT_THAT(texts("CYCLE961(18,,1,-20,-80,20,-80,-90,10,-90,25,,,0,,0,3,20,1,,1,)", -90, -80),
              AllOf(HasSubstr("the corner is at X-40.000 Y-30.000 Z-5.000"), HasSubstr(", 70.711 mm from the pole")));
  // A second side at 70 degrees, that of another block.
  world.part =
      "[part]\npose = { z = -480 }\n[[part.feature]]\nshape = \"box\"\ncentre = [20, 0, -20]\nsize = [70, 60, 20]\n";
  world.more =
      "[[fixture]]\nname = \"block\"\npose = { x = -40, y = -30, z = -500, c = -20 }\n[[fixture.feature]]\n"
      "shape = \"box\"\ncentre = [15, 30, 0]\nsize = [30, 60, 20]\n";
  const std::string slanted = texts("CYCLE961(8,,1,95,150,80,110,-105,-80,,,,,0,70,0,3,20,1,,1,)", -105, -80);
  EXPECT_THAT(slanted, HasSubstr("the corner is at X-40.000 Y-30.000 Z-5.000"));
  EXPECT_THAT(slanted, Not(HasSubstr("is turned by")));
  world.more = "";
  world.part =
      boxWith("[[part.feature]]\nshape = \"pocket\"\nsize = [90, 80]\ndepth = 20\ncorner_radius = 2\n", "{ z = -480 }");
  EXPECT_THAT(texts("CYCLE961(5,,1,20,40,20,,-25,-20,,,,,0,,0,3,20,1,,1,)", -25, -20),
              HasSubstr("the corner is at X-45.000 Y-40.000 Z-5.000"));
}

/// Where one of the walls is missing, or the walls are three times as far apart, nothing of that size is there.
TEST(Outlines, OfASlotAreNotTakenFromSomethingElse) {
  World world;
  world.origin = {0, 0, -480};
  const std::string slot =
      "TCH PROBE 408 SLOT ~\nQ321=+0 ~\nQ322=+0 ~\nQ311=+14 ~\nQ272=+2 ~\nQ261=-8 ~\nQ320=+0 ~\nQ260=+40 ~\n"
      "Q301=+0 ~\nQ305=+0 ~\nQ405=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n";
  for (const double side : {1.0, -1.0}) {
    world.part = fmt::format(
        "[part]\npose = {{ z = -480 }}\n[[part.feature]]\nshape = \"box\"\ncentre = [0, {}, -20]\nsize = [60, 20, "
        "20]\n",
        side * 17);
    const Told step = run(world, probeAbove + slot);
    ASSERT_FALSE(step.finished());
    EXPECT_THAT(textsOf(step), Not(HasSubstr("the slot of"))) << side;
  }
  world.part = boxWith("[[part.feature]]\nshape = \"pocket\"\nsize = [100, 45]\ndepth = 20\ncorner_radius = 2\n",
                       "{ z = -480 }");
  const Told wide = run(world, probeAbove + slot);
  ASSERT_FALSE(wide.finished());
  EXPECT_THAT(textsOf(wide), Not(HasSubstr("the slot of")));
}

/// Missed by the same way: a flat face square to it and a round one beside its middle are not turned.
TEST(Outlines, OfAFaceThatIsNotTurnedTellNoAngle) {
  World world;
  world.origin = {0, 0, -480};
  const std::string front =
      "TCH PROBE 427 COORDINATE ~\nQ263=+10 ~\nQ264=-45 ~\nQ261=-8 ~\nQ320=+2 ~\nQ272=+2 ~\nQ267=+1 ~\nQ260=+20 ~\n"
      "Q281=+0 ~\nQ288=+99 ~\nQ289=-99 ~\nQ309=+0 ~\nQ330=+0\n";
  for (const std::string& part :
       {plate("{ z = -480 }"),
        std::string(
            "[part]\npose = { z = -500 }\n[[part.feature]]\nshape = \"cylinder\"\ndiameter = 60\nheight = 20\n")}) {
    world.part = part;
    const Told told = run(world, probeAbove + front);
    ASSERT_FALSE(told.finished());
    EXPECT_THAT(textsOf(told), HasSubstr(" mm further in +Y"));
    EXPECT_THAT(textsOf(told), Not(HasSubstr("that face")));
  }
}

/// A beam hangs in the way of body and stylus, above the ball; a roof hangs in the way of the body alone, so near to
/// the axis that no body passes it.
TEST(Outlines, OfABodyTellWhatHelps) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  world.probe = "stylus_length = 50\nbody_radius = 30\nbody_length = 90\n";
  const auto fixture = [](double x, double z, double height) {
    return fmt::format(
        "[[fixture]]\nname = \"fixture\"\npose = {{ x = {}, z = {} }}\n[[fixture.feature]]\nshape = \"box\"\n"
        "size = [40, 40, {}]\n",
        x, z, height);
  };
  const std::string way = "L X-160 Y+0 FMAX\nL Z+5 FMAX\nL X+30 F2000\n";
  world.more = fixture(50, -460, 80);
  const Told beam = run(world, probeAbove + way);
  ASSERT_FALSE(beam.finished());
  EXPECT_THAT(textsOf(beam), HasSubstr("the body met \"fixture\""));
  EXPECT_THAT(textsOf(beam), Not(HasSubstr("too wide")));
  EXPECT_THAT(textsOf(beam), Not(HasSubstr("a stylus that is")));
  // The roof begins at X31, 60 mm above the plate, and ends 95 mm above it: the stylus passes below.
  world.more = fixture(51, -420, 35);
  const Told roof = run(world, probeAbove + way);
  ASSERT_FALSE(roof.finished());
  EXPECT_THAT(textsOf(roof), HasSubstr("the body met \"fixture\""));
  EXPECT_THAT(textsOf(roof), Not(HasSubstr("too wide")));
}

/// A program that goes on after it found nothing has no alarm to explain.
TEST(Outlines, OfATouchThatTheProgramDoesNotNeedAreNotTold) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  const Told told = run(world, probeAbove +
                                   "L X-60 Y+0 FMAX\nL Z-8 FMAX\nTCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q1\n"
                                   "TCH PROBE 3.2 X ANGLE: +0\nTCH PROBE 3.3 DIST +5 F100 MB 1 REFERENCE SYSTEM: 0\n"
                                   "TCH PROBE 3.4 ERRORMODE1\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_EQ(told.outcome.journal.interrupted.size(), 1U);
  EXPECT_EQ(textsOf(told), "");
}

}  // namespace
}  // namespace probewright::truth::testing
