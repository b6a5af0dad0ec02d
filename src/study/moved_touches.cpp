#include "study/moved_touches.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "metrology/fits.hpp"
#include "study/random.hpp"

namespace probewright::study {

using control::Along;
using control::Quantity;

namespace {

constexpr std::uint64_t sets = 512;
/// Any number; the errors depend on it alone.
constexpr std::uint64_t seed = 100;

bool isRound(const control::FitRecord& fit) { return fit.shape == "circle" || fit.shape == "sphere"; }

std::vector<Vector2> inPlane(std::span<const Vector3> points) {
  std::vector<Vector2> flat;
  for (const Vector3& point : points)
    flat.emplace_back(point.head<2>());
  return flat;
}

/// In degrees.
double angle(double sine, double cosine) { return degreesFromRadians(std::atan2(sine, cosine)); }

/// What a result says of the shape, but for what is added to it. Lengths in mm, angles in degrees.
double valueOf(const control::FitRecord& fit, const Eigen::Vector4d& numbers, const control::ResultRecord& result) {
  const Quantity quantity = result.kind.of.quantity;
  const Along along = result.kind.of.along;
  if (fit.shape == "line") return angle(numbers[1], numbers[0]);
  if (fit.shape == "plane") return angle(numbers[along == Along::A ? 1 : 0], numbers[2]);
  if (quantity == Quantity::Diameter) return 2 * numbers[3];
  if (quantity == Quantity::Radius) return numbers[3];
  return numbers[along == Along::First ? 0 : along == Along::Second ? 1 : 2];
}

}  // namespace

MovedTouches::MovedTouches(const control::CycleRecord& cycle, const control::FitRecord& fit, double scatter)
    : fit_(fit) {
  findPoints(cycle);
  const auto measured = numbersOf(points_);
  if (!measured) return;
  measured_ = *measured;
  for (const Vector3& point : points_) {
    Vector3 normal = measured_.head<3>();
    if (isRound(fit)) normal = (point - measured_.head<3>()).normalized();
    if (fit.shape == "line") normal = Vector3(-measured_[1], measured_[0], 0);
    normals_.push_back(normal);
  }
  const std::size_t count = points_.size();
  determined_ = true;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> errors(count);
    for (const double error : {scatter, -scatter}) {
      errors[i] = error;
      move(errors, one_);
    }
  }
  const boost::math::normal normal;
  for (std::uint64_t set = 0; set < sets && determined_; ++set) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < count; ++i)
      errors.push_back(boost::math::quantile(normal, uniforms({seed, set}, static_cast<std::uint32_t>(i))[0]));
    for (const double sign : {scatter, -scatter}) {
      std::vector<double> moved = errors;
      for (double& error : moved)
        error *= sign;
      move(moved, all_);
    }
    errors_.push_back(std::move(errors));
  }
}

void MovedTouches::findPoints(const control::CycleRecord& cycle) {
  const bool isFlat = fit_.shape == "circle" || fit_.shape == "line";
  std::vector<Vector3> points;
  for (const std::size_t touch : fit_.touches) {
    if (touch >= cycle.touches.size()) return;
    points.push_back(cycle.plane.planeFromXyz(cycle.touches[touch].ballCentre));
    if (isFlat) points.back().z() = 0;
  }
  points_ = std::move(points);
}

std::optional<MovedTouches::Numbers> MovedTouches::numbersOf(std::span<const Vector3> points) const {
  Numbers numbers = Numbers::Zero();
  if (fit_.shape == "circle") {
    const auto made = metrology::fitCircle(inPlane(points));
    if (!made) return std::nullopt;
    numbers << made->shape.centre.x(), made->shape.centre.y(), 0, made->shape.radius;
  } else if (fit_.shape == "sphere") {
    const auto made = metrology::fitSphere(points);
    if (!made) return std::nullopt;
    numbers << made->shape.centre, made->shape.radius;
  } else if (fit_.shape == "line") {
    const auto made = metrology::fitLine(inPlane(points));
    if (!made) return std::nullopt;
    numbers.head<2>() = made->shape.direction;
  } else {
    const auto made = metrology::fitPlane(points);
    if (!made) return std::nullopt;
    numbers.head<3>() = made->shape.normal;
  }
  return numbers;
}

void MovedTouches::move(const std::vector<double>& errors, std::vector<Numbers>& moved) {
  std::vector<Vector3> points = points_;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] += errors[i] * normals_[i];
  const auto numbers = numbersOf(points);
  determined_ = determined_ && numbers;
  moved.push_back(numbers.value_or(measured_));
}

double MovedTouches::distance(const Numbers& moved, const control::ResultRecord& result) const {
  const double distance = valueOf(fit_, moved, result) - valueOf(fit_, measured_, result);
  return isRound(fit_) ? distance : std::remainder(distance, 360);
}

std::optional<double> MovedTouches::uncertaintyOf(const control::ResultRecord& result) const {
  if (!determined_) return std::nullopt;
  // What is linear has its variance without chance; the sets tell only what is left.
  std::vector<double> slopes;
  double variance = 0;
  for (std::size_t i = 0; i < one_.size(); i += 2) {
    slopes.push_back((distance(one_[i], result) - distance(one_[i + 1], result)) / 2);
    variance += slopes.back() * slopes.back();
  }
  for (std::size_t set = 0; set < errors_.size(); ++set) {
    double linear = 0;
    for (std::size_t i = 0; i < slopes.size(); ++i)
      linear += slopes[i] * errors_[set][i];
    // What the square of a moved distance has more than that of the linear one, whose sign does not matter.
    for (const std::size_t opposite : {std::size_t{0}, std::size_t{1}}) {
      const double moved = distance(all_[2 * set + opposite], result);
      variance += (moved - linear) * (moved + linear) / static_cast<double>(all_.size());
    }
  }
  return std::sqrt(std::max(variance, 0.0));
}

}  // namespace probewright::study
