#include "survival/middle_run.hpp"

#include <algorithm>
#include <utility>

namespace probewright::survival {

namespace {

constexpr double onLine = 1e-6;  // mm: positions of one line, which differ by rounding

}  // namespace

BoxVerdict MiddleRun::undecided(std::string why, const Step* at) const {
  return {Verdict::Undecided, Reason{std::move(why), at ? placeAt(outcome.trace, at->seconds) : SourcePlace{}}};
}

std::optional<BoxVerdict> MiddleRun::carryOut(const ClampedProgram& program, const Box& box) {
  static_cast<WatchedRun&>(*this) = program.watch(box.middle());
  if (end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
  if (!end.failure) {
    if (auto other = otherThanMeant(program.meant(), path, truth, program.worlds().sizeVaries()))
      end.failure = Reason{*std::move(other), {}};
  }
  if (end.failure) return BoxVerdict{Verdict::Fails, end.failure};
  if (program.obstacle()) return BoxVerdict{Verdict::Undecided, program.obstacle()};

  displacements = program.worlds().displacements(box, truth);
  farthest = program.worlds().farthestFromMiddle(box);
  kinematics.emplace(machine(), truth.errors);
  for (const Step& step : steps) {
    if (step.kind != StepKind::Measure) continue;
    if (step.sensor != machine::Sensor::TouchProbe) return undecided("a tool touch probe measures", &step);
    if (!step.touched) return undecided("a measuring move ends without a touch", &step);
    if (step.part != machine::TouchWith::Ball) return undecided("the shaft of the stylus measures", &step);
    const double signal = way(step.from, step.latched);
    plan.push_back({signal, way(step.from, step.end) - signal});
  }
  if (auto verdict = replays(program)) return verdict;
  return findTouches();
}

/// The control must order the same whatever is measured, and wherever the axes stand beyond a touch.
std::optional<BoxVerdict> MiddleRun::replays(const ClampedProgram& program) {
  double apart = 0;  // of solids from where they are in the middle
  for (const Displacements::OfSolid& solid : displacements.ofSolids)
    apart = std::max(apart, solid.shift.norm() + solid.turn);
  Course course{steps, std::vector<bool>(steps.size())};
  const WatchedRun again = program.replay(truth, plan);
  if (again.end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
  const auto same = aligned(course, again.steps, machine());
  if (again.end.failure || !same) return undecided("the run cannot be replayed");
  for (std::size_t i = 0; i < same->size(); ++i)
    if (way((*same)[i].to, steps[i].to) > 1e-6) return undecided("the run cannot be replayed");
  std::vector<PlannedTouch> little = plan;
  for (std::size_t i = 0; i < little.size(); ++i)
    little[i].signal -= 0.01 + 0.01 / static_cast<double>(i + 1);
  const WatchedRun otherwise = program.replay(truth, little);
  if (otherwise.end.failure || !addStillMoves(course, otherwise.steps, machine()))
    return undecided("what is measured may change the course of the program, or turn a rotary axis");
  // A control that goes up first where the next position is higher leaves this move out where it is lower, and a box
  // may hold both. Whether the course is whole, every touch is asked later (passOn); here it is enough to try.
  for (const double sign : {-1.0, 1.0}) {
    std::vector<PlannedTouch> far = plan;
    for (PlannedTouch& touch : far)
      touch.signal += sign * apart;
    const WatchedRun there = program.replay(truth, far);
    if (there.end.cancelled) return BoxVerdict{Verdict::Cancelled, {}};
    if (!there.end.failure) static_cast<void>(addStillMoves(course, there.steps, machine()));
  }
  steps = course.steps;
  optional = course.optional;
  // Where the axes come to stand beyond a touch must not matter.
  std::vector<PlannedTouch> shorter = plan;
  for (std::size_t i = 0; i < shorter.size(); ++i)
    shorter[i].overtravel *= 0.3 + 0.4 / static_cast<double>(i + 1);
  const WatchedRun braked = program.replay(truth, shorter);
  const auto sooner = aligned(course, braked.steps, machine());
  if (braked.end.failure || !sooner) return undecided("the way of braking decides");
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (way((*sooner)[i].to, steps[i].to) > 1e-6)
      return undecided("a move depends on where the axes stop after a touch", &steps[i]);
  return std::nullopt;
}

std::optional<BoxVerdict> MiddleRun::findTouches() {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& step = steps[i];
    if (step.kind != StepKind::Measure) continue;
    if (!touches.empty()) {
      const Step& before = steps[touches.back()];
      if (way(before.from, step.from) < onLine && way(before.to, step.to) < onLine)
        return undecided("the same place is measured repeatedly", &step);
    }
    touches.push_back(i);
  }
  return std::nullopt;
}

std::size_t MiddleRun::cycleOf(std::size_t touch) const {
  const auto& cycles = outcome.journal.cycles;
  const double seconds = steps[touches[touch]].seconds;
  std::size_t place = 0;
  while (place < cycles.size() &&
         (seconds < cycles[place].startSeconds - 1e-9 || seconds > cycles[place].endSeconds + 1e-9))
    ++place;
  return place;
}

std::vector<std::vector<std::size_t>> MiddleRun::circlesOf(std::size_t cycle,
                                                           const std::vector<std::size_t>& own) const {
  std::vector<std::vector<std::size_t>> circles;
  if (cycle >= outcome.journal.cycles.size()) return circles;
  const control::CycleRecord& record = outcome.journal.cycles[cycle];
  for (const control::FitRecord& fit : record.fits) {
    if (fit.shape != "circle") continue;
    std::vector<std::size_t> circle;
    for (const std::size_t touch : fit.touches)
      if (touch < own.size()) circle.push_back(touch);
    // Each measuring move has its touch in the record; where that is otherwise, the circle goes through all of them.
    if (record.touches.size() != own.size() || circle.size() != fit.touches.size()) {
      circle.resize(own.size());
      std::ranges::generate(circle, [next = std::size_t{0}]() mutable { return next++; });
    }
    circles.push_back(std::move(circle));
  }
  return circles;
}

CycleSize MiddleRun::sizeOfBores(std::size_t bores, const std::vector<Vector3>& places,
                                 const std::vector<Vector3>& ways) const {
  const std::size_t each = places.size() / bores;
  double size = 1e9;
  std::vector<Vector3> middles;
  for (std::size_t bore = 0; bore < bores; ++bore) {
    const auto begin = static_cast<std::ptrdiff_t>(bore * each), behind = begin + static_cast<std::ptrdiff_t>(each);
    const std::vector<Vector3> own(places.begin() + begin, places.begin() + behind);
    size = std::min(size, sizeOf(own, {ways.begin() + begin, ways.begin() + behind}));
    Vector3 middle = Vector3::Zero();
    for (const Vector3& place : own)
      middle += place / static_cast<double>(each);
    middles.push_back(middle);
  }
  if (bores == 2) return {std::min(size, sizeOf(middles, {Vector3::UnitY(), Vector3::UnitY()})), {}};
  return {std::min(size, bores == 3 ? sizeOfArc(middles) : sizeOfCrossing(middles)), {}};
}

const CycleSize& MiddleRun::sizeAround(std::size_t cycle) {
  const auto [known, isNew] = sizes_.try_emplace(cycle);
  if (isNew) known->second = findSize(cycle);
  return known->second;
}

CycleSize MiddleRun::findSize(std::size_t cycle) const {
  std::vector<std::size_t> own;
  std::vector<Vector3> places, ways;
  for (std::size_t a = 0; a < touches.size(); ++a) {
    if (cycleOf(a) != cycle) continue;
    own.push_back(a);
    const Step& step = steps[touches[a]];
    places.push_back(spindleAt(step.latched));
    ways.push_back((places.back() - spindleAt(step.from)).normalized());
  }
  const auto& cycles = outcome.journal.cycles;
  const std::string name = cycle < cycles.size() ? cycles[cycle].name : "";
  // Of several bores each is one thing, and what follows from their middles another.
  const std::size_t bores = name == "416" || name == "430"   ? 3
                            : name == "418"                  ? 4
                            : name == "401" || name == "402" ? 2
                                                             : 0;
  const bool apart = bores > 0 && places.size() % bores == 0;
  CycleSize size = apart ? sizeOfBores(bores, places, ways) : CycleSize{sizeOf(places, ways), {}};
  const auto circles = circlesOf(cycle, own);
  for (const std::vector<std::size_t>& circle : circles) {
    std::vector<Vector3> points, directions;
    for (const std::size_t touch : circle) {
      points.push_back(places[touch]);
      directions.push_back(ways[touch]);
    }
    size.size = std::min(size.size, sizeOfRound(points, directions));
  }
  if (!apart && circles.empty()) size.corner = cornerOf(places, ways);
  return size;
}

double MiddleRun::leverAfter(std::size_t step) const {
  const Vector3 touched = spindleAt(steps[step].latched);
  double lever = 0;
  for (std::size_t k = step + 1; k < steps.size(); ++k)
    lever = std::max({lever, (spindleAt(steps[k].from) - touched).norm(), (spindleAt(steps[k].to) - touched).norm()});
  return lever;
}

}  // namespace probewright::survival
