#include "truth/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/stopped_place.hpp"
#include "simulation/contact_search.hpp"
#include "simulation/face_at.hpp"
#include "simulation/round_faces.hpp"
#include "truth/family_truth.hpp"

namespace probewright::truth {

using control::InterruptedMotion;
using control::Interruption;
using records::Diagnosis;
using records::Ghost;
using simulation::Motion;
using simulation::PathTouch;
using simulation::ToolShape;
using simulation::TrueTool;

namespace {

constexpr double farthest = 100;  // mm that are looked at beyond the end of a measuring move

std::string number(double value) { return formatFixed(value, 3); }

/// "X+1.000 Y+2.000 Z+3.000".
std::string coordinates(const Vector3& p) {
  return fmt::format("X{} Y{} Z{}", formatSigned(p.x(), 3), formatSigned(p.y(), 3), formatSigned(p.z(), 3));
}

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

/// "+Y", or of slanted directions "X+0.71 Y-0.71".
std::string directionText(const Vector3& direction) {
  Eigen::Index along = 0;
  direction.cwiseAbs().maxCoeff(&along);
  if (std::abs(direction[along]) > 0.999) return fmt::format("{}{}", direction[along] > 0 ? '+' : '-', "XYZ"[along]);
  std::string text;
  for (int i = 0; i < 3; ++i)
    if (std::abs(direction[i]) > 0.005)
      text += fmt::format("{}{}{}", text.empty() ? "direction " : " ", "XYZ"[i], formatSigned(direction[i], 2));
  return text;
}

/// One interrupted motion in the true world.
class Case {
public:
  Case(const InterruptedMotion& motion, const control::CycleRecord* cycle, control::ControlKind control,
       const simulation::VirtualMachine& machine)
      : motion_(motion),
        cycle_(cycle),
        family_(familyTruth(control)),
        control_(control),
        truth_(machine.truth()),
        path_(machine.path()),
        kinematics_(truth_.machine, truth_.errors),
        surroundings_(truth_.solids),
        spindleDegrees_(machine.spindle().angle) {
    tool_ = toolThen();
    shape_ = simulation::shapeOf(tool_, spindleDegrees_);
  }

  Diagnosis diagnose() {
    Diagnosis known;
    known.cycle = motion_.cycle;
    known.seconds = motion_.seconds;
    switch (motion_.why) {
      case Interruption::NoContact:
        missed(known);
        feature(known);
        break;
      case Interruption::Deflected:
      case Interruption::Collision:
        met(known);
        feature(known);
        break;
      case Interruption::Limit:
        feature(known);
        break;
    }
    return known;
  }

private:
  const TrueTool* toolThen() const {
    const auto after =
        std::ranges::upper_bound(path_.points, motion_.seconds + 1e-6, {}, &simulation::PathPoint::seconds);
    if (after == path_.points.begin()) return nullptr;
    const int index = std::prev(after)->tool;
    return index < 0 ? nullptr : &truth_.tools[static_cast<std::size_t>(index)];
  }

  bool isProbe() const { return tool_ != nullptr && tool_->kind == simulation::ToolKind::Probe; }

  Pose tableFromSpindle(const machine::AxisPositions& axes) const {
    return kinematics_.tableFromSpindle(axes, motion_.seconds);
  }

  Vector3 inProgram(const Vector3& onTable) const { return motion_.programFromTable * onTable; }

  std::string place(const Vector3& onTable) const {
    return fmt::format("{} ({} on the table)",
                       control::workpiecePlace(ProgramPlace(inProgram(onTable)), motion_.programUnit,
                                               truth_.machine.mainSpindle.has_value()),
                       coordinates(onTable));
  }

  /// A measuring move that felt nothing: what it would have felt.
  void missed(Diagnosis& known) const {
    if (!isProbe() || shape_.balls.empty()) return;
    Motion on = beyond();
    const double length = on.profile.length();
    const Vector3 way = tableFromSpindle(motion_.to) * shape_.tip - tableFromSpindle(motion_.from) * shape_.tip;
    if (!(way.norm() > 0)) return;
    const Vector3 ahead = (motion_.programFromTable.linear() * way).normalized();
    simulation::SearchOptions options{.precision = 1e-4, .ignoreShafts = true};
    const auto touch = simulation::firstTouch(on, 0, 1, shape_, surroundings_, options);
    if (cycle_ != nullptr && !cycle_->touches.empty() && cycle_->touches.back().outcome != "touched") {
      const Vector3 target = motion_.programFromTable.inverse() * cycle_->touches.back().target;
      known.expected = Ghost{"plane", target, -way.normalized(), 0, {}};
    }
    if (!touch) {
      known.texts.push_back(
          fmt::format("nothing is in the way of the ball for another {:.0f} mm in {}", length, directionText(ahead)));
      return;
    }
    const double further = touch->fraction * length;
    known.found = Ghost{known.expected ? "plane" : "point", touch->point, touch->normal, 0, {}};
    std::string text =
        fmt::format("the face of {} is {} mm further in {}, at {}", quoted(truth_.solids[touch->solid].name),
                    number(further), directionText(ahead), place(touch->point));
    if (family_ != nullptr) {
      const Reach reach = family_->reach(cycle_, way.norm(), control_);
      // Half a millimetre for pretravel and what the face lies askew.
      const double enough = reach.now + further + 0.5;
      const bool inch = reach.ofProgram && motion_.programUnit != 1;
      text += fmt::format("; with {} {} the touch would reach it", reach.name,
                          inch ? fmt::format("{:.2f} inch", std::ceil(100 * enough / motion_.programUnit) / 100)
                               : fmt::format("{:.0f} mm", std::ceil(enough)));
    }
    known.texts.push_back(std::move(text));
    const simulation::PlacedSolid& solid = truth_.solids[touch->solid];
    const auto face = simulation::faceAt(*solid.solid, solid.tableFromSolid.inverse() * touch->point,
                                         solid.tableFromSolid.linear().transpose() * touch->normal);
    if (face && face->kind == simulation::AnalyticSurface::Kind::Plane)
      askew(known, ahead, (motion_.programFromTable.linear() * touch->normal).normalized());
  }

  /// How a flat face is turned against the direction in which it was to be touched.
  static void askew(Diagnosis& known, const Vector3& ahead, const Vector3& normal) {
    const Vector3 turn = (-ahead).cross(normal);
    const double angle = degreesFromRadians(std::atan2(turn.norm(), -ahead.dot(normal)));
    if (angle < 0.05 || angle > 60) return;
    Eigen::Index axis = 2;
    turn.cwiseAbs().maxCoeff(&axis);
    if (std::abs(turn[axis]) > 0.999 * turn.norm()) {
      known.texts.push_back(fmt::format("that face is turned by {} deg about {}",
                                        formatSigned(std::copysign(angle, turn[axis]), 3), "XYZ"[axis]));
    } else {
      known.texts.push_back(
          fmt::format("that face leans by {} deg against the direction in which it is probed", number(angle)));
    }
  }

  /// The motion on from its end, in the same direction.
  Motion beyond() const {
    const Vector3 way = tableFromSpindle(motion_.to) * shape_.tip - tableFromSpindle(motion_.from) * shape_.tip;
    const double factor = farthest / std::max(way.norm(), 1e-9);
    machine::AxisPositions to;
    std::ranges::transform(motion_.to.values, motion_.from.values, to.values.begin(),
                           [&](double end, double start) { return end + factor * (end - start); });
    return {kinematics_, motion_.to, to, motion_.to, motion_.seconds, simulation::MotionProfile(farthest, 1, 1)};
  }

  /// Something touched where nothing should be.
  void met(Diagnosis& known) const {
    const PathTouch* touch = touchThen();
    if (touch == nullptr) return;
    known.found = Ghost{"point", touch->point, touch->normal, 0, {}};
    known.texts.push_back(fmt::format("the {} met {} at {}", touch->part, quoted(touch->solid), place(touch->point)));
    if (touch->part == "body" && isProbe()) bodyTooWide(known);
  }

  const PathTouch* touchThen() const {
    for (auto touch = path_.touches.rbegin(); touch != path_.touches.rend(); ++touch)
      if (std::abs(touch->seconds - motion_.seconds) < 1e-6) return &*touch;
    // A stylus that was deflected before the motion began.
    for (auto touch = path_.touches.rbegin(); touch != path_.touches.rend(); ++touch)
      if (touch->seconds < motion_.seconds) return motion_.measuring ? &*touch : nullptr;
    return nullptr;
  }

  /// True if with such a probe nothing but the ball would touch on the whole way. A measuring move ends where the ball
  /// touches: its target lies behind the surface.
  bool wouldBeFree(const TrueTool& tool) const {
    const ToolShape shape = simulation::shapeOf(&tool, spindleDegrees_);
    if (simulation::shaftOverlap(tableFromSpindle(motion_.from), shape, surroundings_)) return false;
    const Vector3 way = tableFromSpindle(motion_.to) * shape.tip - tableFromSpindle(motion_.from) * shape.tip;
    const Motion whole{kinematics_,  motion_.from,    motion_.to,
                       motion_.from, motion_.seconds, simulation::MotionProfile(std::max(way.norm(), 1e-6), 1, 1)};
    const auto touch = simulation::firstTouch(whole, 0, 1, shape, surroundings_, {.precision = 1e-4});
    return !touch || !touch->shaft;
  }

  /// The smallest change of the probe by which it would be free; nothing if even the largest is not enough.
  template <class Change>
  std::optional<double> leastChange(double largest, const Change& change) const {
    const auto freeWith = [&](double amount) {
      TrueTool tool = *tool_;
      change(tool, amount);
      return wouldBeFree(tool);
    };
    if (freeWith(0) || !freeWith(largest)) return std::nullopt;
    double low = 0, high = largest;
    while (high - low > 0.01) {
      const double middle = (low + high) / 2;
      (freeWith(middle) ? high : low) = middle;
    }
    return high;
  }

  void bodyTooWide(Diagnosis& known) const {
    const simulation::TrueProbe& probe = tool_->probe;
    const auto narrower = leastChange(probe.bodyRadius - probe.stylusRadius,
                                      [](TrueTool& tool, double amount) { tool.probe.bodyRadius -= amount; });
    if (narrower) {
      known.texts.push_back(
          fmt::format("the body of the probe, {} mm in diameter, is {:.1f} mm too wide for this place "
                      "at this depth",
                      number(2 * probe.bodyRadius), 2 * *narrower));
    }
    // The ball stays where it is; the body stands higher by what the stylus is longer.
    const auto longer = leastChange(300, [](TrueTool& tool, double amount) { tool.probe.stylusLength += amount; });
    if (longer)
      known.texts.push_back(fmt::format("a stylus that is {:.1f} mm longer would keep the body clear there", *longer));
  }

  /// Where it is what the cycle looked for.
  void feature(Diagnosis& known) const {
    if (cycle_ == nullptr || family_ == nullptr || !isProbe()) return;
    const Vector3 shank = motion_.programFromTable.linear() * tableFromSpindle(motion_.end).linear() * shape_.shank;
    Eigen::Index axis = 2;
    shank.cwiseAbs().maxCoeff(&axis);
    roundFeature(known, axis);
    walls(known, axis);
    corner(known, axis);
  }

  static control::WorkingPlane planeOf(Eigen::Index axis) { return control::WorkingPlane::ofToolAxis("XYZ"[axis]); }

  void corner(Diagnosis& known, Eigen::Index axis) const {
    const auto called = family_->corner(*cycle_, planeOf(axis).planeFromXyz(startOfCycle()).z());
    if (!called) return;
    const auto expected = std::optional(inWorkpiece(*called, static_cast<int>(axis)));
    const Eigen::Affine3d tableFromProgram = motion_.programFromTable.inverse();
    const auto found = trueCorner(*expected, tableFromProgram, truth_.solids);
    if (!found) return;
    const Vector3 at = tableFromProgram * expected->corner;
    const std::array<Vector3, 2> ends = {tableFromProgram * expected->sides[0].point,
                                         tableFromProgram * expected->sides[1].point};
    const Vector3 along = (tableFromProgram.linear() * Vector3::Unit(axis)).normalized();
    known.expected = Ghost{"outline", at, along, 0, {ends[0], at, ends[1]}};
    known.found = Ghost{"outline",
                        found->corner,
                        along,
                        0,
                        {found->corner + found->along[0] * (ends[0] - at).norm(), found->corner,
                         found->corner + found->along[1] * (ends[1] - at).norm()}};
    known.texts.push_back(fmt::format("the corner is at {}, {} mm from {}", place(found->corner),
                                      number((found->corner - at).norm()), expected->from));
    if (std::abs(found->turned[0]) > 0.05)
      known.texts.push_back(fmt::format("its first side is turned by {} deg", formatSigned(found->turned[0], 3)));
  }

  void walls(Diagnosis& known, Eigen::Index axis) const {
    const auto expected = family_->walls(*cycle_, planeOf(axis), startOfCycle());
    if (!expected) return;
    const Eigen::Affine3d tableFromProgram = motion_.programFromTable.inverse();
    const auto found = trueWalls(*expected, tableFromProgram, truth_.solids);
    if (!found) return;
    const Vector3 expectedCentre = tableFromProgram * expected->centre;
    const Vector3 along = (tableFromProgram.linear() * Vector3::Unit(axis)).normalized();
    std::vector<double> expectedWidths;
    for (const WallPair& pair : expected->pairs)
      expectedWidths.push_back(pair.width);
    known.expected = outlineOf(expectedCentre, along, *expected, expectedWidths);
    known.found = outlineOf(found->centre, along, *expected, found->widths);
    const bool rectangle = found->widths.size() == 2;
    const std::string size = number(found->widths[0]) + (rectangle ? " x " + number(found->widths[1]) : std::string());
    const char* what = rectangle ? (expected->inside ? "pocket" : "stud") : expected->inside ? "slot" : "ridge";
    known.texts.push_back(fmt::format("the {} of {} mm has its centre at {}, {} mm from {}", what, size,
                                      place(found->centre), number((found->centre - expectedCentre).norm()),
                                      expected->from));
  }

  /// The rectangle of these widths; of a slot or ridge a square between its walls.
  Ghost outlineOf(const Vector3& centre, const Vector3& along, const ExpectedWalls& expected,
                  const std::vector<double>& widths) const {
    const Eigen::Affine3d tableFromProgram = motion_.programFromTable.inverse();
    const Vector3 first = (tableFromProgram.linear() * expected.pairs[0].across).normalized() * widths[0] / 2;
    const Vector3 second = along.cross(first).normalized() * widths.back() / 2;
    return {"outline",
            centre,
            along,
            0,
            {centre + first + second, centre - first + second, centre - first - second, centre + first - second,
             centre + first + second}};
  }

  /// A hole or stud.
  void roundFeature(Diagnosis& known, Eigen::Index axis) const {
    const Eigen::Affine3d tableFromProgram = motion_.programFromTable.inverse();
    const auto expected = family_->round(*cycle_, planeOf(axis), startOfCycle());
    if (!expected) return;
    const Vector3 expectedCentre = tableFromProgram * expected->centre;
    const Vector3 along = (tableFromProgram.linear() * Vector3::Unit(axis)).normalized();
    struct Candidate {
      Vector3 centre;
      double diameter = 0, apart = 1e300;
      bool hole = false;
    } best;
    for (const simulation::PlacedSolid& placed : truth_.solids) {
      for (const simulation::RoundFace& face : simulation::roundFaces(*placed.solid)) {
        const double diameter = 2 * face.form.radius;
        const Vector3 direction = placed.tableFromSolid.linear() * face.form.axes.col(2);
        const double slope = direction.dot(along);
        if (std::abs(slope) < 0.9 || std::abs(diameter - expected->diameter) > 0.3 * expected->diameter) continue;
        const Vector3 origin = placed.tableFromSolid * face.form.origin;
        const Vector3 centre = origin + direction * ((expectedCentre - origin).dot(along) / slope);
        const double apart = (centre - expectedCentre).norm();
        if (apart < best.apart) best = {centre, diameter, apart, face.hole};
      }
    }
    if (best.apart > 3 * expected->diameter + 50) return;
    known.expected = Ghost{"circle", expectedCentre, along, expected->diameter, {}};
    known.found = Ghost{"circle", best.centre, along, best.diameter, {}};
    known.texts.push_back(fmt::format("the {} of {} mm has its centre at {}, {} mm from {}",
                                      best.hole ? "hole" : "stud", number(best.diameter), place(best.centre),
                                      number(best.apart), expected->from));
  }

  /// Where the ball was when the cycle began, as the control believes it.
  Vector3 startOfCycle() const {
    const auto after =
        std::ranges::upper_bound(path_.points, cycle_->startSeconds + 1e-6, {}, &simulation::PathPoint::seconds);
    if (after == path_.points.begin()) return Vector3::Zero();
    return inProgram(std::prev(after)->tip);
  }

  const InterruptedMotion& motion_;
  const control::CycleRecord* cycle_;
  const FamilyTruth* family_;
  control::ControlKind control_;
  const simulation::Truth& truth_;
  const simulation::PathRecord& path_;
  simulation::TrueKinematics kinematics_;
  simulation::Surroundings surroundings_;
  double spindleDegrees_ = 0;
  const TrueTool* tool_ = nullptr;
  ToolShape shape_;
};

/// True if the motion is what the alarm of its cycle is about, or what stopped the program.
bool isAlarm(const control::Journal& journal, std::size_t index) {
  const InterruptedMotion& motion = journal.interrupted[index];
  if (!motion.measuring) return true;
  if (!motion.cycle || journal.cycles[*motion.cycle].alarm.empty()) return false;
  const bool isLast = index + 1 == journal.interrupted.size() || journal.interrupted[index + 1].cycle != motion.cycle;
  return isLast;
}

}  // namespace

std::vector<Diagnosis> diagnoses(const session::RunOutcome& outcome, const simulation::VirtualMachine& machine) {
  const control::Journal& journal = outcome.journal;
  std::vector<Diagnosis> all;
  constexpr std::size_t most = 100;
  for (std::size_t i = 0; i < journal.interrupted.size() && all.size() < most; ++i) {
    if (!isAlarm(journal, i)) continue;
    const InterruptedMotion& motion = journal.interrupted[i];
    const control::CycleRecord* cycle = motion.cycle ? &journal.cycles[*motion.cycle] : nullptr;
    Diagnosis known = Case(motion, cycle, outcome.control, machine).diagnose();
    if (!known.texts.empty()) all.push_back(std::move(known));
  }
  return all;
}

}  // namespace probewright::truth
