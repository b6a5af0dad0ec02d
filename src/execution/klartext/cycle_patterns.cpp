#include <fmt/format.h>

#include "control/alarm.hpp"
#include "execution/klartext/cycles.hpp"
#include "execution/klartext/excerpt.hpp"
#include "language/klartext/pattern.hpp"

/// Patterns of points: PATTERN DEF, SEL PATTERN, and cycle 12 called at each of them.
namespace probewright::execution::klartext {

using control::Alarm;

void Cycles::definePattern(std::string_view text) {
  const auto value = [&](std::string_view name) { return parameters_.numberNamed(name); };
  auto points = patternPoints(text, value);
  if (!points) throw Alarm("Pattern wrong", points.error().message, points.error().advice);
  for (Vector3& point : *points)
    point *= control_.unit;
  pattern_ = std::move(*points);
}

void Cycles::selectPattern(const std::string& path) {
  const Result<std::string> bytes = run_.readHostFile(path);
  if (!bytes) {
    throw Alarm("Table missing",
                fmt::format("The point table {} cannot be read: {}", excerptOf(path), bytes.error().message),
                "put the table beside the program");
  }
  auto points = pointTable(*bytes, fileNameOf(path));
  if (!points) throw Alarm("Table wrong", points.error().message, points.error().advice);
  pattern_ = std::move(*points);
}

void Cycles::callAtPattern() {
  if (pattern_.empty()) {
    throw Alarm("Pattern not defined", "CYCL CALL PAT finds no pattern of points",
                "program PATTERN DEF or SEL PATTERN before it");
  }
  run_.levels.back().pattern = PatternRun{pattern_, 0, control_.coordinates.current().shift, run_.cycleProgram};
  nextPatternPoint();
}

/// The points count as an additional datum shift for the program that cycle 12 calls.
void Cycles::nextPatternPoint() {
  auto& run = run_.levels.back().pattern;
  if (!run) return;
  auto& transformations = control_.coordinates.current();
  transformations.shift = run->shift;
  if (run->next == run->points.size()) {
    run.reset();
  } else {
    const Matrix3 axes = transformations.matrix(control_.coordinates.plane).linear();
    transformations.shift += axes * run->points[run->next++];
    requestedProgram_ = run->program;
  }
  control_.applyCoordinates();
}

}  // namespace probewright::execution::klartext
