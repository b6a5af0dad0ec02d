#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "truth/told.hpp"

/// Which true value belongs to a result, where faces, triangles and other touches could be mistaken for each other.
namespace probewright::truth::testing {
namespace {

constexpr double exact = 1e-6;  // mm, degrees

std::string box(const Vector3& centre, const Vector3& size) {
  return fmt::format("[[part.feature]]\nshape = \"box\"\ncentre = [{}, {}, {}]\nsize = [{}, {}, {}]\n", centre.x(),
                     centre.y(), centre.z(), size.x(), size.y(), size.z());
}

/// Triangles of a prism that stands on Z0, with these corners, seen from above against the clock.
std::string prism(const std::vector<Vector2>& corners, double height) {
  std::string text;
  const auto facet = [&text](const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 normal = (b - a).cross(c - a).normalized();
    text += fmt::format("facet normal {} {} {}\nouter loop\n", normal.x(), normal.y(), normal.z());
    for (const Vector3& at : {a, b, c})
      text += fmt::format("vertex {} {} {}\n", at.x(), at.y(), at.z());
    text += "endloop\nendfacet\n";
  };
  const auto at = [](const Vector2& corner, double z) { return Vector3(corner.x(), corner.y(), z); };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2 &from = corners[i], &to = corners[(i + 1) % corners.size()];
    facet(at(from, 0), at(to, 0), at(to, height));
    facet(at(from, 0), at(to, height), at(from, height));
    if (i == 0 || i + 1 == corners.size()) continue;
    facet(at(corners[0], height), at(from, height), at(to, height));
    facet(at(corners[0], 0), at(to, 0), at(from, 0));
  }
  return text;
}

/// An STL file that goes with the test.
class Triangles {
public:
  explicit Triangles(const std::string& facets)
      : path_(std::filesystem::temp_directory_path() / fmt::format("touched-faces-{}.stl", getpid())) {
    std::ofstream(path_) << "solid shape\n" << facets << "endsolid shape\n";
  }
  ~Triangles() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Triangles(const Triangles&) = delete;
  Triangles& operator=(const Triangles&) = delete;
  std::string path() const { return path_.string(); }

private:
  std::filesystem::path path_;
};

/// Two touches on two flat faces, one 0.5 mm in front of the other: the line runs through both points.
TEST(TouchedFaces, OfTwoStepsTellTheLineThroughTheirPoints) {
  const std::string edge =
      "TCH PROBE 420 ANGLE ~\nQ263=-30 ~\nQ264=-30 ~\nQ265=+30 ~\nQ266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\nQ261=-8 ~\n"
      "Q320=+2 ~\nQ260=+20 ~\nQ301=+1 ~\nQ281=+0\n";
  const Told steps = run(
      worldWith("[part]\npose = { z = -480 }\n" + box({-20, 0, -20}, {40, 60, 20}) + box({20, 0.5, -20}, {40, 60, 20})),
      probeAbove + edge);
  ASSERT_TRUE(steps.finished()) << steps.why();
  EXPECT_NEAR(steps.value("Q150"), degreesFromRadians(std::atan2(0.5, 60)), exact);
  EXPECT_EQ(steps.of("Q150")->basis, records::TruthBasis::Points);
  const Told one = run(worldWith(plate("{ z = -480 }")), probeAbove + edge);
  ASSERT_TRUE(one.finished()) << one.why();
  EXPECT_EQ(one.of("Q150")->basis, records::TruthBasis::Face);
  EXPECT_EQ(one.of("Q150")->shape, "plane");
}

/// Three touches on three flat faces, which are 0.4 and 0.9 mm apart in height: the plane runs through all points.
TEST(TouchedFaces, OfThreeStepsTellThePlaneThroughTheirPoints) {
  const Told told = run(worldWith("[part]\npose = { z = -480 }\n" + box({-25, -20, -20}, {30, 30, 20}) +
                                  box({25, -20, -20}, {30, 30, 20.4}) + box({-25, 20, -20}, {30, 30, 20.9})),
                        probeAbove +
                            "TCH PROBE 431 PLANE ~\nQ263=-25 ~\nQ264=-20 ~\nQ294=+0 ~\nQ265=+25 ~\nQ266=-20 ~\n"
                            "Q295=+0.4 ~\nQ296=-25 ~\nQ297=+20 ~\nQ298=+0.9 ~\nQ320=+2 ~\nQ260=+20 ~\nQ281=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  // It rises by 0.9 in 40 along Y and by 0.4 in 50 along X. Turned by A about X, then by B about Y, Z becomes
  // (cos A sin B, -sin A, cos A cos B).
  const Vector3 normal = Vector3(-0.4 / 50, -0.9 / 40, 1).normalized();
  EXPECT_NEAR(told.value("Q170"), degreesFromRadians(std::asin(-normal.y())), exact);
  EXPECT_NEAR(told.value("Q171"), degreesFromRadians(std::atan2(normal.x(), normal.z())), exact);
  EXPECT_EQ(told.of("Q170")->basis, records::TruthBasis::Points);
}

/// A wall of the part and one of triangles: what both together tell rests on points.
TEST(TouchedFaces, OfAFaceAndOfTrianglesRestOnPoints) {
  const Triangles wall(prism({{-30, 0}, {30, 0}, {30, 10}, {-30, 10}}, 20));
  for (const double side : {1.0, -1.0}) {
    // The slot is 14 wide: from Y-7 to Y+7.
    World world = worldWith("[part]\npose = { z = -480 }\n" + box({0, -side * 12, -20}, {60, 10, 20}));
    world.more = fmt::format("[[fixture]]\nname = \"wall\"\nfile = \"{}\"\npose = {{ y = {}, z = -500 }}\n",
                             wall.path(), side > 0 ? 7 : -17);
    const Told told =
        run(world,
            probeAbove +
                "TCH PROBE 408 SLOT ~\nQ321=+0 ~\nQ322=+0 ~\nQ311=+14 ~\nQ272=+2 ~\nQ261=-8 ~\nQ320=+0 ~\nQ260=+40 ~\n"
                "Q301=+0 ~\nQ305=+0 ~\nQ405=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
    ASSERT_TRUE(told.finished()) << told.why();
    EXPECT_NEAR(told.value("Q166"), 14, 1e-4) << side;
    EXPECT_NEAR(told.value("Q157"), 0, 1e-4) << side;
    EXPECT_EQ(told.of("Q166")->basis, records::TruthBasis::Points) << side;
    EXPECT_EQ(told.of("Q166")->shape, "") << side;
  }
}

/// Triangles do not tell which of them belong together; the circles that the control laid through its points do.
TEST(TouchedFaces, OfTwoStudsOfTrianglesAreThoseOfTheFits) {
  constexpr double radius = 8;
  std::string facets;
  for (const double x : {-20.0, 20.0}) {
    std::vector<Vector2> corners;
    for (int i = 0; i < 360; ++i) {
      const double at = radiansFromDegrees(i);
      corners.emplace_back(x + radius * std::cos(at), 0.3 + radius * std::sin(at));
    }
    facets += prism(corners, 20);
  }
  const Triangles studs(facets);
  const Told told = run(
      worldWith(fmt::format("[part]\nfile = \"{}\"\npose = {{ z = -500 }}\n", studs.path())),
      probeAbove +
          "TCH PROBE 1411 TWO CIRCLES ~\nQ1100=-20 ~\nQ1101=+0 ~\nQ1102=-5 ~\nQ1116=+16 ~\nQ1103=+20 ~\nQ1104=+0 ~\n"
          "Q1105=-5 ~\nQ1117=+16 ~\nQ1115=+1 ~\nQ423=+4 ~\nQ325=+0 ~\nQ1119=+360 ~\nQ320=+2 ~\nQ260=+20 ~\nQ1125=+2 ~\n"
          "Q309=+0 ~\nQ1126=+0 ~\nQ1120=+0 ~\nQ1121=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  // Chords of one degree lie up to 0.0003 mm within the circle.
  for (const auto& [name, expected] :
       {std::pair("Q966", 16.0), {"Q967", 16.0}, {"Q950", -20.0}, {"Q951", 0.3}, {"Q953", 20.0}, {"Q954", 0.3}})
    EXPECT_NEAR(told.value(name), expected, 1e-3) << name;
}

/// The probe expects the hole 4 mm beside its place: it touches the wall askew, and the circle of the ball centres is
/// not that of the points in the direction of probing.
TEST(TouchedFaces, OfAHoleBesideItsPlaceAreItsOwn) {
  for (const int cycle : {421, 422}) {
    const bool hole = cycle == 421;
    const Told told = run(
        worldWith(
            "[part]\npose = { z = -480 }\n" +
            (hole ? box({0, 0, -20}, {160, 140, 20}) +
                        "[[part.feature]]\nshape = \"hole\"\ndiameter = 30.01\ncentre = [50, 40, 0]\n"
                  : std::string("[[part.feature]]\nshape = \"cylinder\"\ndiameter = 30.01\nheight = 20\ncentre = [50, "
                                "40, -20]\n"))),
        probeAbove +
            fmt::format("TCH PROBE {} ROUND ~\nQ273=+46 ~\nQ274=+40 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\n"
                        "Q320=+3 ~\nQ260=+20 ~\nQ301=+1 ~\n{}Q279=+9 ~\nQ280=+9 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n",
                        cycle, hole ? "Q275=+30.1 ~\nQ276=+29 ~\n" : "Q277=+30.1 ~\nQ278=+29 ~\n"));
    ASSERT_TRUE(told.finished()) << told.why();
    EXPECT_NEAR(told.value("Q153"), 30.01, exact) << cycle;
    EXPECT_NEAR(told.value("Q151"), 50, exact) << cycle;
    EXPECT_NEAR(told.value("Q152"), 40, exact) << cycle;
  }
}

/// A side is where the ball touched it, not where it was to touch: the sides are turned by 8 degrees, and the axes of
/// the machine are not square.
TEST(TouchedFaces, OfACornerAskewAreItsOwn) {
  const double c = 8;
  const Vector3 planted = probewright::rotation(Vector3::UnitZ(), c) * Vector3(-40, -30, 0);
  const std::string corner =
      "TCH PROBE 414 CORNER ~\nQ263=-30 ~\nQ264=-32 ~\nQ326=+20 ~\nQ296=-36 ~\nQ297=-20 ~\nQ327=+20 ~\nQ261=-8 ~\n"
      "Q320=+6 ~\nQ260=+20 ~\nQ301=+1 ~\nQ304=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\n"
      "Q383=+0 ~\nQ384=+0 ~\nQ333=+0\n";
  World world = worldWith(plate(fmt::format("{{ z = -480, c = {} }}", c)));
  world.probe = "maximum_travel = 40\n";
  for (const char* errors : {"", "[[errors.squareness]]\naxis = \"X\"\ntowards = \"Y\"\ndegrees = 0.5\n"}) {
    world.more = errors;
    const Told told = run(world, probeAbove + corner);
    ASSERT_TRUE(told.finished()) << told.why();
    EXPECT_NEAR(told.value("Q151"), planted.x(), exact) << errors;
    EXPECT_NEAR(told.value("Q152"), planted.y(), exact) << errors;
  }
}

/// The ball stands half a millimetre beside the place where the control sees it: of a round face the value is that
/// where the control saw the touch.
TEST(TouchedFaces, OfARoundFaceAreThoseWhereTheControlSawTheTouch) {
  World world =
      worldWith("[part]\npose = { z = -500 }\n[[part.feature]]\nshape = \"cylinder\"\ndiameter = 40\nheight = 20\n");
  world.probe = "believed_tip_offset = [0.5, 0]\n";
  const Told told =
      run(world, probeAbove +
                     "TCH PROBE 427 COORDINATE ~\nQ263=+10 ~\nQ264=-17 ~\nQ261=-8 ~\nQ320=+4 ~\nQ272=+2 ~\n"
                     "Q267=+1 ~\nQ260=+20 ~\nQ281=+0 ~\nQ288=+99 ~\nQ289=-99 ~\nQ309=+0 ~\nQ330=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(told.value("Q160"), -std::sqrt(400.0 - 100.0), exact);
}

/// The touch of a MEAS block before the cycle is not the cycle's, nor does a tool touch probe on the table matter.
TEST(TouchedFaces, OfACycleAreNotThoseOfABlockBefore) {
  World world = worldWith(plate("{ z = -480 }"), "840Dsl");
  world.more = "[tool_probe]\ndiameter = 20\nthickness = 8\nstem_diameter = 6\npose = { x = 250, y = 120, z = -560 }\n";
  const Told told = run(world,
                        "T1 D1\nM6\nG54 G17 G0 X-55 Y0 Z20\nG1 Z-8 F2000\nMEAS=1 G1 X-30 F300\nG0 X-60\nG0 Z20\n"
                        "X0 Y-40\nG1 Z-8 F2000\nCYCLE978(0,,,1,-30,6,9,2,1,1,,,,,,1)\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(told.value("_OVR[4]"), -30, exact);
  EXPECT_EQ(told.of("_OVR[4]")->shape, "plane");
}

/// CYCLE997 tells a sphere, its height too.
TEST(TouchedFaces, OfASphereAreItsCentreAndDiameter) {
  World world = worldWith(
      "[part]\npose = { z = -500 }\n[[part.feature]]\nshape = \"sphere\"\ndiameter = 25.02\ncentre = [0.3, -0.2, 40]\n",
      "840Dsl");
  const Told told = run(world, "T1 D1\nM6\nG54 G17 G0 X0 Y0 Z37.5\nCYCLE997(9,,1,25,5,4,,,0,0,20)\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(told.value("_OVR[4]"), 25.02, exact);
  EXPECT_NEAR(told.value("_OVR[5]"), 0.3, exact);
  EXPECT_NEAR(told.value("_OVR[6]"), -0.2, exact);
  EXPECT_NEAR(told.value("_OVR[7]"), 20, exact);
}

/// CYCLE961 tells a corner in machine coordinates, too: they are those of the table while it stands at 0.
TEST(TouchedFaces, InMachineCoordinatesAreToldWhileTheTableStandsAtZero) {
  for (const double c : {0.0, 30.0}) {
    World world = worldWith(plate(fmt::format("{{ x = 5, z = -480, c = {} }}", c)), "840Dsl");
    world.origin = {5, 0, -480};
    world.more = "[machine]\nname = \"mill5-table-table\"\n";
    const Told told = run(world, fmt::format("T1 D1\nM6\nG54 G17 G0 Z100\nC{}\nG0 X-55 Y-45\nZ20\nG1 Z-8 F2000\n"
                                             "CYCLE961(16,,1,-20,-45,20,-45,-55,10,,,,,0,,0,20,80,1,,1,)\n",
                                             c));
    ASSERT_TRUE(told.finished()) << told.why();
    if (c == 0) {
      EXPECT_NEAR(told.value("_OVR[21]"), -35, exact);
      EXPECT_NEAR(told.value("_OVR[22]"), -30, exact);
    } else {
      EXPECT_FALSE(told.of("_OVR[21]"));
    }
  }
}

/// A probe that lies along Y measures in the plane of Z and X.
TEST(TouchedFaces, InAnotherPlaneAreThoseOfItsAxes) {
  World world = worldWith("[part]\npose = { x = 0.3, z = -479.6, a = -90 }\n" + box({0, 0, -20}, {80, 60, 20}) +
                          "[[part.feature]]\nshape = \"hole\"\ndiameter = 30.01\n");
  world.probe = "shank_direction = [0, 1, 0]\n";
  const Told told = run(world,
                        "TOOL CALL 1 Y\nL Y+50 R0 FMAX\nL X+0 Z+0 FMAX\nTCH PROBE 421 HOLE ~\nQ273=+0 ~\nQ274=+0 ~\n"
                        "Q262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ275=+30.1 ~\n"
                        "Q276=+29 ~\nQ279=+1 ~\nQ280=+1 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(told.value("Q151"), 0.4, exact);
  EXPECT_NEAR(told.value("Q152"), 0.3, exact);
  EXPECT_NEAR(told.value("Q153"), 30.01, exact);
}

/// Its walls lean both ways: at each height they cross elsewhere.
TEST(TouchedFaces, OfALeaningCornerAreThoseAtTheHeightOfTheTouches) {
  for (const double lower : {0.0, 6.0}) {
    World world = worldWith(plate("{ z = -480, a = 2, b = 1.5 }"));
    world.origin.z() -= lower;
    const Told told =
        run(world,
            probeAbove +
                fmt::format(
                    "TCH PROBE 414 CORNER ~\nQ263=-30 ~\nQ264=-30 ~\nQ326=+20 ~\nQ296=-40 ~\nQ297=-20 ~\nQ327=+20 ~\n"
                    "Q261={:+} ~\nQ320=+3 ~\nQ260=+26 ~\nQ301=+1 ~\nQ304=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\n"
                    "Q303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n",
                    lower - 8));
    ASSERT_TRUE(told.finished()) << told.why();
    // Where the planes of both sides and that of the height meet; each ball touches a little beside the height.
    const Matrix3 turned =
        (probewright::rotation(Vector3::UnitY(), 1.5) * probewright::rotation(Vector3::UnitX(), 2)).linear();
    Matrix3 normals;
    normals << turned.col(0).transpose(), turned.col(1).transpose(), Vector3::UnitZ().transpose();
    const Vector3 corner = normals.inverse() * Vector3(-40, -30, -8);
    EXPECT_NEAR(told.value("Q151"), corner.x(), 0.005) << lower;
    EXPECT_NEAR(told.value("Q152"), corner.y(), 0.005) << lower;
  }
}

}  // namespace
}  // namespace probewright::truth::testing
