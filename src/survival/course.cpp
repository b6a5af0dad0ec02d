#include "survival/course.hpp"

#include <cmath>
#include <utility>

namespace probewright::survival {

bool rotaryDiffers(const machine::MachineDescription& machine, const machine::AxisPositions& a,
                   const machine::AxisPositions& b) {
  for (std::size_t i = 0; i < machine.axes.size(); ++i)
    if (machine.axes[i].kind == machine::AxisKind::Rotary && std::abs(a[i] - b[i]) > 1e-9) return true;
  return false;
}

bool addStillMoves(Course& course, const std::vector<Step>& otherwise, const machine::MachineDescription& machine) {
  constexpr double little = 0.5;  // mm
  std::vector<Step> whole;
  std::vector<bool> added;
  std::size_t i = 0;
  for (const Step& step : otherwise) {
    const bool alike = i < course.steps.size() && course.steps[i].kind == step.kind &&
                       course.steps[i].tool == step.tool && wayOf(machine, course.steps[i].to, step.to) < little;
    if (alike) {
      whole.push_back(course.steps[i++]);
      added.push_back(false);
      continue;
    }
    if (step.kind != StepKind::Move || wayOf(machine, step.from, step.to) > little ||
        rotaryDiffers(machine, step.from, step.to))
      return false;
    Step standing = step;
    standing.from = standing.to = standing.end = whole.empty() ? step.from : whole.back().end;
    standing.seconds = i < course.steps.size() ? course.steps[i].seconds : whole.back().seconds;
    whole.push_back(standing);
    added.push_back(true);
  }
  if (i < course.steps.size()) return false;
  constexpr double shortest = 2;  // mm
  for (std::size_t k = 0; k < whole.size(); ++k)
    if (whole[k].kind == StepKind::Move && wayOf(machine, whole[k].from, whole[k].to) < shortest) added[k] = true;
  course.steps = std::move(whole);
  course.optional = std::move(added);
  return true;
}

std::optional<std::vector<Step>> aligned(const Course& course, const std::vector<Step>& steps,
                                         const machine::MachineDescription& machine) {
  std::vector<Step> found;
  std::size_t next = 0;
  for (std::size_t i = 0; i < course.steps.size(); ++i) {
    const Step& expected = course.steps[i];
    bool there = next < steps.size() && steps[next].kind == expected.kind;
    if (there && course.optional[i]) {
      // One that is left out where nothing is otherwise: the next one then comes in its place.
      std::size_t k = i + 1;
      while (k < course.steps.size() && course.optional[k])
        ++k;
      there = k == course.steps.size() || course.steps[k].kind != steps[next].kind ||
              wayOf(machine, steps[next].to, expected.to) < wayOf(machine, steps[next].to, course.steps[k].to);
    }
    if (there) {
      found.push_back(steps[next++]);
    } else if (course.optional[i]) {
      Step standing = expected;
      standing.from = standing.to = standing.end = found.empty() ? expected.from : found.back().end;
      found.push_back(standing);
    } else {
      return std::nullopt;
    }
    const Step& last = found.back();
    if (last.tool != expected.tool || last.touched != expected.touched || last.feed.rapid != expected.feed.rapid ||
        std::abs(last.feed.perMinute - expected.feed.perMinute) > 1e-6 ||
        rotaryDiffers(machine, last.from, expected.from) || rotaryDiffers(machine, last.to, expected.to))
      return std::nullopt;
  }
  if (next < steps.size()) return std::nullopt;
  return found;
}

}  // namespace probewright::survival
