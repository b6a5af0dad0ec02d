#include "conversion/sinumerik_tasks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "conversion/meanings.hpp"

/// Measuring cycles of a SINUMERIK read as measuring tasks.
namespace probewright::conversion {

namespace {

Feature feature977(int units) {
  if (units < 1 || units > static_cast<int>(features977.size())) {
    throw NotCarriedOver("this variant of CYCLE977 (S_MVAR) is not known");
  }
  return features977[static_cast<std::size_t>(units - 1)];
}

constexpr double leastCornerPath = 20;  ///< CYCLE961 measures over at least that, mm

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

class Reader {
public:
  Reader(const Call& call, const Place& start, const Quantity& ballRadius, Losses& losses)
      : call_(call), start_(start), ballRadius_(ballRadius), losses_(losses) {}

  MeasuringTask task() {
    if (!(number("S_PRNUM") == 0) && !(number("S_PRNUM") == 1))
      losses_.push_back("S_PRNUM: a touch probe measures with the calibration data of its tool, which are one set");
    if (const Quantity touches = number("S_NMSP"); !touches.isNumber() || touches.number() > 1)
      losses_.push_back("S_NMSP: each point is measured once");
    if (call_.cycle == "CYCLE977") return cycle977();
    if (call_.cycle == "CYCLE978") return cycle978();
    if (call_.cycle == "CYCLE979") return cycle979();
    if (call_.cycle == "CYCLE998") return cycle998();
    if (call_.cycle == "CYCLE961") return cycle961();
    if (call_.cycle == "CYCLE976") return cycle976();
    throw NotCarriedOver(fmt::format("{} has no twin on a HEIDENHAIN control", call_.cycle),
                         "docs/conversion.md lists the cycles that both controls have");
  }

private:
  Quantity number(std::string_view name) const { return call_.number(name); }
  /// The measuring direction: S_MD, or where that is 0 or left out, the sign of the way to the set value.
  int direction(const Quantity& toSetValue) const {
    const int way = call_.integer("S_MD");
    if (way != 0) return way == 1 ? 1 : -1;
    if (!toSetValue.isNumber()) {
      throw NotCarriedOver(
          fmt::format("the measuring direction of {} is known only when the program runs", call_.cycle),
          "write S_MD there: 1 plus, 2 minus");
    }
    return toSetValue.number() > 0 ? 1 : -1;
  }
  double known(std::string_view name) const {
    const Quantity value = number(name);
    if (!value.isNumber()) {
      throw NotCarriedOver(fmt::format("{} of {} is known only when the program runs", name, call_.cycle),
                           "write a number there, or convert this call by hand");
    }
    return value.number();
  }

  /// From one coordinate to another; if they differ by the ball's radius, as near as a common ball lets it be known.
  double distance(const Quantity& from, const Quantity& to) const {
    const double commonRadius = 2 * call_.millimetre;
    const Quantity way = to - from;
    double length = way.number();
    for (const Quantity::Term& term : way.terms()) {
      if (ballRadius_.terms().empty() || term.expression != ballRadius_.terms().front().expression) {
        throw NotCarriedOver(fmt::format("how the points of {} lie is known only when the program runs", call_.cycle),
                             "write numbers there, or convert this call by hand");
      }
      length += term.factor * commonRadius;
    }
    return length;
  }

  MeasuringTask begun(Feature feature) {
    MeasuringTask task;
    task.feature = feature;
    task.millimetre = call_.millimetre;
    task.place = start_;
    task.place[2] = start_[2] + ballRadius_;
    task.clearance = start_[2];
    task.path = task.beyond = number("S_FA");
    correction(task);
    if (call_.cycle != "CYCLE961" && call_.digit("S_MVAR", 5) != 0) {
      losses_.push_back("S_MVAR: the probe measures as it was calibrated, without turning the spindle");
    }
    const double leastPath = call_.probe.setUp * call_.millimetre;
    if (task.path.isNumber() && task.path.number() < leastPath - 1e-6) {
      losses_.push_back(fmt::format(
          "S_FA: the touch begins SET_UP of the touch probe table in front of the surface; {} is taken for it",
          numberText(leastPath)));
    }
    // CYCLE978 and CYCLE998 take the empirical value off what corrects a zero offset, too.
    const bool empirical =
        task.tool || (task.correction != Correction::None &&
                      (feature == Feature::Surface || feature == Feature::Edge || feature == Feature::Plane));
    if (empirical && !(number("S_EVNUM") == 0))
      losses_.push_back("S_EVNUM: neither empirical nor mean values are kept");
    return task;
  }

  void correction(MeasuringTask& task) {
    const int kind = call_.digit("S_MVAR", 3);
    if (kind == 2) return correctedTool(task);
    if (kind != 1 || number("S_KNUM") == 0) return;
    const int code = call_.integer("S_KNUM");
    const int which = code / 1000 % 10;
    if (code % 1000 == 0 && code >= 0 && code < 20000 && which != 2 && which != 9) return;  // no number, no correction
    task.correction = Correction::Origin;
    if (which == 9) {
      task.active = true;
    } else if (which == 0 && code % 1000 >= 1 && code % 1000 <= 99) {
      task.row = code % 1000;
    } else {
      throw NotCarriedOver(
          fmt::format("S_KNUM = {} corrects a base or system frame, which a HEIDENHAIN control does not have", code),
          "correct a settable zero offset: S_KNUM = 10001 is G54");
    }
  }

  /// The tool of S_KNUM1 and S_TNAME.
  void correctedTool(MeasuringTask& task) {
    const int code = call_.integer("S_KNUM1");
    if (code == 0) return;
    const int component = call_.digit("S_KNUM1", 6), memory = call_.digit("S_KNUM1", 7);
    const bool alongTool = task.feature == Feature::Surface && call_.integer("S_MA") == 3;
    const std::string tool = call_.text("S_TNAME");
    if (tool.empty()) {
      losses_.push_back("S_TNAME: the tool to correct is not named here, none is corrected");
    } else if (code % 100000 != 1) {
      losses_.push_back("S_KNUM1: touch probe cycles correct the first edge of a tool only, none is corrected");
    } else if (call_.digit("S_KNUM1", 8) == 1) {
      losses_.push_back("S_KNUM1: no tool is corrected with the opposite sign");
    } else if (component != 0 && component != (alongTool ? 1 : 4)) {
      losses_.push_back("S_KNUM1: touch probe cycles correct the radius, along the tool its length; none is corrected");
    } else if (memory != 0 && memory != 4) {
      losses_.push_back("S_KNUM1: tool tables have no additive and setup offsets, none is corrected");
    } else {
      if (memory == 4) losses_.push_back("S_KNUM1: the wear (DR, DL) is corrected instead of the geometry");
      task.tool = {.tool = tool, .least = number("S_TZL"), .most = number("S_TDIF")};
    }
  }

  /// With a tolerance the set value of a tool correction is its middle.
  void tolerate(MeasuringTask& task) const {
    if (call_.digit("S_MVAR", 3) != 2 || call_.digit("_AMODE", 1) != 1) return;
    const Quantity upper = number("S_TUL"), lower = number("S_TLL");
    const Limits limits{(upper - lower) / 2, (lower - upper) / 2};
    for (std::size_t i = 0; i < (isRectangular(task.feature) ? 2U : 1U); ++i) {
      task.size[i] = task.size[i] + (upper + lower) / 2;
      task.limits[i] = limits;
    }
    // Beyond the tolerance every difference corrects.
    if (task.tool && task.tool->least.number() > limits.upper.number()) task.tool->least = limits.upper;
    if (task.feature == Feature::Surface) task.place[static_cast<std::size_t>(task.axis)] = task.size[0];
  }

  MeasuringTask cycle977() {
    if (call_.digit("_AMODE", 2) == 1)
      throw NotCarriedOver("_AMODE of CYCLE977 names another set position of the centre than the start");
    MeasuringTask task = begun(feature977(call_.digit("S_MVAR", 1)));
    const bool zone = call_.digit("S_MVAR", 4) == 1;
    if (zone || !isInside(task.feature)) {
      task.place[2] = task.place[2] + number("S_ID");
      task.clearanceBetween = true;
    }
    task.size = {number(isRectangular(task.feature) ? "S_SETV0" : "S_SETV"), number("S_SETV1")};
    tolerate(task);
    task.angle = number("S_STA1");
    task.step = 90;
    if (isWidth(task.feature)) task.axis = call_.integer("S_MA") - 1;
    if (task.axis < 0 || task.axis > 1) throw NotCarriedOver("S_MA of CYCLE977 is 1 or 2");
    if (!isRound(task.feature) && !(task.angle == 0)) {
      throw NotCarriedOver("S_STA1: HEIDENHAIN cycles measure this feature along the axes only",
                           "turn the coordinate system before the cycle");
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (isWidth(task.feature) && i != static_cast<std::size_t>(task.axis)) continue;
      if (task.correction == Correction::Origin) task.wish[i] = task.place[i];
    }
    return task;
  }

  MeasuringTask cycle978() {
    MeasuringTask task = begun(Feature::Surface);
    task.axis = call_.integer("S_MA") - 1;
    if (task.axis < 0 || task.axis > 2) throw NotCarriedOver("S_MA of CYCLE978 is 1, 2 or 3");
    const auto axis = static_cast<std::size_t>(task.axis);
    task.sign = direction(number("S_SETV") - start_[axis]);
    task.place[axis] = task.size[0] = number("S_SETV");
    tolerate(task);
    if (task.correction == Correction::Origin) task.wish[axis] = task.place[axis];
    if (task.axis == 2 && task.sign > 0) throw NotCarriedOver("a touch from below is not converted");
    return task;
  }

  MeasuringTask cycle979() {
    MeasuringTask task = begun(call_.digit("S_MVAR", 1) == 2 ? Feature::SpigotSegment : Feature::HoleSegment);
    task.place[0] = number("S_CPA");
    task.place[1] = number("S_CPO");
    task.size[0] = number("S_SETV");
    tolerate(task);
    task.angle = number("S_STA1");
    task.step = number("S_INCA");
    task.touches = call_.digit("S_MVAR", 4) == 1 ? 4 : 3;
    if (task.correction == Correction::Origin) task.wish = {task.place[0], task.place[1], std::nullopt};
    return task;
  }

  /// With a protection zone, the way from the start height to the part, whatever its sign.
  Quantity wayDown(std::string_view name) const {
    if (call_.digit("S_MVAR", 4) != 1) return 0;
    const Quantity way = number(name);
    return way.number() < 0 ? -way : way;
  }

  MeasuringTask cycle998() { return call_.digit("S_MVAR", 1) == 6 ? plane() : edge(); }

  /// CYCLE998 looks for further points about the first one, and farther by what the safe area permits.
  void lookFarther(MeasuringTask& task, double distance) const {
    if (call_.digit("S_MVAR", 6) == 1) return;  // from the start position of the first one
    constexpr double mostAngle = 45;
    const double farther = distance * std::tan(radians(std::min(std::abs(known("S_TSA")), mostAngle)));
    task.path = task.path + farther;
    task.beyond = task.beyond + farther;
  }

  MeasuringTask edge() {
    MeasuringTask task = begun(Feature::Edge);
    if (call_.digit("S_MVAR", 4) == 1) losses_.push_back("S_MVAR: no protection zone");
    const int code = call_.integer("S_MA");
    task.axis = code % 10 - 1;
    task.along = code / 100 - 1;
    if (task.axis < 0 || task.axis > 2 || task.along < 0 || task.along > 1 || task.axis == task.along) {
      throw NotCarriedOver(fmt::format("S_MA = {}: HEIDENHAIN cycles do not measure that way", code));
    }
    const auto axis = static_cast<std::size_t>(task.axis);
    // With a protection zone S_SETV is a way from where the probe stands.
    const bool zone = call_.digit("S_MVAR", 4) == 1;
    task.sign = direction(zone ? number("S_SETV") : number("S_SETV") - start_[axis]);
    if (task.axis == 2 && task.sign > 0) throw NotCarriedOver("a touch from below is not converted");
    const auto along = static_cast<std::size_t>(task.along);
    task.place = start_;
    task.place[2] = task.axis == 2 ? start_[2] : start_[2] + ballRadius_;
    task.place[axis] =
        start_[axis] + (task.path + (axis == 2 ? Quantity() : ballRadius_) + wayDown("S_SETV")) * task.sign;
    const Quantity set = number("S_STA1");
    task.further = {task.place};
    task.further[0][along] = task.further[0][along] + number("S_ID");
    if (call_.digit("S_MVAR", 6) != 1 && !(set == 0)) {
      const bool against = (task.axis == 0 && task.along == 1) || (task.axis == 2 && task.along == 0);
      const double slope = std::tan(radians(known("S_STA1"))) * (against ? -1 : 1);
      task.further[0][axis] = task.further[0][axis] + number("S_ID") * slope;
    }
    lookFarther(task, known("S_ID"));
    task.angle = task.axis == 0 ? set + 90 : set;
    if (task.correction == Correction::Origin) {
      const bool rotary = call_.integer("S_RA") != 0;
      if (rotary && task.axis == 2) throw NotCarriedOver("S_RA: only the axis about the tool axis is corrected");
      task.correction = rotary ? Correction::RotaryAxis : Correction::Rotation;
    }
    return task;
  }

  MeasuringTask plane() {
    MeasuringTask task = begun(Feature::Plane);
    task.clearanceBetween = call_.digit("S_MVAR", 4) == 1;
    task.place[2] = start_[2] - task.path - wayDown("S_SETV");
    task.sign = -1;
    if (task.correction == Correction::Origin) task.correction = Correction::Rotation;
    task.further = {task.place, task.place};
    task.further[0][0] = task.place[0] + number("S_SETV0");
    task.further[1][0] = task.place[0] + number("S_SETV2");
    task.further[1][1] = task.place[1] + number("S_SETV3");
    const bool level = number("S_STA1") == 0 && number("S_INCA") == 0;
    if (!level && call_.digit("S_MVAR", 6) != 1) {
      const double first = radians(known("S_STA1")), second = radians(known("S_INCA"));
      // Turned about the 2nd axis, then about the 1st.
      const double nx = std::cos(first) * std::sin(second), ny = -std::sin(first),
                   nz = std::cos(first) * std::cos(second);
      for (Place& point : task.further) {
        point[2] = point[2] - (point[0] - task.place[0]) * (nx / nz) - (point[1] - task.place[1]) * (ny / nz);
      }
    }
    lookFarther(task, std::max(known("S_SETV0"), std::hypot(known("S_SETV2"), known("S_SETV3"))));
    return task;
  }

  MeasuringTask cycle961() {
    const int units = call_.digit("S_MVAR", 1);
    const bool rightAngled = units == 5 || units == 6;  // three points
    const bool inside = units == 5 || units == 7;
    MeasuringTask task = begun(inside ? Feature::InsideCorner : Feature::OutsideCorner);
    if (rightAngled && task.correction != Correction::None) {
      throw NotCarriedOver("HEIDENHAIN cycles set a preset at a corner by two points on each edge",
                           "measure it with four points (S_MVAR units 7 or 8) before converting");
    }
    const auto value = [this](int i) { return number(fmt::format("S_SETV{}", i)); };
    std::array<std::array<Quantity, 2>, 4> starts;
    if (call_.digit("S_MVAR", 2) == 1) {
      for (std::size_t i = 0; i < 4; ++i)
        starts[i] = {value(static_cast<int>(2 * i)), value(static_cast<int>(2 * i + 1))};
    } else {
      const double first = radians(known("S_STA1")), second = first + radians(rightAngled ? 90 : known("S_INCA"));
      const int corner = call_.digit("S_MVAR", 5);
      for (int i = 0; i < 4; ++i) {
        const bool backwards = i < 2 ? corner == 2 || corner == 3 : corner == 3 || corner == 4;
        double length = known(fmt::format("S_SETV{}", i));
        if (backwards) length = -std::abs(length);
        if (i == 2 && length == 0 && rightAngled) length = known("S_SETV3") / 2;
        if (i == 0 && length == 0) length = (backwards ? -std::abs(known("S_SETV1")) : known("S_SETV1")) / 2;
        const double angle = i < 2 ? first : second;
        starts[static_cast<std::size_t>(i)] = {value(4) + length * std::cos(angle),
                                               value(5) + length * std::sin(angle)};
      }
    }
    if (rightAngled) starts[3] = starts[2];
    constexpr double parallel = 1e-6;
    if (std::abs(distance(starts[0][1], starts[1][1])) > parallel ||
        std::abs(distance(starts[2][0], starts[3][0])) > parallel) {
      throw NotCarriedOver("HEIDENHAIN cycles measure corners whose edges run along the axes",
                           "turn the coordinate system before the cycle");
    }
    if (distance(starts[0][0], starts[1][0]) < 0) {
      throw NotCarriedOver("the first edge becomes the negative main axis, which HEIDENHAIN cycles do not do",
                           "let the first edge run in the positive direction");
    }
    // The pole is where the start positions' lines meet; from there the edges run towards the points.
    const Quantity pole1 = starts[2][0], pole2 = starts[0][1];
    const std::array apart = {distance(pole1, starts[0][0]), distance(pole1, starts[1][0]),
                              distance(pole2, starts[2][1]), distance(pole2, starts[3][1])};
    const int side = inside ? -1 : 1;
    task.sign = side * (apart[2] + apart[3] > 0 ? 1 : -1);
    task.secondSign = side * (apart[0] + apart[1] > 0 ? 1 : -1);
    // The edges are taken to lie within S_FA, but not so far that the points would lie on the other side of a corner.
    double nearest = std::abs(apart[0]);
    for (const double each : apart)
      if (std::abs(each) > parallel) nearest = std::min(nearest == 0 ? std::abs(each) : nearest, std::abs(each));
    task.path = std::min(std::max(known("S_FA"), leastCornerPath * call_.millimetre), nearest / 2);
    const double asked = known("S_FA");
    task.beyond = Quantity(2 * (rightAngled ? asked : std::max(asked, leastCornerPath * call_.millimetre))) - task.path;
    const Quantity height = task.place[2] - wayDown("S_ID");
    task.clearanceBetween = call_.digit("S_MVAR", 4) == 1;
    const Quantity edge1 = pole2 + (task.path + ballRadius_) * task.sign;
    const Quantity edge2 = pole1 + (task.path + ballRadius_) * task.secondSign;
    task.place = {starts[0][0], edge1, height};
    task.further = {{starts[1][0], edge1, height}, {edge2, starts[2][1], height}, {edge2, starts[3][1], height}};
    if (rightAngled) task.further.pop_back();
    if (task.correction != Correction::None) {
      task.correction = Correction::OriginAndRotation;
      task.wish = {number("S_SETV8"), number("S_SETV9"), std::nullopt};
    }
    return task;
  }

  MeasuringTask cycle976() {
    MeasuringTask task;
    task.millimetre = call_.millimetre;
    task.path = task.beyond = number("S_FA");
    const int body = call_.digit("S_MVAR", 1);
    if (body != 0 && call_.digit("S_MVAR", 5) != 0)
      losses_.push_back("S_MVAR: touch probe cycles calibrate the positional deviation of the ball, too");
    switch (body) {
      case 0:
        if (call_.digit("S_MVAR", 7) != 1 || call_.integer("S_MA") != 3 || call_.integer("S_MD") != 1) {
          throw NotCarriedOver("this calibration has no twin on a HEIDENHAIN control");
        }
        task.feature = Feature::ProbeLength;
        task.place[2] = number("S_SETV");
        break;
      case 1:
      case 2:
        if (body == 1 && call_.digit("S_MVAR", 4) != 0)
          throw NotCarriedOver("touch probe cycles calibrate in all directions of a ring",
                               "calibrate with 0 in the thousands of S_MVAR");
        task.feature = Feature::ProbeInRing;
        break;
      case 3:
        task.feature = Feature::ProbeOnBall;
        task.calibratesLength = call_.digit("S_MVAR", 7) == 1;
        task.place[2] = number("S_SETV0") - number("S_SETV") / 2;
        break;
      default:
        throw NotCarriedOver("a HEIDENHAIN control does not calibrate at an edge");
    }
    task.size[0] = number("S_SETV");
    if (call_.digit("S_MVAR", 6) == 1) task.angle = number("S_STA1");
    return task;
  }

  const Call& call_;
  const Place& start_;
  Quantity ballRadius_;
  Losses& losses_;
};

}  // namespace

MeasuringTask sinumerikTask(const Call& call, const Place& start, const Quantity& ballRadius, Losses& losses) {
  return Reader(call, start, ballRadius, losses).task();
}

std::array<std::optional<Quantity>, 3> sinumerikEnd(const Call& call, const MeasuringTask& task, const Place& start,
                                                    const Quantity& ballRadius, const Results& results) {
  std::array<std::optional<Quantity>, 3> end = {start[0], start[1], start[2]};
  const auto measured = [&](Meaning meaning) -> std::optional<Quantity> {
    const auto found = results.find(meaning);
    return found == results.end() ? std::nullopt : std::optional(Quantity::of(found->second));
  };
  const auto axis = static_cast<std::size_t>(task.axis);
  if (call.cycle == "CYCLE977") {
    // In the middle of the feature, at the height of the start.
    if (isWidth(task.feature)) {
      end[axis] = measured(Meaning::Coordinate);
    } else {
      end[0] = measured(Meaning::Centre1);
      end[1] = measured(Meaning::Centre2);
    }
  } else if (task.feature == Feature::Surface) {
    end[axis] = task.place[axis] - (task.path + (axis == 2 ? Quantity() : ballRadius)) * task.sign;
  } else {
    end = {};
  }
  return end;
}

namespace {

/// The cycle that measures a feature, and the units of its S_MVAR.
struct Measurement {
  const char* cycle;
  int units;
};

std::optional<Measurement> measurementOf(Feature feature) {
  const auto among977 = std::ranges::find(features977, feature);
  if (among977 != features977.end())
    return Measurement{"CYCLE977", 1 + static_cast<int>(among977 - features977.begin())};
  switch (feature) {
    case Feature::HoleSegment:
      return Measurement{"CYCLE979", 1};
    case Feature::SpigotSegment:
      return Measurement{"CYCLE979", 2};
    case Feature::Surface:
      return Measurement{"CYCLE978", 0};
    case Feature::Edge:
      return Measurement{"CYCLE998", 5};
    case Feature::Plane:
      return Measurement{"CYCLE998", 6};
    case Feature::InsideCorner:
      return Measurement{"CYCLE961", 7};
    case Feature::OutsideCorner:
      return Measurement{"CYCLE961", 8};
    default:
      return std::nullopt;
  }
}

}  // namespace

Results sinumerikResults(const MeasuringTask& task) {
  const auto measurement = measurementOf(task.feature);
  if (!measurement) return {};
  Results results = resultsOf(*cycles::sinumerikCycle(measurement->cycle), measurement->units);
  if (isWidth(task.feature)) {
    // Of the centre only the coordinate across groove or rib is measured.
    const bool first = task.axis == 0;
    results[Meaning::Coordinate] = results.at(first ? Meaning::Centre1 : Meaning::Centre2);
    results[Meaning::CoordinateDeviation] = results.at(first ? Meaning::Centre1Deviation : Meaning::Centre2Deviation);
    for (const Meaning centre :
         {Meaning::Centre1, Meaning::Centre2, Meaning::Centre1Deviation, Meaning::Centre2Deviation})
      results.erase(centre);
  }
  return results;
}

Quantity sinumerikEdgeAngle(const MeasuringTask& task, const Quantity& angle) {
  Quantity counted = task.axis == 0 ? angle - 90 : angle;
  if (!counted.isNumber()) return counted;
  return std::remainder(counted.number(), 180.0);
}

}  // namespace probewright::conversion
