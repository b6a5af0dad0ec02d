#include "survival/box_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "simulation/contact_search.hpp"
#include "survival/middle_run.hpp"
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
    return middle_.undecided(std::move(why), at);
  }

  bool isLinear(std::size_t axis) const { return machine().axes[axis].kind == AxisKind::Linear; }
  const machine::MachineDescription& machine() const { return middle_.truth.machine; }
  double way(const AxisPositions& a, const AxisPositions& b) const { return middle_.way(a, b); }
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
    return {*middle_.kinematics, from, step.to, from, step.seconds, simulation::MotionProfile(1, 1, 1)};
  }
  ToolShape shapeOf(const Step& step) const {
    return simulation::shapeOf(step.tool < 0 ? nullptr : &middle_.truth.tools[static_cast<std::size_t>(step.tool)],
                               step.spindleDegrees);
  }
  const Displacements::OfTool& ownOf(const Step& step) const {
    static const Displacements::OfTool none;
    return step.tool < 0 ? none : middle_.displacements.ofTools[static_cast<std::size_t>(step.tool)];
  }
  Shift turned(const Step& step, double degrees) const {
    if (step.tool < 0) return {};
    const simulation::TrueProbe& probe = middle_.truth.tools[static_cast<std::size_t>(step.tool)].probe;
    return {0, radiansFromDegrees(degrees) * (probe.tipOffset.norm() + probe.starArm)};
  }
  Vector3 upOf(const Step& step) const {
    return middle_.kinematics->tableFromSpindle(step.from, 0).linear() * shapeOf(step).shank;
  }
  /// How far the tool on this step can be from the solid otherwise than in the middle, its own parts aside.
  Shift shiftOf(const Step& step, const Shift& commanded, double turn, std::size_t solid) const;
  /// Where on the line of the last touch a place lies: 0 where the measuring move began, 1 at its end.
  std::optional<double> placeOnLine(const std::vector<Step>& steps, std::size_t measured,
                                    const AxisPositions& at) const;

  const ClampedProgram& program_;
  const ClampedWorlds& worlds_;
  const Box& box_;
  MiddleRun middle_;
  std::vector<simulation::PlacedSolid> solids_, mostSolids_, leastSolids_;
  std::vector<Surroundings> most_, least_;         ///< a solid each; they refer to those above
  double errors_ = 0;                              ///< mm: of the machine, where they differ from run to run
  std::vector<Spread> spreads_;                    ///< a step each
  std::vector<double> shifts_;                     ///< of touches along their way, mm
  std::map<std::size_t, double> nearness_;         ///< by cycle: the most that a touch shifts, over the size
  std::vector<std::vector<double>> resultSlopes_;  ///< by touch: what each result changes by
  std::optional<std::size_t> inbound_;             ///< the step whose line is being left
};

Shift Proof::apart(const Step& step, const AxisPositions& a, const AxisPositions& b) const {
  if (a == b) return {};
  const Vector3 way = middle_.kinematics->tableFromSpindle(b, 0).translation() -
                      middle_.kinematics->tableFromSpindle(a, 0).translation();
  return shiftAgainst(way, upOf(step));
}

Shift Proof::shiftOf(const Step& step, const Shift& commanded, double turn, std::size_t solid) const {
  const Displacements::OfSolid& own = middle_.displacements.ofSolids[solid];
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
  if (auto verdict = middle_.carryOut(program_, box_))
    return program_.stop().stop_requested() ? BoxVerdict{Verdict::Cancelled, {}} : verdict;
  const simulation::MachineErrors& errors = middle_.truth.errors;
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
  spreads_.assign(middle_.steps.size(), {});
  return std::nullopt;
}

std::optional<BoxVerdict> Proof::passOn(std::size_t touch, std::size_t step, double shift) {
  const Step& at = middle_.steps[step];
  const std::size_t cycle = middle_.cycleOf(touch);
  const CycleSize& around = middle_.sizeAround(cycle);
  const double size = around.size;
  const double bent = shift * shift / around.bending(around.corner ? middle_.leverAfter(step) : 0);
  bool matters = false;
  // Controls go the long way where something is too low and the short one where it is not: to either side by itself.
  std::vector<Spread> most(middle_.steps.size());
  session::RunOutcome outcome;
  for (const double way : {-shift, shift}) {
    std::vector<PlannedTouch> plan = middle_.plan;
    plan[touch].signal += way;
    WatchedRun shifted = program_.replay(middle_.truth, plan);
    if (shifted.end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
    if (shifted.end.failure)
      return undecided(fmt::format("with this touch {:.3f} mm off: {}", shift, shifted.end.failure->why), &at);
    const auto course = aligned(middle_.course(), shifted.steps, machine());
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
      const Pose pose = middle_.kinematics->tableFromSpindle(from, step.seconds);
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
  const simulation::BodyClearance::Margins margins{moved, moved + middle_.farthest};
  if (auto near = program_.bodies()->nearer(motionOf(from, step), margins, thick))
    return undecided(near->text(), &step);
  return std::nullopt;
}

std::optional<BoxVerdict> Proof::standsClear(const Step& step, const Spread& spread) const {
  const ToolShape shape = shapeOf(step);
  const Pose pose = middle_.kinematics->tableFromSpindle(step.end, step.seconds);
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
  const double shift = std::max(high - middle_.plan[touch].signal, middle_.plan[touch].signal - low);
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
      std::vector<PlannedTouch> plan = middle_.plan;
      for (std::size_t i = 0; i < plan.size(); ++i)
        plan[i].signal += (further[i] ? curvature : -curvature) * shifts_[i];
      const WatchedRun corner = program_.replay(middle_.truth, plan);
      if (corner.end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
      if (corner.end.failure)
        return BoxVerdict{Verdict::Undecided, Reason{corner.end.failure->why, corner.end.failure->place}};
      const auto course = aligned(middle_.course(), corner.steps, machine());
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
