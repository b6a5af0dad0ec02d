#include <vector>

#include "control/alarm.hpp"
#include "execution/sinumerik/host.hpp"
#include "metrology/fits.hpp"

/// CALCDAT: the circle through points, as programs compute it from what they have measured.
namespace probewright::execution::sinumerik {

using control::Alarm;

/// CALCDAT(POINTS, COUNT, RESULT): POINTS[n,2] has abscissa and ordinate of 3 or 4 points, RESULT[3] gets the centre
/// and the radius. STATUS=CALCDAT(...) becomes TRUE if there is such a circle.
void SinumerikHost::circleThroughPoints(const Command& command, Evaluation& evaluation) {
  const auto words = evaluation.words(command.words);
  const auto arrayAt = [&](std::size_t place) -> UserVariable& {
    const Operand value = place < words.size() ? words[place].value : Operand{};
    const Node* node = value.node >= 0 ? &evaluation.block().nodes[static_cast<std::size_t>(value.node)] : nullptr;
    UserVariable* found = nullptr;
    if (node != nullptr && node->operation == Operation::Variable)
      found = variables_.find(evaluation.at(evaluation.block().variables[node->a].name));
    if (found == nullptr || found->type() != Type::Real)
      throw Alarm("14020", "CALCDAT takes an array of points, their number and an array for the circle",
                  "write CALCDAT(PT,3,RES) with DEF REAL PT[3,2] and DEF REAL RES[3]");
    return *found;
  };
  const UserVariable& points = arrayAt(0);
  UserVariable& circle = arrayAt(2);
  const double count = evaluation.number(words[1].value);
  if ((count != 3 && count != 4) || points.sizes()[1] < 2 || points.sizes()[0] < count || circle.count() < 3)
    throw Alarm("14020", "CALCDAT computes a circle from 3 or 4 points of an array [n,2] into an array [3]",
                "compare the sizes of the arrays with their DEF");
  std::vector<Vector2> places;
  for (double i = 0; i < count; ++i) {
    const double x[] = {i, 0}, y[] = {i, 1};
    places.emplace_back(std::get<double>(points.at(points.place("CALCDAT", x))),
                        std::get<double>(points.at(points.place("CALCDAT", y))));
  }
  const auto fit = metrology::fitCircle(std::span<const Vector2>(places));
  if (fit) {
    circle.set(0, fit->shape.centre.x());
    circle.set(1, fit->shape.centre.y());
    circle.set(2, fit->shape.radius);
  }
  if (command.variable >= 0)
    return write(evaluation.block().variables[static_cast<std::size_t>(command.variable)], fit ? 1.0 : 0.0, evaluation);
  if (!fit) throw Alarm("14051", "CALCDAT: no circle leads through these points", fit.error().message);
}

}  // namespace probewright::execution::sinumerik
