#include "control/sinumerik/frame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace probewright::control::sinumerik {
namespace {

using testing::HasSubstr;

// Elementary matrices written out, independent of what the frame uses.
Matrix3 aboutX(double degrees) {
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  return (Matrix3() << 1, 0, 0, 0, c, -s, 0, s, c).finished();
}
Matrix3 aboutY(double degrees) {
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  return (Matrix3() << c, 0, s, 0, 1, 0, -s, 0, c).finished();
}
Matrix3 aboutZ(double degrees) {
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  return (Matrix3() << c, -s, 0, s, c, 0, 0, 0, 1).finished();
}

Frame call(std::string_view function, std::vector<AxisValue> arguments) {
  auto frame = frameFunction(function, arguments);
  EXPECT_TRUE(frame) << (frame ? "" : frame.error().message);
  return frame.value_or(Frame());
}

double difference(const Eigen::Affine3d& a, const Eigen::Affine3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

class Random {
public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
  bool coin() { return engine_() % 2 == 0; }

private:
  std::mt19937_64 engine_;
};

TEST(Frame, IsTheProductOfElementaryTransforms) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    Frame frame;
    Vector3 shift, angles, diagonal;
    for (std::size_t k = 0; k < 3; ++k) {
      FrameAxis& axis = frame.geometry[k];
      axis = {random.between(-500, 500), random.between(-1, 1), random.between(-180, 180), random.between(0.1, 3),
              random.coin()};
      const auto row = static_cast<Eigen::Index>(k);
      shift[row] = axis.coarse + axis.fine;
      angles[row] = axis.rotation;
      diagonal[row] = axis.scale * (axis.mirror ? -1 : 1);
    }
    const Matrix3 linear = aboutZ(angles.z()) * aboutY(angles.y()) * aboutX(angles.x()) * diagonal.asDiagonal();
    const Eigen::Affine3d map = transform(frame);
    EXPECT_LT((map.linear() - linear).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_EQ(map.translation(), shift);
  }
}

TEST(Frame, AnglesComeBackFromTheMatrix) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const Vector3 angles(random.between(-180, 180), random.between(-89.9, 89.9), random.between(-180, 180));
    const Matrix3 matrix = aboutZ(angles.z()) * aboutY(angles.y()) * aboutX(angles.x());
    EXPECT_LT((rpyFromRotation(matrix) - angles).cwiseAbs().maxCoeff(), 1e-9);
  }
  // Y outside of +-90 degrees comes back as the other solution: the same rotation.
  for (int i = 0; i < 5000; ++i) {
    const Matrix3 matrix =
        aboutZ(random.between(-400, 400)) * aboutY(random.between(-400, 400)) * aboutX(random.between(-400, 400));
    const Vector3 angles = rpyFromRotation(matrix);
    EXPECT_LE(std::abs(angles.y()), 90.0);
    EXPECT_LE(angles.x(), 180.0);
    EXPECT_GT(angles.x(), -180.0);
    EXPECT_LT((aboutZ(angles.z()) * aboutY(angles.y()) * aboutX(angles.x()) - matrix).cwiseAbs().maxCoeff(), 1e-12);
  }
  EXPECT_EQ(rpyFromRotation(aboutZ(180)).z(), 180.0);
  EXPECT_EQ(rpyFromRotation(aboutX(-180)).x(), 180.0);
}

TEST(Frame, AtThePoleTheAngleAboutXIsZero) {
  for (const double y : {90.0, -90.0}) {
    for (double x = -170; x <= 180; x += 35) {
      for (double z = -170; z <= 180; z += 35) {
        const Matrix3 matrix = aboutZ(z) * aboutY(y) * aboutX(x);
        const Vector3 angles = rpyFromRotation(matrix);
        EXPECT_EQ(angles.x(), 0.0);
        EXPECT_NEAR(angles.y(), y, 1e-6);
        const Matrix3 back = aboutZ(angles.z()) * aboutY(angles.y()) * aboutX(angles.x());
        EXPECT_LT((back - matrix).cwiseAbs().maxCoeff(), 1e-8);
      }
    }
  }
}

TEST(Frame, SurvivesTheWayThroughItsTransform) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    Frame frame;
    std::array<bool, 3> mirrors = {};
    for (std::size_t k = 0; k < 3; ++k) {
      mirrors[k] = random.coin();
      frame.geometry[k] = {random.between(-500, 500), 0, random.between(-89, 89), random.between(0.5, 2), mirrors[k]};
    }
    const auto back = frameFromTransform(transform(frame), mirrors);
    ASSERT_TRUE(back);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(back->geometry[k].mirror, mirrors[k]);
      EXPECT_NEAR(back->geometry[k].scale, frame.geometry[k].scale, 1e-12);
      EXPECT_NEAR(back->geometry[k].rotation, frame.geometry[k].rotation, 1e-9);
    }
    const auto unknown = frameFromTransform(transform(frame));
    ASSERT_TRUE(unknown);
    EXPECT_LT(difference(transform(*unknown), transform(frame)), 1e-12);
  }
}

TEST(Frame, ChainsAsMatricesMultiply) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    Frame outer, inner;
    const double scale = random.coin() ? 1 : random.between(0.5, 2);
    for (std::size_t k = 0; k < 3; ++k) {
      outer.geometry[k] = {random.between(-500, 500), random.between(-1, 1), random.between(-180, 180), scale,
                           random.coin()};
      inner.geometry[k] = {random.between(-500, 500), random.between(-1, 1), random.between(-180, 180),
                           random.between(0.5, 2), random.coin()};
    }
    const auto chained = chain(outer, inner);
    ASSERT_TRUE(chained) << chained.error().message;
    EXPECT_LT(difference(transform(*chained), transform(outer) * transform(inner)), 1e-9);
  }
}

TEST(Frame, ChainOfFunctionsDependsOnTheirOrder) {
  const Frame shift = call("CTRANS", {{"X", 10}, {"Y", 5}});
  const Frame turn = call("CROT", {{"Z", 30}});
  const Frame shiftThenTurn = chain(shift, turn).value();
  EXPECT_EQ(shiftThenTurn.geometry[0].coarse, 10);
  EXPECT_EQ(shiftThenTurn.geometry[2].rotation, 30);
  const Frame turnThenShift = chain(turn, shift).value();
  EXPECT_NEAR(turnThenShift.geometry[0].coarse, 10 * std::sqrt(3.0) / 2 - 5 * 0.5, 1e-12);
  EXPECT_NEAR(turnThenShift.geometry[1].coarse, 10 * 0.5 + 5 * std::sqrt(3.0) / 2, 1e-12);
  EXPECT_EQ(turnThenShift.geometry[2].rotation, 30);
}

TEST(Frame, FineTranslationsStayFineWhilePossible) {
  Frame outer = call("CTRANS", {{"X", 10}});
  outer.geometry[0].fine = 0.25;
  const Frame inner = call("CFINE", {{"X", 0.5}, {"C", 0.125}});
  const Frame sum = chain(outer, inner).value();
  EXPECT_EQ(sum.geometry[0].coarse, 10);
  EXPECT_EQ(sum.geometry[0].fine, 0.75);
  EXPECT_EQ(sum.get("c", FramePart::Fine), 0.125);
  const Frame turned = chain(call("CROT", {{"Z", 90}}), inner).value();
  EXPECT_EQ(turned.geometry[0].fine, 0);
  EXPECT_NEAR(turned.geometry[1].coarse, 0.5, 1e-15);
}

TEST(Frame, ARotaryAxisIsShiftedByItself) {
  const Frame sum = chain(call("CTRANS", {{"C", 90}}), call("CTRANS", {{"C", -30}, {"A", 5}})).value();
  EXPECT_EQ(sum.get("C", FramePart::Translation), 60);
  EXPECT_EQ(sum.get("A", FramePart::Translation), 5);
  EXPECT_TRUE(transform(sum).isApprox(Eigen::Affine3d::Identity()));
}

TEST(Frame, RefusesWhatNoFrameCanHold) {
  const auto sheared = chain(call("CSCALE", {{"X", 2}}), call("CROT", {{"Z", 30}}));
  ASSERT_FALSE(sheared);
  EXPECT_THAT(sheared.error().message, HasSubstr("shear"));
  EXPECT_TRUE(chain(call("CROT", {{"Z", 30}}), call("CSCALE", {{"X", 2}})));
  Eigen::Affine3d flat = Eigen::Affine3d::Identity();
  flat.linear()(2, 2) = 0;
  EXPECT_FALSE(frameFromTransform(flat));
  const auto error = [](std::string_view function, std::vector<AxisValue> arguments) {
    const auto frame = frameFunction(function, arguments);
    return frame ? "" : frame.error().message;
  };
  EXPECT_THAT(error("CTRANS", {{"X", 1}, {"x", 2}}), HasSubstr("names axis X twice"));
  EXPECT_THAT(error("CROT", {{"C", 1}}), HasSubstr("not about C"));
  EXPECT_THAT(error("CSCALE", {{"X", 0}}), HasSubstr("cannot take this value"));
  EXPECT_THAT(error("CSPIN", {}), HasSubstr("not a frame function"));
  EXPECT_THAT(error("CROTS", {{"X", 90}, {"Y", 90}}), HasSubstr("no plane"));
}

TEST(Frame, SolidAnglesGiveThePlaneOfTheirTraces) {
  Random random(5);
  const std::array<std::string, 3> names = {"X", "Y", "Z"};
  for (int i = 0; i < 600; ++i) {
    const int k = i % 3, m = (k + 1) % 3, n = (k + 2) % 3;
    const double a = random.between(-80, 80), b = random.between(-80, 80);
    std::vector<AxisValue> arguments = {{names[static_cast<std::size_t>(k)], a},
                                        {names[static_cast<std::size_t>(m)], b}};
    if (random.coin()) std::swap(arguments[0], arguments[1]);
    const Matrix3 r = transform(call("CROTS", arguments)).linear();
    EXPECT_LT((r.transpose() * r - Matrix3::Identity()).norm(), 1e-12);
    EXPECT_NEAR(r.determinant(), 1, 1e-12);
    // The new first axis lies in the plane of the old first and third axes, inclined by b.
    EXPECT_NEAR(r(m, k), 0, 1e-12);
    EXPECT_NEAR(std::atan2(-r(n, k), r(k, k)) * 180 / M_PI, b, 1e-9);
    // The plane cuts the old second/third plane in a line inclined by a: that line is normal to the new third axis.
    Vector3 trace = Vector3::Zero();
    trace[m] = std::cos(a * M_PI / 180);
    trace[n] = std::sin(a * M_PI / 180);
    EXPECT_NEAR(trace.dot(r.col(n)), 0, 1e-12);
  }
  EXPECT_EQ(call("CROTS", {{"Y", 20}}), call("CROT", {{"Y", 20}}));
}

TEST(Frame, WritesItsExpression) {
  Frame frame = call("CTRANS", {{"X", 10}, {"Y", -5.25}, {"C", 90}});
  EXPECT_EQ(frameExpression(frame), "CTRANS(X,10,Y,-5.25,C,90)");
  frame.set("Z", FramePart::Rotation, 3);
  frame.set("X", FramePart::Fine, 1e-7);
  frame.set("Y", FramePart::Scale, 2);
  frame.set("Z", FramePart::Mirror, 1);
  EXPECT_EQ(frameExpression(frame), "CTRANS(X,10,Y,-5.25,C,90):CFINE(X,0.0000001):CROT(Z,3):CSCALE(Y,2):CMIRROR(Z)");
  EXPECT_EQ(frameExpression(Frame()), "CTRANS()");
}

}  // namespace
}  // namespace probewright::control::sinumerik
