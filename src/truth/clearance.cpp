#include "truth/clearance.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "simulation/body_clearance.hpp"
#include "simulation/contact_search.hpp"

namespace probewright::truth {

using records::ClearanceSpan;
using simulation::BodyClearance;
using simulation::Motion;
using simulation::PathKind;
using simulation::PathPoint;
using simulation::PlacedSolid;
using simulation::ToolShape;

namespace {

constexpr double most = 20;        // mm that are told
constexpr double fine = 0.05;      // mm
constexpr double onTheWay = 0.02;  // mm: how far a bent way may be from the one searched
constexpr double roughly = 1;      // mm: the same while the distance is not known any better

ToolShape grown(const ToolShape& shape, double by) {
  ToolShape thick = shape;
  for (simulation::Ball& ball : thick.balls)
    ball.radius += by;
  for (simulation::Shaft& shaft : thick.shafts) {
    shaft.radius += by;
    if (shaft.ends == simulation::Ends::Round) continue;
    const Vector3 more = shaft.axis.normalized() * by;
    shaft.start -= more;
    shaft.axis += 2 * more;
  }
  return thick;
}

/// Without what touches when it measures.
ToolShape withoutFeelers(ToolShape shape) {
  shape.balls.clear();
  std::erase_if(shape.shafts, [](const simulation::Shaft& shaft) {
    return std::string_view(shaft.part) == simulation::shaftName ||
           std::string_view(shaft.part) == simulation::cutterName;
  });
  return shape;
}

bool isToolProbe(const PlacedSolid& placed) { return placed.role == simulation::SolidRole::ToolProbe; }
bool isNoToolProbe(const PlacedSolid& placed) { return !isToolProbe(placed); }
bool isAnything(const PlacedSolid&) { return true; }

/// The block that the control carried out then.
std::optional<SourcePlace> placeAt(const session::RunOutcome& outcome, double seconds) {
  const records::RunTrace& trace = outcome.trace;
  const auto next = std::ranges::upper_bound(trace.blocks, seconds + 1e-9, {}, &records::RunTrace::Block::seconds);
  if (next == trace.blocks.begin()) return std::nullopt;
  const records::RunTrace::Block& block = *std::prev(next);
  return SourcePlace{trace.files[block.file], block.line, 0};
}

bool samePlace(const std::optional<SourcePlace>& a, const std::optional<SourcePlace>& b) {
  return a && b && a->file == b->file && a->line == b->line;
}

bool hasEnds(const machine::Axis& axis) { return axis.kind == machine::AxisKind::Linear || !axis.modulo; }

records::TravelMargin marginOf(const machine::Axis& axis, double position, double seconds) {
  const bool linear = axis.kind == machine::AxisKind::Linear;
  return {.axis = axis.name,
          .unit = linear ? "mm" : "deg",
          .margin = std::min(position - axis.minimum, axis.maximum - position),
          .position = position,
          .seconds = seconds};
}

/// The moves of a path, one after the other.
class Moves {
public:
  Moves(const session::RunOutcome& outcome, const simulation::VirtualMachine& machine)
      : outcome_(outcome),
        truth_(machine.truth()),
        path_(machine.path()),
        kinematics_(truth_.machine, truth_.errors),
        // On lathes tool touch probes stand on the bed, beside what turns.
        surroundings_(truth_.solids, truth_.machine.mainSpindle ? isNoToolProbe : isAnything),
        spindleDegrees_(machine.spindle().angle) {
    if (!truth_.bodies.empty())
      bodies_ = std::make_unique<BodyClearance>(truth_, BodyClearance::Pairs::SpindleAgainstTable);
  }

  std::vector<ClearanceSpan> spans() {
    std::vector<ClearanceSpan> spans;
    for (std::size_t i = 1; i < path_.points.size(); ++i) {
      const PathPoint& from = path_.points[i - 1];
      const PathPoint& to = path_.points[i];
      // A tool change is not watched; where it ends the next move begins.
      if (to.kind == PathKind::Start || to.kind == PathKind::ToolChange || from.axes == to.axes) continue;
      ClearanceSpan span = spanOf(from, to);
      if (span.orMore && !spans.empty() && spans.back().orMore && spans.back().cycle == span.cycle) {
        spans.back().to = span.to;
      } else {
        spans.push_back(std::move(span));
      }
    }
    return spans;
  }

private:
  const ToolShape& shapeOf(int tool) {
    const auto [place, isNew] = shapes_.try_emplace(tool);
    if (isNew)
      place->second =
          simulation::shapeOf(tool < 0 ? nullptr : &truth_.tools[static_cast<std::size_t>(tool)], spindleDegrees_);
    return place->second;
  }

  ClearanceSpan spanOf(const PathPoint& from, const PathPoint& to) {
    ClearanceSpan span;
    span.from = from.seconds;
    span.to = to.seconds;
    span.cycle = cycleAt(from.seconds, to.seconds);
    span.place = placeAt(outcome_, from.seconds);
    span.distance = most;
    span.orMore = true;
    const bool meant = to.kind == PathKind::Measure || to.kind == PathKind::Retract;
    const ToolShape moving = meant ? withoutFeelers(shapeOf(to.tool)) : shapeOf(to.tool);
    const Motion motion{kinematics_, from.axes, to.axes, from.axes, from.seconds, simulation::MotionProfile(1, 1, 1)};
    if (!moving.balls.empty() || !moving.shafts.empty()) ofTool(span, motion, moving);
    if (bodies_) ofBodies(span, motion, moving);
    return span;
  }

  /// From what lies on the table.
  void ofTool(ClearanceSpan& span, const Motion& motion, const ToolShape& moving) const {
    const auto touchWith = [&](double by, double precision) {
      return simulation::firstTouch(motion, 0, 1, grown(moving, by), surroundings_, {.precision = precision});
    };
    auto touch = touchWith(most + roughly, roughly);
    if (!touch) return;
    double free = 0, touching = most + 2 * roughly;
    while (touching - free > fine && free < most) {
      const double middle = (free + touching) / 2;
      // Bent ways are taken as exactly as the answer is known; what that leaves open stays between the bounds.
      const double precision = std::clamp((touching - free) / 8, onTheWay, roughly);
      const double open = precision > onTheWay ? precision : 0;
      if (auto nearer = touchWith(middle, precision)) {
        touching = std::min(touching, middle + open);
        touch = std::move(nearer);
      } else {
        free = std::max(free, middle - open);
      }
    }
    if (free >= most) return;
    span.distance = free;
    span.orMore = false;
    span.part = touch->shaft ? moving.shafts[*touch->shaft].part : "ball";
    span.solid = truth_.solids[touch->solid].name;
  }

  /// From bodies of the machine, and of those that carry the tool from what lies on the table; if they are nearer than
  /// what the span tells.
  void ofBodies(ClearanceSpan& span, const Motion& motion, const ToolShape& moving) const {
    const auto nearWith = [&](double by) { return bodies_->nearer(motion, {by, by}, grown(moving, by)); };
    auto near = nearWith(span.distance);
    if (!near) return;
    double free = 0, touching = span.distance;
    while (touching - free > fine) {
      const double middle = (free + touching) / 2;
      if (auto nearer = nearWith(middle)) {
        touching = middle;
        near = std::move(nearer);
      } else {
        free = middle;
      }
    }
    span.distance = free;
    span.orMore = false;
    span.part = near->other.empty() ? "tool" : near->body;
    span.solid = near->other.empty() ? near->body : near->other;
  }

  std::optional<std::size_t> cycleAt(double from, double to) const {
    const auto& cycles = outcome_.journal.cycles;
    const auto next = std::ranges::upper_bound(cycles, from + 1e-9, {}, &control::CycleRecord::startSeconds);
    if (next == cycles.begin()) return std::nullopt;
    const auto cycle = std::prev(next);
    if (to > cycle->endSeconds + 1e-9) return std::nullopt;
    return static_cast<std::size_t>(cycle - cycles.begin());
  }

  const session::RunOutcome& outcome_;
  const simulation::Truth& truth_;
  const simulation::PathRecord& path_;
  simulation::TrueKinematics kinematics_;
  simulation::Surroundings surroundings_;
  double spindleDegrees_ = 0;
  std::map<int, ToolShape> shapes_;
  std::unique_ptr<BodyClearance> bodies_;
};

}  // namespace

records::Clearance clearanceOf(const session::RunOutcome& outcome, const simulation::VirtualMachine& machine,
                               double limit) {
  return {limit, Moves(outcome, machine).spans()};
}

std::vector<records::TravelMargin> travelMargins(const simulation::VirtualMachine& machine) {
  std::vector<records::TravelMargin> margins;
  const auto& axes = machine.truth().machine.axes;
  const auto& points = machine.path().points;
  for (std::size_t i = 0; i < axes.size() && !points.empty(); ++i) {
    if (!hasEnds(axes[i])) continue;
    records::TravelMargin least = marginOf(axes[i], points.front().axes[i], points.front().seconds);
    for (const PathPoint& point : points) {
      if (auto here = marginOf(axes[i], point.axes[i], point.seconds); here.margin < least.margin)
        least = std::move(here);
    }
    margins.push_back(std::move(least));
  }
  return margins;
}

std::vector<records::TravelMargin> nearEnds(const session::RunOutcome& outcome,
                                            const simulation::VirtualMachine& machine, double limit) {
  std::vector<records::TravelMargin> near;
  const auto& axes = machine.truth().machine.axes;
  const auto& points = machine.path().points;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const PathPoint &from = points[k - 1], &to = points[k];
    if (to.kind == PathKind::Start || to.kind == PathKind::ToolChange) continue;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (!hasEnds(axes[i]) || to.axes[i] == from.axes[i]) continue;
      records::TravelMargin here = marginOf(axes[i], to.axes[i], to.seconds);
      if (here.margin >= limit) continue;
      here.place = placeAt(outcome, from.seconds);
      const auto before = std::ranges::find_if(
          near.rbegin(), near.rend(), [&](const records::TravelMargin& other) { return other.axis == here.axis; });
      if (before == near.rend() || !samePlace(before->place, here.place)) {
        near.push_back(std::move(here));
      } else if (here.margin < before->margin) {
        *before = std::move(here);
      }
    }
  }
  return near;
}

}  // namespace probewright::truth
