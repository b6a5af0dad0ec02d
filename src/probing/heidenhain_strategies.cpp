#include "probing/heidenhain_strategies.hpp"

#include <cmath>

namespace probewright::probing {
namespace {

PartPoint at(const Vector2& point, double height) { return {point.x(), point.y(), height}; }

/// Touches all of `plan` from one place in the middle, at the measuring height.
std::vector<EvaluatedTouch> probeFromCentre(HeidenhainProber& prober, const PartPoint& centre,
                                            const std::vector<PlannedTouch>& plan, const Heights& heights) {
  prober.approach(ballAt(centre), heights.clearance);
  std::vector<EvaluatedTouch> touches;
  for (const PlannedTouch& planned : plan)
    touches.push_back(prober.touch(planned));
  if (heights.ending == Ending::AtClearanceHeight) prober.moveSouthPoleTo(heights.clearance);
  return touches;
}

}  // namespace

std::vector<EvaluatedTouch> probeCircle(HeidenhainProber& prober, const CircleTask& task, const Heights& heights) {
  const PartPoint centre = at(task.centre, heights.measuring);
  const auto plan = planCircle(centre, task.diameter, task.startAngle, task.stepAngle, task.count, task.side);
  if (task.side == Side::Inside && task.diameter / 2 <= prober.standOff(heights.extraClearance)) {
    return probeFromCentre(prober, centre, plan, heights);
  }
  std::vector<EvaluatedTouch> touches;
  prober.approach(prober.prePosition(plan.front(), heights.extraClearance), heights.clearance);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i > 0) {
      const BallCentre next = prober.prePosition(plan[i], heights.extraClearance);
      if (heights.between == Between::AtClearanceHeight) {
        prober.moveSouthPoleTo(heights.clearance);
        if (task.traverse == Traverse::Arc) {
          prober.moveOnArc(centre, task.stepAngle);
        } else {
          prober.moveInPlane(next);
        }
        prober.moveTo(next);
      } else {
        prober.moveOnArc(centre, task.stepAngle);
      }
    }
    touches.push_back(prober.touch(plan[i]));
  }
  if (heights.ending == Ending::AtClearanceHeight) prober.moveSouthPoleTo(heights.clearance);
  return touches;
}

std::vector<EvaluatedTouch> probeRectangle(HeidenhainProber& prober, const RectangleTask& task,
                                           const Heights& heights) {
  const PartPoint centre = at(task.centre, heights.measuring);
  const auto plan = planRectangle(centre, task.length1, task.length2, task.side);
  if (task.side == Side::Inside &&
      std::min(task.length1, task.length2) / 2 <= prober.standOff(heights.extraClearance)) {
    return probeFromCentre(prober, centre, plan, heights);
  }
  std::vector<EvaluatedTouch> touches;
  prober.approach(prober.prePosition(plan.front(), heights.extraClearance), heights.clearance);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i > 0) {
      const BallCentre next = prober.prePosition(plan[i], heights.extraClearance);
      if (heights.between == Between::AtClearanceHeight) {
        prober.moveSouthPoleTo(heights.clearance);
        prober.moveInPlane(next);
        prober.moveTo(next);
      } else {
        // Outside around the corner: first along the side just probed, then along the next one. Inside through the
        // middle of the pocket, which is free whatever its corners look like.
        const Eigen::Index along = std::abs(plan[i - 1].direction[0]) > 0.5 ? 1 : 0;
        const Eigen::Index first = task.side == Side::Outside ? along : 1 - along;
        BallCentre corner = prober.position();
        corner[first] = next[first];
        prober.moveTo(corner);
        prober.moveTo(next);
      }
    }
    touches.push_back(prober.touch(plan[i]));
  }
  prober.moveSouthPoleTo(heights.clearance);
  return touches;
}

std::vector<EvaluatedTouch> probeWidth(HeidenhainProber& prober, const WidthTask& task, const Heights& heights) {
  const PartPoint centre = at(task.centre, heights.measuring);
  const auto plan = planWidth(centre, task.width, task.axis == 0 ? 0.0 : 90.0, task.side);
  if (task.side == Side::Inside && task.width / 2 <= prober.standOff(heights.extraClearance)) {
    return probeFromCentre(prober, centre, plan, heights);
  }
  Heights used = heights;
  if (task.side == Side::Outside) used.between = Between::AtClearanceHeight;
  return probePoints(prober, {{plan[0]}, {plan[1]}}, used);
}

std::vector<EvaluatedTouch> probePoints(HeidenhainProber& prober, const std::vector<RoutedTouch>& plan,
                                        const Heights& heights) {
  std::vector<EvaluatedTouch> touches;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const auto& [touch, via] = plan[i];
    const BallCentre start = prober.prePosition(touch, heights.extraClearance);
    if (i == 0) {
      prober.approach(start, heights.clearance);
    } else if (heights.between == Between::AtClearanceHeight) {
      prober.moveSouthPoleTo(heights.clearance);
      prober.moveInPlane(start);
      prober.moveTo(start);
    } else {
      if (via) prober.moveInPlane(BallCentre(via->x(), via->y(), 0));
      prober.moveTo(start);
    }
    touches.push_back(prober.touch(touch));
  }
  prober.moveSouthPoleTo(heights.clearance);
  return touches;
}

}  // namespace probewright::probing
