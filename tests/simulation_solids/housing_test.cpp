#include <gtest/gtest.h>

#include "simulation/cad_solid.hpp"
#include "worlds.hpp"

namespace probewright::simulation {
namespace {

/// The table of examples/parts/README.md, felt with a ball on the checked-in part.
class Housing : public ::testing::TestWithParam<double> {
protected:
  static const Solid& part() {
    static const auto solid = readStep(std::string(PROBEWRIGHT_SOURCE_DIR) + "/examples/parts/housing.step");
    if (!solid) throw std::runtime_error(format(solid.error()));
    return **solid;
  }

  /// The touch point of a ball that comes from `from` and goes `distance` in the direction.
  Vector3 touch(const Vector3& from, const Vector3& direction, double distance = 60) const {
    const auto contact = part().firstContact(from, from + distance * direction.normalized(), GetParam());
    if (!contact) return Vector3::Constant(std::nan(""));
    EXPECT_GT(contact->fraction, 0);
    return contact->touchPoint;
  }

  void expectTouch(const Vector3& from, const Vector3& direction, const Vector3& expected) const {
    const Vector3 found = touch(from, direction);
    EXPECT_LT((found - expected).norm(), 1e-6) << "expected " << expected.transpose() << " found " << found.transpose();
  }
};

TEST_P(Housing, BodyHasItsFaces) {
  EXPECT_LT((part().bounds().minimum - Vector3(0, 0, -40)).norm(), 1e-6);
  EXPECT_LT((part().bounds().maximum - Vector3(120, 80, 12)).norm(), 1e-6);
  expectTouch({-20, 30, -10}, {1, 0, 0}, {0, 30, -10});
  expectTouch({140, 30, -10}, {-1, 0, 0}, {120, 30, -10});
  expectTouch({50, -20, -10}, {0, 1, 0}, {50, 0, -10});
  expectTouch({50, 100, -10}, {0, -1, 0}, {50, 80, -10});
  for (const auto& [x, y] :
       {std::pair(50.0, 3.0), {70.0, 8.0}, {2.0, 30.0}, {24.0, 52.0}, {95.0, 48.0}, {115.0, 28.0}}) {
    expectTouch({x, y, 30}, {0, 0, -1}, {x, y, 0});
  }
  // Sharp edges at X 0 and Y 0: the ball meets them where the closed form says.
  const double r = GetParam();
  const auto edge = part().firstContact({-r / 2, 40, 20}, {-r / 2, 40, -20}, r);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->ballCentre.z(), r * std::sqrt(0.75), 1e-6);
}

TEST_P(Housing, BoreAndBoltCircleAreWhereTheTableSays) {
  for (const double angle : {10.0, 100.0, 190.0, 280.0}) {
    const Vector3 out = rotation(Vector3::UnitZ(), angle) * Vector3::UnitX();
    for (const double z : {-3.0, -10.0, -37.0}) {
      expectTouch({60, 40, z}, out, Vector3(60, 40, z) + 20.006 * out);
    }
    for (int hole = 0; hole < 6; ++hole) {
      const Vector3 centre = Vector3(60, 40, -8) + 30 * (rotation(Vector3::UnitZ(), 60.0 * hole) * Vector3::UnitX());
      expectTouch(centre, out, centre + 4 * out);
    }
  }
  expectTouch({90, 40, -8}, {0, 0, -1}, {90, 40, -20});
  EXPECT_FALSE(part().firstContact({60, 40, 20}, {60, 40, -80}, GetParam())) << "through";
  // The chamfer of 1 mm: a ball coming down onto it touches at 45 degrees.
  const double r = GetParam();
  const Vector3 onChamfer(60 + 20.506, 40, -0.5);
  const Vector3 normal = Vector3(-1, 0, 1).normalized();
  expectTouch(onChamfer + (r + 5) * normal, -normal, onChamfer);
}

TEST_P(Housing, PocketAndSlotAreWhereTheTableSays) {
  expectTouch({20, 16, -8}, {1, 0, 0}, {35, 16, -8});
  expectTouch({20, 16, -8}, {-1, 0, 0}, {5, 16, -8});
  expectTouch({20, 16, -8}, {0, 1, 0}, {20, 26, -8});
  expectTouch({20, 16, -8}, {0, -1, 0}, {20, 6, -8});
  expectTouch({20, 16, 10}, {0, 0, -1}, {20, 16, -15});
  // Corner radius 4 around (31, 22).
  expectTouch({31, 22, -8}, {1, 1, 0}, Vector3(31, 22, -8) + 4 * Vector3(1, 1, 0).normalized());
  expectTouch({20, 64, -6}, {0, 1, 0}, {20, 69, -6});
  expectTouch({20, 64, -6}, {0, -1, 0}, {20, 59, -6});
  expectTouch({20, 64, -6}, {1, 0, 0}, {35, 64, -6});
  expectTouch({20, 64, -6}, {-1, 0, 0}, {5, 64, -6});
  expectTouch({20, 64, 10}, {0, 0, -1}, {20, 64, -12});
}

TEST_P(Housing, SpigotRibFilletAndChamferAreWhereTheTableSays) {
  for (const double angle : {0.0, 45.0, 90.0, 200.0, 300.0}) {
    const Vector3 out = rotation(Vector3::UnitZ(), angle) * Vector3::UnitX();
    expectTouch(Vector3(104, 62, 7) + 20 * out, -out, Vector3(104, 62, 7) + 9.997 * out);
  }
  expectTouch({104, 62, 30}, {0, 0, -1}, {104, 62, 12});
  expectTouch({104, 40, 6}, {0, -1, 0}, {104, 22, 6});
  expectTouch({104, -10, 6}, {0, 1, 0}, {104, 14, 6});
  expectTouch({80, 18, 6}, {1, 0, 0}, {92, 18, 6});
  expectTouch({130, 18, 6}, {-1, 0, 0}, {116, 18, 6});
  expectTouch({104, 18, 30}, {0, 0, -1}, {104, 18, 10});
  const Vector3 corner = Vector3(1, 1, 0).normalized();
  expectTouch(Vector3(114, 74, -20) + 30 * corner, -corner, Vector3(114, 74, -20) + 6 * corner);
  const Vector3 up = Vector3(0, 1, 1).normalized();
  expectTouch(Vector3(60, 79, -1) + 10 * up, -up, {60, 79, -1});
  const Vector3 right = Vector3(1, 0, 1).normalized();
  expectTouch(Vector3(119, 40, -1) + 10 * right, -right, {119, 40, -1});
}

TEST_P(Housing, AStylusReachesEveryFeature) {
  const double shaft = GetParam() * 0.6;
  const Vector3 upwards(0, 0, 50);
  for (const Vector3& down : {Vector3(60, 40, -37), Vector3(90, 40, -12), Vector3(20, 16, -11), Vector3(20, 64, -8),
                              Vector3(84, 62, 6), Vector3(104, 30, 5)}) {
    const Vector3 above(down.x(), down.y(), 40);
    EXPECT_FALSE(part().firstContact(above, down, GetParam())) << down.transpose();
    EXPECT_FALSE(part().firstCapsuleContact(above, down, upwards, shaft)) << down.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(BallRadius, Housing, ::testing::Values(2.0, 3.0));

}  // namespace
}  // namespace probewright::simulation
