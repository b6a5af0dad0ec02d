#include "survival/box_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "simulation/contact_search.hpp"
#include "survival/course.hpp"
#include "survival/curvature.hpp"
#include "survival/shift.hpp"

namespace probewright::survival {

using machine::AxisKind;
using machine::AxisPositions;
using simulation::Motion;
using simulation::Surroundings;
using simulation::ToolShape;

namespace {

constexpr double deviations =
    8;  // of the scatter that is taken for the most: 1.2e-15 of a normal distribution lie beyond
constexpr double onLine = 1e-6;     // mm: positions of one line, which differ by rounding
constexpr double leastBall = 0.05;  // mm: a ball that is left with less says nothing of where the touch is
constexpr double ofReadings =
    1.05;  // positions over readings: scales are at most 10 mm per m, polynomials add their part

ToolShape bodiesOf(ToolShape shape) {
  shape.balls.clear();
  std::erase_if(shape.shafts,
                [](const simulation::Shaft& shaft) { return std::string_view(shaft.part) == simulation::shaftName; });
  return shape;
}

/// What is known of a step over the whole box.
struct Spread {
  Shift from, to;   ///< how far its ends can lie from those in the middle
  double way = 0;   ///< mm: how much longer or shorter it can be
  double turn = 0;  ///< degrees, of the spindle
};

class Proof {
public:
  Proof(const ClampedProgram& program, const Box& box) : program_(program), worlds_(program.worlds()), box_(box) {}

  BoxVerdict run();

private:
  BoxVerdict undecided(std::string why, const Step* at = nullptr) const {
    if (program_.stop().stop_requested()) return {Verdict::Cancelled, {}};
    return {Verdict::Undecided,
            Reason{std::move(why), at ? placeAt(middle_.outcome.trace, at->seconds) : SourcePlace{}}};
  }

  bool isLinear(std::size_t axis) const { return machine().axes[axis].kind == AxisKind::Linear; }
  const machine::MachineDescription& machine() const { return middle_.truth.machine; }
  double way(const AxisPositions& a, const AxisPositions& b) const { return wayOf(machine(), a, b); }
  /// How far the tool of the step is at `b` from where it is at `a`.
  Shift apart(const Step& step, const AxisPositions& a, const AxisPositions& b) const;

  std::optional<BoxVerdict> prepare();
  std::optional<BoxVerdict> passOn(std::size_t touch, std::size_t step, double shift);
  std::optional<BoxVerdict> look(std::size_t step);
  std::optional<BoxVerdict> lookAtTouch(std::size_t step);
  std::optional<BoxVerdict> lookAtCorners();
  std::optional<BoxVerdict> withinTravel(const Step& step, const Spread& spread) const;
  std::optional<BoxVerdict> isClear(const Step& step, const AxisPositions& from, const Shift& shift) const;
  /// The same of the machine's bodies.
  std::optional<BoxVerdict> bodiesClear(const Step& step, const AxisPositions& from, const Shift& shift) const;
  std::optional<BoxVerdict> standsClear(const Step& step, const Spread& spread) const;
  Motion motionOf(const AxisPositions& from, const Step& step) const {
    return {*kinematics_, from, step.to, from, step.seconds, simulation::MotionProfile(1, 1, 1)};
  }
  ToolShape shapeOf(const Step& step) const {
    return simulation::shapeOf(step.tool < 0 ? nullptr : &middle_.truth.tools[static_cast<std::size_t>(step.tool)],
                               step.spindleDegrees);
  }
  const Displacements::OfTool& ownOf(const Step& step) const {
    static const Displacements::OfTool none;
    return step.tool < 0 ? none : displacements_.ofTools[static_cast<std::size_t>(step.tool)];
  }
  Shift turned(const Step& step, double degrees) const {
    if (step.tool < 0) return {};
    const simulation::TrueProbe& probe = middle_.truth.tools[static_cast<std::size_t>(step.tool)].probe;
    return {0, radiansFromDegrees(degrees) * (probe.tipOffset.norm() + probe.starArm)};
  }
  Vector3 upOf(const Step& step) const {
    return kinematics_->tableFromSpindle(step.from, 0).linear() * shapeOf(step).shank;
  }
  /// How far the tool on this step can be from the solid otherwise than in the middle, its own parts aside.
  Shift shiftOf(const Step& step, const Shift& commanded, double turn, std::size_t solid) const;
  std::size_t cycleOf(std::size_t touch) const;
  /// The size of what the touches of a cycle are on: see curvature.hpp.
  double sizeAround(std::size_t cycle) const;
  /// Where on the line of the last touch a place lies: 0 where the measuring move began, 1 at its end.
  std::optional<double> placeOnLine(const std::vector<Step>& steps, std::size_t measured,
                                    const AxisPositions& at) const;

  const ClampedProgram& program_;
  const ClampedWorlds& worlds_;
  const Box& box_;
  WatchedRun middle_;
  std::optional<simulation::TrueKinematics> kinematics_;
  std::vector<simulation::PlacedSolid> solids_, mostSolids_, leastSolids_;
  std::vector<Surroundings> most_, least_;  ///< a solid each; they refer to those above
  Displacements displacements_;
  double errors_ = 0;            ///< mm: of the machine, where they differ from run to run
  double apart_ = 0;             ///< mm: of solids from where they are in the middle of the box
  double farthest_ = 0;          ///< mm: of solids from where they are in the middle of all tolerances
  std::vector<bool> optional_;   ///< of the steps: see Course
  std::vector<Spread> spreads_;  ///< a step each
  std::vector<PlannedTouch> plan_;
  std::vector<std::size_t> touches_;               ///< steps
  std::vector<double> shifts_;                     ///< of touches along their way, mm
  std::map<std::size_t, double> nearness_;         ///< by cycle: the most that a touch shifts, over the size
  std::vector<std::vector<double>> resultSlopes_;  ///< by touch: what each result changes by
  std::optional<std::size_t> inbound_;             ///< the step whose line is being left
};

Shift Proof::apart(const Step& step, const AxisPositions& a, const AxisPositions& b) const {
  if (a == b) return {};
  const Vector3 way =
      kinematics_->tableFromSpindle(b, 0).translation() - kinematics_->tableFromSpindle(a, 0).translation();
  return shiftAgainst(way, upOf(step));
}

Shift Proof::shiftOf(const Step& step, const Shift& commanded, double turn, std::size_t solid) const {
  const Displacements::OfSolid& own = displacements_.ofSolids[solid];
  Shift shift = commanded + turned(step, turn) + everyWay(errors_ + own.turn);
  const Vector3 up = upOf(step);
  Shift most;
  for (int corner = 0; corner < 4; ++corner) {
    const Vector3 way(own.shift.x(), (corner & 1) != 0 ? -own.shift.y() : own.shift.y(),
                      (corner & 2) != 0 ? -own.shift.z() : own.shift.z());
    most = larger(most, shiftAgainst(way, up));
  }
  return shift += most;
}

std::optional<BoxVerdict> Proof::prepare() {
  middle_ = program_.watch(box_.middle());
  if (middle_.end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
  if (!middle_.end.failure) {
    if (auto other = otherThanMeant(program_.meant(), middle_.path, middle_.truth, worlds_.sizeVaries()))
      middle_.end.failure = Reason{*std::move(other), {}};
  }
  if (middle_.end.failure) return BoxVerdict{Verdict::Fails, middle_.end.failure};
  if (program_.obstacle()) return BoxVerdict{Verdict::Undecided, program_.obstacle()};

  displacements_ = worlds_.displacements(box_, middle_.truth);
  farthest_ = worlds_.farthestFromMiddle(box_);
  for (const Displacements::OfSolid& solid : displacements_.ofSolids)
    apart_ = std::max(apart_, solid.shift.norm() + solid.turn);
  const simulation::MachineErrors& errors = middle_.truth.errors;
  kinematics_.emplace(machine(), errors);
  for (std::size_t i = 0; i < errors.axes.size() && i < machine().axes.size(); ++i) {
    const simulation::AxisErrors& axis = errors.axes[i];
    errors_ += axis.backlash;
    const double end = std::max(std::abs(machine().axes[i].minimum), std::abs(machine().axes[i].maximum)) / 1000;
    for (const simulation::Deviation& deviation : axis.deviations) {
      double most = std::abs(deviation.amplitude), power = 1;
      for (const double coefficient : deviation.polynomial) {
        most += std::abs(coefficient) * power;
        power *= end;
      }
      errors_ += 2 * most;
    }
  }
  for (const simulation::ThermalDrift& drift : errors.thermal)
    errors_ += drift.amount.norm();
  solids_ = middle_.truth.solids;
  const auto each = [](const std::vector<simulation::PlacedSolid>& solids) {
    std::vector<Surroundings> single;
    for (const simulation::PlacedSolid& solid : solids)
      single.emplace_back(std::vector<simulation::PlacedSolid>{solid});
    return single;
  };
  if (worlds_.anySizeVaries()) {
    const auto most = worlds_.truthWithMost(box_), least = worlds_.truthWithLeast(box_);
    if (!most || !least) return undecided((most ? least : most).error().message);
    mostSolids_ = most->solids;
    leastSolids_ = least->solids;
  } else {
    mostSolids_ = leastSolids_ = solids_;
  }
  most_ = each(mostSolids_);
  least_ = each(leastSolids_);
  for (const Step& step : middle_.steps) {
    if (step.kind != StepKind::Measure) continue;
    if (step.sensor != machine::Sensor::TouchProbe) return undecided("a tool touch probe measures", &step);
    if (!step.touched) return undecided("a measuring move ends without a touch", &step);
    if (step.part != machine::TouchWith::Ball) return undecided("the shaft of the stylus measures", &step);
    const double signal = way(step.from, step.latched), end = way(step.from, step.end);
    plan_.push_back({signal, end - signal});
  }
  Course course{middle_.steps, std::vector<bool>(middle_.steps.size())};
  const WatchedRun again = program_.replay(middle_.truth, plan_);
  if (again.end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
  const auto same = aligned(course, again.steps, machine());
  if (again.end.failure || !same) return undecided("the run cannot be replayed");
  for (std::size_t i = 0; i < same->size(); ++i)
    if (way((*same)[i].to, middle_.steps[i].to) > 1e-6) return undecided("the run cannot be replayed");
  std::vector<PlannedTouch> little = plan_;
  for (std::size_t i = 0; i < little.size(); ++i)
    little[i].signal -= 0.01 + 0.01 / static_cast<double>(i + 1);
  const WatchedRun otherwise = program_.replay(middle_.truth, little);
  if (otherwise.end.failure || !addStillMoves(course, otherwise.steps, machine()))
    return undecided("what is measured may change the course of the program, or turn a rotary axis");
  // A control that goes up first where the next position is higher leaves this move out where it is lower, and a box
  // may hold both. Whether the course is whole, every touch is asked later (passOn); here it is enough to try.
  for (const double way : {-1.0, 1.0}) {
    std::vector<PlannedTouch> far = plan_;
    for (PlannedTouch& touch : far)
      touch.signal += way * apart_;
    const WatchedRun there = program_.replay(middle_.truth, far);
    if (there.end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
    if (!there.end.failure) static_cast<void>(addStillMoves(course, there.steps, machine()));
  }
  middle_.steps = course.steps;
  optional_ = course.optional;
  for (std::size_t i = 0; i < middle_.steps.size(); ++i) {
    const Step& step = middle_.steps[i];
    if (step.kind != StepKind::Measure) continue;
    if (!touches_.empty()) {
      const Step& before = middle_.steps[touches_.back()];
      if (way(before.from, step.from) < onLine && way(before.to, step.to) < onLine)
        return undecided("the same place is measured repeatedly", &step);
    }
    touches_.push_back(i);
  }
  spreads_.assign(middle_.steps.size(), {});
  // Where the axes come to stand beyond a touch must not matter.
  std::vector<PlannedTouch> shorter = plan_;
  for (std::size_t i = 0; i < shorter.size(); ++i)
    shorter[i].overtravel *= 0.3 + 0.4 / static_cast<double>(i + 1);
  const WatchedRun braked = program_.replay(middle_.truth, shorter);
  const auto sooner = aligned(course, braked.steps, machine());
  if (braked.end.failure || !sooner) return undecided("the way of braking decides");
  for (std::size_t i = 0; i < middle_.steps.size(); ++i)
    if (way((*sooner)[i].to, middle_.steps[i].to) > 1e-6)
      return undecided("a move depends on where the axes stop after a touch", &middle_.steps[i]);
  return std::nullopt;
}

/// The cycle that a touch belongs to, by its place in the journal; one past the last for touches of no cycle.
std::size_t Proof::cycleOf(std::size_t touch) const {
  const auto& cycles = middle_.outcome.journal.cycles;
  const double seconds = middle_.steps[touches_[touch]].seconds;
  std::size_t place = 0;
  while (place < cycles.size() &&
         (seconds < cycles[place].startSeconds - 1e-9 || seconds > cycles[place].endSeconds + 1e-9))
    ++place;
  return place;
}

double Proof::sizeAround(std::size_t cycle) const {
  std::vector<Vector3> places, ways;
  for (std::size_t a = 0; a < touches_.size(); ++a) {
    if (cycleOf(a) != cycle) continue;
    const Step& step = middle_.steps[touches_[a]];
    places.push_back(kinematics_->tableFromSpindle(step.latched, 0).translation());
    ways.push_back((places.back() - kinematics_->tableFromSpindle(step.from, 0).translation()).normalized());
  }
  const auto& cycles = middle_.outcome.journal.cycles;
  const std::string name = cycle < cycles.size() ? cycles[cycle].name : "";
  // Of several bores each is one thing, and what follows from their middles another.
  const std::size_t bores = name == "416" || name == "430"   ? 3
                            : name == "418"                  ? 4
                            : name == "401" || name == "402" ? 2
                                                             : 0;
  if (bores == 0 || places.size() % bores != 0) return sizeOf(places, ways);
  const std::size_t each = places.size() / bores;
  double size = 1e9;
  std::vector<Vector3> middles;
  for (std::size_t bore = 0; bore < bores; ++bore) {
    const auto begin = static_cast<std::ptrdiff_t>(bore * each), end = static_cast<std::ptrdiff_t>((bore + 1) * each);
    const std::vector<Vector3> own(places.begin() + begin, places.begin() + end);
    size = std::min(size, sizeOf(own, {ways.begin() + begin, ways.begin() + end}));
    Vector3 middle = Vector3::Zero();
    for (const Vector3& place : own)
      middle += place / static_cast<double>(each);
    middles.push_back(middle);
  }
  if (bores == 2) return std::min(size, sizeOf(middles, {Vector3::UnitY(), Vector3::UnitY()}));
  return std::min(size, bores == 3 ? sizeOfArc(middles) : sizeOfCrossing(middles));
}

std::optional<BoxVerdict> Proof::passOn(std::size_t touch, std::size_t step, double shift) {
  const Step& at = middle_.steps[step];
  const std::size_t cycle = cycleOf(touch);
  const double size = sizeAround(cycle);
  const double bent = shift * shift / size;
  bool matters = false;
  // Controls go the long way where something is too low and the short one where it is not: to either side by itself.
  std::vector<Spread> most(middle_.steps.size());
  session::RunOutcome outcome;
  for (const double way : {-shift, shift}) {
    std::vector<PlannedTouch> plan = plan_;
    plan[touch].signal += way;
    WatchedRun shifted = program_.replay(middle_.truth, plan);
    if (shifted.end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
    if (shifted.end.failure)
      return undecided(fmt::format("with this touch {:.3f} mm off: {}", shift, shifted.end.failure->why), &at);
    const auto course = aligned({middle_.steps, optional_}, shifted.steps, machine());
    if (!course)
      return undecided("what is measured here may change the course of the program, or turn a rotary axis", &at);
    for (std::size_t k = step + 1; k < middle_.steps.size(); ++k) {
      const Step &plain = middle_.steps[k], &moved = (*course)[k];
      // The step that leaves the touch begins where that one ended, whatever follows from it.
      if (k != step + 1) most[k].from = larger(most[k].from, apart(plain, plain.from, moved.from));
      most[k].to = larger(most[k].to, apart(plain, plain.to, moved.to));
      most[k].way = std::max(most[k].way, std::abs(this->way(moved.from, moved.to) - this->way(plain.from, plain.to)));
      most[k].turn = std::max(most[k].turn, std::abs(std::remainder(moved.spindleDegrees - plain.spindleDegrees, 360)));
    }
    outcome = std::move(shifted.outcome);
  }
  for (std::size_t k = step + 1; k < middle_.steps.size(); ++k) {
    const Spread& other = most[k];
    Spread& spread = spreads_[k];
    if (other.from.moves()) spread.from += curvature * other.from + everyWay(bent);
    if (other.to.moves()) spread.to += curvature * other.to + everyWay(bent);
    if (other.from.moves() || other.to.moves()) {
      matters = true;
      spread.way += curvature * other.way + bent;
    }
    if (other.turn > 1e-9) spread.turn += curvature * other.turn + degreesFromRadians(bent / size);
  }
  // Shares of what follows from several cycles multiply.
  if (matters) nearness_[cycle] = std::max(nearness_[cycle], shift / size);
  double sum = 0;
  for (const auto& [of, nearness] : nearness_)
    sum += nearness;
  if (matters && sum > nearEnough)
    return undecided(
        fmt::format("what follows depends on this touch, which may lie {:.3f} mm further or less far", shift), &at);
  std::vector<double> slopes;
  const auto &before = middle_.outcome.journal.cycles, &after = outcome.journal.cycles;
  for (std::size_t c = 0; c < before.size() && c < after.size(); ++c)
    for (std::size_t r = 0; r < before[c].results.size() && r < after[c].results.size(); ++r)
      slopes.push_back(after[c].results[r].value - before[c].results[r].value);
  resultSlopes_.push_back(std::move(slopes));
  return std::nullopt;
}

std::optional<BoxVerdict> Proof::withinTravel(const Step& step, const Spread& spread) const {
  const double room = ofReadings * spread.to.any();
  for (std::size_t i = 0; i < machine().axes.size(); ++i) {
    const machine::Axis& axis = machine().axes[i];
    if (!isLinear(i)) continue;
    if (step.to[i] - room < axis.minimum || step.to[i] + room > axis.maximum)
      return undecided(fmt::format("axis {} may come to the end of its travel", axis.name), &step);
  }
  return std::nullopt;
}

std::optional<BoxVerdict> Proof::isClear(const Step& step, const AxisPositions& from, const Shift& shift) const {
  const ToolShape shape = shapeOf(step);
  if (shape.balls.empty() && shape.shafts.empty()) return std::nullopt;
  const Motion motion = motionOf(from, step);
  const Spread& spread = spreads_[static_cast<std::size_t>(&step - middle_.steps.data())];
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const ToolShape thick = grown(shape, shiftOf(step, shift, spread.turn, s), ownOf(step));
    std::optional<simulation::Touch> touch;
    if (from == step.to) {
      const Pose pose = kinematics_->tableFromSpindle(from, step.seconds);
      touch = ballOverlap(pose, thick, most_[s]);
      if (!touch) touch = shaftOverlap(pose, thick, most_[s]);
    } else {
      touch = simulation::firstTouch(motion, 0, 1, thick, most_[s], {.precision = 1e-3});
    }
    if (touch)
      return undecided(fmt::format("{} may touch \"{}\"", touch->shaft ? shape.shafts[*touch->shaft].part : "the ball",
                                   solids_[s].name),
                       &step);
  }
  return std::nullopt;
}

std::optional<BoxVerdict> Proof::bodiesClear(const Step& step, const AxisPositions& from, const Shift& shift) const {
  if (program_.bodies() == nullptr) return std::nullopt;
  const Spread& spread = spreads_[static_cast<std::size_t>(&step - middle_.steps.data())];
  const Shift tool = shift + everyWay(errors_);
  const double moved = tool.any();
  const ToolShape thick = grown(shapeOf(step), tool + turned(step, spread.turn), ownOf(step));
  const simulation::BodyClearance::Margins margins{moved, moved + farthest_};
  if (auto near = program_.bodies()->nearer(motionOf(from, step), margins, thick))
    return undecided(near->text(), &step);
  return std::nullopt;
}

std::optional<BoxVerdict> Proof::standsClear(const Step& step, const Spread& spread) const {
  const ToolShape shape = shapeOf(step);
  const Pose pose = kinematics_->tableFromSpindle(step.end, step.seconds);
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const Shift shift = shiftOf(step, larger(spread.from, spread.to), spread.turn, s);
    const ToolShape thick = grown(shape, shift, ownOf(step));
    if (ballOverlap(pose, thick, most_[s]) || shaftOverlap(pose, thick, most_[s]))
      return undecided(fmt::format("the tool may touch \"{}\" where it stands", solids_[s].name), &step);
  }
  return bodiesClear(step, step.end, larger(spread.from, spread.to));
}

std::optional<double> Proof::placeOnLine(const std::vector<Step>& steps, std::size_t measured,
                                         const AxisPositions& at) const {
  const Step& touch = steps[measured];
  const double length = way(touch.from, touch.end);
  if (length < onLine || rotaryDiffers(machine(), touch.from, at)) return std::nullopt;
  double along = 0, beside = 0;
  for (std::size_t i = 0; i < machine().axes.size(); ++i)
    if (isLinear(i)) along += (at[i] - touch.from[i]) * (touch.end[i] - touch.from[i]) / length;
  for (std::size_t i = 0; i < machine().axes.size(); ++i) {
    if (!isLinear(i)) continue;
    const double off = at[i] - touch.from[i] - along * (touch.end[i] - touch.from[i]) / length;
    beside += off * off;
  }
  if (std::sqrt(beside) > onLine || along > length + onLine) return std::nullopt;
  return along;
}

std::optional<BoxVerdict> Proof::look(std::size_t index) {
  const Step& step = middle_.steps[index];
  const Spread& spread = spreads_[index];
  if (step.kind == StepKind::Turn || step.kind == StepKind::ToolChange) {
    if (inbound_ && placeOnLine(middle_.steps, *inbound_, step.from).value_or(1) > onLine)
      return undecided("something turns or changes while the ball is at the surface", &step);
    inbound_.reset();
    return standsClear(step, spread);
  }
  if (auto end = withinTravel(step, spread)) return end;
  AxisPositions from = step.from;
  Shift shift = larger(spread.from, spread.to);
  if (inbound_) {
    // Back along the line that the ball has come in on, in the same world: it was free there.
    const auto begins = placeOnLine(middle_.steps, *inbound_, step.from);
    const auto ends = placeOnLine(middle_.steps, *inbound_, step.to);
    if (begins && *begins < onLine) {
      inbound_.reset();
    } else if (begins && step.kind == StepKind::Measure) {
      return lookAtTouch(index);
    } else if (!ends) {
      return undecided("the ball leaves the surface on another way than it came on", &step);
    } else {
      if (*ends > -onLine) {
        if (*ends < onLine) inbound_.reset();
        return std::nullopt;
      }
      shift = larger(shift, spreads_[*inbound_].from);
      from = middle_.steps[*inbound_].from;
      inbound_.reset();
    }
  }
  if (step.kind == StepKind::Measure) return lookAtTouch(index);
  if (auto hit = isClear(step, from, shift)) return hit;
  return bodiesClear(step, from, shift);
}

std::optional<BoxVerdict> Proof::lookAtTouch(std::size_t index) {
  const Step& step = middle_.steps[index];
  const Spread& spread = spreads_[index];
  const double length = way(step.from, step.to);
  const ToolShape shape = shapeOf(step);
  const simulation::TrueTool& tool = middle_.truth.tools[static_cast<std::size_t>(step.tool)];
  const Motion motion = motionOf(step.from, step);
  const Shift commanded = larger(spread.from, spread.to);
  const std::size_t touch = shifts_.size();
  const TouchedFace* meant = touch < program_.meant().size() ? &program_.meant()[touch] : nullptr;
  if (meant == nullptr) return undecided("a touch that the setup as it is written does not have", &step);
  // The touch comes between that of a larger ball and that of a smaller one, wherever they are along the tool.
  const simulation::SearchOptions exact{.precision = 1e-6};
  double earliest = 1;
  std::vector<std::optional<double>> firstOf(solids_.size());
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const Shift by = shiftOf(step, commanded, spread.turn, s);
    const auto first = firstTouch(motion, 0, 1, everywhere(shape, by, ownOf(step)), most_[s], exact);
    if (!first) continue;
    firstOf[s] = first->fraction;
    earliest = std::min(earliest, first->fraction);
  }
  const Shift by = shiftOf(step, commanded, spread.turn, meant->solid);
  double latest = 0;
  for (const ToolShape& thin : anywhere(shape, by, ownOf(step))) {
    for (const simulation::Ball& ball : thin.balls)
      if (ball.radius < leastBall) return undecided("things can shift by as much as the ball's radius", &step);
    const auto last = firstTouch(motion, 0, 1, thin, least_[meant->solid], exact);
    if (!last) return undecided(fmt::format("the ball may not reach \"{}\"", solids_[meant->solid].name), &step);
    latest = std::max(latest, last->fraction);
  }
  if (earliest <= 0) return undecided("the ball may touch where the measuring move begins", &step);
  for (std::size_t s = 0; s < solids_.size(); ++s)
    if (s != meant->solid && firstOf[s] && *firstOf[s] <= latest)
      return undecided(fmt::format("the ball may touch \"{}\" first", solids_[s].name), &step);
  if (meant->face && !worlds_.sizeVaries()[meant->solid]) {
    const simulation::PlacedSolid& solid = solids_[meant->solid];
    if (const auto others = program_.otherFaces().of(*solid.solid, *meant->face)) {
      const Surroundings around({{others, solid.tableFromSolid, solid.name, solid.role}});
      if (firstTouch(motion, 0, latest, everywhere(shape, by, ownOf(step)), around, exact))
        return undecided(fmt::format("the ball may touch another face of \"{}\"", solid.name), &step);
    }
  }
  // From contact to signal and to where the axes stand.
  const simulation::TrueProbe& probe = tool.probe;
  const double scatter =
      deviations * worlds_.asWritten().world.truth.tools[static_cast<std::size_t>(step.tool)].probe.repeatability;
  const double soonest = std::min({0.0, probe.pretravel - std::abs(probe.lobing), probe.axialPretravel}) - scatter;
  const double speed = step.feed.perMinute / 60;
  const double longest = std::max({0.0, probe.pretravel + std::abs(probe.lobing), probe.axialPretravel}) + scatter +
                         speed * probe.signalDelay;
  const double low = earliest * (length - spread.way) + soonest, high = latest * (length + spread.way) + longest;
  if (!(high < length - spread.way))
    return undecided(fmt::format("the touch may come {:.3f} mm too late", high - length + spread.way), &step);
  const double furthest = std::min(1.0, latest + (longest + probe.ballRadius) / length);
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const Shift more = shiftOf(step, commanded, spread.turn, s);
    const ToolShape thick = grown(shape, more, ownOf(step));
    simulation::SearchOptions shafts{.precision = 1e-3};
    shafts.ignoreBall = true;
    auto hit = firstTouch(motion, 0, latest, thick, most_[s], shafts);
    const ToolShape bodies = bodiesOf(thick);
    if (!hit && !bodies.shafts.empty()) hit = firstTouch(motion, 0, furthest, bodies, most_[s], shafts);
    if (hit)
      return undecided(fmt::format("the stylus or the body of the probe may touch \"{}\"", solids_[s].name), &step);
  }
  if (auto hit = bodiesClear(step, step.from, commanded)) return hit;
  const double shift = std::max(high - plan_[touch].signal, plan_[touch].signal - low);
  shifts_.push_back(shift);
  inbound_ = index;
  return passOn(touch, index, shift);
}

/// Alarms that come when a result leaves a limit: each result is brought to its least and greatest value.
std::optional<BoxVerdict> Proof::lookAtCorners() {
  std::set<std::vector<bool>> seen;
  const std::size_t results = resultSlopes_.empty() ? 0 : resultSlopes_.front().size();
  for (std::size_t r = 0; r < results; ++r) {
    for (const bool greatest : {false, true}) {
      std::vector<bool> further;
      bool any = false;
      for (const auto& slopes : resultSlopes_) {
        const double slope = r < slopes.size() ? slopes[r] : 0;
        any = any || slope != 0;
        further.push_back((slope > 0) == greatest);
      }
      if (!any || !seen.insert(further).second) continue;
      std::vector<PlannedTouch> plan = plan_;
      for (std::size_t i = 0; i < plan.size(); ++i)
        plan[i].signal += (further[i] ? curvature : -curvature) * shifts_[i];
      const WatchedRun corner = program_.replay(middle_.truth, plan);
      if (corner.end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
      if (corner.end.failure)
        return BoxVerdict{Verdict::Undecided, Reason{corner.end.failure->why, corner.end.failure->place}};
      const auto course = aligned({middle_.steps, optional_}, corner.steps, machine());
      if (!course) return undecided("what is measured may change the course of the program");
      for (std::size_t k = 0; k < course->size(); ++k)
        if (apart(middle_.steps[k], middle_.steps[k].to, (*course)[k].to).any() >
            curvature * spreads_[k].to.any() + 1e-6)
          return undecided("a move follows what is measured otherwise than expected", &middle_.steps[k]);
    }
  }
  return std::nullopt;
}

BoxVerdict Proof::run() {
  if (auto end = prepare()) return *end;
  for (std::size_t i = 0; i < middle_.steps.size(); ++i) {
    if (program_.stop().stop_requested()) return {Verdict::Cancelled, {}};
    if (auto end = look(i)) return *end;
  }
  if (auto end = lookAtCorners()) return *end;
  return {Verdict::Proven, {}};
}

}  // namespace

BoxVerdict proveBox(const ClampedProgram& program, const Box& box) { return Proof(program, box).run(); }

}  // namespace probewright::survival
