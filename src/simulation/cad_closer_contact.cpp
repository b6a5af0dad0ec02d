#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "simulation/ball_on_face.hpp"
#include "simulation/cad_contact.hpp"
#include "simulation/surface_steps.hpp"
#include "simulation/touch_proof.hpp"
#include "simulation/triangle_region.hpp"

namespace probewright::simulation {
namespace {

/// One search for the contact of a ball with a free-form face, where one of its triangles is.
///
/// It looks at boxes of the parameters. In a box the surface leaves the plane that touches it in the middle by no more
/// than `SurfaceBends::fromPlane`, so the ball does not meet it before it meets the piece of the plane, grown by that;
/// what a box needs not be looked at for follows from that and from bounds of the derivatives, never from samples:
/// - the ball meets the grown piece of the plane later than what is known already, or never;
/// - no place in it can be touched: there the way from the surface to the centre is a normal of the surface
///   (`facesTheBall`);
/// - Newton's method has found a touch, and there is no earlier one in the box (`isOnlyTouch`).
/// Otherwise the box is halved. Touches on the border of a face are those of its edges.
class CloserLook {
public:
  CloserLook(const CadFace& face, const FaceQuestion& question, const Way& way, double radius, Meeting& best)
      : face_(face),
        surface_(**face.freeform),
        region_(question.triangle, face.domain),
        way_(way),
        radius_(radius),
        best_(best),
        ball_(face, way, radius, best),
        proof_(surface_, way, radius) {
    if (question.isSolved) addTouch({question.at, question.when});
  }

  /// True if what meetFaceNear has found shows that the ball touches nothing in the region before that.
  bool isClear(const FaceQuestion& question) const {
    return proof_.isClearBefore({question.at, question.when}, region_.whole(), question.soonest);
  }

  /// Boxes, those first that would be met first, until all is known or they are as good as the surface.
  void closely(int& boxesLeft) {
    consider({region_.whole(), -1e300});
    for (int looked = 0; !open_.empty() && best_.when >= 0; ++looked) {
      std::pop_heap(open_.begin(), open_.end(), later);
      const Part next = open_.back();
      open_.pop_back();
      // Where a pole is met, many places beside it are met nearly as soon: there the last digit has to do.
      constexpr int kMany = 400;
      const double same = looked < kMany ? kSame : kSameAmongMany;
      if (next.soonest > std::min(best_.when - same, latest_ + kSame)) return;
      if (next.isFlat || looked >= kMostParts || --boxesLeft < 0) {
        meetFlat(next);
        continue;
      }
      for (const ParameterBox& half : halves(next))
        consider({half, next.soonest});
    }
  }

private:
  static constexpr int kMostParts = 20000;
  static constexpr double kFlat = 1e-8;  ///< mm: a plane that leaves the surface by less is as good as the surface
  static constexpr double kSame = 1e-7;  ///< mm: contacts nearer to each other are the same
  static constexpr double kSameAmongMany = 8e-7;
  static constexpr double kRounding = 1e-9;  ///< mm

  /// A box of parameters whose place on the surface may be met, and where at the earliest.
  struct Part {
    ParameterBox box;
    double soonest = 0;
    bool isFlat = false;
    Vector2 size = Vector2::Zero();  ///< what each parameter adds to what is not known of the part
  };
  static bool later(const Part& a, const Part& b) { return a.soonest > b.soonest; }

  /// The plane that touches the surface in the middle of a box.
  struct Plane {
    SurfacePoint at;
    SurfaceBends bends;
    Vector2 middle, half;
    double growth = 0;
    double reach = 0;  ///< no point of the surface in the box is farther from its middle

    Vector3 corner(int u, int v) const { return at.point + u * half.x() * at.u + v * half.y() * at.v; }
    bool sweep(const Way& way, double radius, Meeting& meeting) const {
      const Vector3 a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1), d = corner(-1, 1);
      const bool first = sweepTriangle(way, radius, {a, b, c}, meeting);
      return sweepTriangle(way, radius, {a, c, d}, meeting) || first;
    }
  };

  enum class State : std::uint8_t { Done, Open };

  Plane planeOf(const ParameterBox& box) const {
    Plane plane{surface_.at(box.middle()), surface_.bends(box.low, box.high), box.middle(), box.half()};
    const Vector2 h = plane.half;
    plane.bends.narrow(plane.at, h);
    plane.growth = kRounding + plane.bends.fromPlane(h);
    plane.reach = std::min(plane.bends.u * h.x() + plane.bends.v * h.y(),
                           plane.at.u.norm() * h.x() + plane.at.v.norm() * h.y() + plane.growth);
    return plane;
  }

  std::array<ParameterBox, 2> halves(const Part& part) const {
    const Eigen::Index k = part.size.x() >= part.size.y() ? 0 : 1;
    double at = part.box.middle()[k];
    if (const auto kink = surface_.kinkAcrossU(part.box.low.x(), part.box.high.x())) return cut(part.box, 0, *kink);
    if (const auto kink = surface_.kinkAcrossV(part.box.low.y(), part.box.high.y())) return cut(part.box, 1, *kink);
    return cut(part.box, k, at);
  }
  static std::array<ParameterBox, 2> cut(const ParameterBox& box, Eigen::Index k, double at) {
    std::array<ParameterBox, 2> halves{box, box};
    halves[0].high[k] = halves[1].low[k] = at;
    return halves;
  }

  void consider(Part part) {
    if (look(part) == State::Done) return;
    open_.push_back(part);
    std::push_heap(open_.begin(), open_.end(), later);
  }

  /// Done if nothing in the part is met before the best meeting, which may be one found here. Otherwise the part is as
  /// small as it can be told to be.
  State look(Part& part) {
    for (int i = 0;; ++i) {
      if (!region_.reaches(part.box)) return State::Done;
      if (hasKink(surface_, part.box)) return State::Open;
      const Plane plane = planeOf(part.box);
      part.size = sizeOf(plane);
      part.isFlat = plane.growth < kFlat;
      Meeting coarse;
      coarse.when = best_.when;
      if (!plane.sweep(way_, radius_ + plane.growth, coarse) || coarse.when > best_.when - kSame) return State::Done;
      part.soonest = coarse.when;
      noteReal(part, plane);
      if (part.soonest > latest_ + kSame) return State::Done;
      Times times = timesNear(plane, part.soonest);
      narrow(times, plane, part.soonest);
      if (times.from > times.to) return State::Done;
      const ParameterBox old = part.box;
      if (!shrink(part.box, plane, times)) return State::Done;
      const Vector2 share = (part.box.high - part.box.low).cwiseQuotient(old.high - old.low);
      constexpr double kWorth = 0.5;
      constexpr int kMost = 12;
      if (share.prod() < kWorth && i < kMost) continue;
      if (!face_.domain.isEverywhere() && !face_.domain.reaches(part.box.low, part.box.high)) return State::Done;
      if (!facesTheBall(plane, times) || isHollow(plane, times)) return State::Done;
      // Where a touch could not be told to be the only one, or one is known, none need be looked for.
      if (isAnswered(part.box, times)) return State::Done;
      if (!mayBeConvex(plane, times) || holdsTouch(part.box)) return State::Open;
      return settles(part, plane, times, coarse);
    }
  }

  Vector2 sizeOf(const Plane& plane) const {
    constexpr double kFlatSizes = 1e-3;
    const Vector2 h = plane.half, size(plane.bends.u * h.x(), plane.bends.v * h.y());
    const double mixed = plane.bends.uv * h.x() * h.y();
    return Vector2(plane.bends.uu * h.x() * h.x() + mixed, plane.bends.vv * h.y() * h.y() + mixed) +
           kFlatSizes / radius_ * size.cwiseAbs2();
  }

  /// The ball does not go beyond where it meets a point of the face.
  void noteReal(const Part& part, const Plane& plane) {
    Meeting met;
    met.when = std::min(best_.when, latest_);
    if (sweepPoint(way_, radius_, plane.at.point, met) && face_.domain.contains(part.box.middle()))
      latest_ = std::max(0.0, met.when);
  }

  Times timesNear(const Plane& plane, double soonest) const {
    const Vector3 arm = plane.at.point - way_.start;
    const double along = arm.dot(way_.direction), across = arm.squaredNorm() - along * along;
    const double reach = radius_ + plane.reach;
    const double before = std::sqrt(std::max(0.0, reach * reach - across));
    return {std::max({0.0, soonest, along - before}), std::min({best_.when, latest_, way_.length, along + before})};
  }

  /// Takes away when the ball cannot enter the surface within a part: at a touch the way w from the surface to the
  /// centre is a normal, so seen along the slopes in the middle of the part it is no longer than the radius times what
  /// the slopes turn by.
  void narrow(Times& times, const Plane& plane, double soonest) const {
    const SurfacePoint& s = plane.at;
    const SurfaceBends& b = plane.bends;
    const Vector2 h = plane.half;
    const Vector3 &along = way_.direction, start = way_.start - s.point;
    const double turnU = b.uu * h.x() + b.uv * h.y(), turnV = b.uv * h.x() + b.vv * h.y();
    for (const auto& [slope, turn] : {std::pair(s.u, turnU), std::pair(s.v, turnV)}) {
      const double most = radius_ * turn + Shift{s, h, plane.growth, 0}.along(slope, along);
      const double speed = along.dot(slope), at = start.dot(slope);
      if (speed == 0) {
        if (std::abs(at) > most) times.to = -1;
        continue;
      }
      const double a = (-most - at) / speed, c = (most - at) / speed;
      times = {std::max(times.from, std::min(a, c)), std::min(times.to, std::max(a, c))};
    }
    // What is left of w across the plane, on the side that the ball comes from, unless it overlaps from the start.
    if (soonest < 0) return;
    const Vector3 across = s.u.cross(s.v);
    const Form form{s.u.squaredNorm(), std::abs(s.u.dot(s.v)), s.v.squaredNorm()};
    if (!form.isConvex()) return;
    const Vector3 normal = across.normalized() * (across.dot(along) > 0 ? -1 : 1);
    const double aside = radius_ * std::sqrt(form.ofInverse(turnU, turnV));
    if (!(aside < radius_)) return;
    const double height = std::sqrt(radius_ * radius_ - aside * aside), speed = -normal.dot(along);
    if (height * speed <= aside) return;
    times.to = std::min(times.to, (normal.dot(start) - height + plane.growth) / speed);
  }

  /// Takes away what the ball does not reach in this time. False if that is all.
  bool shrink(ParameterBox& box, const Plane& plane, const Times& times) const {
    const Vector3 from = way_.at(times.from), to = way_.at(times.to);
    const double near = radius_ + plane.growth + kRounding;
    const Vector3 low = (from.cwiseMin(to).array() - near).matrix() - plane.at.point;
    const Vector3 high = (from.cwiseMax(to).array() + near).matrix() - plane.at.point;
    Vector2 first = -plane.half, last = plane.half;
    constexpr int kRounds = 2;
    for (int round = 0; round < kRounds; ++round) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const Vector2 slope(plane.at.u[axis], plane.at.v[axis]);
        for (Eigen::Index k = 0; k < 2; ++k) {
          const double other = slope[1 - k];
          const double least = std::min(other * first[1 - k], other * last[1 - k]);
          const double most = std::max(other * first[1 - k], other * last[1 - k]);
          if (slope[k] == 0) {
            if (least > high[axis] || most < low[axis]) return false;
            continue;
          }
          const double a = (low[axis] - most) / slope[k], b = (high[axis] - least) / slope[k];
          first[k] = std::max(first[k], std::min(a, b));
          last[k] = std::min(last[k], std::max(a, b));
          if (first[k] > last[k]) return false;
        }
      }
    }
    const Vector2 middle = box.middle();
    box = {box.low.cwiseMax(middle + first), box.high.cwiseMin(middle + last)};
    return true;
  }

  /// True if each place within the part where the ball could touch at these times is one where the surface bends around
  /// the ball more than the ball does: there it would touch places beside it before.
  bool isHollow(const Plane& plane, const Times& times) const {
    const SurfacePoint& s = plane.at;
    const SurfaceBends& b = plane.bends;
    const Vector2 h = plane.half;
    const Vector3 w = way_.at(times.middle()) - s.point;
    const Shift shift{s, h, plane.growth, times.half()};
    const auto isHollowAlong = [&](const Vector3& slope, double turn, const Vector3& bend, double most, double change) {
      const double size = slope.norm() + turn;
      return size * size - w.dot(bend) + shift.along(bend, way_.direction) + radius_ * std::min(2 * most, change) < 0;
    };
    return isHollowAlong(s.u, b.uu * h.x() + b.uv * h.y(), s.uu, b.uu, b.uuu * h.x() + b.uuv * h.y()) ||
           isHollowAlong(s.v, b.uv * h.x() + b.vv * h.y(), s.vv, b.vv, b.uvv * h.x() + b.vvv * h.y());
  }

  /// False if the ball touches no place within the part at these times, as the centre lies on no normal there: at a
  /// touch, w * (a Su + b Sv) = 0, w from the surface to the centre. With a and b so that this is the way along the
  /// plane to the foot of the centre in the middle of the times, it is more than what all of it can change by.
  bool facesTheBall(const Plane& plane, const Times& times) const {
    const SurfacePoint& s = plane.at;
    const Vector3 w = way_.at(times.middle()) - s.point;
    Eigen::Matrix2d form;
    form << s.u.dot(s.u), s.u.dot(s.v), s.u.dot(s.v), s.v.dot(s.v);
    const Vector2 along = form.inverse() * Vector2(w.dot(s.u), w.dot(s.v));
    if (!along.allFinite()) return true;
    const Vector3 tangent = along.x() * s.u + along.y() * s.v;
    const SurfaceBends& b = plane.bends;
    const Vector2 h = plane.half;
    // |w| is the radius where the ball touches.
    const double turns = radius_ * (std::abs(along.x()) * (b.uu * h.x() + b.uv * h.y()) +
                                    std::abs(along.y()) * (b.uv * h.x() + b.vv * h.y()));
    return w.dot(tangent) <= turns + Shift{s, h, plane.growth, times.half()}.along(tangent, way_.direction);
  }

  bool mayBeConvex(const Plane& plane, const Times& times) const {
    const Vector3 w = way_.at(times.middle()) - plane.at.point;
    const Shift shift{plane.at, plane.half, plane.growth, times.half()};
    return formAbout(plane.at, plane.bends, shift, w, radius_, way_.direction, Vector3::Zero()).isConvex();
  }

  State settles(const Part& part, const Plane& plane, const Times& times, const Meeting& coarse) {
    const ParameterBox& box = part.box;
    const Vector2 extent = box.high - box.low;
    if (coarse.when < 0 && ball_.meetsAtStart(box.middle(), extent)) return State::Done;
    // The piece of the plane itself, where it is met at all, gives a better start than the grown one.
    Meeting met;
    plane.sweep(way_, radius_, met);
    const Meeting& seed = met.found() ? met : coarse;
    Vector2 at = parametersOf(plane, part, seed.point);
    double when = std::max(0.0, seed.when);
    constexpr double kBeyond = 0.5;
    const ParameterBox within{box.low - kBeyond * extent, box.high + kBeyond * extent};
    if (!solveSurfaceTouch(surface_, way_, radius_, extent, &within, at, when)) return State::Open;
    if ((way_.at(when) - surface_.at(at).point).dot(way_.direction) >= 0) return State::Open;
    ball_.accept(when, at);
    addTouch({at, when});
    return answers(touches_.back(), box, times) ? State::Done : State::Open;
  }

  void addTouch(const SurfaceTouch& touch) {
    constexpr std::size_t kMost = 4;
    if (touches_.size() == kMost) touches_.erase(touches_.begin());
    touches_.push_back(touch);
  }
  bool holdsTouch(const ParameterBox& box) const {
    return std::ranges::any_of(touches_, [&](const SurfaceTouch& touch) {
      return (touch.at - box.low).minCoeff() >= 0 && (box.high - touch.at).minCoeff() >= 0;
    });
  }
  bool isAnswered(const ParameterBox& box, const Times& times) const {
    // One far away tells no more of it than of a larger box.
    const Vector2 beside = (box.high - box.low) / 2;
    return std::ranges::any_of(touches_, [&](const SurfaceTouch& touch) {
      return (touch.at - box.low + beside).minCoeff() >= 0 && (box.high + beside - touch.at).minCoeff() >= 0 &&
             answers(touch, box, times);
    });
  }
  /// True if a touch shows that the ball touches nothing else in the box at these times, which the best meeting ends.
  bool answers(const SurfaceTouch& touch, const ParameterBox& box, const Times& times) const {
    if (touch.when > times.to - kSame && proof_.isClearBefore(touch, box, times.from)) return true;
    return proof_.isOnlyTouch(touch, box, {std::min(times.from, touch.when), std::max(times.to, touch.when)});
  }

  Vector2 parametersOf(const Plane& plane, const Part& part, const Vector3& point) const {
    const Vector3 arm = point - plane.at.point;
    Eigen::Matrix2d form;
    form << plane.at.u.dot(plane.at.u), plane.at.u.dot(plane.at.v), 0, plane.at.v.dot(plane.at.v);
    form(1, 0) = form(0, 1);
    const Vector2 step = form.inverse() * Vector2(arm.dot(plane.at.u), arm.dot(plane.at.v));
    if (!step.allFinite()) return part.box.middle();
    return (plane.middle + step).cwiseMax(part.box.low).cwiseMin(part.box.high);
  }

  /// As a last resort the piece of the plane itself, unless what is known already is the same within its precision.
  void meetFlat(const Part& part) {
    const Plane plane = planeOf(part.box);
    Meeting flat;
    flat.when = best_.when - 4 * std::min(plane.growth, kSame);
    if (!plane.sweep(way_, radius_, flat)) return;
    const Vector2 at = parametersOf(plane, part, flat.point);
    if (face_.domain.contains(at)) ball_.meet(flat.when, at);
  }

  const CadFace& face_;
  const FreeformSurface& surface_;
  TriangleRegion region_;
  const Way& way_;
  double radius_;
  Meeting& best_;
  BallOnFace ball_;
  TouchProof proof_;
  std::vector<Part> open_;
  std::vector<SurfaceTouch> touches_;
  double latest_ = 1e300;  ///< the ball meets something by then
};

}  // namespace

bool isClearBefore(const CadFace& face, const FaceQuestion& question, const Way& way, double radius) {
  if (!question.isSolved) return false;
  Meeting none;
  return CloserLook(face, question, way, radius, none).isClear(question);
}

void meetFaceClosely(const CadFace& face, const FaceQuestion& question, const Way& way, double radius, int& boxesLeft,
                     Meeting& best) {
  CloserLook(face, question, way, radius, best).closely(boxesLeft);
}

}  // namespace probewright::simulation
