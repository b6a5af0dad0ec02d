#include "simulation/edge_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/edge_distance.hpp"

namespace probewright::simulation {

namespace {

constexpr double touching = 1e-9;      // mm
constexpr double couldTouch = 1e-4;    // mm, of what turns at any angle
constexpr double shortestStep = 1e-5;  // mm of the path
constexpr double shortestTurn = 1e-4;  // rad
constexpr double fullTurn = 2 * std::numbers::pi;
constexpr double exact = 1e-11;  // mm of the path, to which a contact is found

class EdgeSearch {
public:
  EdgeSearch(const Motion& motion, const CuttingEdges& edges, const Spin& spin, const DistanceSolid& solid,
             const Pose& solidFromTable, const std::stop_token& stop)
      : motion_(motion),
        edges_(edges),
        spin_(spin),
        solid_(solid),
        solidFromTable_(solidFromTable),
        stop_(stop),
        length_(motion.profile.length()),
        rate_(std::abs(radiansFromDegrees(spin.degreesPerSecond))),
        stretch_(stretchOf(motion)) {}

  std::optional<EdgeContact> first() const { return rate_ > 0 && !edges_.round() ? ofTurning() : ofStanding(); }

private:
  /// How much further a point of the tool moves on the table than the axes say, at most.
  static double stretchOf(const Motion& motion) {
    constexpr int pieces = 8;
    const double length = motion.profile.length();
    double most = 1;
    for (int i = 0; i < pieces && length > 0; ++i) {
      const Pose from = motion.tableFromSpindleAt(static_cast<double>(i) / pieces);
      const Pose to = motion.tableFromSpindleAt(static_cast<double>(i + 1) / pieces);
      for (const Vector3& place : {Vector3(0, 0, 0), Vector3(100, 0, -300), Vector3(0, 100, -300)})
        most = std::max(most, (to * place - from * place).norm() * pieces / length);
    }
    return 1.02 * most;
  }

  double secondsAt(double travelled) const { return motion_.profile.secondsAt(travelled); }
  double degreesAt(double seconds) const { return spin_.at(motion_.startSeconds + seconds); }
  Pose solidFromSpindle(double travelled) const {
    return solidFromTable_ * motion_.tableFromSpindleAt(length_ > 0 ? travelled / length_ : 0);
  }
  EdgeDistance distance(std::size_t edge, double travelled, double seconds) const {
    return edges_.nearest(edge, solidFromSpindle(travelled) * edges_.spindleFromCutter(degreesAt(seconds)), solid_);
  }
  double gapAt(std::size_t edge, double seconds) const {
    return distance(edge, motion_.profile.travelledAt(seconds), seconds).gap;
  }
  void mayStop(double travelled) const {
    if (stop_.stop_requested()) throw SearchStopped{length_ > 0 ? travelled / length_ : 0};
  }

  EdgeContact contact(std::size_t edge, double travelled, double seconds) const {
    const EdgeDistance near = distance(edge, travelled, seconds);
    return {length_ > 0 ? travelled / length_ : 0, degreesAt(seconds), edge, near.place, near.normal};
  }

  /// The tool is a body that does not change: as far as the gap is wide it may travel at once.
  std::optional<EdgeContact> ofStanding() const {
    std::optional<EdgeContact> first;
    double end = length_;
    for (std::size_t edge = 0; edge < edges_.count(); ++edge) {
      const auto gap = [&](double travelled) { return distance(edge, travelled, 0).gap; };
      double travelled = 0, before = 0;
      for (;;) {
        mayStop(travelled);
        const double free = gap(travelled);
        if (free <= touching) {
          for (int i = 0; i < 60 && free < 0 && travelled - before > exact; ++i) {
            const double middle = 0.5 * (before + travelled);
            (gap(middle) <= 0 ? travelled : before) = middle;
          }
          first = contact(edge, travelled, 0);
          end = travelled;
          break;
        }
        if (travelled >= end) break;
        before = travelled;
        travelled = std::min(end, travelled + std::max(free / stretch_, shortestStep));
      }
    }
    return first;
  }

  /// How far the axes travel from `travelled` until what turns could touch at some angle; nothing: not before `end`.
  /// `leastGap`: of all angles, by the pose of the spindle.
  template <class LeastGap>
  std::optional<double> towards(double travelled, double end, const LeastGap& leastGap) const {
    double before = travelled;
    for (;;) {
      mayStop(travelled);
      const double free = leastGap(solidFromSpindle(travelled));
      if (free <= couldTouch) return before;
      if (travelled >= end) return std::nullopt;
      before = travelled;
      travelled = std::min(end, travelled + std::max(free / stretch_, shortestStep));
    }
  }

  /// By how much the spindle may turn at least before an edge touches, radians: a turn that leaves the whole edge in
  /// front of a plane beside the solid, by more than the axes travel meanwhile. An edge that runs along a face hardly
  /// comes nearer, however fast it turns.
  double freeTurn(std::size_t edge, double seconds, const Vector3& normal, double least, double most) const {
    const Pose spindle = solidFromSpindle(motion_.profile.travelledAt(seconds));
    const double degrees = degreesAt(seconds);
    const Pose pose = spindle * edges_.spindleFromCutter(degrees);
    // The axis lies between where the cutter is and where it is half a turn later.
    const Pose opposite = spindle * edges_.spindleFromCutter(degrees + 180);
    const double sense = spin_.degreesPerSecond < 0 ? -1 : 1;
    const Line axis{0.5 * (pose.translation() + opposite.translation()), sense * pose.linear().col(2)};
    const Plane plane = planeBeside(solid_, normal);
    const double travels = stretch_ * motion_.profile.targetSpeed() / rate_;
    const double across = normal.cross(axis.direction).norm();  // what of a turn leads through the plane
    const double parted = edges_.nearest(edge, pose, HalfSpace(plane)).gap;
    least = std::max(least, parted / (travels + across * edges_.reach()));
    for (double turn = std::min(most, fullTurn); turn > least; turn *= 0.5)
      if (edges_.nearest(edge, pose, TurnsBehindPlane(plane, axis, turn)).gap > travels * turn) return turn;
    return least;
  }

  /// The first touch of an edge between two times.
  std::optional<double> touchOf(std::size_t edge, double from, double until) const {
    const double fastest = stretch_ * motion_.profile.targetSpeed() + rate_ * edges_.reach();
    double seconds = from, before = from, turn = 0.1;
    for (;;) {
      const EdgeDistance near = distance(edge, motion_.profile.travelledAt(seconds), seconds);
      if (near.gap <= 0) {
        for (int i = 0; i < 60 && (seconds - before) * fastest > exact; ++i) {
          const double middle = 0.5 * (before + seconds);
          (gapAt(edge, middle) <= 0 ? seconds : before) = middle;
        }
        return seconds;
      }
      if (seconds >= until) return std::nullopt;
      before = seconds;
      // The fastest point takes at least so long for the gap.
      const double least = std::max(near.gap / fastest * rate_, shortestTurn);
      turn = freeTurn(edge, seconds, near.normal, least, 4 * turn);
      seconds = std::min(until, seconds + turn / rate_);
    }
  }

  std::optional<EdgeContact> ofTurning() const {
    const double turn = fullTurn / rate_;
    const double duration = motion_.profile.duration();
    double travelled = 0;
    for (;;) {
      const auto near = towards(travelled, length_, [&](const Pose& pose) { return edges_.leastGap(pose, solid_); });
      if (!near) return std::nullopt;
      const double begin = secondsAt(*near);
      double end = std::min(begin + turn, duration);
      std::optional<std::size_t> touched;
      for (std::size_t edge = 0; edge < edges_.count(); ++edge) {
        // An edge that runs along a face is near it all the time: it is followed only once it can touch at all.
        const auto own = towards(*near, motion_.profile.travelledAt(end),
                                 [&](const Pose& pose) { return edges_.leastGap(edge, pose, solid_); });
        if (!own) continue;
        if (const auto seconds = touchOf(edge, std::max(begin, secondsAt(*own)), end)) {
          end = *seconds;
          touched = edge;
        }
      }
      if (touched) return contact(*touched, motion_.profile.travelledAt(end), end);
      if (end >= duration) return std::nullopt;
      travelled = motion_.profile.travelledAt(end);
    }
  }

  const Motion& motion_;
  const CuttingEdges& edges_;
  const Spin& spin_;
  const DistanceSolid& solid_;
  Pose solidFromTable_;
  const std::stop_token& stop_;
  double length_, rate_, stretch_;
};

}  // namespace

std::optional<EdgeContact> firstEdgeContact(const Motion& motion, const CuttingEdges& edges, const Spin& spin,
                                            const DistanceSolid& solid, const Pose& solidFromTable,
                                            const std::stop_token& stop) {
  return EdgeSearch(motion, edges, spin, solid, solidFromTable, stop).first();
}

}  // namespace probewright::simulation
