#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "control/journal.hpp"

/// What a fit says when its touches are moved by their scatter: whether the law of propagation of uncertainty, which is
/// of first order, can be trusted there.
namespace probewright::study {

/// The fit of a cycle's record, laid again through touches that normal distributed errors along the surface normals
/// have moved: 512 sets of errors, each with its opposite. They are the same every time.
class MovedTouches {
public:
  /// A fit of the cycle, and the standard deviation of the errors, mm, greater than 0.
  MovedTouches(const control::CycleRecord& cycle, const control::FitRecord& fit, double scatter);

  /// The root of the mean squared distance of a result of the fit from the one that was measured: standard deviation
  /// and shift of the mean together, in mm or degrees. Exact where the result follows the touches linearly.
  /// Nothing
  /// if some of the moved touches determine no such shape. Of centre, diameter and radius of circles and spheres,
  /// angles of lines, projection angles of planes.
  std::optional<double> uncertaintyOf(const control::ResultRecord& result) const;

private:
  /// Circle and sphere: centre and radius; line: direction; plane: normal.
  using Numbers = Eigen::Vector4d;
  void findPoints(const control::CycleRecord& cycle);
  std::optional<Numbers> numbersOf(std::span<const Vector3> points) const;
  void move(const std::vector<double>& errors, std::vector<Numbers>& moved);
  double distance(const Numbers& moved, const control::ResultRecord& result) const;

  const control::FitRecord& fit_;
  std::vector<Vector3> points_;              ///< along main, minor and tool axis
  std::vector<Vector3> normals_;             ///< of each of them, unit
  Numbers measured_ = Numbers::Zero();       ///< of the touches as they are
  std::vector<Numbers> one_;                 ///< of each touch alone, moved by the scatter to and fro
  std::vector<Numbers> all_;                 ///< of each set and its opposite
  std::vector<std::vector<double>> errors_;  ///< of each set, in standard deviations
  bool determined_ = false;
};

}  // namespace probewright::study
