#include "cycles/heidenhain/nominal_position.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "cycles/heidenhain/html_log.hpp"
#include "metrology/iso286.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using metrology::DimensionText;

namespace {

constexpr const char* axisNames[] = {"main axis", "minor axis", "tool axis"};
constexpr double largest = 99999.9999;

/// The Q parameter that a text names after "@": only Q1900 to Q1999 may hold actual positions.
double actualFrom(Context& context, int number, const std::string& name) {
  const auto parameter = parseInteger(std::string_view(name).substr(1));
  if (!parameter || *parameter < 1900 || *parameter > 1999) {
    throw Alarm("Actual position wrong", fmt::format("QS{} takes the actual position from {}", number, name),
                "use one of Q1900 to Q1999");
  }
  return context.control().q.q(static_cast<int>(*parameter));
}

/// ISO tolerances belong to the size in mm: in inch programs the text cannot have known them.
std::optional<metrology::Tolerance> toleranceOf(const DimensionText& text, double unit) {
  if (!text.tolerance) return std::nullopt;
  if (unit == 1 || text.toleranceClass.empty()) {
    return metrology::Tolerance{text.tolerance->lower * unit, text.tolerance->upper * unit};
  }
  const bool hasGrade = std::ranges::any_of(text.toleranceClass, [](char c) { return c >= '0' && c <= '9'; });
  const double size = *text.nominal * unit;
  const auto found = hasGrade ? metrology::isoTolerance(size, text.toleranceClass)
                              : metrology::generalTolerance(size, text.toleranceClass);
  if (!found) throw Alarm("Nominal position wrong", found.error().message, found.error().advice);
  return *found;
}

Verdict along(double actual, const metrology::Limits& limits, int sign) {
  switch (metrology::conformance(actual, limits)) {
    case metrology::Conformance::Below:
      return sign > 0 ? Verdict::Rework : Verdict::Scrap;
    case metrology::Conformance::Above:
      return sign > 0 ? Verdict::Scrap : Verdict::Rework;
    case metrology::Conformance::Within:
      break;
  }
  return Verdict::Good;
}

Compared compared(const NominalValue& value, Verdict verdict) {
  Compared result{.nominal = value.nominal, .lower = {}, .upper = {}, .verdict = verdict};
  if (value.limits) {
    result.lower = value.limits->lower;
    result.upper = value.limits->upper;
  }
  return result;
}

}  // namespace

NominalValue nominalValue(Context& context, int number) {
  const Argument& argument = context.arguments().at(static_cast<std::uint32_t>(number));
  const double unit = context.control().unit;
  NominalValue value;
  if (!argument.isText) {
    value.nominal = argument.number * unit;
    return value;
  }
  const Result<DimensionText> text = metrology::parseDimension(argument.text);
  if (!text) {
    throw Alarm("Nominal position wrong",
                fmt::format("QS{} = \"{}\", column {}: {}", number, argument.text, text.error().place.column,
                            text.error().message),
                text.error().advice);
  }
  value.semiAutomatic = text->unknownPosition;
  if (text->nominal) {
    if (std::abs(*text->nominal) > largest) {
      throw Alarm("Nominal position wrong", fmt::format("QS{} = \"{}\" is out of range", number, argument.text),
                  "its range is -99999.9999 to 99999.9999");
    }
    value.nominal = *text->nominal * unit;
    const auto tolerance = toleranceOf(*text, unit);
    if (tolerance && tolerance->width() > 0) value.limits = metrology::limits(*value.nominal, *tolerance);
  }
  if (text->actual) value.actual = *text->actual * unit;
  if (!text->actualParameter.empty()) value.actual = actualFrom(context, number, text->actualParameter) * unit;
  if (!value.nominal && !value.semiAutomatic) {
    throw Alarm("Nominal position wrong", fmt::format("QS{} = \"{}\" has no nominal position", number, argument.text),
                "write the nominal position, or ? where it is not known");
  }
  return value;
}

PartPoint NominalPosition::place() const {
  PartPoint position;
  for (std::size_t i = 0; i < 3; ++i) {
    if (axes[i].nominal) position[static_cast<Eigen::Index>(i)] = *axes[i].nominal;
  }
  return position;
}

void requireNominal(const NominalPosition& position, std::size_t axis) {
  if (position.axes[axis].nominal) return;
  throw Alarm("Nominal position not defined",
              fmt::format("Position {} has no nominal position in the {}, which the cycle needs (Q{})",
                          position.ordinal, axisNames[axis], position.first + static_cast<int>(axis)),
              "write the nominal position after the ?");
}

NominalPosition nominalPosition(Context& context, int ordinal, const std::array<bool, 3>& needed) {
  NominalPosition position;
  position.ordinal = ordinal;
  position.first = 1100 + 3 * (ordinal - 1);
  int nominals = 0;
  int actuals = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    position.axes[i] = nominalValue(context, position.first + static_cast<int>(i));
    nominals += position.axes[i].nominal ? 1 : 0;
    actuals += position.axes[i].actual ? 1 : 0;
  }
  if (nominals == 0) {
    throw Alarm("Nominal position not defined",
                fmt::format("Position {} has no nominal position in any axis (Q{} to Q{})", ordinal, position.first,
                            position.first + 2),
                "give the nominal position at least in the axis that is measured");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (needed[i]) requireNominal(position, i);
  }
  if (actuals != 0 && actuals != 3) {
    throw Alarm("Actual position incomplete",
                fmt::format("Position {} has an actual position (@) in {} of three axes", ordinal, actuals),
                "give it in all three axes or in none");
  }
  return position;
}

std::array<bool, 3> axisOf(int direction) {
  std::array<bool, 3> axes{};
  axes[static_cast<std::size_t>(std::abs(direction) - 1)] = true;
  return axes;
}

MeasuredPosition measuredPosition(const NominalPosition& nominal, const PartPoint& actual,
                                  const std::array<bool, 3>& measuredAxes) {
  MeasuredPosition measured{actual, actual, actual};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    if (!nominal.axes[i].nominal) continue;
    measured.nominal[index] = nominal.axes[i].middle();
    if (measuredAxes[i] || nominal.known()) measured.wanted[index] = measured.nominal[index];
  }
  return measured;
}

void RotationFindings::note(const std::string& label, const NominalValue& value, double actual, double deviation,
                            Verdict verdict) {
  const double unit = context_.control().mainUnit;
  const int decimals = unit == 1 ? 4 : 5;
  const auto number = [unit, decimals](double length) { return formatFixed(length / unit, decimals); };
  static constexpr const char* words[] = {"", "good", "rework", "scrap"};
  rows_.push_back({label, value.nominal ? number(*value.nominal) : "?", value.limits ? number(value.limits->lower) : "",
                   value.limits ? number(value.limits->upper) : "", number(actual), number(deviation),
                   words[static_cast<std::size_t>(verdict)]});
  verdict_ = metrology::worst(verdict_, verdict);
}

void RotationFindings::add(const NominalPosition& nominal, const MeasuredPosition& measured, int direction) {
  const PlaneWay deviation = measured.deviation();
  const int offset = nominal.first - 1100;
  for (int i = 0; i < 3; ++i) {
    const NominalValue& value = nominal.axes[static_cast<std::size_t>(i)];
    Verdict verdict = Verdict::None;
    if (value.limits) {
      verdict = std::abs(direction) == i + 1 ? along(measured.actual[i], *value.limits, direction)
                                             : metrology::positionVerdict(measured.actual[i], *value.limits);
    }
    context_.result(950 + offset + i, measured.actual[i], compared(value, verdict));
    context_.result(980 + offset + i, deviation[i]);
    note(fmt::format("Position {}, {}", nominal.ordinal, axisNames[i]), value, measured.actual[i], deviation[i],
         verdict);
  }
}

void RotationFindings::addDiameter(const NominalValue& nominal, double actual, int ordinal, Side side) {
  Verdict verdict = Verdict::None;
  if (nominal.limits) {
    verdict = side == Side::Inside ? metrology::boreVerdict(actual, *nominal.limits)
                                   : metrology::studVerdict(actual, *nominal.limits);
  }
  context_.result(965 + ordinal, actual, compared(nominal, verdict));
  context_.result(995 + ordinal, actual - nominal.middle());
  note(fmt::format("Diameter {}", ordinal), nominal, actual, actual - nominal.middle(), verdict);
}

void RotationFindings::addAngle(int parameter, const std::string& label, double actual) {
  context_.result(parameter, actual);
  rows_.push_back({label, "", "", "", formatFixed(actual, 4), "", ""});
}

void RotationFindings::finish() {
  context_.record().verdict = verdict_;
  context_.set(183, verdict_ == Verdict::None ? -1 : static_cast<int>(verdict_) - static_cast<int>(Verdict::Good));
  const std::vector<std::string> heading = {"",       "Nominal",   "Lower limit", "Upper limit",
                                            "Actual", "Deviation", "Status"};
  addToHtmlLog(context_, heading, rows_);

  const int reaction = context_.option(309);
  const bool stops = verdict_ == Verdict::Scrap ? reaction != 0 : verdict_ == Verdict::Rework && reaction == 1;
  if (!stops) return;
  std::string text = verdict_ == Verdict::Scrap ? "Tolerance exceeded: scrap" : "Tolerance exceeded: rework";
  for (const auto& row : rows_) {
    if (row[1].empty()) continue;
    text += fmt::format("\n{}: nominal {}, actual {}{}{}", row[0], row[1], row[4], row[6].empty() ? "" : ", ", row[6]);
  }
  context_.stop(text);
}

}  // namespace probewright::cycles::heidenhain
