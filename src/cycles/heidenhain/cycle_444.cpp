#include <fmt/format.h>

#include <algorithm>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/html_log.hpp"
#include "cycles/heidenhain/parameters.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice reactionChoices[] = {
    {0, "none"}, {1, "stop if a tolerance is exceeded"}, {2, "stop if the surface lies too low"}};

constexpr Parameter normal(std::uint32_t number, std::string_view name, std::string_view meaning) {
  return {
      .name = name, .address = number, .meaning = meaning, .kind = ValueKind::Number, .minimum = -10, .maximum = 10};
}

constexpr Parameter parameters444[] = {
    coordinate(263, "Q263", "nominal point, main axis"),
    coordinate(264, "Q264", "nominal point, minor axis"),
    coordinate(294, "Q294", "nominal point, touch probe axis"),
    normal(581, "Q581", "surface normal, main axis component"),
    normal(582, "Q582", "surface normal, minor axis component"),
    normal(583, "Q583", "surface normal, tool axis component"),
    setUpClearance,
    clearanceHeight,
    {.name = "QS400",
     .address = 400,
     .meaning = "tolerance along the normal, such as \"0.4-0.1\"; blank: not monitored",
     .kind = ValueKind::Text},
    option(309, "Q309", "reaction to a tolerance error", reactionChoices),
};

constexpr ResultDefinition results444[] = {
    {"Q151", {"measured ", "position, main axis"}, result::actual(of::position1).main()},
    {"Q152", {"measured ", "position, minor axis"}, result::actual(of::position2).main()},
    {"Q153", {"measured ", "position, tool axis"}, result::actual(of::position3).main()},
    {"Q161", {"deviation, ", "main axis"}, result::difference(of::position1)},
    {"Q162", {"deviation, ", "minor axis"}, result::difference(of::position2)},
    {"Q163", {"deviation, ", "tool axis"}, result::difference(of::position3)},
    {"Q164", "deviation along the normal: negative undersize, positive oversize",
     result::difference(of::alongNormal).main()},
    {"Q183", "workpiece: -1 not monitored, 0 good, 1 rework, 2 scrap", result::status},
};

/// "0.4-0.1", "0.4", "-0.1"; nothing where the text is no tolerance.
std::optional<metrology::Tolerance> toleranceIn(std::string text) {
  std::erase(text, ' ');
  if (text.empty()) return metrology::Tolerance{};
  const bool isSigned = text.front() == '+' || text.front() == '-';
  const auto dimension = metrology::parseDimension(fmt::format("0{}{}", isSigned ? "" : "+", text));
  if (!dimension || dimension->actual || !dimension->actualParameter.empty()) return std::nullopt;
  return dimension->tolerance;
}

/// What the call is compared with; nothing where its text monitors nothing.
std::optional<metrology::Limits> limitsOf(Context& context) {
  const metrology::Tolerance tolerance = toleranceIn(context.arguments().text(400)).value();
  const bool monitors = tolerance.width() > 0 && tolerance.lower <= 0 && tolerance.upper >= 0;
  if (!monitors) return std::nullopt;
  const double unit = context.control().unit;
  return metrology::Limits{tolerance.lower * unit, tolerance.upper * unit};
}

void rules(CallRules& call) {
  const auto normal = call.numbers({581, 582, 583});
  if (normal && !(normal->norm() > 1e-9)) {
    call.refuse("Surface normal wrong", 583, "The normal vector Q581, Q582, Q583 has no length",
                "give the direction away from the surface");
  }
  const auto tolerance = call.value(400);
  if (tolerance && !toleranceIn(tolerance->text)) {
    call.refuse("Tolerance wrong", 400, fmt::format("QS400 = \"{}\" is not a tolerance", tolerance->text),
                "write the upper and the lower deviation, such as \"0.4-0.1\"");
  }
}

Verdict verdictOf(double deviation, const metrology::Limits& limits) {
  switch (metrology::conformance(deviation, limits)) {
    case metrology::Conformance::Above:
      return Verdict::Rework;
    case metrology::Conformance::Below:
      return Verdict::Scrap;
    case metrology::Conformance::Within:
      break;
  }
  return Verdict::Good;
}

constexpr LogTerm logTerms[] = {
    {"PROBING IN 3-D", "IZMERENIYE V 3D", "AVKAENNING 3D"},
    {"Along the normal", "По нормали", "Längs normalen"},
};

constexpr Example examples[] = {{"Q583", 1}};

constexpr CycleDefinition definition = {
    .number = 444,
    .name = "444",
    .title = "PROBING IN 3-D",
    .family = CycleFamily::Special,
    .summary =
        "Measures one point of a surface along its normal and compares its deviation with a tolerance; for free-form "
        "surfaces.",
    .parameters = parameters444,
    .results = results444,
    .controls = control::onTNC640,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  const PlaneWay n = PlaneWay(context.q(581), context.q(582), context.q(583)).normalized();
  const PartPoint nominal(context.q(263), context.q(264), context.q(294));
  const auto limits = limitsOf(context);

  auto& prober = context.prober();
  const PlannedTouch planned{nominal, -n};
  prober.approach(prober.prePosition(planned, context.q(320)), context.q(260));
  const EvaluatedTouch touch = prober.touch(planned);
  prober.moveSouthPoleTo(context.q(260));

  const PlaneWay deviation = touch.surface - nominal;
  const double along = deviation.dot(n);
  const Verdict verdict = limits ? verdictOf(along, *limits) : Verdict::None;
  for (int i = 0; i < 3; ++i)
    context.result(151 + i, touch.surface[i], {.nominal = nominal[i]});
  for (int i = 0; i < 3; ++i)
    context.result(161 + i, deviation[i]);
  Compared compared{.nominal = 0, .verdict = verdict};
  if (limits) {
    compared.lower = limits->lower;
    compared.upper = limits->upper;
  }
  context.result(164, along, compared);
  context.set(183, verdict == Verdict::None ? -1 : static_cast<int>(verdict) - static_cast<int>(Verdict::Good));
  context.record().verdict = verdict;

  const double unit = context.control().mainUnit;
  const int decimals = unit == 1 ? 4 : 5;
  const auto number = [unit, decimals](double length) { return formatFixed(length / unit, decimals); };
  const PlaneWay path = -n * prober.probe().distance;
  static constexpr const char* names[] = {"Main axis", "Minor axis", "Tool axis"};
  static constexpr const char* words[] = {"", "good", "rework", "scrap"};
  const char* state = words[static_cast<std::size_t>(verdict)];
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; i < 3; ++i) {
    // Where the normal points down an axis, the upper limit along it is the lower coordinate.
    const auto [lower, upper] = std::minmax({limits ? limits->lower * n[i] : 0, limits ? limits->upper * n[i] : 0});
    const auto limit = [&](double value) { return limits ? number(nominal[i] + value) : std::string(); };
    rows.push_back({names[i], number(path[i]), number(nominal[i]), limit(lower), limit(upper), number(touch.surface[i]),
                    number(deviation[i]), ""});
  }
  rows.push_back({"Along the normal", number(prober.probe().distance), number(0), limits ? number(limits->lower) : "",
                  limits ? number(limits->upper) : "", number(along), number(along), state});
  addToHtmlLog(context,
               {"", "Probing direction", "Nominal", "Lower limit", "Upper limit", "Actual", "Deviation", "Status"},
               rows, "TCHPR444.html");

  const int reaction = context.option(309);
  const bool stops = verdict == Verdict::Scrap ? reaction != 0 : verdict == Verdict::Rework && reaction == 1;
  if (stops) {
    context.stop(fmt::format("Tolerance exceeded: {}\nDeviation along the surface normal {}", state,
                             formatSigned(along / unit, decimals)));
  }
}

}  // namespace

extern const Entry cycle444 = {.definition = definition,
                               .conditions = {.under = Transformed::ByShiftOrRotation, .mismatchWithTcpm = true},
                               .logTerms = logTerms,
                               .rules = rules,
                               .run = run};

}  // namespace probewright::cycles::heidenhain
