#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "geometry/primitives.hpp"

/// The poles of one piece of a spline surface, and what they bound there.
namespace probewright::simulation {

/// The poles that reach a piece, or those of a derivative there.
class LocalNet {
public:
  using Pole = Eigen::Vector4d;  ///< x, y, z times the weight, and the weight

  void resize(int rows, int columns) {
    rows_ = std::max(0, rows), columns_ = std::max(0, columns);
    poles_.resize(static_cast<std::size_t>(rows_ * columns_));
  }
  Pole& at(int i, int j) { return poles_[static_cast<std::size_t>(i * columns_ + j)]; }
  const Pole& at(int i, int j) const { return poles_[static_cast<std::size_t>(i * columns_ + j)]; }

  /// Becomes the net of a derivative; `k` is the place of the knot with which the piece begins.
  void differentiateU(const LocalNet& net, const std::vector<double>& knots, int k) {
    resize(net.rows_ - 1, net.columns_);
    for (int i = 0; i < rows_; ++i) {
      const double share = shareOf(knots, k, net.rows_, i);
      for (int j = 0; j < columns_; ++j)
        at(i, j) = share * (net.at(i + 1, j) - net.at(i, j));
    }
  }
  void differentiateV(const LocalNet& net, const std::vector<double>& knots, int k) {
    resize(net.rows_, net.columns_ - 1);
    for (int j = 0; j < columns_; ++j) {
      const double share = shareOf(knots, k, net.columns_, j);
      for (int i = 0; i < rows_; ++i)
        at(i, j) = share * (net.at(i, j + 1) - net.at(i, j));
    }
  }
  /// From the poles of a piece, along u, to those of the part from `a` to `b` as a polynomial of its own; `k` is the
  /// place of the knot with which the piece begins.
  void restrictU(const std::vector<double>& knots, int k, double a, double b) {
    restrict(knots, k, a, b, rows_, columns_, columns_, 1);
  }
  void restrictV(const std::vector<double>& knots, int k, double a, double b) {
    restrict(knots, k, a, b, columns_, rows_, 1, columns_);
  }
  /// Becomes the net of a derivative of a polynomial along an interval of this length.
  void differencesU(const LocalNet& net, double length) {
    resize(net.rows_ - 1, net.columns_);
    for (int i = 0; i < rows_; ++i) {
      for (int j = 0; j < columns_; ++j)
        at(i, j) = (rows_ / length) * (net.at(i + 1, j) - net.at(i, j));
    }
  }
  void differencesV(const LocalNet& net, double length) {
    resize(net.rows_, net.columns_ - 1);
    for (int i = 0; i < rows_; ++i) {
      for (int j = 0; j < columns_; ++j)
        at(i, j) = (columns_ / length) * (net.at(i, j + 1) - net.at(i, j));
    }
  }

  double size() const {
    double most = 0;
    for (const Pole& pole : poles_)
      most = std::max(most, pole.head<3>().squaredNorm());
    return std::sqrt(most);
  }
  /// The least and the largest of what the poles rise along a unit vector; 0 where there is none.
  std::pair<double, double> rise(const Vector3& normal) const {
    std::pair<double, double> found{0, 0};
    for (std::size_t i = 0; i < poles_.size(); ++i) {
      const double height = normal.dot(poles_[i].head<3>());
      found =
          i == 0 ? std::pair(height, height) : std::pair(std::min(found.first, height), std::max(found.second, height));
    }
    return found;
  }
  double weight() const {
    double most = 0;
    for (const Pole& pole : poles_)
      most = std::max(most, std::abs(pole.w()));
    return most;
  }

private:
  static double shareOf(const std::vector<double>& knots, int k, int count, int i) {
    const int degree = count - 1;
    const auto at = [&](int place) { return knots[static_cast<std::size_t>(place)]; };
    return degree / (at(k + i + 1) - at(k + i + 1 - degree));
  }

  /// Of all `lines` of `count` poles: those of a line follow each other by `step`, the lines by `stride`.
  void restrict(const std::vector<double>& knots, int k, double a, double b, int count, int lines, int step,
                int stride) {
    const int degree = count - 1;
    const auto row = [&](std::vector<Pole>& poles, int i) {
      return poles.data() + static_cast<std::ptrdiff_t>(i * lines);
    };
    std::vector<Pole>&from = from_, &work = work_;
    from.resize(poles_.size());
    work.resize(poles_.size());
    for (int i = 0; i < count; ++i) {
      for (int line = 0; line < lines; ++line)
        row(from, i)[line] = poles_[static_cast<std::size_t>(i * step + line * stride)];
    }
    // de Boor's steps with `t` as the argument number `r`, which leave the poles from r on.
    const auto insert = [&](std::vector<Pole>& poles, int r, double t) {
      for (int i = degree; i >= r; --i) {
        const double left = knots[static_cast<std::size_t>(k - degree + i)];
        const double share = (t - left) / (knots[static_cast<std::size_t>(k + i + 1 - r)] - left);
        for (int line = 0; line < lines; ++line)
          row(poles, i)[line] += (1 - share) * (row(poles, i - 1)[line] - row(poles, i)[line]);
      }
    };
    for (int ends = degree; ends >= 0; --ends) {
      // With `ends` arguments at the end, the others at the beginning.
      std::copy(from.begin(), from.end(), work.begin());
      for (int r = degree - ends + 1; r <= degree; ++r)
        insert(work, r, b);
      for (int line = 0; line < lines; ++line)
        poles_[static_cast<std::size_t>(ends * step + line * stride)] = row(work, degree)[line];
      if (ends > 0) insert(from, degree - ends + 1, a);
    }
  }

  int rows_ = 0, columns_ = 0;
  std::vector<Pole> poles_;
  std::vector<Pole> from_, work_;  ///< of restrict()
};

}  // namespace probewright::simulation
