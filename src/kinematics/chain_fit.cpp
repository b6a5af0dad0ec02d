#include "kinematics/chain_fit.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "kinematics/minimum.hpp"

namespace probewright::kinematics {

using machine::AxisPositions;
using machine::ChainElement;
using machine::MachineDescription;
using machine::RotaryCorrection;

namespace {

constexpr double perRadian = 100;  ///< mm: parameters that are angles count as ways at this distance
/// A parameter that moves the sightings by less than this times itself is left open: 0.001 mm would become 1 mm.
constexpr double weakest = 1e-3;

enum class Kind { Position, Tilt, Zero, Sphere, Shift };

/// Parameters that are free together.
struct Group {
  Kind kind = Kind::Position;
  std::size_t axis = 0;
  Eigen::Matrix<double, 3, Eigen::Dynamic> basis;  ///< directions of positions, rotation vectors of tilts
  Eigen::Index count() const { return kind == Kind::Zero ? 1 : basis.cols(); }
};

Vector3 directionOf(const MachineDescription& machine, std::size_t axis) {
  for (const auto* chain : {&machine.tableChain, &machine.spindleChain}) {
    for (const ChainElement& element : *chain) {
      if (element.axis == axis) return element.direction;
    }
  }
  return Vector3::UnitZ();
}

Eigen::Matrix<double, 3, Eigen::Dynamic> across(const Vector3& axis) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> both(3, 2);
  both.col(0) = axis.unitOrthogonal();
  both.col(1) = axis.cross(both.col(0));
  return both;
}

std::vector<Group> groupsOf(const ChainFitTask& task, const MachineDescription& machine) {
  std::vector<Group> groups;
  for (const AxisFreedoms& free : task.free) {
    const Vector3 direction = directionOf(machine, free.axis);
    groups.push_back({Kind::Position, free.axis, across(direction)});
    if (free.zero) groups.push_back({Kind::Zero, free.axis, {}});
    if (!free.tilt) continue;
    Group tilt{Kind::Tilt, free.axis, across(direction)};
    if (free.zeroOf) {
      const Vector3 left = direction.cross(directionOf(machine, *free.zeroOf));
      if (left.norm() > 1e-3) tilt.basis = left.normalized();
    }
    groups.push_back(std::move(tilt));
  }
  if (!task.sphere) groups.push_back({Kind::Sphere, 0, Matrix3::Identity()});
  if (task.shift) groups.push_back({Kind::Shift, 0, Matrix3::Identity()});
  return groups;
}

RotaryCorrection& correctionOf(std::vector<RotaryCorrection>& corrections, std::size_t axis) {
  const auto found = std::ranges::find(corrections, axis, &RotaryCorrection::axis);
  if (found != corrections.end()) return *found;
  corrections.push_back({.axis = axis});
  return corrections.back();
}

/// What the parameters of the groups mean.
struct Model {
  std::vector<RotaryCorrection> corrections;
  Vector3 sphere = Vector3::Zero();
  Vector3 shift = Vector3::Zero();
};

Model modelOf(const ChainFitTask& task, const std::vector<Group>& groups, const Vector3& sphere,
              const Eigen::VectorXd& parameters) {
  Model model{task.believed, sphere, Vector3::Zero()};
  Eigen::Index at = 0;
  for (const Group& group : groups) {
    const Eigen::VectorXd part = parameters.segment(at, group.count());
    at += group.count();
    switch (group.kind) {
      case Kind::Position:
        correctionOf(model.corrections, group.axis).position += group.basis * part;
        break;
      case Kind::Tilt:
        correctionOf(model.corrections, group.axis).orientation +=
            degreesFromRadians(1 / perRadian) * (group.basis * part);
        break;
      case Kind::Zero:
        correctionOf(model.corrections, group.axis).zero += degreesFromRadians(part[0] / perRadian);
        break;
      case Kind::Sphere:
        model.sphere += part;
        break;
      case Kind::Shift:
        model.shift = part;
        for (const std::size_t axis : task.beforeShift)
          correctionOf(model.corrections, axis).position -= part;
        break;
    }
  }
  return model;
}

Eigen::Index countOf(const std::vector<Group>& groups) {
  Eigen::Index count = 0;
  for (const Group& group : groups)
    count += group.count();
  return count;
}

double spanOf(std::span<const SphereSighting> sightings, std::size_t axis) {
  const auto [low, high] =
      std::ranges::minmax(sightings, {}, [axis](const SphereSighting& sighting) { return sighting.axes[axis]; });
  return high.axes[axis] - low.axes[axis];
}

double meanRadius(const MachineDescription& machine, std::span<const SphereSighting> sightings, std::size_t axis) {
  double sum = 0;
  for (const SphereSighting& sighting : sightings)
    sum += radiusAbout(machine, sighting, axis);
  return sum / static_cast<double>(sightings.size());
}

/// The most sightings between which no rotary axis but this one turned: the series that measured it. All of them if it
/// never turned alone.
std::vector<SphereSighting> seriesOf(const ChainFitTask& task, std::span<const SphereSighting> sightings,
                                     std::size_t axis) {
  constexpr double same = 1e-6;  // degrees
  const auto stand = [&](const SphereSighting& one, const SphereSighting& other) {
    return std::ranges::all_of(task.free, [&](const AxisFreedoms& free) {
      return free.axis == axis || std::abs(one.axes[free.axis] - other.axes[free.axis]) < same;
    });
  };
  std::vector<SphereSighting> longest;
  for (const SphereSighting& first : sightings) {
    std::vector<SphereSighting> series;
    std::ranges::copy_if(sightings, std::back_inserter(series),
                         [&](const SphereSighting& other) { return stand(first, other); });
    if (spanOf(series, axis) > (longest.empty() ? 0 : spanOf(longest, axis))) longest = std::move(series);
  }
  return longest.empty() ? std::vector<SphereSighting>(sightings.begin(), sightings.end()) : longest;
}

std::size_t positionsOf(std::span<const SphereSighting> sightings, std::size_t axis) {
  constexpr double same = 1e-3;  // degrees
  std::vector<double> readings;
  for (const SphereSighting& sighting : sightings)
    readings.push_back(sighting.axes[axis]);
  std::ranges::sort(readings);
  const auto repeated =
      std::ranges::unique(readings, [](double one, double next) { return std::abs(next - one) < same; });
  return readings.size() - repeated.size();
}

}  // namespace

Vector3 seen(const ChainFitTask& task, const MachineDescription& machine, const SphereSighting& sighting) {
  Vector3 tip = machine::baseFromSpindle(machine, sighting.axes) * sighting.ball;
  if (task.tipDeviation) tip += task.tipDeviation(sighting.axes);
  return machine::baseFromTable(machine, task.reference) *
         (machine::baseFromTable(machine, sighting.axes).inverse() * tip);
}

double radiusAbout(const MachineDescription& machine, const SphereSighting& sighting, std::size_t axis) {
  // Half a turn of the axis leads to the opposite point of the circle.
  SphereSighting turned = sighting;
  turned.axes[axis] += 180;
  const auto onTable = [&](const SphereSighting& each) {
    return Vector3(machine::baseFromTable(machine, each.axes).inverse() *
                   (machine::baseFromSpindle(machine, each.axes) * each.ball));
  };
  return (onTable(turned) - onTable(sighting)).norm() / 2;
}

Result<ChainFit> fitChain(const ChainFitTask& task, std::span<const SphereSighting> sightings) {
  if (sightings.empty()) return fail("the sphere was not found anywhere", "measure it");
  const MachineDescription believed = machine::corrected(task.built, task.believed);
  Vector3 sphere = task.sphere.value_or(Vector3::Zero());
  if (!task.sphere) {
    for (const SphereSighting& sighting : sightings)
      sphere += seen(task, believed, sighting) / static_cast<double>(sightings.size());
  }
  ChainFit fit;
  std::vector<Group> groups = groupsOf(task, believed);
  const auto residualsOf = [&](const Model& model) {
    const MachineDescription machine = machine::corrected(task.built, model.corrections);
    const Pose reference = machine::baseFromTable(machine, task.reference);
    Eigen::VectorXd residuals(3 * static_cast<Eigen::Index>(sightings.size()));
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const SphereSighting& sighting = sightings[i];
      Vector3 tip = machine::baseFromSpindle(machine, sighting.axes) * sighting.ball + model.shift;
      if (task.tipDeviation) tip += task.tipDeviation(sighting.axes);
      residuals.segment<3>(3 * static_cast<Eigen::Index>(i)) =
          reference * (machine::baseFromTable(machine, sighting.axes).inverse() * tip) - model.sphere;
    }
    return residuals;
  };
  const Residuals residuals = [&](const Eigen::VectorXd& p) { return residualsOf(modelOf(task, groups, sphere, p)); };

  // Freedoms that nothing tells go, one after the other.
  for (;;) {
    const Eigen::VectorXd start = Eigen::VectorXd::Zero(countOf(groups));
    if (start.size() == 0) break;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian(residuals, start), Eigen::ComputeFullV);
    const bool enough = 3 * static_cast<Eigen::Index>(sightings.size()) >= start.size();
    if (enough && svd.singularValues()[start.size() - 1] > weakest) break;
    const Eigen::VectorXd open = svd.matrixV().col(start.size() - 1);
    auto worst = groups.end(), weakPlace = groups.end();
    double most = 1e-6, mostPlace = 1e-6;
    Eigen::Index at = 0;
    for (auto group = groups.begin(); group != groups.end(); ++group) {
      const double share = open.segment(at, group->count()).norm();
      at += group->count();
      const bool mayGo = group->kind == Kind::Tilt || group->kind == Kind::Zero;
      double& highest = mayGo ? most : mostPlace;
      if (!mayGo && group->kind != Kind::Position) continue;
      if (share <= highest) continue;
      highest = share;
      (mayGo ? worst : weakPlace) = group;
    }
    const auto& [group, what] = worst != groups.end()
                                    ? std::pair(worst, worst->kind == Kind::Tilt ? "direction" : "zero position")
                                    : std::pair(weakPlace, "place");
    if (group == groups.end())
      return fail("the positions leave the place of the sphere open", "measure at more positions");
    const std::vector<SphereSighting> series = seriesOf(task, sightings, group->axis);
    const std::string sentence =
        fmt::format("{} positions over {:.4g} degrees with the sphere {:.4g} mm from the axis leave the {} of {} open",
                    positionsOf(series, group->axis), spanOf(series, group->axis),
                    meanRadius(believed, series, group->axis), what, task.built.axes[group->axis].name);
    if (worst == groups.end()) {
      return fail(sentence, "spread the positions of the axis further, measure at more of them, or move the sphere");
    }
    fit.undetermined.push_back(sentence);
    groups.erase(worst);
  }

  Eigen::VectorXd parameters = Eigen::VectorXd::Zero(countOf(groups));
  Eigen::MatrixXd cofactors = Eigen::MatrixXd::Zero(parameters.size(), parameters.size());
  if (parameters.size() > 0) {
    auto minimum = minimise(residuals, parameters);
    if (!minimum)
      return fail("no machine fits the measured positions", "check the sphere and its clamping, and the kinematics");
    parameters = std::move(minimum->parameters);
    cofactors = std::move(minimum->cofactors);
  }
  const Model model = modelOf(task, groups, sphere, parameters);
  fit.corrections = model.corrections;
  fit.machine = machine::corrected(task.built, model.corrections);
  fit.shift = model.shift;
  fit.sphere = model.sphere;
  const Eigen::VectorXd left = residualsOf(model);
  for (Eigen::Index i = 0; i < left.size(); i += 3)
    fit.residuals.emplace_back(left.segment<3>(i));
  fit.rms = std::sqrt(left.squaredNorm() / static_cast<double>(sightings.size()));
  fit.degreesOfFreedom = static_cast<int>(left.size() - parameters.size());
  for (const AxisFreedoms& free : task.free) {
    FoundAxis found{.axis = free.axis,
                    .radius = meanRadius(fit.machine, sightings, free.axis),
                    .span = spanOf(sightings, free.axis)};
    Eigen::Index at = 0;
    for (const Group& group : groups) {
      const auto block = cofactors.block(at, at, group.count(), group.count());
      at += group.count();
      if (group.axis != free.axis) continue;
      if (group.kind == Kind::Position) found.positionCofactors = group.basis * block * group.basis.transpose();
      if (group.kind != Kind::Tilt) continue;
      found.tilted = true;
      found.orientationCofactors = group.basis * block * group.basis.transpose() / (perRadian * perRadian);
    }
    fit.axes.push_back(found);
  }
  return fit;
}

std::vector<double> valuations(const ChainFitTask& task, std::span<const std::vector<SphereSighting>> series) {
  const MachineDescription believed = machine::corrected(task.built, task.believed);
  ChainFitTask places = task;
  for (AxisFreedoms& free : places.free)
    free.tilt = free.zero = false;
  places.sphere = Vector3::Zero();
  places.shift = false;
  const std::vector<Group> groups = groupsOf(places, believed);
  const Residuals errors = [&](const Eigen::VectorXd& p) {
    const MachineDescription machine =
        machine::corrected(task.built, modelOf(places, groups, Vector3::Zero(), p).corrections);
    std::vector<Vector3> all;
    for (const std::vector<SphereSighting>& each : series) {
      for (std::size_t i = 1; i < each.size(); ++i)
        all.push_back(seen(task, machine, each[i]) - seen(task, machine, each.front()));
    }
    Eigen::VectorXd values(3 * static_cast<Eigen::Index>(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i)
      values.segment<3>(3 * static_cast<Eigen::Index>(i)) = all[i];
    return values;
  };
  std::vector<double> found(task.free.size(), 0.0);
  if (found.empty()) return found;
  const Eigen::MatrixXd slopes = jacobian(errors, Eigen::VectorXd::Zero(countOf(groups)));
  const Eigen::MatrixXd normal = slopes.transpose() * slopes;
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(normal);
  if (!lu.isInvertible()) return found;
  const Eigen::MatrixXd inverse = lu.inverse();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto block = inverse.block<2, 2>(2 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(i));
    const Eigen::Matrix2d both = block;
    // The larger eigenvalue, which does not depend on how the two coordinates are chosen.
    const double mean = both.trace() / 2, half = std::hypot((both(0, 0) - both(1, 1)) / 2, both(0, 1));
    found[i] = 1 / (mean + half);
  }
  return found;
}

}  // namespace probewright::kinematics
