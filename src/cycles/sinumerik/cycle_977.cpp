#include <fmt/format.h>

#include <algorithm>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/measuring_method.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice features977[] = {{1, "hole"}, {2, "circular spigot"},    {3, "groove"},
                                  {4, "rib"},  {5, "rectangular pocket"}, {6, "rectangular spigot"}};
constexpr CodeDigit variant977[] = {{1, 1, "feature", features977},
                                    {3, 1, "task", parameters::measureOrCorrect},
                                    {4, 1, "protection zone", parameters::protectionZone},
                                    {5, 1, "method", parameters::method}};

/// The tens are of versions newer than 4.4; they and the two arguments that belong to them are known from the calls
/// that programs have. Their names are not published.
constexpr Choice centres977[] = {{0, "centre where the cycle starts"}, {1, "centre at S_POS1, S_POS2"}};
constexpr CodeDigit mode977[] = {{1, 1, "tolerance", parameters::withTolerance}, {2, 1, "set position", centres977}};

constexpr Parameter parameters977[] = {
    parameters::variant(variant977),
    parameters::zeroOffset(1),
    parameters::toolToCorrect(2),
    parameters::dataSet(3),
    parameters::length(4, "S_SETV", "set value of the diameter or width"),
    parameters::length(5, "S_SETV0", "set value of the rectangle's length in the 1st axis"),
    parameters::length(6, "S_SETV1", "set value of the rectangle's length in the 2nd axis"),
    parameters::measuringPath(7),
    parameters::safeArea(8),
    parameters::angle(9, "S_STA1", "angle between measuring axis and workpiece"),
    parameters::length(10, "S_ID", "infeed to the measuring height, with sign"),
    parameters::length(11, "S_SZA", "protection zone: diameter, width, or length in the 1st axis"),
    parameters::length(12, "S_SZO", "protection zone of a rectangle: length in the 2nd axis"),
    parameters::count<3>(13, "S_MA", "measuring axis of groove and rib: 1 or 2"),
    parameters::repetitions(14),
    parameters::toolName(15),
    parameters::dlNumber(16),
    parameters::zeroOffsetRange(17),
    parameters::dimensionalDifference(18),
    parameters::upperTolerance(19),
    parameters::lowerTolerance(20),
    parameters::meanRange(21),
    parameters::weight(22),
    parameters::memories(23),
    parameters::reserved(24),
    parameters::plane(25),
    parameters::coded(26, "_AMODE", "alternative mode", mode977),
    parameters::length(27, "S_POS1", "set position of the centre, 1st axis or measuring axis, with _AMODE = 10 and 11"),
    parameters::length(28, "S_POS2", "set position of the centre, 2nd axis, with _AMODE = 10 and 11"),
};

/// The measuring variants by the units of S_MVAR.
constexpr std::uint16_t hole = 1 << 1, spigot = 1 << 2, groove = 1 << 3, rib = 1 << 4, rectangles = 1 << 5 | 1 << 6;
constexpr std::uint16_t centred = hole | spigot | groove | rib;

constexpr auto results977 = joined(
    std::array<ResultDefinition, 38>{{
        {"_OVR[0]", {"set value: ", "diameter of the hole"}, result::set(of::diameter), hole},
        {"_OVR[0]", {"set value: ", "diameter of the spigot"}, result::set(of::diameter), spigot},
        {"_OVR[0]", {"set value: ", "width of the groove"}, result::set(of::width), groove},
        {"_OVR[0]", {"set value: ", "width of the rib"}, result::set(of::width), rib},
        {"_OVR[0]", {"set value: ", "length of the rectangle in the 1st axis"}, result::set(of::length1), rectangles},
        {"_OVR[1]", {"set value: ", "centre, 1st axis"}, result::set(of::centre1), centred},
        {"_OVR[1]", {"set value: ", "length of the rectangle in the 2nd axis"}, result::set(of::length2), rectangles},
        {"_OVR[2]", {"set value: ", "centre, 2nd axis"}, result::set(of::centre2), centred},
        {"_OVR[2]", {"set value: ", "centre of the rectangle, 1st axis"}, result::set(of::centre1), rectangles},
        {"_OVR[3]", {"set value: ", "centre of the rectangle, 2nd axis"}, result::set(of::centre2), rectangles},
        {"_OVR[4]", {"actual value: ", "diameter of the hole"}, result::actual(of::diameter).main(), hole},
        {"_OVR[4]", {"actual value: ", "diameter of the spigot"}, result::actual(of::diameter).main(), spigot},
        {"_OVR[4]", {"actual value: ", "width of the groove"}, result::actual(of::width).main(), groove},
        {"_OVR[4]", {"actual value: ", "width of the rib"}, result::actual(of::width).main(), rib},
        {"_OVR[4]",
         {"actual value: ", "length of the rectangle in the 1st axis"},
         result::actual(of::length1).main(),
         rectangles},
        {"_OVR[5]", {"actual value: ", "centre, 1st axis"}, result::actual(of::centre1).main(), centred},
        {"_OVR[5]",
         {"actual value: ", "length of the rectangle in the 2nd axis"},
         result::actual(of::length2).main(),
         rectangles},
        {"_OVR[6]", {"actual value: ", "centre, 2nd axis"}, result::actual(of::centre2).main(), centred},
        {"_OVR[6]",
         {"actual value: ", "centre of the rectangle, 1st axis"},
         result::actual(of::centre1).main(),
         rectangles},
        {"_OVR[7]",
         {"actual value: ", "centre of the rectangle, 2nd axis"},
         result::actual(of::centre2).main(),
         rectangles},
        {"_OVR[8]", "upper tolerance limit of the diameter", result::upperLimit(of::diameter), hole | spigot},
        {"_OVR[8]", "upper tolerance limit of the width", result::upperLimit(of::width), groove | rib},
        {"_OVR[8]", "upper tolerance limit of the rectangle's length in the 1st axis", result::upperLimit(of::length1),
         rectangles},
        {"_OVR[9]", "upper tolerance limit of the rectangle's length in the 2nd axis", result::upperLimit(of::length2),
         rectangles},
        {"_OVR[12]", "lower tolerance limit of the diameter", result::lowerLimit(of::diameter), hole | spigot},
        {"_OVR[12]", "lower tolerance limit of the width", result::lowerLimit(of::width), groove | rib},
        {"_OVR[12]", "lower tolerance limit of the rectangle's length in the 1st axis", result::lowerLimit(of::length1),
         rectangles},
        {"_OVR[13]", "lower tolerance limit of the rectangle's length in the 2nd axis", result::lowerLimit(of::length2),
         rectangles},
        {"_OVR[16]", {"difference: ", "diameter of the hole"}, result::difference(of::diameter), hole},
        {"_OVR[16]", {"difference: ", "diameter of the spigot"}, result::difference(of::diameter), spigot},
        {"_OVR[16]", {"difference: ", "width of the groove"}, result::difference(of::width), groove},
        {"_OVR[16]", {"difference: ", "width of the rib"}, result::difference(of::width), rib},
        {"_OVR[16]",
         {"difference: ", "length of the rectangle in the 1st axis"},
         result::difference(of::length1),
         rectangles},
        {"_OVR[17]", {"difference: ", "centre, 1st axis"}, result::difference(of::centre1), centred},
        {"_OVR[17]",
         {"difference: ", "length of the rectangle in the 2nd axis"},
         result::difference(of::length2),
         rectangles},
        {"_OVR[18]", {"difference: ", "centre, 2nd axis"}, result::difference(of::centre2), centred},
        {"_OVR[18]",
         {"difference: ", "centre of the rectangle, 1st axis"},
         result::difference(of::centre1),
         rectangles},
        {"_OVR[19]",
         {"difference: ", "centre of the rectangle, 2nd axis"},
         result::difference(of::centre2),
         rectangles},
    }},
    parameters::correctionResultsWithoutLimits);

enum class Feature { Hole = 1, Spigot, Groove, Rib, Pocket, RectangularSpigot };

bool isRectangle(Feature feature) { return feature == Feature::Pocket || feature == Feature::RectangularSpigot; }
bool isRound(Feature feature) { return feature == Feature::Hole || feature == Feature::Spigot; }

Side sideOf(Feature feature) {
  const bool inside = feature == Feature::Hole || feature == Feature::Groove || feature == Feature::Pocket;
  return inside ? Side::Inside : Side::Outside;
}

/// Two opposite walls, measured along one direction through a start point.
struct Pair {
  double size = 0;    ///< distance of the walls
  double middle = 0;  ///< of the walls, from the start point
};

/// Touches opposite walls from the height where the cycle started.
class Walls {
public:
  Walls(Context& context, Feature feature, Method method)
      : context_(context),
        side_(sideOf(feature)),
        toucher_(context, method),
        startHeight_(context.prober().position().z()),
        zone_(context.digit("S_MVAR", 4) == 1) {}

  /// Walls expected `size` apart about `centre`, across `along`; `zone`: width of the protection zone there.
  Pair measure(const PartPoint& centre, const PlaneWay& along, double size, double zone) {
    const double path = measuringPath(size, zone);
    const double upper = along.dot(touch(centre + along * size / 2, along * outwards(side_), path) - centre);
    const double lower = along.dot(touch(centre - along * size / 2, -along * outwards(side_), path) - centre);
    return {.size = upper - lower, .middle = (upper + lower) / 2};
  }

  /// Refuses a zone that leaves no room for the ball.
  void requireRoom(double size, double zone) { measuringPath(size, zone); }

  /// To the centre, at the height of the start.
  void finish(const PartPoint& centre) {
    toucher_.finish();
    context_.prober().moveInPlane(tipAt(centre));
  }

private:
  bool infeeds() const { return zone_ || side_ == Side::Outside; }

  /// S_FA, shortened where the way to the start position would enter the zone.
  double measuringPath(double size, double zone) {
    const double wanted = context_.real("S_FA");
    if (!zone_) return wanted;
    const double room = side_ == Side::Inside ? (size - zone) / 2 : (zone - size) / 2;
    const double longest = room - context_.prober().probe().ballDiameter;
    if (zone > 0 && longest <= 0) {
      context_.alarm(61334, fmt::format("{:.3f} mm between zone and wall leave no room for the ball", room));
    }
    return zone > 0 ? std::min(wanted, longest) : wanted;
  }

  PartPoint touch(PartPoint setpoint, const PlaneWay& direction, double path) {
    probing::SinumerikProber& prober = context_.prober();
    setpoint[2] = startHeight_ + (infeeds() ? context_.real("S_ID") : 0);
    if (infeeds()) {
      prober.moveInPlane(toucher_.startOf(setpoint, direction, path));
      prober.moveHeightTo(setpoint.z());
    }
    const MeasuredPoint point = toucher_.measure(setpoint, direction, path);
    if (infeeds()) prober.moveHeightTo(startHeight_);
    return point.surface;
  }

  Context& context_;
  Side side_;
  Toucher toucher_;
  double startHeight_;
  bool zone_;
};

constexpr Requirement requirements[] = {
    {"S_SETV", Need::Positive, variant::units<1, 2, 3, 4>}, {"S_SETV0", Need::Positive, variant::units<5, 6>},
    {"S_SETV1", Need::Positive, variant::units<5, 6>},      {"S_MA", Need::NotZero, variant::units<3, 4>},
    {"S_MA", Need::Within, variant::units<3, 4>, 1, 2},
};

/// The ball must fit between zone and wall; its size is known to the run only.
void zones(CallCombinations& call) {
  const int feature = call.digit(1);
  const bool inside = feature == 1 || feature == 3 || feature == 5;
  const auto check = [&](std::string_view size, std::string_view zone) {
    const auto set = call.number(size), width = call.number(zone);
    if (!set || !width || *width <= 0) return;
    if (inside ? *width < *set : *width > *set) return;
    call.refuse(zone, fmt::format("{} = {}: the protection zone leaves no room {} the set size {}", zone,
                                  formatShortest(*width), inside ? "within" : "around", formatShortest(*set)));
  };
  if (feature <= 4) return check("S_SETV", "S_SZA");
  check("S_SETV0", "S_SZA");
  check("S_SETV1", "S_SZO");
}

void setPosition(CallCombinations& call) {
  const auto mode = call.number("_AMODE");
  if (!mode || variant::digit(truncated(std::abs(*mode)), 2) == 1) return;
  for (const std::string_view name : {"S_POS1", "S_POS2"})
    if (const auto value = call.number(name); value && *value != 0)
      return call.warn(
          name, fmt::format("{} = {} is not observed: the tens of _AMODE are not 1", name, formatShortest(*value)));
}

void combinations(CallCombinations& call) {
  if (call.digit(4) == 1) zones(call);
  setPosition(call);
}

int oldForm(OldCall& call) {
  call.nothingFrom(5);
  if (call.digit(2) != 0 || call.digit(4) > 1) call.refuseVariant();
  call.setValues(2);
  return call.digit(1) + call.task(OldCall::Corrects::AlsoTools) + call.digit(4) * 1000;
}

constexpr TitleSize titleSizes[] = {{"S_SETV", 0b1'1110}, {"S_SETV0", 0b110'0000}, {"S_SETV1", 0b110'0000}};

constexpr Example examples[] = {
    {"S_MVAR", 1},  // a hole
    {"S_SETV", 30},
};

constexpr CycleDefinition definition = {
    .number = 977,
    .name = "CYCLE977",
    .title = "Hole, spigot, groove, rib, rectangle",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures size and centre of a hole, spigot, groove, rib, rectangular pocket or spigot by touches across "
        "the axes of the plane, and corrects the zero offset so that the centre lies where the cycle started "
        "or where the call says, or the tool.",
    .parameters = parameters977,
    .results = results977,
    .controls = control::onSinumerik,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  const int units = context.digit("S_MVAR", 1);
  if (units < 1 || units > 6 || context.digit("S_MVAR", 4) > 1) context.alarm(61307);
  const auto feature = static_cast<Feature>(units);
  if (feature == Feature::Hole) {
    context.requireProbe({710, 712, 714, 580});
  } else {
    context.requireProbe({710, 712, 580});
  }
  const Task task = taskOf(context);
  const Method method = methodOf(context);
  requireCalibrationFor(context, method);
  const bool oneAxis = feature == Feature::Groove || feature == Feature::Rib;
  const int axis = oneAxis ? context.measuringAxis(2) : 0;
  const auto target = task == Task::ZeroOffset ? frameTarget(context, GlobalBase::Allowed) : std::nullopt;

  // Where the probe stands is the set position of the centre, unless the call names another.
  const PartPoint start = partAt(context.prober().position());
  PartPoint setCentre = start;
  if (context.digit("_AMODE", 2) == 1) {
    setCentre[oneAxis ? axis : 0] = context.real("S_POS1");
    if (!oneAxis) setCentre[1] = context.real("S_POS2");
  }
  const PlaneWay first = probing::directionAt(context.real("S_STA1") + (axis == 1 ? 90 : 0));
  const PlaneWay second = probing::directionAt(context.real("S_STA1") + 90);
  const double set1 = setValueOf(context, task, context.real(isRectangle(feature) ? "S_SETV0" : "S_SETV"));
  const double set2 = isRectangle(feature) ? setValueOf(context, task, context.real("S_SETV1")) : set1;
  if (!(set1 > 0) || !(set2 > 0))
    context.alarm(61319, isRectangle(feature) ? "S_SETV0 and S_SETV1, the set lengths, must be greater than 0"
                                              : "S_SETV, the set size, must be greater than 0");

  Walls walls(context, feature, method);
  const double zone1 = context.real("S_SZA"), zone2 = isRectangle(feature) ? context.real("S_SZO") : zone1;
  walls.requireRoom(set1, zone1);
  if (!oneAxis) walls.requireRoom(set2, zone2);
  const Pair pair1 = walls.measure(start, first, set1, zone1);
  PartPoint centre = start + first * pair1.middle;
  Pair pair2;
  if (!oneAxis) {
    walls.finish(centre);
    pair2 = walls.measure(centre, second, set2, zone2);
    centre += second * pair2.middle;
  }
  walls.finish(centre);

  // A chord beside the middle is too short: the diameter is the one through the centre.
  const double size1 = isRound(feature) ? pair2.size : pair1.size;
  const Side side = sideOf(feature);
  const double empirical = task == Task::Tool ? empiricalValue(context) : 0;
  const auto report = [&context](int element, double set, double actual, const Compared& compared, double off = 0) {
    context.result(element, set);
    context.result(4 + element, actual, compared);
    context.result(16 + element, actual - set - off);
  };
  int element = 0;
  report(element++, set1, size1, comparedSize(context, task, set1, size1, side), empirical);
  if (isRectangle(feature)) {
    report(element++, set2, pair2.size, comparedSize(context, task, set2, pair2.size, side), empirical);
  }
  report(element++, setCentre.x(), centre.x(), {.nominal = setCentre.x()});
  report(element, setCentre.y(), centre.y(), {.nominal = setCentre.y()});
  context.noteCall();

  context.checkSafeArea(size1 - set1 - empirical);
  if (isRectangle(feature)) context.checkSafeArea(pair2.size - set2 - empirical);
  if (task == Task::ZeroOffset) {
    context.checkSafeArea(first.dot(centre - setCentre));
    if (!oneAxis) context.checkSafeArea(second.dot(centre - setCentre));
  }

  if (target) {
    const PlaneWay directions[] = {first, second};
    correctTranslation(context, *target, machinePoint(context, centre), setCentre,
                       std::span(directions).first(oneAxis ? 1 : 2));
    context.result(28, context.real("S_TSA"));
  }
  if (task == Task::Tool) {
    const Dimension dimensions[] = {{.set = set1, .actual = size1},
                                    {.set = set2, .actual = pair2.size, .upperResult = 9, .lowerResult = 13}};
    correctTool(context, std::span(dimensions).first(isRectangle(feature) ? 2 : 1), influenceOnSize(side, axis));
  }
}

}  // namespace

extern const Entry cycle977 = {.definition = definition,
                               .title = {.byFeature = true, .sizes = titleSizes},
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .run = run};

}  // namespace probewright::cycles::sinumerik
