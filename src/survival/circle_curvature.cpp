#include "survival/circle_curvature.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "metrology/elements.hpp"
#include "metrology/fits.hpp"
#include "survival/curvature.hpp"

namespace probewright::survival {

namespace {

/// One column, or two where a point may shift anywhere.
using Ways = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 2>;
using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 2>;
using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 2>;

/// What the points are: touches with their ways, or middles of bores, which may shift anywhere.
enum class Points { Touches, Middles };

/// A circle in the middle of a box, in the terms of the header.
class FittedCircle {
public:
  static std::optional<FittedCircle> through(const std::vector<Vector2>& points, const std::vector<Ways>& ways);

  std::size_t count() const { return spokes_.size(); }
  /// How much the centre's derivative by touch k is in the middle.
  double derivative(std::size_t k) const { return (centre_ * spokes_[k].slope).norm(); }
  /// How far the centre's derivatives can be from that while the touches shift by `shifts`; nothing if no bound holds.
  std::optional<std::vector<double>> changes(const std::vector<double>& shifts) const;

private:
  struct Spoke {
    Vector2 along, across;  ///< u, t
    double length = 0, residual = 0;
    Row alongWays, acrossWays;               ///< u . W, t . W
    Vector3 alongSolved, acrossSolved, row;  ///< u^T T, t^T T, q
    Columns slope;                           ///< y
  };
  /// The right sides of the bounds if no y_k changes by more than `supposed`.
  std::optional<std::vector<double>> bounds(const std::vector<double>& shifts,
                                            const std::vector<double>& supposed) const;

  std::vector<Spoke> spokes_;
  Eigen::Matrix<double, 2, 3> centre_;  ///< the rows of T for the centre
  double inverse_ = 0;                  ///< |M^-1|
};

std::optional<FittedCircle> FittedCircle::through(const std::vector<Vector2>& points, const std::vector<Ways>& ways) {
  const auto fit = metrology::fitCircle(points);
  if (!fit || !(fit->shape.radius > 0)) return std::nullopt;
  FittedCircle circle;
  Eigen::Matrix<double, Eigen::Dynamic, 3> rows(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t j = 0; j < points.size(); ++j) {
    Spoke spoke;
    const Vector2 from = points[j] - fit->shape.centre;
    spoke.length = from.norm();
    if (!(spoke.length > 0)) return std::nullopt;
    spoke.along = from / spoke.length;
    spoke.across = Vector2(-spoke.along.y(), spoke.along.x());
    spoke.residual = spoke.length - fit->shape.radius;
    spoke.alongWays = spoke.along.transpose() * ways[j];
    spoke.acrossWays = spoke.across.transpose() * ways[j];
    rows.row(static_cast<Eigen::Index>(j)) << spoke.along.transpose(), 1;
    circle.spokes_.push_back(std::move(spoke));
  }
  const Eigen::HouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 3>> qr(rows);
  const Eigen::Matrix3d upper = qr.matrixQR().topRows<3>().triangularView<Eigen::Upper>();
  if (!(upper.diagonal().cwiseAbs().minCoeff() > 1e-9)) return std::nullopt;
  const Eigen::Matrix3d solve = upper.inverse();
  circle.centre_ = solve.topRows<2>();
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  for (std::size_t j = 0; j < points.size(); ++j) {
    Spoke& spoke = circle.spokes_[j];
    spoke.alongSolved = circle.centre_.transpose() * spoke.along;
    spoke.acrossSolved = circle.centre_.transpose() * spoke.across;
    spoke.row = (rows.row(static_cast<Eigen::Index>(j)) * solve).transpose();
    matrix += spoke.residual / spoke.length * spoke.acrossSolved * spoke.acrossSolved.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  const double weakest = solver.eigenvalues().minCoeff();
  if (!(weakest > 0.1)) return std::nullopt;  // no minimum, or hardly one
  circle.inverse_ = 1 / weakest;
  for (Spoke& spoke : circle.spokes_) {
    const Columns right =
        spoke.row * spoke.alongWays + spoke.residual / spoke.length * spoke.acrossSolved * spoke.acrossWays;
    spoke.slope = matrix.inverse() * right;
  }
  return circle;
}

std::optional<std::vector<double>> FittedCircle::bounds(const std::vector<double>& shifts,
                                                        const std::vector<double>& supposed) const {
  double more = 0;  // half the sum of S_k D_k
  for (std::size_t k = 0; k < count(); ++k)
    more += shifts[k] * supposed[k] / 2;
  std::vector<double> rowChange(count()), turn(count()), rightChange(count());
  double rowsSquared = 0, residuals = 0;
  for (std::size_t j = 0; j < count(); ++j) {
    const Spoke& spoke = spokes_[j];
    double across = spoke.acrossSolved.norm() * more + shifts[j] * spoke.acrossWays.norm();
    double along = spoke.alongSolved.norm() * more + shifts[j] * spoke.alongWays.norm();
    double residual = spoke.row.norm() * more;
    for (std::size_t k = 0; k < count(); ++k) {
      across += shifts[k] * Row(spoke.acrossSolved.transpose() * spokes_[k].slope).norm();
      along += shifts[k] * Row(spoke.alongSolved.transpose() * spokes_[k].slope).norm();
      Row own = -spoke.row.transpose() * spokes_[k].slope;
      if (j == k) own += spoke.alongWays;
      residual += shifts[k] * own.norm();
    }
    const double least = spoke.length - along;
    if (!(least > 0)) return std::nullopt;
    residual += across * across / (2 * least);
    turn[j] = across / least;
    rowChange[j] = turn[j] * spoke.acrossSolved.norm() + turn[j] * turn[j] / 2 * spoke.alongSolved.norm();
    rowsSquared += rowChange[j] * rowChange[j];
    // (e / rho) t t^T: of the residual's change, of the length's, of the turn.
    const double turned = turn[j] * spoke.alongSolved.norm() + turn[j] * turn[j] / 2 * spoke.acrossSolved.norm();
    const double most = spoke.acrossSolved.norm() + turned;
    const double base = std::abs(spoke.residual) / spoke.length;
    const double share = (std::abs(spoke.residual) + residual) / least;
    const double shareChange = residual / least + base * std::max(along, along + across * across / (2 * least)) / least;
    residuals += shareChange * most * most + base * (2 * spoke.acrossSolved.norm() * turned + turned * turned);
    const double alongChange = turn[j] * spoke.acrossWays.norm() + turn[j] * turn[j] / 2 * spoke.alongWays.norm();
    const double acrossMost = spoke.acrossWays.norm() + turn[j] * spoke.alongWays.norm();
    rightChange[j] = spoke.alongWays.norm() * rowChange[j] + alongChange * (spoke.row.norm() + rowChange[j]) +
                     share * acrossMost * most + base * spoke.acrossWays.norm() * spoke.acrossSolved.norm();
  }
  const double change = 2 * std::sqrt(rowsSquared) + rowsSquared + residuals;
  if (!(inverse_ * change < 1)) return std::nullopt;
  std::vector<double> found;
  for (std::size_t k = 0; k < count(); ++k)
    found.push_back(inverse_ * (rightChange[k] + change * spokes_[k].slope.norm()) / (1 - inverse_ * change));
  return found;
}

std::optional<std::vector<double>> FittedCircle::changes(const std::vector<double>& shifts) const {
  constexpr int most = 100;
  std::vector<double> supposed(count(), 0);
  for (int i = 0; i < most; ++i) {
    for (double& each : supposed)
      each = 1.02 * each + 1e-12;
    auto found = bounds(shifts, supposed);
    if (!found) return std::nullopt;
    bool holds = true;
    for (std::size_t k = 0; k < count(); ++k)
      holds = holds && (*found)[k] < supposed[k];
    if (holds) {
      const double scale = Eigen::JacobiSVD<Eigen::Matrix<double, 2, 3>>(centre_).singularValues()[0];
      for (double& each : supposed)
        each *= scale;
      return supposed;
    }
    supposed = *std::move(found);
  }
  return std::nullopt;
}

/// A circle through three points, in closed form.
class ThreePoints {
public:
  ThreePoints(const std::vector<Vector2>& points, const std::vector<Ways>& ways, const Vector2& centre);

  std::size_t count() const { return 3; }
  double derivative(std::size_t k) const { return radius_ / (twice_ / sides_[k]) * along_[k]; }
  std::optional<std::vector<double>> changes(const std::vector<double>& shifts) const;

private:
  double radius_ = 0, twice_ = 0;            ///< twice the area
  std::array<double, 3> sides_{};            ///< between the two other points
  std::array<double, 3> along_{}, aside_{};  ///< of the ways, along the spoke and across it
};

ThreePoints::ThreePoints(const std::vector<Vector2>& points, const std::vector<Ways>& ways, const Vector2& centre)
    : radius_((points[0] - centre).norm()) {
  const Vector2 first = points[1] - points[0], second = points[2] - points[0];
  twice_ = std::abs(first.x() * second.y() - first.y() * second.x());
  for (std::size_t k = 0; k < 3; ++k) {
    sides_[k] = (points[(k + 1) % 3] - points[(k + 2) % 3]).norm();
    const Vector2 spoke = (points[k] - centre).normalized();
    along_[k] = (spoke.transpose() * ways[k]).norm();
    aside_[k] = (Vector2(-spoke.y(), spoke.x()).transpose() * ways[k]).norm();
  }
}

std::optional<std::vector<double>> ThreePoints::changes(const std::vector<double>& shifts) const {
  constexpr double arc = 1.1;  // an arc over its chord, up to half the radius
  const double loss = shifts[0] * sides_[0] + shifts[1] * sides_[1] + shifts[2] * sides_[2] + shifts[0] * shifts[1] +
                      shifts[1] * shifts[2] + shifts[2] * shifts[0];
  const double least = twice_ - loss;
  if (!(least > 0)) return std::nullopt;
  const auto ends = [&](std::size_t k) { return shifts[(k + 1) % 3] + shifts[(k + 2) % 3]; };
  double logarithm = 0;
  for (std::size_t k = 0; k < 3; ++k)
    logarithm += shifts[k] * (sides_[k] + ends(k)) / least;
  const double more = std::exp(logarithm), greatest = radius_ * more, smallest = radius_ / more;
  const double moves = logarithm * greatest;
  std::vector<double> found;
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = sides_[i] - ends(i), way = moves + shifts[i];
    if (!(side > 2 * ends(i) && way < smallest / 2)) return std::nullopt;
    const double turn = arc * ends(i) / side, turned = arc * way / smallest;
    const double middle = radius_ * sides_[i] / twice_, high = greatest * (sides_[i] + ends(i)) / least,
                 low = smallest * side / (twice_ + loss);
    const double change = turned * aside_[i] + turned * turned / 2 * along_[i];
    found.push_back(std::max(high - middle, middle - low) * (along_[i] + change) + middle * change +
                    high * (along_[i] + change) * turn);
  }
  return found;
}

/// True if (1) holds for all touches that shift by as much as `size` lets them.
template <class Circle>
bool holds(const Circle& circle, double size, Points are) {
  // The middle of a bore shifts by half of what each of its four touches does, by root 2 of one shift together.
  const double shift = nearEnough * size * (are == Points::Middles ? std::numbers::sqrt2 : 1);
  const double share = are == Points::Middles ? 0.5 : 1;
  const auto together = circle.changes(std::vector<double>(circle.count(), shift));
  if (!together) return false;
  for (std::size_t i = 0; i < circle.count(); ++i) {
    std::vector<double> own(circle.count(), 0);
    own[i] = shift;
    const auto alone = circle.changes(own);
    if (!alone) return false;
    // The mean of touch i alone is no farther from the middle than half of what its end is: the bounds are convex.
    const double mean = (*alone)[i] / 2;
    const double least = std::max(0.0, circle.derivative(i) - mean);
    if (share * ((*together)[i] + mean) > (are == Points::Touches ? (curvature - 1) * least : 0) + nearEnough)
      return false;
  }
  return true;
}

template <class Circle>
double sizeOf(const Circle& circle, double atMost, Points are) {
  constexpr double step = 0.9, least = 0.01;
  // The bounds grow faster than in proportion: what holds at the size holds for all smaller shifts.
  for (double size = atMost; size > least * atMost; size *= step)
    if (holds(circle, size, are)) return size;
  return least * atMost;
}

double sizeOf(const std::vector<Vector2>& points, const std::vector<Ways>& ways, double atMost, Points are) {
  if (points.size() == 3) {
    const auto circle = metrology::circleThrough(points[0], points[1], points[2]);
    if (circle) return sizeOf(ThreePoints(points, ways, circle->centre), atMost, are);
  } else if (points.size() > 3) {
    if (const auto circle = FittedCircle::through(points, ways)) return sizeOf(*circle, atMost, are);
  }
  return 0.01 * atMost;
}

}  // namespace

double sizeOfCircle(const std::vector<Vector2>& points, const std::vector<Vector2>& ways, double atMost) {
  std::vector<Ways> single;
  for (const Vector2& way : ways)
    single.emplace_back(way);
  return sizeOf(points, single, atMost, Points::Touches);
}

double sizeOfBoreCircle(const std::vector<Vector2>& points, double atMost) {
  return sizeOf(points, std::vector<Ways>(points.size(), Ways(Eigen::Matrix2d::Identity())), atMost, Points::Middles);
}

}  // namespace probewright::survival
