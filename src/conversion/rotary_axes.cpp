#include <fmt/format.h>

#include <cmath>

#include "conversion/heidenhain_tasks.hpp"
#include "conversion/to_sinumerik.hpp"
#include "geometry/primitives.hpp"

/// Workpieces that a rotary table aligns: touch probe cycles 403 and 1410.
namespace probewright::conversion {

using namespace language;

std::string ToSinumerik::tableAxis() const { return std::string(1, static_cast<char>('A' + (axis(2)[0] - 'X'))); }

void ToSinumerik::alignRotaryAxis(const Block& block, const Call& call) {
  const int wanted = call.integer("Q312"), measuring = call.integer("Q272");
  if (measuring == 3 || toolAxis_ != 'Z' || (wanted != 0 && wanted != 6)) {
    throw NotCarriedOver("only the axis that turns about Z is aligned, by an edge measured in the plane");
  }
  const bool zeroes = call.number("Q337") == 1;
  if (zeroes && call.has("Q303") && call.integer("Q303") != 1) {
    throw NotCarriedOver("Q303: the angle goes to a datum table, which a SINUMERIK does not have",
                         "let the cycle write to the preset table: Q303 = 1");
  }
  Losses losses;
  const MeasuringTask edge = heidenhainTasks(call, ballRadius_, losses).front();
  const auto along = static_cast<std::size_t>(edge.along);
  const Quantity way = edge.further.at(0)[along] - edge.place[along];
  const Quantity target = call.number("Q380");
  if (!way.isNumber() || !target.isNumber()) throw NotCarriedOver("the angles are known only when the program runs");
  // CYCLE998 counts from the positive offset axis; with Q312 = 0 the edge has a direction, from the first point on.
  const bool directed = wanted == 0;
  const double base = (edge.axis == 0 ? 90.0 : 0.0) + (directed && way.number() < 0 ? 180.0 : 0.0);
  const double set =
      directed ? normalizedDegrees(target.number() - base) : std::remainder(target.number() - base, 180.0);
  const double most = directed ? 135 : 45;  // the edge is off by at most 45 degrees
  if (std::abs(set) > most) throw NotCarriedOver("the workpiece lies too far from the angle that it is aligned to");

  out_.line("; 403 ROT IN ROTARY AXIS");
  task(block, edge, call.cycle);
  if (usedQ_.contains(150)) {
    const std::string angle = parameter(150);
    out_.line(fmt::format("{}={}", angle, sinumerikText(Quantity::of("_OVR[4]") + normalizedDegrees(base))));
    const double lowest = directed ? -180 : -90;
    out_.line(fmt::format("IF {}>{}", angle, -lowest));
    out_.line(fmt::format("  {0}={0}-{1}", angle, -2 * lowest));
    out_.line("ENDIF");
  }
  // A table turns the workpiece against the direction of its axis (ISO 841).
  const std::string table = tableAxis();
  out_.line(fmt::format("G0 {}=IC({})", table, sinumerikText(Quantity::of("_OVR[4]") - set)));
  if (zeroes) {
    std::optional<Quantity> row;
    if (directed) row = call.number("Q305");
    if (row && *row == 0) {
      takeRowZero();
      row = 99;
    }
    if (row && !row->isNumber()) row = runningRow(*row, RowZero::Preset);
    setComponent(row, table + ",TR", [&](const std::string&) { return fmt::format("$AA_IM[{}]", table); });
  }
  for (const std::string& loss : losses)
    out_.lose(block, loss);
  forgetPosition();
}

}  // namespace probewright::conversion
