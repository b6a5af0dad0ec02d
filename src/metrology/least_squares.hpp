#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "metrology/householder.hpp"

/// Levenberg-Marquardt for the few parameters of a shape.
namespace probewright::metrology {

/// Minimises the sum of squares of a problem that offers
///   static constexpr int freedoms;  type State;
///   void evaluate(const State&, Eigen::VectorXd& residuals, Eigen::Matrix<double, Dynamic, freedoms>& jacobian) const;
///   State moved(const State&, const Eigen::Matrix<double, freedoms, 1>& step) const;
/// whose lengths are of the order of 1. Steps are undamped Gauss-Newton steps until one fails to improve. The Jacobian
/// is factored by Householder QR, never squared, so that flat minima keep their digits.
template <class Problem>
class LeastSquares {
public:
  static constexpr int freedoms = Problem::freedoms;
  using State = typename Problem::State;
  using Step = Eigen::Matrix<double, freedoms, 1>;
  using Square = Eigen::Matrix<double, freedoms, freedoms>;
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, freedoms>;

  LeastSquares(const Problem& problem, State start) : problem_(problem), state_(std::move(start)) {
    problem_.evaluate(state_, residuals_, jacobian_);
    cost_ = residuals_.squaredNorm();
  }

  /// True if the minimum was reached.
  bool minimise() {
    constexpr int mostIterations = 300;
    constexpr double stepLimit = 1e-14;
    double damping = 0;
    double lastLength = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < mostIterations; ++iteration) {
      factor();
      for (;;) {
        const Step step = stepFor(damping);
        if (!step.allFinite()) return false;
        const double length = step.norm();
        State candidate = problem_.moved(state_, step);
        problem_.evaluate(candidate, trialResiduals_, trialJacobian_);
        const double trialCost = trialResiduals_.squaredNorm();
        // Near the minimum the cost is flat to its last digit while the steps still shrink: then they are the measure.
        const bool shrinks = length < 1e-6 && length < 0.9 * lastLength && trialCost <= cost_ * (1 + 1e-12);
        if (trialCost <= cost_ || shrinks) {
          // Steps that neither shrink nor lower the cost are rounding noise, larger the flatter the minimum is.
          const bool noise = length < 1e-9 && length >= 0.9 * lastLength && !(trialCost < cost_ * (1 - 1e-9));
          lastLength = length;
          state_ = std::move(candidate);
          residuals_.swap(trialResiduals_);
          jacobian_.swap(trialJacobian_);
          cost_ = trialCost;
          damping = damping < 1e-8 ? 0 : damping / 10;
          if (length < stepLimit || noise) return true;
          break;
        }
        // A step of this size that does not improve is rounding noise at the minimum.
        if (length < 1e-12) return true;
        damping = damping == 0 ? 1e-4 : damping * 10;
        if (damping > 1e20) return false;
      }
    }
    return false;
  }

  const State& state() const { return state_; }
  const Eigen::VectorXd& residuals() const { return residuals_; }

  /// (J^T J)^-1 at the state, or false if the points leave a parameter undetermined.
  bool cofactors(Square& result) {
    factor();
    const auto diagonal = upper_.diagonal().cwiseAbs();
    if (!(diagonal.minCoeff() > 1e-11 * diagonal.maxCoeff())) return false;
    const Square inverse = upper_.template triangularView<Eigen::Upper>().solve(Square::Identity());
    result = inverse * inverse.transpose();
    return true;
  }

private:
  void factor() {
    const Eigen::Index rows = std::max<Eigen::Index>(jacobian_.rows(), freedoms);
    Jacobian padded = Jacobian::Zero(rows, freedoms);
    padded.topRows(jacobian_.rows()) = jacobian_;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rows);
    right.head(residuals_.size()) = -residuals_;
    triangularize(padded, right);
    upper_ = padded.template topRows<freedoms>().template triangularView<Eigen::Upper>();
    right_ = right.template head<freedoms>();
  }

  Step stepFor(double damping) const {
    if (damping == 0) {
      const auto diagonal = upper_.diagonal().cwiseAbs();
      if (diagonal.minCoeff() > 1e-14 * diagonal.maxCoeff()) {
        return upper_.template triangularView<Eigen::Upper>().solve(right_);
      }
      damping = 1e-12;
    }
    Eigen::Matrix<double, 2 * freedoms, freedoms> stacked;
    stacked.template topRows<freedoms>() = upper_;
    stacked.template bottomRows<freedoms>().setZero();
    for (int i = 0; i < freedoms; ++i) {
      stacked(freedoms + i, i) = std::sqrt(damping) * std::max(upper_.col(i).norm(), 1e-12);
    }
    Eigen::Matrix<double, 2 * freedoms, 1> right;
    right << right_, Step::Zero();
    triangularize(stacked, right);
    Step step = right.template head<freedoms>();
    substituteBack(stacked.template topRows<freedoms>(), step);
    return step;
  }

  const Problem& problem_;
  State state_;
  Eigen::VectorXd residuals_, trialResiduals_;
  Jacobian jacobian_, trialJacobian_;
  double cost_ = 0;
  Square upper_ = Square::Zero();
  Step right_ = Step::Zero();
};

}  // namespace probewright::metrology
