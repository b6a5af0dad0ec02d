#include <gmock/gmock.h>

#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "metrology/elements.hpp"
#include "records/results.hpp"
#include "reports/summary.hpp"
#include "truth/told.hpp"

/// The true values beside results, against what was planted.
namespace probewright::truth::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double exact = 1e-6;  // mm

const std::string hole421 =
    "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 421 HOLE ~\nQ273=+0 ~\nQ274=+0 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\n"
    "Q261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ275=+30.021 ~\nQ276=+30 ~\nQ279=+0.5 ~\nQ280=+0.5 ~\nQ281=+0 ~\n"
    "Q309=+0 ~\nQ330=+0\n";

const std::string hole977 = "T1 D1\nM6\nG54 G17 G0 X0 Y0 Z-5\nCYCLE977(1,,,1,30,,,5,1,,,,,,1)\n";

/// As a table of the control can hold it.
double written(double value) { return std::round(value * 1000) / 1000; }

/// Where a point of the plate truly is in the preset's system.
Vector3 seen(const World& world, const Pose& tableFromPart, const Vector3& point) {
  const Pose tableFromPreset = translation(world.origin) * probewright::rotation(Vector3::UnitZ(), world.rotation);
  return tableFromPreset.inverse() * (tableFromPart * point);
}

TEST(TrueValues, OfAHoleAreItsOwnWhateverTheProbeBelieves) {
  std::mt19937_64 engine(15);
  std::uniform_real_distribution<double> off(-0.8, 0.8);
  for (const char* control : {"TNC640", "840Dsl"}) {
    for (int i = 0; i < 4; ++i) {
      World world;
      world.control = control;
      world.origin = {10 + written(off(engine)), 5, -480};
      world.rotation = written(3 * off(engine));
      world.believedRadius = 3 + 0.01 * off(engine);
      world.probe = "repeatability = 0.001\n";
      const double x = 10 + off(engine), y = 5 + off(engine), c = off(engine);
      world.part = plate(fmt::format("{{ x = {}, y = {}, z = -480, c = {} }}", x, y, c));
      const bool heidenhain = world.control == "TNC640";
      const Told told = run(world, heidenhain ? hole421 : hole977);
      ASSERT_TRUE(told.finished()) << told.why();
      const Vector3 centre =
          seen(world, translation({x, y, -480}) * probewright::rotation(Vector3::UnitZ(), c), Vector3::Zero());
      EXPECT_NEAR(told.value(heidenhain ? "Q153" : "_OVR[4]"), 30.01, exact);
      EXPECT_NEAR(told.value(heidenhain ? "Q151" : "_OVR[5]"), centre.x(), exact);
      EXPECT_NEAR(told.value(heidenhain ? "Q152" : "_OVR[6]"), centre.y(), exact);
      EXPECT_EQ(told.of(heidenhain ? "Q153" : "_OVR[4]")->basis, records::TruthBasis::Face);
      EXPECT_EQ(told.of(heidenhain ? "Q153" : "_OVR[4]")->shape, "cylinder");
      // What the control measures has the error of its belief: the ball counts twice.
      EXPECT_NEAR(told.measured(heidenhain ? "Q153" : "_OVR[4]"), 30.01 + 2 * (world.believedRadius - 3), 0.004);
    }
  }
}

TEST(TrueValues, OfATiltedHoleStandWhereItsAxisPassesTheHeightOfTheTouches) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480, b = 2 }");
  const Told told = run(world, hole421);
  ASSERT_TRUE(told.finished()) << told.why();
  // The axis leans by 2 degrees in X and passes the origin; Q261 puts the ball's centre 5 mm below it. It touches a
  // little higher or lower, where the wall leans: the mean height is that of the centre.
  EXPECT_NEAR(told.value("Q151"), -5 * std::tan(radiansFromDegrees(2)), 1e-4);
  EXPECT_NEAR(told.value("Q153"), 30.01, exact);
  // A plane square to the tool cuts the cylinder in an ellipse: what was measured is wider.
  EXPECT_GT(told.measured("Q153"), 30.012);
}

TEST(TrueValues, OfARectangleAreThoseOfItsFaces) {
  World world;
  world.origin = {0, 0, -480};
  world.part =
      "[part]\npose = { x = 0.3, y = -0.2, z = -480, c = 1 }\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, -20]\n"
      "size = [80, 60, 20]\n[[part.feature]]\nshape = \"pocket\"\nsize = [30, 20]\ndepth = 15\ncorner_radius = 4\n";
  const Told told = run(world,
                        "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 423 POCKET ~\nQ273=+0 ~\nQ274=+0 ~\nQ282=+30 ~\n"
                        "Q283=+20 ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ284=+30.5 ~\nQ285=+29.5 ~\n"
                        "Q286=+20.5 ~\nQ287=+19.5 ~\nQ279=+1 ~\nQ280=+1 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(told.value("Q154"), 30, exact);
  EXPECT_NEAR(told.value("Q155"), 20, exact);
  EXPECT_NEAR(told.value("Q151"), 0.3, exact);
  EXPECT_NEAR(told.value("Q152"), -0.2, exact);
  EXPECT_EQ(told.of("Q151")->shape, "plane");
  // Probed along the axes a turned rectangle is longer: 30 / cos(1 degree).
  EXPECT_NEAR(told.measured("Q154"), 30 / std::cos(radiansFromDegrees(1)), 0.002);
}

TEST(TrueValues, OfASlopingFaceAreThoseWhereItWasProbed) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480, b = -3 }");
  // The top face rises towards +X with the tangent of 3 degrees.
  const Told told =
      run(world,
          "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 427 COORDINATE ~\nQ263=+30 ~\nQ264=+5 ~\nQ261=+0 ~\n"
          "Q320=+2 ~\nQ272=+3 ~\nQ267=-1 ~\nQ260=+20 ~\nQ281=+0 ~\nQ288=+5 ~\nQ289=-5 ~\nQ309=+0 ~\nQ330=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(told.value("Q160"), 30 * std::tan(radiansFromDegrees(3)), exact);
  // The ball lies on the slope beside its lowest point.
  EXPECT_NEAR(told.measured("Q160") - told.value("Q160"), 3 * (1 / std::cos(radiansFromDegrees(3)) - 1), 1e-5);
  const auto& touch = told.truth().cycles.back().touches.front();
  ASSERT_TRUE(touch);
  EXPECT_EQ(touch->solid, "plate");
  EXPECT_EQ(touch->shape, "plane");
}

TEST(TrueValues, OfAnEdgeAndAPlaneAreTheirAngles) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480, c = 1.5 }");
  const Told edge = run(world,
                        "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 420 ANGLE ~\nQ263=-30 ~\nQ264=-30 ~\nQ265=+30 ~\n"
                        "Q266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\nQ261=-8 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+1 ~\nQ281=+0\n");
  ASSERT_TRUE(edge.finished()) << edge.why();
  EXPECT_NEAR(edge.value("Q150"), 1.5, exact);
  world.part = plate("{ z = -480, a = 1.2 }");
  const Told plane = run(world,
                         "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 431 PLANE ~\nQ263=+30 ~\nQ264=-25 ~\nQ294=+0 ~\n"
                         "Q265=-30 ~\nQ266=-25 ~\nQ295=+0 ~\nQ296=+30 ~\nQ297=+25 ~\nQ298=+0 ~\nQ320=+2 ~\nQ260=+20 ~\n"
                         "Q281=+0\n");
  ASSERT_TRUE(plane.finished()) << plane.why();
  EXPECT_NEAR(std::abs(plane.value("Q170")), 1.2, exact);
  EXPECT_GT(plane.value("Q170") * plane.measured("Q170"), 0);
  EXPECT_FALSE(plane.of("Q172")) << "a plane does not tell its angle about Z";
  // Each of several touches is as high as the face leans there.
  const Told points =
      run(world,
          "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 1420 PLANE ~\nQ1100=+30 ~\nQ1101=-25 ~\nQ1102=+0 ~\n"
          "Q1103=-30 ~\nQ1104=-25 ~\nQ1105=+0 ~\nQ1106=+30 ~\nQ1107=+25 ~\nQ1108=+0 ~\nQ372=-3 ~\n"
          "Q320=+2 ~\nQ260=+20 ~\nQ1125=+2 ~\nQ309=+0 ~\nQ1126=+0 ~\nQ1120=+0 ~\nQ1121=+0\n");
  ASSERT_TRUE(points.finished()) << points.why();
  for (const auto& [name, y] : {std::pair("Q952", -25), {"Q955", -25}, {"Q958", 25}})
    EXPECT_NEAR(points.value(name), y * std::tan(radiansFromDegrees(1.2)), exact) << name;
}

TEST(TrueValues, OfACornerAndACircleOfHolesComeFromSeveralFaces) {
  World world;
  world.origin = {0, 0, -480};
  const double x = 0.4, y = -0.3, c = 0.7;
  world.part = plate(fmt::format("{{ x = {}, y = {}, z = -480, c = {} }}", x, y, c));
  const Told corner =
      run(world,
          "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 414 CORNER ~\nQ263=-30 ~\nQ264=-30 ~\nQ326=+20 ~\n"
          "Q296=-40 ~\nQ297=-20 ~\nQ327=+20 ~\nQ261=-8 ~\nQ320=+3 ~\nQ260=+20 ~\nQ301=+1 ~\nQ304=+0 ~\n"
          "Q305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_TRUE(corner.finished()) << corner.why();
  const Vector3 planted = translation({x, y, 0}) * probewright::rotation(Vector3::UnitZ(), c) * Vector3(-40, -30, 0);
  EXPECT_NEAR(corner.value("Q151"), planted.x(), exact);
  EXPECT_NEAR(corner.value("Q152"), planted.y(), exact);

  // Holes on a circle of 40, the second of them 0.1 mm too far out.
  world.part =
      "[part]\npose = { z = -480 }\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, -20]\nsize = [80, 80, 20]\n";
  std::vector<Vector2> centres;
  for (int i = 0; i < 3; ++i) {
    const double radius = i == 1 ? 20.1 : 20, at = radiansFromDegrees(30 + 120 * i);
    centres.emplace_back(radius * std::cos(at), radius * std::sin(at));
    world.part += fmt::format("[[part.feature]]\nshape = \"hole\"\ndiameter = 12\ncentre = [{}, {}, 0]\n",
                              centres.back().x(), centres.back().y());
  }
  const auto circle = *metrology::circleThrough(centres[0], centres[1], centres[2]);
  const Told bolts =
      run(world,
          "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 430 CIRCLE ~\nQ273=+0 ~\nQ274=+0 ~\nQ262=+40 ~\n"
          "Q291=+30 ~\nQ292=+150 ~\nQ293=+270 ~\nQ261=-5 ~\nQ260=+20 ~\nQ288=+41 ~\nQ289=+39 ~\nQ279=+1 ~\n"
          "Q280=+1 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n");
  ASSERT_TRUE(bolts.finished()) << bolts.why();
  EXPECT_NEAR(bolts.value("Q151"), circle.centre.x(), exact);
  EXPECT_NEAR(bolts.value("Q152"), circle.centre.y(), exact);
  EXPECT_NEAR(bolts.value("Q153"), 2 * circle.radius, exact);
}

/// Three touches: a side that is touched once is taken as square to the other one.
TEST(TrueValues, OfACornerOfThreePointsAreThoseOfItsFaces) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  const double x = 0.4, y = -0.3, c = 0.7;
  world.part = plate(fmt::format("{{ x = {}, y = {}, z = -480, c = {} }}", x, y, c));
  const Vector3 planted = translation({x, y, 0}) * probewright::rotation(Vector3::UnitZ(), c) * Vector3(-40, -30, 0);
  // Its axes are not square: the control sees the sides at an angle that they do not have.
  world.more = "[[errors.squareness]]\naxis = \"X\"\ntowards = \"Y\"\ndegrees = 0.05\n";
  // Two points on the side towards -Y and one on that towards -X, and the other way round: the first edge is along Y
  // then.
  for (const auto& [points, turned] : {std::pair("-20,-45,20,-45,-55,10", 0.0), {"-55,10,-55,-10,20,-45", -90.0}}) {
    const Told told = run(world, fmt::format("T1 D1\nM6\nG54 G17 G0 X-55 Y-45 Z20\nG1 Z-8 F2000\n"
                                             "CYCLE961(16,,1,{},,,,,0,,0,20,80,1,,1,)\n",
                                             points));
    ASSERT_TRUE(told.finished()) << told.why();
    EXPECT_NEAR(std::remainder(told.value("_OVR[4]") - c - turned, 180), 0, exact) << points;
    EXPECT_NEAR(told.value("_OVR[5]"), planted.x(), exact) << points;
    EXPECT_NEAR(told.value("_OVR[6]"), planted.y(), exact) << points;
  }
}

/// Its walls lean: they cross elsewhere at each height.
TEST(TrueValues, OfATiltedCornerAreThoseAtTheHeightOfTheTouches) {
  const double a = radiansFromDegrees(2), down = 8;
  for (const double lower : {0.0, 6.0}) {
    World world;
    world.origin = {0, 0, -480 - lower};
    world.part = plate("{ z = -480, a = 2 }");
    const Told corner = run(
        world,
        fmt::format("TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 414 CORNER ~\nQ263=-30 ~\nQ264=-30 ~\nQ326=+20 ~\n"
                    "Q296=-40 ~\nQ297=-20 ~\nQ327=+20 ~\nQ261={:+} ~\nQ320=+3 ~\nQ260=+26 ~\nQ301=+1 ~\nQ304=+0 ~\n"
                    "Q305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n",
                    lower - down));
    ASSERT_TRUE(corner.finished()) << corner.why();
    EXPECT_NEAR(corner.value("Q151"), -40, exact);
    // The ball touches beside the height of its centre, by its radius times the sine of the tilt.
    EXPECT_NEAR(corner.value("Q152"), -(30 - down * std::sin(a)) / std::cos(a), 0.004);
  }
}

/// Cycle 418 sets the preset where the lines from the first hole to the third and from the second to the fourth cross.
TEST(TrueValues, OfFourHolesAreWhereTheirDiagonalsCross) {
  World world;
  world.origin = {0, 0, -480};
  const Pose pose = translation({0.4, -0.3, 0}) * probewright::rotation(Vector3::UnitZ(), 0.7);
  world.part =
      "[part]\npose = { x = 0.4, y = -0.3, z = -480, c = 0.7 }\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, "
      "-20]\nsize = [80, 60, 20]\n";
  const Vector3 holes[] = {{-25, -15, 0}, {25, -18, 0}, {22, 16, 0}, {-24, 14, 0}};
  for (const Vector3& hole : holes)
    world.part +=
        fmt::format("[[part.feature]]\nshape = \"hole\"\ndiameter = 12\ncentre = [{}, {}, 0]\n", hole.x(), hole.y());
  const Told told =
      run(world,
          "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 418 FOUR HOLES ~\nQ268=-25 ~\nQ269=-15 ~\nQ270=+25 ~\nQ271=-18 ~\n"
          "Q316=+22 ~\nQ317=+16 ~\nQ318=-24 ~\nQ319=+14 ~\nQ261=-5 ~\nQ260=+20 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\n"
          "Q303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const Vector3 first = holes[2] - holes[0], second = holes[3] - holes[1], between = holes[1] - holes[0];
  const double along =
      (between.x() * second.y() - between.y() * second.x()) / (first.x() * second.y() - first.y() * second.x());
  const Vector3 planted = pose * Vector3(holes[0] + along * first);
  EXPECT_NEAR(told.value("Q151"), planted.x(), exact);
  EXPECT_NEAR(told.value("Q152"), planted.y(), exact);
}

/// From a top of 40 mm the cone gets 1 mm wider each millimetre further down. The ball's centre is 8 mm below the top;
/// it touches lower than that, as the wall leans towards it.
TEST(TrueValues, OfAConeAreThoseAtTheHeightOfTheTouches) {
  World world;
  world.origin = {0, 0, -480};
  world.part =
      "[part]\npose = { z = -500 }\n[[part.feature]]\nshape = \"cone\"\ndiameter = 60\ntop_diameter = 40\nheight = "
      "20\n";
  const Told told =
      run(world,
          "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 422 STUD ~\nQ273=+0 ~\nQ274=+0 ~\nQ262=+48 ~\nQ325=+0 ~\n"
          "Q247=+90 ~\nQ261=-8 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+1 ~\nQ277=+60 ~\nQ278=+40 ~\nQ279=+0.5 ~\n"
          "Q280=+0.5 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(told.value("Q153"), 40 + 8 + 3 * std::sin(std::atan(0.5)), 1e-4);
  EXPECT_NEAR(told.value("Q151"), 0, exact);
  EXPECT_EQ(told.of("Q153")->shape, "cone");
}

/// At a height the sphere is as wide as its circle there: the ball of 3 mm, whose centre is 6 mm above that of the
/// sphere, touches it in line with both centres.
TEST(TrueValues, OfASphereAreThoseOfItsCircleAtTheHeightOfTheTouches) {
  World world;
  world.origin = {0, 0, -480};
  world.part = "[part]\npose = { x = 0.3, z = -500 }\n[[part.feature]]\nshape = \"sphere\"\ndiameter = 40\n";
  for (const double above : {6.0, -2.0}) {
    const Told told =
        run(world, fmt::format("TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 422 STUD ~\nQ273=+0 ~\nQ274=+0 ~\n"
                               "Q262=+40 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261={:+} ~\nQ320=+2 ~\nQ260=+20 ~\n"
                               "Q301=+1 ~\nQ277=+60 ~\nQ278=+20 ~\nQ279=+0.5 ~\nQ280=+0.5 ~\nQ281=+0 ~\n"
                               "Q309=+0 ~\nQ330=+0\n",
                               -20 + above));
    ASSERT_TRUE(told.finished()) << told.why();
    const double height = above * 20 / 23;
    EXPECT_NEAR(told.value("Q153"), 2 * std::sqrt(400 - height * height), 1e-5) << above;
    EXPECT_NEAR(told.value("Q151"), 0.3, exact) << above;
    EXPECT_EQ(told.of("Q153")->shape, "sphere");
  }
}

/// A ball that is believed beside the spindle's axis shifts what is measured of a slot, not where it is.
TEST(TrueValues, OfASlotAreThoseOfItsWalls) {
  for (const double a : {0.0, 1.0}) {
    World world;
    world.origin = {0, 0, -480};
    world.probe = "believed_tip_offset = [0.02, -0.03]\n";
    world.part = fmt::format(
        "[part]\npose = {{ y = 0.4, z = -480, a = {} }}\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, -40]\nsize "
        "= [160, "
        "140, 40]\n[[part.feature]]\nshape = \"pocket\"\nsize = [100, 14.02]\ndepth = 20\ncorner_radius = 2\n",
        a);
    const Told told =
        run(world,
            "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 408 SLOT ~\nQ321=+0 ~\nQ322=+0 ~\nQ311=+14 ~\nQ272=+2 ~\n"
            "Q261=-8 ~\nQ320=+0 ~\nQ260=+40 ~\nQ301=+0 ~\nQ305=+0 ~\nQ405=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\n"
            "Q383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
    ASSERT_TRUE(told.finished()) << told.why();
    // It leans about X: 8 mm below the origin its middle lies that much further in +Y.
    EXPECT_NEAR(told.value("Q157"), 0.4 + 8 * std::tan(radiansFromDegrees(a)), 1e-4) << a;
    EXPECT_NEAR(told.value("Q166"), 14.02, exact) << a;
    EXPECT_GT(std::abs(told.measured("Q157") - told.value("Q157")), 0.01) << a;
  }
}

/// Triangles do not tell a face: the true value is that of the points that were touched, with a ball that is believed
/// 0.01 mm too large as with one that is known.
TEST(TrueValues, OfTrianglesAreThoseOfTheTouchedPoints) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("true-values-{}.stl", getpid());
  {
    // A box of 80 x 60 x 20 with its top at Z0, two triangles a side, corners in the order that looks outwards.
    const Vector3 low(-40, -30, -20), high(40, 30, 0);
    std::ofstream out(file);
    out << "solid box\n";
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto corner = [&](bool alongU, bool alongV) {
          Vector3 at;
          at[axis] = upper ? high[axis] : low[axis];
          at[u] = alongU ? high[u] : low[u];
          at[v] = alongV ? high[v] : low[v];
          return at;
        };
        std::array<Vector3, 4> square{corner(false, false), corner(true, false), corner(true, true),
                                      corner(false, true)};
        if (!upper) std::swap(square[1], square[3]);
        Vector3 normal = Vector3::Zero();
        normal[axis] = upper ? 1 : -1;
        for (const int first : {1, 2}) {
          out << fmt::format("facet normal {} {} {}\nouter loop\n", normal.x(), normal.y(), normal.z());
          for (const int at : {0, first, first + 1}) {
            const Vector3& point = square[static_cast<std::size_t>(at)];
            out << fmt::format("vertex {} {} {}\n", point.x(), point.y(), point.z());
          }
          out << "endloop\nendfacet\n";
        }
      }
    out << "endsolid box\n";
  }
  for (const double believed : {3.0, 3.01}) {
    World world;
    world.origin = {0, 0, -480};
    world.believedRadius = believed;
    world.part = fmt::format("[part]\nfile = \"{}\"\npose = {{ y = 0.4, z = -480, a = 1.2 }}\n", file.string());
    const Told front =
        run(world,
            "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 427 COORDINATE ~\nQ263=+0 ~\nQ264=-30 ~\nQ261=-8 ~\n"
            "Q320=+2 ~\nQ272=+2 ~\nQ267=+1 ~\nQ260=+20 ~\nQ281=+0 ~\nQ288=+99 ~\nQ289=-99 ~\nQ309=+0 ~\nQ330=+0\n");
    ASSERT_TRUE(front.finished()) << front.why();
    const double a = radiansFromDegrees(1.2);
    // The front side leans: y cos a + (z + ...) sin a = -30 about the part's origin, at the height of the ball's
    // centre.
    EXPECT_NEAR(front.value("Q160"), 0.4 - (30 - 8 * std::sin(a)) / std::cos(a), 1e-3) << believed;
    EXPECT_EQ(front.of("Q160")->basis, records::TruthBasis::Points);
    const Told plane =
        run(world,
            "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 431 PLANE ~\nQ263=+30 ~\nQ264=-25 ~\nQ294=+0 ~\n"
            "Q265=-30 ~\nQ266=-25 ~\nQ295=+0 ~\nQ296=+30 ~\nQ297=+25 ~\nQ298=+0 ~\nQ320=+2 ~\nQ260=+20 ~\n"
            "Q281=+0\n");
    ASSERT_TRUE(plane.finished()) << plane.why();
    EXPECT_NEAR(std::abs(plane.value("Q170")), 1.2, 1e-4) << believed;
  }
  std::filesystem::remove(file);
}

/// CYCLE998 tells the angles of a plane about both axes from three points.
TEST(TrueValues, OfAPlaneOfThreePointsAreItsAngles) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480, a = 1.2, b = 0.7 }");
  const Told told = run(world, "T1 D1\nM6\nG54 G17 G0 X-30 Y-20 Z12\nCYCLE998(6,,,1,,,,10,5,,,,60,,60,40,1,,1,)\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(told.value("_OVR[4]"), 1.2, exact);
  EXPECT_NEAR(told.value("_OVR[5]"), 0.7, exact);
}

/// In line with the touches the points of both holes lie in a plane, which nobody has measured. Each hole has a size
/// and a place of its own.
TEST(TrueValues, OfALineThroughTwoHolesAreItsAngleInLineWithTheTouches) {
  for (const double c : {0.0, 0.7, -0.4}) {
    World world;
    world.origin = {0, 0, -480};
    world.part = fmt::format(
        "[part]\npose = {{ z = -480, c = {} }}\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, -20]\nsize = [80, "
        "60, "
        "20]\n",
        c);
    for (const auto& [x, diameter] : {std::pair(-20, 16.01), {20, 17.02}})
      world.part +=
          fmt::format("[[part.feature]]\nshape = \"hole\"\ndiameter = {}\ncentre = [{}, 0, 0]\n", diameter, x);
    const Told told =
        run(world,
            "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 1411 TWO CIRCLES ~\nQ1100=-20 ~\nQ1101=+0 ~\nQ1102=-5 ~\n"
            "Q1116=+16 ~\nQ1103=+20 ~\nQ1104=+0 ~\nQ1105=-5 ~\nQ1117=+17 ~\nQ1115=+0 ~\nQ423=+4 ~\nQ325=+0 ~\n"
            "Q1119=+360 ~\nQ320=+0 ~\nQ260=+20 ~\nQ1125=+2 ~\nQ309=+0 ~\nQ1126=+0 ~\nQ1120=+0 ~\nQ1121=+0\n");
    ASSERT_TRUE(told.finished()) << told.why();
    EXPECT_NEAR(told.measured("Q964"), c, exact);
    ASSERT_TRUE(told.of("Q964"));
    EXPECT_NEAR(told.value("Q964"), c, exact);
    const double cosine = std::cos(radiansFromDegrees(c)), sine = std::sin(radiansFromDegrees(c));
    for (const auto& [name, value] : {std::pair("Q966", 16.01),
                                      {"Q967", 17.02},
                                      {"Q950", -20 * cosine},
                                      {"Q951", -20 * sine},
                                      {"Q953", 20 * cosine},
                                      {"Q954", 20 * sine}})
      EXPECT_NEAR(told.value(name), value, exact) << name;
  }
}

/// The axis of the shaft lies a little beside the turning axis: one touch is wrong by that, two are not.
TEST(TrueValues, OfATurnedDiameterAreThoseOfAllItsTouches) {
  for (const double beside : {-0.0076, 0.004}) {
    World world;
    world.control = "840Dsl";
    world.origin = {0, 0, 180};
    world.part = fmt::format(
        "[part]\npose = {{ x = {} }}\n[[part.feature]]\nshape = \"cylinder\"\ndiameter = 27.982\nheight = 180\n",
        beside);
    world.probe = "stylus_length = 60\nbody_radius = 20\nshank_direction = [0, 0, 1]\n";
    world.more = "[machine]\nname = \"lathe2c\"\n";
    const std::string to = "T=\"PROBE\" D1\nG54 G18 G90 G95 DIAMON\nG0 X140 Z50\nG0 X44\nZ-12\n";
    for (const char* call : {"CYCLE994(2,,,1,28,102,,20,8,1,1)\n", "CYCLE974(10002,,,1,28,2,8,1,0,1)\n",
                             "DIAMOF\nCYCLE994(2,,,1,14,102,,20,8,1,1)\n"}) {
      const Told told = run(world, to + call);
      ASSERT_TRUE(told.finished()) << call << told.why();
      const double diameter = call[0] == 'D' ? 27.982 / 2 : 27.982;
      EXPECT_NEAR(told.measured("_OVR[4]"), diameter, 1e-5) << call;
      EXPECT_NEAR(told.value("_OVR[4]"), diameter, 1e-5) << call;
    }
    const Told once = run(world, to + "CYCLE974(2,,,1,28,2,8,1,0,1)\n");
    ASSERT_TRUE(once.finished()) << once.why();
    EXPECT_NEAR(once.value("_OVR[4]"), 27.982 + 2 * beside, 1e-5);
  }
}

TEST(TrueValues, AreLeftOutWhereThereIsNone) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  const Told told = run(world, hole977);
  ASSERT_TRUE(told.finished()) << told.why();
  for (const char* name : {"_OVR[0]", "_OVR[16]", "_OVI[3]"})
    EXPECT_FALSE(told.of(name)) << name;
}

TEST(TrueValues, AreToldEverywhereButToTheBlind) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  const Told told = run(world, hole421);
  ASSERT_TRUE(told.finished()) << told.why();
  const auto json = records::resultsJson(told.outcome.journal, told.outcome.info);
  EXPECT_NEAR(json["cycles"][0]["results"][2]["truth"]["value"].get<double>(), 30.01, exact);
  EXPECT_THAT(reports::summaryText(told.outcome.journal, told.outcome.info), HasSubstr("true 30.0100, error "));
  setup::MachineOptions blind;
  blind.blind = true;
  const Told hidden = run(world, hole421, blind);
  EXPECT_THAT(records::resultsText(hidden.outcome.journal, hidden.outcome.info), Not(HasSubstr("truth")));
  EXPECT_THAT(reports::summaryText(hidden.outcome.journal, hidden.outcome.info), Not(HasSubstr("true ")));
}

}  // namespace
}  // namespace probewright::truth::testing
