#include "kinematics_sinumerik/scene.hpp"

/// What errors of probe and machine leave in the vectors: what theory says, neither more nor less.
namespace probewright {
namespace {

using namespace testing_support;

/// A probe that signals late along its axis is a tool that is too long: every ball lies deeper by that. The vectors
/// move as that asks, the directions of the axes do not.
TEST(LateSignal, ShiftsTheVectorsAlongTheTool) {
  constexpr double late = 0.02;
  const Vector3 down(0, 0, -late), up = -down, still = Vector3::Zero();
  struct Case {
    const Build* build;
    std::array<Vector3, 4> shift;  ///< of I1 to I4
  };
  for (const Case& each : {Case{&tableTable, {still, down, still, up}}, Case{&headTable, {up, down, down, up}},
                           Case{&headHead, {still, up, down, still}}, Case{&oneAxis, {still, down, still, up}}}) {
    std::array<std::array<Vector3, 6>, 2> vectors;
    for (const int run : {0, 1}) {
      simulation::Truth truth = perfectWorld(each.build->machine);
      truth.tools[0].probe.axialPretravel = run * late;
      truth.tools[0].probe.pretravel = run * 0.008;  // alike all round: no centre moves
      KinematicsScene scene(*each.build, truth);
      scene.measureAll();
      scene.calculate({{"S_MVAR", 0}});
      vectors[static_cast<std::size_t>(run)] = {scene.found(1),  scene.found(4), scene.found(15),
                                                scene.found(18), scene.found(7), scene.found(10)};
    }
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT((vectors[1][i] - vectors[0][i] - each.shift[i]).norm(), 1e-5) << each.build->machine << " I" << i + 1;
    for (std::size_t i = 4; i < 6; ++i)
      EXPECT_LT((vectors[1][i] - vectors[0][i]).norm(), 1e-7);
  }
}

/// Linear axes that are not square turn the circle of the ball into an ellipse. The axis comes out as the circle
/// through the three readings of that ellipse.
TEST(Squareness, BendsTheCircle) {
  simulation::Truth truth = perfectWorld(oneAxis.machine);
  truth.errors.squareness.push_back({*truth.machine.axisIndex("Z"), *truth.machine.axisIndex("X"), 0.02});
  KinematicsScene scene(oneAxis, truth);
  scene.measureAll();
  scene.calculate();
  std::array<Vector3, 3> reading;
  for (std::size_t i = 0; i < 3; ++i)
    reading[i] = scene.above(scene.turned(oneAxis.positions[0][i], 0), -KinematicsScene::ballRadius - 2);
  // All in the plane XZ: |c - p|^2 is the same for the three.
  Eigen::Matrix2d equations;
  Vector2 sides;
  for (int i = 0; i < 2; ++i) {
    const Vector2 p(reading[0].x(), reading[0].z());
    const auto next = static_cast<std::size_t>(i) + 1;
    const Vector2 q(reading[next].x(), reading[next].z());
    equations.row(i) = (q - p).transpose();
    sides[i] = (q.squaredNorm() - p.squaredNorm()) / 2;
  }
  const Vector2 centre = equations.inverse() * sides;
  const Vector3 found = scene.found(4);
  EXPECT_LT((Vector2(found.x(), found.z() + 98) - centre).norm(), 1e-5);
  const double error = (Vector2(found.x(), found.z()) - Vector2(0, -700)).norm();
  EXPECT_GT(error, 1e-3);
}

/// A scattering signal: a coordinate across the tool is the mean of two touches, the one along it a single touch. The
/// circle takes of each place the part e along its radius n: n c + r = e for centre and radius, three equations.
TEST(Repeatability, GoesIntoTheAxisAsTheoryCounts) {
  constexpr double sigma = 0.002;
  constexpr int runs = 60;
  const Eigen::Matrix2d ofPlace = Eigen::Vector2d(sigma * sigma / 2, sigma * sigma).asDiagonal();
  const Vector2 radius = Vector2(oneAxis.ball.x(), oneAxis.ball.z() + 700).normalized();
  Matrix3 equations;
  Vector3 variance;
  for (int i = 0; i < 3; ++i) {
    // In the plane of X and Z a table that turns about -Y turns from X to Z.
    const double angle = oneAxis.positions[0][static_cast<std::size_t>(i)];
    const Vector2 n = Eigen::Rotation2Dd(radiansFromDegrees(angle)) * radius;
    equations.row(i) << n.x(), n.y(), 1;
    variance[i] = n.dot(ofPlace * n);
  }
  const Eigen::Matrix<double, 2, 3> share = equations.inverse().topRows<2>();
  const Eigen::Matrix2d expected = share * variance.asDiagonal() * share.transpose();
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int run = 0; run < runs; ++run) {
    simulation::Truth truth = perfectWorld(oneAxis.machine);
    truth.tools[0].probe.repeatability = sigma;
    truth.seed = static_cast<std::uint64_t>(run + 1);
    KinematicsScene scene(oneAxis, truth);
    scene.measureAll();
    scene.calculate();
    const Vector2 error(scene.found(4).x(), scene.found(4).z() + 700);
    sum += error * error.transpose() / runs;
  }
  // The variance of 60 samples is known to a third or so.
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(sum(i, i), 0.5 * expected(i, i));
    EXPECT_LT(sum(i, i), 1.7 * expected(i, i));
  }
}

}  // namespace
}  // namespace probewright
