#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "simulation/cad_contact.hpp"
#include "simulation/cad_vectors.hpp"
#include "simulation/settling.hpp"

namespace probewright::simulation {
namespace {

/// One search for the contact of a ball with a curved edge.
class EdgeSearch {
public:
  EdgeSearch(const CadEdge& edge, const TrimmedDomain* within, const Way& way, double radius, Meeting& best)
      : edge_(edge), within_(within), way_(way), radius_(radius), best_(best) {}

  /// Looks near the chord between two parameters; `coarse` is the meeting with the grown chord.
  void near(double low, double high, const Meeting& coarse, int depth = 0) {
    if (depth == 0) {
      for (const double t : {low, high}) {
        if (counts(t)) sweepPoint(way_, radius_, pointAt(t), best_);
      }
    }
    if (settles(low, high, coarse)) return;
    constexpr int kDeepest = 14;
    const double middle = (low + high) / 2;
    const std::array<double, 3> ends{low, middle, high};
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector3 a = pointAt(ends[k]);
      const Vector3 b = pointAt(ends[k + 1]);
      const double deviation = (pointAt((ends[k] + ends[k + 1]) / 2) - (a + b) / 2).norm();
      Meeting finer;
      finer.when = best_.when;
      if (!sweepSegment(way_, radius_ + 1e-9 + 2 * deviation, a, b, finer)) continue;
      if (finer.when > best_.when - 1e-7) continue;
      if (depth < kDeepest && deviation > 1e-8) {
        near(ends[k], ends[k + 1], finer, depth + 1);
      } else if (deviation < 1e-6) {
        meetStraight(ends[k], ends[k + 1], a, b);
      }
    }
  }

private:
  std::array<Vector3, 3> evaluateCurve(double t) const {
    gp_Pnt p;
    gp_Vec d1, d2;
    edge_.curve->D2(t, p, d1, d2);
    return {vector(p), vector(d1), vector(d2)};
  }
  Vector3 pointAt(double t) const { return vector(edge_.curve->Value(t)); }

  bool counts(double t) const {
    return within_ == nullptr || within_->contains(edge_.acrossU ? Vector2(edge_.kinkAt, t) : Vector2(t, edge_.kinkAt));
  }

  /// Meets a piece that is as good as straight; beyond the border of the face that it is a kink of, there is nothing.
  void meetStraight(double low, double high, const Vector3& a, const Vector3& b) {
    Meeting met;
    met.when = best_.when;
    if (!sweepSegment(way_, radius_, a, b, met)) return;
    const Vector3 line = b - a;
    const double share =
        line.squaredNorm() > 0 ? std::clamp(line.dot(met.point - a) / line.squaredNorm(), 0.0, 1.0) : 0;
    if (counts(low + share * (high - low))) keep(best_, met.when, met.point, met.normal);
  }

  bool project(const Vector3& p, double extent, double& t) const {
    Settling settling(1e-11);
    for (int i = 0; i < 30; ++i) {
      const auto [c, d1, d2] = evaluateCurve(t);
      const Vector3 w = p - c;
      double curvature = d1.squaredNorm() - w.dot(d2);
      if (curvature <= 0) curvature = d1.squaredNorm();
      if (curvature <= 0) return false;
      const double step = std::clamp(w.dot(d1) / curvature, -extent, extent);
      t += step;
      if (settling.after(std::abs(step) * d1.norm())) return true;
    }
    return false;
  }

  double gapAt(double when, double t) const { return (way_.at(when) - pointAt(t)).norm() - radius_; }

  /// True if what happens near the chord is known: a contact, which goes into the best, or none.
  bool settles(double low, double high, const Meeting& coarse) {
    const double extent = high - low;
    const Vector3 from = pointAt(low);
    const Vector3 line = pointAt(high) - from;
    const double share =
        line.squaredNorm() > 0 ? std::clamp(line.dot(coarse.point - from) / line.squaredNorm(), 0.0, 1.0) : 0.5;
    const double seed = low + share * extent;
    const auto onChord = [&](double t) {
      return t >= low - 0.01 * extent && t <= high + 0.01 * extent && t >= edge_.first && t <= edge_.last;
    };
    if (coarse.when < 0) {
      double t = seed;
      if (project(way_.start, extent, t) && onChord(t) && counts(t)) {
        const double gap = gapAt(0, t);
        if (gap < -kTouchTolerance) {
          keep(best_, gap, pointAt(t), Vector3::Zero());
          return true;
        }
      }
    }
    double at = seed;
    double when = std::max(0.0, coarse.when);
    if (!solve(extent, at, when)) return false;
    if (!onChord(at)) return false;
    const Vector3 touch = pointAt(at);
    if ((way_.at(when) - touch).dot(way_.direction) >= 0) return false;
    if (!counts(at) || when < -1e-7 || when > way_.length || when >= best_.when) return true;
    if (std::abs(gapAt(when, at)) > 1e-7) return false;
    const double end = std::min(way_.length, std::max(when, 0.0) + 1e-3 * radius_);
    double later = at;
    if (project(way_.at(end), extent, later) && gapAt(end, later) >= -kTouchTolerance) return true;
    keep(best_, std::max(0.0, when), touch, Vector3::Zero());
    return true;
  }

  /// Newton's method for the place where the ball touches the curve.
  bool solve(double extent, double& at, double& when) const {
    Settling settling(1e-12);
    for (int i = 0; i < 25; ++i) {
      const auto [c, d1, d2] = evaluateCurve(at);
      const Vector3 w = way_.at(when) - c;
      const Vector2 f(w.dot(d1), (w.squaredNorm() - radius_ * radius_) / (2 * radius_));
      Eigen::Matrix2d jacobian;
      jacobian << w.dot(d2) - d1.squaredNorm(), way_.direction.dot(d1), -w.dot(d1) / radius_,
          way_.direction.dot(w) / radius_;
      if (std::abs(jacobian.determinant()) < 1e-300) return false;
      const Vector2 step = -jacobian.inverse() * f;
      const double scale = std::min(
          {1.0, extent / std::max(std::abs(step.x()), 1e-300), radius_ / std::max(std::abs(step.y()), 1e-300)});
      at += scale * step.x();
      when += scale * step.y();
      const bool still = settling.after(std::abs(step.y()));
      if (still && std::abs(step.x()) * d1.norm() < 1e-9) return true;
    }
    return false;
  }

  const CadEdge& edge_;
  const TrimmedDomain* within_;
  const Way& way_;
  double radius_;
  Meeting& best_;
};

}  // namespace

void meetEdgeNear(const CadEdge& edge, const TrimmedDomain* within, const CadElement& chord, const Meeting& coarse,
                  const Way& way, double radius, Meeting& best) {
  EdgeSearch(edge, within, way, radius, best).near(chord.parameters[0].x(), chord.parameters[1].x(), coarse);
}

}  // namespace probewright::simulation
