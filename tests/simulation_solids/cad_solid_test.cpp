#include "simulation/cad_solid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Writer.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include "worlds.hpp"

namespace probewright::simulation {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::randomDirection;
using testing::randomPoint;
using testing::randomPose;
using testing::ScratchFolder;
using testing::uniform;
using testing::walkToContact;

using Distance = std::function<double(const Vector3&)>;

TopoDS_Shape moved(const TopoDS_Shape& shape, const Pose& pose) {
  gp_Trsf transform;
  const Eigen::Matrix<double, 3, 4> m = pose.matrix().topRows<3>();
  transform.SetValues(m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3), m(2, 0), m(2, 1), m(2, 2),
                      m(2, 3));
  return BRepBuilderAPI_Transform(shape, transform, Standard_True).Shape();
}

std::unique_ptr<Solid> throughStep(const TopoDS_Shape& shape, const Pose& pose) {
  const ScratchFolder folder;
  const auto written = writeStep(moved(shape, pose), folder / "part.step");
  EXPECT_TRUE(written) << format(written.error());
  auto solid = readStep(folder / "part.step");
  EXPECT_TRUE(solid) << format(solid.error());
  return solid ? std::move(*solid) : nullptr;
}

/// The distance from a convex or ring-shaped body of revolution about z, by its meridian outside the axis: a polygon
/// in (radius, z).
double distanceToMeridian(double rho, double z, const std::vector<Vector2>& polygon, bool open) {
  double best = 1e300;
  const Vector2 p(rho, z);
  for (std::size_t i = 0; i + (open ? 1 : 0) < polygon.size(); ++i) {
    const Vector2& a = polygon[i];
    const Vector2 edge = polygon[(i + 1) % polygon.size()] - a;
    const double s = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - a - s * edge).norm());
  }
  return best;
}

double rhoOf(const Vector3& p) { return std::hypot(p.x(), p.y()); }

/// Sends balls at the part and compares each first contact with the walk over the closed-form distance.
struct Expectation {
  int contacts = 0;
  int misses = 0;
};

Expectation compare(const Solid& solid, const Pose& pose, const Distance& distance,
                    const std::function<std::pair<Vector3, Vector3>()>& way, const std::function<double()>& radius,
                    int count) {
  Expectation seen;
  for (int i = 0; i < count; ++i) {
    const auto [from, to] = way();
    const double r = radius();
    const auto expected = walkToContact(distance, from, to, r);
    if (expected && (std::isnan(*expected) || *expected == 0)) continue;
    const auto contact = solid.firstContact(pose * from, pose * to, r);
    EXPECT_EQ(contact.has_value(), expected.has_value())
        << i << " from " << from.transpose() << " to " << to.transpose() << " radius " << r;
    if (!contact || !expected) {
      ++seen.misses;
      continue;
    }
    ++seen.contacts;
    EXPECT_NEAR(contact->fraction * (to - from).norm(), *expected, 1e-6)
        << i << " from " << from.transpose() << " to " << to.transpose() << " radius " << r;
    const Vector3 touch = pose.inverse() * contact->touchPoint;
    EXPECT_NEAR(distance(touch), 0, 1e-6) << i;
    EXPECT_LT((contact->touchPoint + r * contact->normal - contact->ballCentre).norm(), 1e-6) << i;
  }
  return seen;
}

/// Ways from outside towards and past a body of about the given size.
std::function<std::pair<Vector3, Vector3>()> inwardWays(std::mt19937_64& random, double size) {
  return [&random, size] {
    const Vector3 from = 4 * size * randomDirection(random);
    const Vector3 aim = randomPoint(random, 0.5 * size);
    return std::pair<Vector3, Vector3>(from, from + uniform(random, 2.5, 8) * size * (aim - from).normalized());
  };
}

TEST(CadSolid, MeetsABoxWithItsEdgesAndCorners) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 4; ++i) {
    const Vector3 half(uniform(random, 5, 30), uniform(random, 5, 30), uniform(random, 2, 20));
    const Pose pose = randomPose(random, 200);
    const auto solid = throughStep(
        BRepPrimAPI_MakeBox(gp_Pnt(-half.x(), -half.y(), -half.z()), gp_Pnt(half.x(), half.y(), half.z())).Shape(),
        pose);
    ASSERT_TRUE(solid);
    const Distance distance = [&](const Vector3& p) { return (p.cwiseAbs() - half).cwiseMax(0).norm(); };
    const auto seen = compare(
        *solid, pose,
        [&](const Vector3& p) {
          const Vector3 q = p.cwiseAbs() - half;
          return q.maxCoeff() < 0 ? -q.maxCoeff() : distance(p);
        },
        inwardWays(random, 30), [&] { return uniform(random, 0.3, 8); }, 150);
    EXPECT_GT(seen.contacts, 50);
  }
}

TEST(CadSolid, MeetsACylinderAndAConeFromOutside) {
  std::mt19937_64 random(12);
  for (int i = 0; i < 8; ++i) {
    const double bottom = uniform(random, 5, 20);
    const double top = i % 2 == 0 ? bottom : uniform(random, i == 5 ? 0.0 : 1.0, bottom - 1);
    const double height = uniform(random, 5, 40);
    const TopoDS_Shape shape = i % 2 == 0 ? BRepPrimAPI_MakeCylinder(bottom, height).Shape()
                                          : BRepPrimAPI_MakeCone(bottom, top, height).Shape();
    const Pose pose = randomPose(random, 200);
    const auto solid = throughStep(shape, pose);
    ASSERT_TRUE(solid);
    const std::vector<Vector2> meridian{{0, 0}, {bottom, 0}, {top, height}, {0, height}};
    const auto seen = compare(
        *solid, pose, [&](const Vector3& p) { return distanceToMeridian(rhoOf(p), p.z(), meridian, true); },
        inwardWays(random, 25), [&] { return uniform(random, 0.3, 8); }, 100);
    EXPECT_GT(seen.contacts, 30);
  }
}

TEST(CadSolid, MeetsSphereAndTorusFromOutside) {
  std::mt19937_64 random(13);
  for (int i = 0; i < 4; ++i) {
    const double ring = uniform(random, 8, 20);
    const double tube = uniform(random, 1, 7);
    const Pose pose = randomPose(random, 200);
    const auto sphere = throughStep(BRepPrimAPI_MakeSphere(ring).Shape(), pose);
    const auto torus = throughStep(BRepPrimAPI_MakeTorus(ring, tube).Shape(), pose);
    ASSERT_TRUE(sphere && torus);
    const auto radius = [&] { return uniform(random, 0.3, 8); };
    EXPECT_GT(compare(
                  *sphere, pose, [&](const Vector3& p) { return std::abs(p.norm() - ring); }, inwardWays(random, 25),
                  radius, 100)
                  .contacts,
              20);
    EXPECT_GT(compare(
                  *torus, pose, [&](const Vector3& p) { return std::abs(std::hypot(rhoOf(p) - ring, p.z()) - tube); },
                  inwardWays(random, 25), radius, 100)
                  .contacts,
              20);
  }
}

TEST(CadSolid, MeetsABoreFromInsideAndAtItsRims) {
  std::mt19937_64 random(14);
  for (int i = 0; i < 5; ++i) {
    const double bore = uniform(random, 5, 20);
    const double depth = uniform(random, 5, 30);
    const Pose pose = randomPose(random, 200);
    const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(-60, -60, -depth), gp_Pnt(60, 60, 0)).Shape();
    const auto solid = throughStep(
        BRepAlgoAPI_Cut(block, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -50), gp::DZ()), bore, 100).Shape())
            .Shape(),
        pose);
    ASSERT_TRUE(solid);
    const Distance distance = [&](const Vector3& p) {
      return std::hypot(std::max(bore - rhoOf(p), 0.0), std::max({p.z(), -depth - p.z(), 0.0}));
    };
    const auto ways = [&] {
      const Vector3 from(uniform(random, -0.4, 0.4) * bore, uniform(random, -0.4, 0.4) * bore,
                         uniform(random, -depth - 15, 15));
      return std::pair<Vector3, Vector3>(from, from + uniform(random, 1, 25) * randomDirection(random));
    };
    const auto seen = compare(
        *solid, pose, distance, ways, [&] { return uniform(random, 0.5, 0.4 * bore); }, 400);
    EXPECT_GT(seen.contacts, 40);
  }
}

TEST(CadSolid, MeetsHollowSphereConeAndTorusFromInside) {
  std::mt19937_64 random(15);
  const auto hollow = [](const TopoDS_Shape& shape) {
    return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(gp_Pnt(-50, -50, -50), gp_Pnt(50, 50, 50)).Shape(), shape).Shape();
  };
  const auto radius = [&] { return uniform(random, 0.3, 1.5); };
  for (int i = 0; i < 3; ++i) {
    const Pose pose = randomPose(random, 200);
    const auto sphere = throughStep(hollow(BRepPrimAPI_MakeSphere(20).Shape()), pose);
    const auto torus = throughStep(hollow(BRepPrimAPI_MakeTorus(30, 6).Shape()), pose);
    const auto cone = throughStep(hollow(BRepPrimAPI_MakeCone(20, 8, 25).Shape()), pose);
    ASSERT_TRUE(sphere && torus && cone);
    const auto ways = [&](const Vector3& middle) {
      return [&random, middle] {
        const Vector3 from = middle + randomPoint(random, 2);
        return std::pair<Vector3, Vector3>(from, from + uniform(random, 1, 60) * randomDirection(random));
      };
    };
    EXPECT_GT(
        compare(
            *sphere, pose, [&](const Vector3& p) { return std::abs(20 - p.norm()); }, ways(Vector3::Zero()), radius, 60)
            .contacts,
        20);
    EXPECT_GT(compare(
                  *torus, pose, [&](const Vector3& p) { return std::abs(6 - std::hypot(rhoOf(p) - 30, p.z())); },
                  ways({30, 0, 0}), radius, 60)
                  .contacts,
              20);
    const std::vector<Vector2> meridian{{0, 0}, {20, 0}, {8, 25}, {0, 25}};
    EXPECT_GT(compare(
                  *cone, pose, [&](const Vector3& p) { return distanceToMeridian(rhoOf(p), p.z(), meridian, true); },
                  ways({0, 0, 10}), radius, 60)
                  .contacts,
              20);
  }
}

Handle(Geom_BSplineSurface) wavySurface() {
  TColgp_Array2OfPnt points(1, 12, 1, 10);
  for (int i = 1; i <= 12; ++i) {
    for (int j = 1; j <= 10; ++j) {
      const double x = 5.0 * (i - 6.5);
      const double y = 5.0 * (j - 5.5);
      points(i, j) = gp_Pnt(x, y, 4 * std::sin(x / 9) * std::cos(y / 11) + 0.01 * x * y);
    }
  }
  return GeomAPI_PointsToBSplineSurface(points, 3, 8, GeomAbs_C2, 1e-3).Surface();
}

/// The distance from a free-form surface by dense sampling and a pattern search from the nearest samples.
class SampledSurface {
public:
  explicit SampledSurface(const Handle(Geom_BSplineSurface) & surface) : surface_(surface) {
    surface_->Bounds(u0_, u1_, v0_, v1_);
    for (int i = 0; i <= kGrid; ++i) {
      for (int j = 0; j <= kGrid; ++j)
        samples_.push_back(at(double(i) / kGrid, double(j) / kGrid));
    }
  }

  double distance(const Vector3& p) const {
    double nearest = 1e300;
    for (const Vector3& sample : samples_)
      nearest = std::min(nearest, (sample - p).squaredNorm());
    double best = 1e300;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (std::sqrt((samples_[i] - p).squaredNorm()) > std::sqrt(nearest) + 0.02) continue;
      best = std::min(best, refine(p, double(i / (kGrid + 1)) / kGrid, double(i % (kGrid + 1)) / kGrid));
    }
    return best;
  }

private:
  static constexpr int kGrid = 120;

  Vector3 at(double s, double t) const {
    const gp_Pnt p = surface_->Value(u0_ + s * (u1_ - u0_), v0_ + t * (v1_ - v0_));
    return {p.X(), p.Y(), p.Z()};
  }

  double refine(const Vector3& p, double s, double t) const {
    double best = (at(s, t) - p).norm();
    for (double step = 1.0 / kGrid; step > 1e-9; step /= 2) {
      for (bool better = true; better;) {
        better = false;
        for (const auto& [ds, dt] : {std::pair(step, 0.0),
                                     {-step, 0.0},
                                     {0.0, step},
                                     {0.0, -step},
                                     {step, step},
                                     {-step, -step},
                                     {step, -step},
                                     {-step, step}}) {
          const double s2 = std::clamp(s + ds, 0.0, 1.0);
          const double t2 = std::clamp(t + dt, 0.0, 1.0);
          const double d = (at(s2, t2) - p).norm();
          if (d < best - 1e-15) {
            best = d;
            s = s2;
            t = t2;
            better = true;
          }
        }
      }
    }
    return best;
  }

  Handle(Geom_BSplineSurface) surface_;
  double u0_ = 0, u1_ = 0, v0_ = 0, v1_ = 0;
  std::vector<Vector3> samples_;
};

TEST(CadSolid, MeetsAFreeFormFaceAndItsRim) {
  std::mt19937_64 random(16);
  const Handle(Geom_BSplineSurface) surface = wavySurface();
  const SampledSurface samples(surface);
  const Pose pose = randomPose(random, 100);
  const auto solid = throughStep(BRepBuilderAPI_MakeFace(surface, 1e-6).Shape(), pose);
  ASSERT_TRUE(solid);
  const auto ways = [&] {
    const Vector3 from(uniform(random, -40, 40), uniform(random, -35, 35), (random() % 2 == 0 ? 1 : -1) * 40.0);
    const Vector3 aim(uniform(random, -32, 32), uniform(random, -26, 26), 0);
    return std::pair<Vector3, Vector3>(from, from + uniform(random, 30, 70) * (aim - from).normalized());
  };
  const auto seen = compare(
      *solid, pose, [&](const Vector3& p) { return samples.distance(p); }, ways,
      [&] { return uniform(random, 0.5, 4); }, 100);
  EXPECT_GT(seen.contacts, 30);
}

TEST(CadSolid, OverlapAtTheStartIsAContactButTouchingIsNot) {
  const auto solid = throughStep(BRepPrimAPI_MakeCylinder(10, 30).Shape(), Pose::Identity());
  ASSERT_TRUE(solid);
  const auto overlapping = solid->firstContact({11.5, 0, 15}, {30, 0, 15}, 2);
  ASSERT_TRUE(overlapping);
  EXPECT_EQ(overlapping->fraction, 0);
  EXPECT_LT((overlapping->touchPoint - Vector3(10, 0, 15)).norm(), 1e-9);
  EXPECT_LT((overlapping->normal - Vector3::UnitX()).norm(), 1e-9);
  EXPECT_FALSE(solid->firstContact({12, 0, 15}, {30, 0, 15}, 2)) << "leaving";
  EXPECT_FALSE(solid->firstContact({12, 0, 3}, {12, 0, 20}, 2)) << "sliding along the axis";
  EXPECT_FALSE(solid->firstContact({12, -20, 3}, {12, 20, 3}, 2)) << "grazing";
  EXPECT_FALSE(solid->firstContact({-30, 0, 32}, {30, 1, 32}, 2)) << "sliding over the top";
  EXPECT_TRUE(solid->firstContact({12, 0, 15}, {11, 1, 15}, 2)) << "pressing";
  EXPECT_EQ(solid->firstContact({1, 2, 15}, {1, 2.5, 15}, 2)->fraction, 0) << "within the material";
  EXPECT_EQ(solid->firstContact({1, 2, 15}, {1, 50, 15}, 2)->fraction, 0) << "coming out of the material";
  EXPECT_FALSE(solid->firstContact({20, 0, 15}, {20, 0, 15}, 2)) << "standing still";
}

TEST(CadSolid, MeetsACapsuleOnItsTessellation) {
  const auto solid = throughStep(BRepPrimAPI_MakeCylinder(10, 30).Shape(), Pose::Identity());
  ASSERT_TRUE(solid);
  // A shaft of radius 1.5 standing along z meets the side with its whole length.
  const auto side = solid->firstCapsuleContact({40, 0, 10}, {0, 0, 10}, {0, 0, 50}, 1.5);
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->ballCentre.x(), 11.5, 0.01);
  // A slanted one meets the upper rim; in the xz plane its line passes the rim point at the distance of the radius.
  const Vector3 slanted = Vector3(-1, 0, 2).normalized() * 50;
  const auto rim = solid->firstCapsuleContact({40, 0, 20}, {0, 0, 20}, slanted, 1.5);
  ASSERT_TRUE(rim);
  EXPECT_LT((rim->touchPoint - Vector3(10, 0, 30)).norm(), 0.01);
  EXPECT_FALSE(solid->firstCapsuleContact({40, 0, 32}, {0, 0, 32}, {0, 0, 50}, 1.5));
}

TEST(CadSolid, MeetsAShaftAtTheBentBordersOfASheet) {
  // A ring without thickness: triangles with few points along its circles would reach over them or end before them.
  const double outer = 120, inner = 55;
  const auto circle = [](double radius) {
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(gp::XOY(), radius)).Edge()).Wire();
  };
  BRepBuilderAPI_MakeFace ring(gp_Pln(gp::XOY()), circle(outer));
  ring.Add(TopoDS::Wire(circle(inner).Reversed()));
  const auto solid = cadSolid(ring.Shape());
  ASSERT_TRUE(solid) << format(solid.error());
  std::mt19937_64 random(31);
  for (int i = 0; i < 100; ++i) {
    const Vector3 out = rotation(Vector3::UnitZ(), uniform(random, 0, 360)) * Vector3::UnitX();
    const Vector3 low(0, 0, -25), shaft(0, 0, 50);
    const auto outside = (*solid)->firstCapsuleContact(low + 140 * out, low + 100 * out, shaft, 2);
    ASSERT_TRUE(outside);
    EXPECT_NEAR(outside->ballCentre.head<2>().norm(), outer + 2, 0.011) << i;
    const auto inside = (*solid)->firstCapsuleContact(low + 20 * out, low + 80 * out, shaft, 2);
    ASSERT_TRUE(inside);
    EXPECT_NEAR(inside->ballCentre.head<2>().norm(), inner - 2, 0.011) << i;
  }
}

TEST(CadSolid, KnowsItsBounds) {
  const auto solid = throughStep(BRepPrimAPI_MakeBox(gp_Pnt(1, 2, 3), gp_Pnt(10, 20, 30)).Shape(), Pose::Identity());
  ASSERT_TRUE(solid);
  EXPECT_LT((solid->bounds().minimum - Vector3(1, 2, 3)).norm(), 1e-9);
  EXPECT_LT((solid->bounds().maximum - Vector3(10, 20, 30)).norm(), 1e-9);
}

TEST(CadFiles, ReadIges) {
  const ScratchFolder folder;
  IGESControl_Writer writer("MM", 1);
  writer.AddShape(BRepPrimAPI_MakeCylinder(10, 30).Shape());
  writer.ComputeModel();
  ASSERT_TRUE(writer.Write((folder / "part.igs").c_str()));
  const auto solid = readIges(folder / "part.igs");
  ASSERT_TRUE(solid) << format(solid.error());
  const auto contact = (*solid)->firstContact({40, 3, 10}, {-40, 3, 10}, 2);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->ballCentre.x(), std::sqrt(144.0 - 9), 1e-6);
}

TEST(CadFiles, SayWhatIsWrongWithABadFile) {
  const ScratchFolder folder;
  const auto message = [&](const auto& read, const std::string& bytes) {
    const auto solid = read(folder.write("bad.file", bytes), ImportOptions{});
    return solid ? std::string("read") : format(solid.error());
  };
  EXPECT_THAT(message(readStep, " \n"), AllOf(HasSubstr("bad.file"), HasSubstr("empty")));
  EXPECT_THAT(message(readStep, "solid x"), HasSubstr("not a STEP file"));
  EXPECT_THAT(message(readStep, "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=CARTESIAN_POINT('"),
              HasSubstr("ends before"));
  const std::string header =
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
      "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n";
  EXPECT_THAT(message(readStep, header + "ENDSEC;\nEND-ISO-10303-21;\n"), HasSubstr("no body and no face"));
  EXPECT_THAT(message(readStep, header + "#1=CARTESIAN_POINT('',(0.,0.,0.));\nENDSEC;\nEND-ISO-10303-21;\n"),
              HasSubstr("no body and no face"));
  EXPECT_THAT(message(readStep, header + "#1=((((;\n#2=)x%&;\nENDSEC;\nEND-ISO-10303-21;\n"), HasSubstr("bad.file"));
  EXPECT_THAT(message(readIges, ""), HasSubstr("empty"));
  EXPECT_THAT(message(readIges, "ISO-10303-21;"), HasSubstr("not an IGES file"));
  EXPECT_THAT(message(readIges, std::string(72, ' ') + "S      1\n"), HasSubstr("bad.file"));
  EXPECT_FALSE(readStep(folder / "missing.step"));
}

TEST(CadFiles, TheSameSolidGivesTheSameStepFile) {
  const ScratchFolder folder;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(10, 20, 30).Shape();
  ASSERT_TRUE(writeStep(box, folder / "part.step"));
  std::ifstream file(folder / "part.step");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(text, HasSubstr("2000-01-01T00:00:00"));
  ASSERT_TRUE(writeStep(box, folder / "part.step"));
  std::ifstream again(folder / "part.step");
  EXPECT_EQ(text, std::string((std::istreambuf_iterator<char>(again)), {}));
}

}  // namespace
}  // namespace probewright::simulation
