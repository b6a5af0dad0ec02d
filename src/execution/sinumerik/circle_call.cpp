#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "control/alarm.hpp"
#include "cycles/sinumerik/circle_through_points.hpp"
#include "execution/sinumerik/host.hpp"

/// CYCLE116(_CAL[], _MODE): the circle through points, computed in the caller's own variables.
namespace probewright::execution::sinumerik {

using control::Alarm;

namespace {

/// Elements of the array: number of points, four points, centre and radius, status.
constexpr std::size_t firstPoint = 1, centre = 9, radius = 11, status = 12, elements = 13;

}  // namespace

void SinumerikHost::runCircle(WordRange range, Evaluation& evaluation) {
  const auto words = evaluation.words(range);
  const auto variable = [&](std::size_t place) -> UserVariable* {
    if (place >= words.size() || words[place].value.node < 0) return nullptr;
    const Node& node = evaluation.block().nodes[static_cast<std::size_t>(words[place].value.node)];
    if (node.operation != Operation::Variable) return nullptr;
    const ResolvedVariable named = resolve(evaluation.block().variables[node.a], evaluation);
    return named.space == VariableSpace::User && named.indices.empty() ? variables_.find(named.name) : nullptr;
  };
  UserVariable* const array = variable(0);
  UserVariable* const mode = variable(1);
  if (words.size() != 2 || array == nullptr || mode == nullptr || mode->isArray() || array->count() < elements ||
      array->type() != Type::Real)
    throw Alarm("14020", fmt::format("CYCLE116 takes an array of {} REAL and an INT", elements),
                "define DEF REAL _CAL[13] and DEF INT _MODE, and call CYCLE116(_CAL[], _MODE)");

  const auto at = [array](std::size_t place) { return std::get<double>(array->at(place)); };
  std::array<Vector2, 4> points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {at(firstPoint + 2 * i), at(firstPoint + 2 * i + 1)};
  const bool counted = at(0) == 3 || at(0) == 4;
  const cycles::sinumerik::CircleThroughPoints circle =
      cycles::sinumerik::circleThroughPoints(std::span(points).first(counted ? static_cast<std::size_t>(at(0)) : 0));
  if (circle.error == 0) {
    array->set(centre, circle.centre.x());
    array->set(centre + 1, circle.centre.y());
    array->set(radius, circle.radius);
  }
  array->set(status, circle.error == 0 ? 0.0 : 1.0);
  mode->set(0, static_cast<double>(circle.error));
}

}  // namespace probewright::execution::sinumerik
