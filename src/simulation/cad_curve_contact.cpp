#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "simulation/cad_contact.hpp"
#include "simulation/cad_vectors.hpp"
#include "simulation/settling.hpp"

namespace probewright::simulation {
namespace {

/// One search for the contact of a ball with a curved edge.
class EdgeSearch {
public:
  EdgeSearch(const CadEdge& edge, const TrimmedDomain* within, const Way& way, double radius, int& piecesLeft,
             Meeting& best)
      : edge_(edge),
        curve_(**edge.bounded),
        within_(within),
        way_(way),
        radius_(radius),
        piecesLeft_(piecesLeft),
        best_(best) {}

  /// Looks near the chord between two parameters.
  void near(double low, double high) {
    meetPoint(low);
    meetPoint(high);
    if (best_.when >= 0) look(low, high, pointAt(low), pointAt(high), 0);
  }

private:
  static constexpr double kSame = 1e-7;      ///< mm: contacts nearer to each other are the same
  static constexpr double kStraight = 1e-8;  ///< mm: a piece that leaves its chord by less is as good as straight
  static constexpr double kRounding = 1e-9;  ///< mm

  Vector3 pointAt(double t) const { return curve_.at(t).point; }

  void meetPoint(double t) {
    if (counts(t)) sweepPoint(way_, radius_, pointAt(t), best_);
  }

  /// Looks at a piece between two points; in halves, until it is known where it is met before the best meeting.
  void look(double low, double high, const Vector3& from, const Vector3& to, int halvings) {
    if (const auto kink = curve_.kink(low, high)) {
      meetPoint(*kink);
      return lookAtBoth(low, *kink, high, from, to, halvings);
    }
    CurveBends bends = curve_.bends(low, high);
    const double deviation = bends.fromChord(high - low);
    Meeting coarse;
    coarse.when = best_.when;
    if (!sweepSegment(way_, radius_ + kRounding + deviation, from, to, coarse)) return;
    if (coarse.when > best_.when - kSame) return;
    constexpr int kMost = 40;
    if (deviation < kStraight || halvings == kMost || --piecesLeft_ < 0) return meetStraight(low, high, from, to);
    // A touch of one half is seldom that of the other: not each needs a search.
    constexpr int kOnceIn = 3;
    if (halvings % kOnceIn == 0 && settles(low, high, coarse)) return;
    lookAtBoth(low, (low + high) / 2, high, from, to, halvings + 1);
  }

  void lookAtBoth(double low, double middle, double high, const Vector3& from, const Vector3& to, int halvings) {
    const Vector3 between = pointAt(middle);
    const bool forwards = (from - to).dot(way_.direction) <= 0;
    for (const bool first : {forwards, !forwards}) {
      if (best_.when < 0) return;
      first ? look(low, middle, from, between, halvings) : look(middle, high, between, to, halvings);
    }
  }

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
      const auto [c, d1, d2] = curve_.at(t);
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

  /// Looks for a touch of the piece, which goes into the best if it counts. True if there is no earlier one.
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
    if (counts(at) && when > -kSame && when <= way_.length && when < best_.when && std::abs(gapAt(when, at)) < 1e-7) {
      const double end = std::min(way_.length, std::max(when, 0.0) + 1e-3 * radius_);
      double later = at;
      if (!project(way_.at(end), extent, later) || gapAt(end, later) < -kTouchTolerance)
        keep(best_, std::max(0.0, when), touch, Vector3::Zero());
    }
    return when > best_.when - kSame && isClearBefore(low, high, at, when, coarse.when);
  }

  /// True if the ball touches nothing of the piece before a touch; it does not before `soonest`. With q from the touch
  /// to a place of the curve and h its height along the way to the centre there, the ball is its radius R away from the
  /// place until the touch if q * q - 2 R h >= m q * q, where 2 m R is the ball's speed towards the touch times how
  /// long the ball is near.
  bool isClearBefore(double low, double high, double at, double when, double soonest) const {
    const double half = std::max(high - at, at - low);
    const CurveBends bends = curve_.bends(std::min(low, at), std::max(high, at));
    const CurvePoint p = curve_.at(at);
    const Vector3 normal = (way_.at(when) - p.point) / radius_;
    const double towards = -normal.dot(way_.direction), speed = p.d1.norm();
    const double share = std::max(0.0, when - soonest) / (2 * radius_ * towards);
    if (!(towards > 0) || !(share < 1) || !(speed > 0)) return false;
    const double rise = std::min(bends.d2, normal.dot(p.d2) + bends.d3 * half);
    const double straight = 1 - std::min(bends.d2, p.d2.norm() + bends.d3 * half) * half / (2 * speed);
    return rise <= 0 || (straight > 0 && radius_ * rise < (1 - share) * speed * speed * straight * straight);
  }

  /// Newton's method for the place where the ball touches the curve.
  bool solve(double extent, double& at, double& when) const {
    Settling settling(1e-12);
    for (int i = 0; i < 25; ++i) {
      const auto [c, d1, d2] = curve_.at(at);
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
  const FreeformCurve& curve_;
  const TrimmedDomain* within_;
  const Way& way_;
  double radius_;
  int& piecesLeft_;
  Meeting& best_;
};

}  // namespace

void meetEdgeNear(const CadEdge& edge, const TrimmedDomain* within, const CadElement& chord, const Way& way,
                  double radius, int& piecesLeft, Meeting& best) {
  EdgeSearch(edge, within, way, radius, piecesLeft, best).near(chord.parameters[0].x(), chord.parameters[1].x());
}

}  // namespace probewright::simulation
