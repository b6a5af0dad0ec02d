#include "conversion/heidenhain_tasks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "cycles/heidenhain/probe_words.hpp"

/// Touch probe cycles read as measuring tasks.
namespace probewright::conversion {

namespace {

class Reader {
public:
  Reader(const Call& call, const Quantity& ballRadius, Losses& losses)
      : call_(call), ballRadius_(ballRadius), losses_(losses) {}

  std::vector<MeasuringTask> tasks() {
    const int number = std::atoi(call_.cycle.c_str());
    for (const CentredCycles& each : centredCycles)
      if (number == each.preset || number == each.inspection) return centred(each.feature, number == each.preset);
    switch (number) {
      case 400:
        return {edge(Correction::Rotation)};
      case 403:
        return {edge(Correction::None)};
      case 420:
        return {angle()};
      case 401:
      case 402:
        return {pair(number == 401 ? Feature::HolePair : Feature::SpigotPair)};
      case 416:
        return preset(boltCircle(), {331, 332});
      case 418:
        return preset(holes(Feature::HoleDiagonals, {268, 270, 316, 318}), {331, 332});
      case 430:
        return inspectedBoltCircle();
      case 414:
        return preset(outsideCorner(), {331, 332});
      case 415:
        return preset(insideCorner(), {331, 332});
      case 417:
        return {presetSurface(surface(294, 2, -1))};
      case 419:
        return {presetSurface(surface(261, axisOf(272, 3), option(267)))};
      case 427:
        return inspection(surface(261, axisOf(272, 3), option(267)), {{288, 289}});
      case 431:
        return {plane()};
      case 1410:
        return {alignedEdge()};
      case 1420:
        return {alignedPlane()};
      case 9:
        return {lengthOnSurface()};
      case 460:
        return {calibration(Feature::ProbeOnBall)};
      case 461:
        return {calibration(Feature::ProbeLength)};
      case 462:
        return {calibration(Feature::ProbeInRing)};
      default:
        throw NotCarriedOver(fmt::format("touch probe cycle {} has no twin on a SINUMERIK", call_.cycle),
                             "docs/conversion.md lists the cycles that both controls have");
    }
  }

private:
  struct LimitNumbers {
    int upper = 0, lower = 0;
  };

  static std::string nameOf(int number) { return fmt::format("Q{}", number); }
  Quantity q(int number) const { return call_.number(nameOf(number)); }
  int option(int number) const { return call_.integer(nameOf(number)); }
  /// The axis that a parameter names, from 0.
  int axisOf(int number, int most) const {
    const int code = std::abs(option(number));
    if (code < 1 || code > most) throw NotCarriedOver(fmt::format("Q{} = {} names no axis", number, option(number)));
    return code - 1;
  }
  bool asked(int number) const {
    if (!call_.has(nameOf(number))) return false;
    if (!q(number).isNumber()) throw NotCarriedOver(fmt::format("Q{} is known only when the program runs", number));
    return !(q(number) == 0);
  }

  enum class Alone { Each, Both };
  /// The limits of a size as its cycle takes them: 0 and 0 are none. 0 alone is a limit of a coordinate (Both), but
  /// none of a size (Each).
  std::optional<Limits> limitsOf(int upper, int lower, const Quantity& size, Alone none = Alone::Each) const {
    const Quantity most = q(upper), least = q(lower);
    if (most == 0 && least == 0) return std::nullopt;
    Limits limits{most - size, least - size};
    if (none == Alone::Each && most == 0) limits.upper = unlimited;
    if (none == Alone::Each && least == 0) limits.lower = -unlimited;
    if (none == Alone::Each) {
      if (!most.isNumber()) limits.upperUnlessZero = {most};
      if (!least.isNumber()) limits.lowerUnlessZero = {least};
      return limits;
    }
    const auto isSet = [](const Quantity& each) { return each.isNumber() && !(each == 0); };
    if (isSet(most) || isSet(least)) return limits;
    for (const Quantity& each : {most, least})
      if (!each.isNumber()) limits.upperUnlessZero.push_back(each);
    limits.lowerUnlessZero = limits.upperUnlessZero;
    return limits;
  }

  /// Heights and way of approach, which nearly all cycles have.
  MeasuringTask begun(Feature feature) const {
    MeasuringTask task;
    task.feature = feature;
    task.millimetre = call_.millimetre;
    task.path = q(320) + call_.probe.setUp * call_.millimetre;
    task.beyond = Quantity(call_.probe.travel * call_.millimetre) - task.path;
    task.clearance = q(260);
    task.place[2] = q(261);
    task.clearanceBetween = call_.has("Q301") && option(301) == 1;
    return task;
  }

  MeasuringTask circle(Feature feature, int centre) const {
    MeasuringTask task = begun(feature);
    task.place[0] = q(centre);
    task.place[1] = q(centre + 1);
    task.size[0] = q(262);
    task.angle = q(325);
    task.step = q(247);
    task.touches = call_.has("Q423") ? option(423) : 4;
    const bool square = task.touches == 4 && task.step.isNumber() && std::abs(task.step.number()) == 90;
    if (!square) task.feature = isInside(feature) ? Feature::HoleSegment : Feature::SpigotSegment;
    return task;
  }

  MeasuringTask rectangle(Feature feature, int centre, int length) const {
    MeasuringTask task = begun(feature);
    for (int i = 0; i < 2; ++i) {
      task.place[static_cast<std::size_t>(i)] = q(centre + i);
      task.size[static_cast<std::size_t>(i)] = q(length + i);
    }
    return task;
  }

  MeasuringTask width(Feature feature, int first, int second) const {
    MeasuringTask task = begun(feature);
    task.place[0] = q(first);
    task.place[1] = q(second);
    task.size[0] = q(311);
    task.axis = axisOf(272, 2);
    return task;
  }

  std::vector<MeasuringTask> centred(Feature feature, bool presets) {
    const bool inside = isInside(feature);
    if (isRound(feature)) {
      const MeasuringTask task = circle(feature, presets ? 321 : 273);
      if (presets) return preset(task, {331, 332});
      return inspection(task, {inside ? LimitNumbers{275, 276} : LimitNumbers{277, 278}});
    }
    if (isRectangular(feature)) {
      const MeasuringTask task = rectangle(feature, presets ? 321 : 273, presets ? 323 : 282);
      return presets ? preset(task, {331, 332}) : inspection(task, {{284, 285}, {286, 287}});
    }
    if (presets) return preset(width(feature, 321, 322), {405});
    if (!inside) return inspection(ridge(), {{288, 289}});
    if (asked(310)) throw NotCarriedOver("Q310: CYCLE977 touches both walls at the same place");
    return inspection(width(feature, 328, 329), {{288, 289}});
  }

  /// Cycle 426 has the two places of touch.
  MeasuringTask ridge() {
    MeasuringTask task = width(Feature::Rib, 263, 264);
    const auto axis = static_cast<std::size_t>(task.axis);
    const Place other = {q(265), q(266), {}};
    if (!(task.place[1 - axis] == other[1 - axis])) {
      losses_.push_back("Q265, Q266: CYCLE977 touches both sides at the place of the first touch");
    }
    task.place[axis] = (task.place[axis] + other[axis]) / 2;
    return task;
  }

  void log(MeasuringTask& task) {
    if (!call_.has("Q281")) return;
    if (!q(281).isNumber()) {
      losses_.push_back("Q281: whether there is a log is known only when the program runs");
      return;
    }
    task.log = static_cast<MeasuringTask::Log>(std::clamp(option(281), 0, 2));
  }

  MeasuringTask surface(int height, int axis, int sign) const {
    MeasuringTask task = begun(Feature::Surface);
    task.place = {q(263), q(264), q(height)};
    task.axis = axis;
    task.sign = sign;
    task.size[0] = task.place[static_cast<std::size_t>(axis)];
    return task;
  }

  MeasuringTask edge(Correction correction) const {
    MeasuringTask task = begun(Feature::Edge);
    task.place = {q(263), q(264), q(261)};
    task.further = {{q(265), q(266), q(261)}};
    task.axis = axisOf(272, 3);
    task.sign = option(267);
    task.along = task.axis == 2 ? 0 : 1 - task.axis;
    const Quantity dx = task.further[0][0] - task.place[0], dy = task.further[0][1] - task.place[1];
    const bool numbers = dx.isNumber() && dy.isNumber();
    if (task.axis == 2 && numbers && std::abs(dy.number()) > std::abs(dx.number())) task.along = 1;
    task.angle = task.axis == 0 ? 90 : 0;
    task.correction = correction;
    if (correction == Correction::Rotation) {
      task.angle = q(307);
      task.row = q(305);
      task.active = task.row == 0;
      task.fromUnturned = true;
    } else if (numbers && task.axis != 2) {
      const double degrees = std::atan2(dy.number(), dx.number()) * 180 / std::numbers::pi;
      task.angle = degrees > 90 ? degrees - 180 : degrees <= -90 ? degrees + 180 : degrees;
    }
    return task;
  }

  MeasuringTask angle() {
    MeasuringTask task = edge(Correction::None);
    log(task);
    return task;
  }

  /// The holes that `places` tells, by the first of their two parameters.
  MeasuringTask holes(Feature feature, const std::vector<int>& places) const {
    MeasuringTask task = begun(feature);
    for (const int each : places)
      task.further.push_back({q(each), q(each + 1), task.place[2]});
    task.place = task.further.front();
    task.further.erase(task.further.begin());
    return task;
  }

  MeasuringTask pair(Feature feature) const {
    MeasuringTask task = holes(feature, {268, 270});
    if (asked(402))
      throw NotCarriedOver("Q402: the rotary table is not turned", "align with 403, or by 401 and Q402 = 0");
    if (feature == Feature::SpigotPair) {
      task.size = {q(313), q(314)};
      task.further[0][2] = q(315);
    }
    task.correction = Correction::Rotation;
    task.row = q(305);
    task.angle = q(307);
    task.fromUnturned = true;
    return task;
  }

  MeasuringTask boltCircle() const {
    MeasuringTask task = begun(Feature::BoltCircle);
    const Place centre = {q(273), q(274), q(261)};
    for (const int angle : {291, 292, 293}) {
      if (!q(angle).isNumber()) throw NotCarriedOver(fmt::format("Q{} is known only when the program runs", angle));
      const double radians = q(angle).number() * std::numbers::pi / 180;
      task.further.push_back(
          {centre[0] + q(262) * (std::cos(radians) / 2), centre[1] + q(262) * (std::sin(radians) / 2), centre[2]});
    }
    task.place = centre;
    task.size[0] = q(262);
    return task;
  }

  std::vector<MeasuringTask> inspectedBoltCircle() {
    MeasuringTask task = boltCircle();
    task.limits[0] = limitsOf(288, 289, q(262));
    task.centreTolerance = {q(279), q(280)};
    task.stops = asked(309);
    if (!(q(281) == 0)) losses_.push_back("Q281: no measuring log is written of three holes");
    if (!(q(330) == 0) || !call_.text("Q330").empty())
      losses_.push_back("Q330: the breakage of a tool is not monitored");
    return {task};
  }

  MeasuringTask outsideCorner() const {
    MeasuringTask task = begun(Feature::OutsideCorner);
    const Quantity beside = q(296) - q(263), above = q(297) - q(264);
    if (!beside.isNumber() || !above.isNumber()) {
      throw NotCarriedOver("which corner is meant is known only when the program runs");
    }
    task.place = {q(263), q(264), q(261)};
    task.further = {{q(263) + q(326), q(264), q(261)}, {q(296), q(297), q(261)}, {q(296), q(297) + q(327), q(261)}};
    task.sign = above.number() > 0 ? 1 : -1;
    task.secondSign = beside.number() < 0 ? 1 : -1;
    return task;
  }

  MeasuringTask insideCorner() const {
    MeasuringTask task = begun(Feature::InsideCorner);
    const int corner = option(308);
    const double inwards1 = corner == 1 || corner == 4 ? 1 : -1;
    const double inwards2 = corner == 1 || corner == 2 ? 1 : -1;
    const Quantity standOff = ballRadius_ + task.path;
    const Quantity x = q(263), y = q(264), z = q(261);
    task.place = {x + standOff * inwards1, y, z};
    task.further = {{x + q(326) * inwards1, y, z}, {x, y + standOff * inwards2, z}, {x, y + q(327) * inwards2, z}};
    task.sign = inwards2 > 0 ? -1 : 1;
    task.secondSign = inwards1 > 0 ? -1 : 1;
    return task;
  }

  /// What cycles 1410 and 1420 correct.
  Correction rotationCorrection() const {
    if (asked(1120)) throw NotCarriedOver("Q1120: the cycle corrects an origin and an angle in one");
    if (asked(1126)) throw NotCarriedOver("Q1126: the cycle positions rotary axes");
    if (asked(309)) throw NotCarriedOver("Q309: tolerances of positions are not monitored");
    const int transfer = option(1121);
    return transfer == 2 ? Correction::RotaryAxis : transfer == 1 ? Correction::Rotation : Correction::None;
  }

  Place position(int number) const {
    for (int i = 0; i < 3; ++i) {
      const std::string name = nameOf(number + i);
      if (!call_.text(name).empty()) {
        throw NotCarriedOver(fmt::format("{}: positions by hand and with tolerances are not converted", name));
      }
    }
    return {q(number), q(number + 1), q(number + 2)};
  }

  MeasuringTask alignedEdge() const {
    MeasuringTask task = begun(Feature::Edge);
    task.place = position(1100);
    task.further = {position(1103)};
    task.axis = axisOf(372, 3);
    task.sign = option(372) < 0 ? -1 : 1;
    if (task.axis == 2) throw NotCarriedOver("Q372: touches along the tool axis are not converted");
    task.along = 1 - task.axis;
    task.clearanceBetween = option(1125) > 0;
    task.correction = rotationCorrection();
    task.active = true;
    const Quantity dx = task.further[0][0] - task.place[0], dy = task.further[0][1] - task.place[1];
    if (!dx.isNumber() || !dy.isNumber()) throw NotCarriedOver("the angle is known only when the program runs");
    task.angle = std::atan2(dy.number(), dx.number()) * 180 / std::numbers::pi;
    return task;
  }

  MeasuringTask alignedPlane() const {
    MeasuringTask task = begun(Feature::Plane);
    if (option(372) != -3) throw NotCarriedOver("Q372: a plane is measured from above only");
    task.place = position(1100);
    task.further = {position(1103), position(1106)};
    task.clearanceBetween = option(1125) > 0;
    task.correction = rotationCorrection();
    task.active = true;
    return task;
  }

  MeasuringTask plane() {
    MeasuringTask task = begun(Feature::Plane);
    task.place = {q(263), q(264), q(294)};
    task.further = {{q(265), q(266), q(295)}, {q(296), q(297), q(298)}};
    task.clearanceBetween = true;
    log(task);
    return task;
  }

  MeasuringTask calibration(Feature feature) {
    MeasuringTask task;
    task.feature = feature;
    task.millimetre = call_.millimetre;
    const double lengthPath = 5 * call_.millimetre;  // cycle 461 has no set-up clearance
    task.path = feature == Feature::ProbeLength ? Quantity(lengthPath) : q(320) + call_.probe.setUp * call_.millimetre;
    if (feature != Feature::ProbeLength) task.beyond = Quantity(call_.probe.travel * call_.millimetre) - task.path;
    task.size[0] = q(407) * 2;
    task.place[2] = q(434);
    task.angle = q(380);
    task.calibratesLength = asked(433);
    if (asked(433) && feature != Feature::ProbeOnBall) {
      losses_.push_back("Q433: the length is not calibrated along with the ball");
    }
    if (asked(455)) losses_.push_back("Q455: no 3-D calibration");
    return task;
  }

  /// Cycle 9, whose words have no Q numbers.
  MeasuringTask lengthOnSurface() {
    const auto word = [](std::uint32_t address) { return fmt::format("Q{}", address); };
    if (!(call_.number(word(cycles::heidenhain::probe_word::referenceSystem)) == 0)) {
      throw NotCarriedOver("REFERENCE SYSTEM 1: a height in the machine system is not converted");
    }
    MeasuringTask task = calibration(Feature::ProbeLength);
    task.place[2] = call_.number(word(cycles::heidenhain::probe_word::datum));
    return task;
  }

  /// Where a presetting cycle writes to.
  void target(MeasuringTask& task) const {
    const bool turns = isCorner(task.feature) && option(304) == 1;
    task.correction = turns ? Correction::OriginAndRotation : Correction::Origin;
    task.row = q(305);
    const int table = call_.has("Q303") ? option(303) : -1;
    if (table != 1 && !(task.row == 0)) {
      throw NotCarriedOver("the result goes to a datum table, which a SINUMERIK does not have",
                           "let the cycle write to the preset table: Q303 = 1");
    }
  }

  MeasuringTask presetSurface(MeasuringTask task) const {
    target(task);
    task.wish[static_cast<std::size_t>(task.axis)] = q(333);
    return task;
  }

  /// The task sets the preset, and after it the one in the touch probe axis if Q381 asks for that.
  std::vector<MeasuringTask> preset(MeasuringTask task, const std::vector<int>& wishes) const {
    target(task);
    for (std::size_t i = 0; i < wishes.size(); ++i)
      task.wish[wishes.size() == 1 ? static_cast<std::size_t>(task.axis) : i] = q(wishes[i]);
    std::vector<MeasuringTask> tasks = {task};
    if (asked(381)) {
      MeasuringTask surface = begun(Feature::Surface);
      surface.place = {q(382), q(383), q(384)};
      surface.axis = 2;
      surface.sign = -1;
      surface.size[0] = surface.place[2];
      if (isCorner(task.feature)) throw NotCarriedOver("Q381: the preset in the touch probe axis", "set it with 417");
      target(surface);
      surface.wish[2] = q(333);
      surface.answers = false;
      tasks.push_back(surface);
    }
    return tasks;
  }

  std::vector<MeasuringTask> inspection(MeasuringTask task, const std::vector<LimitNumbers>& limits) {
    for (std::size_t i = 0; i < limits.size(); ++i)
      task.limits[i] = limitsOf(limits[i].upper, limits[i].lower, task.size[i],
                                task.feature == Feature::Surface ? Alone::Both : Alone::Each);
    task.centreTolerance = {q(279), q(280)};
    task.stops = asked(309);
    log(task);
    task.tool = monitoredTool();
    return {task};
  }

  /// The tool of Q330.
  std::optional<ToolCorrection> monitoredTool() {
    std::string tool = call_.text("Q330");
    const Quantity number = q(330);
    if (tool.empty() && number == 0) return std::nullopt;
    if (!number.isNumber()) {
      losses_.push_back("Q330: which tool is corrected is known only when the program runs");
      return std::nullopt;
    }
    if (tool.empty() && number.number() != std::round(number.number())) {
      losses_.push_back("Q330: tools with a step index are not corrected");
      return std::nullopt;
    }
    if (asked(498) || asked(531)) {
      losses_.push_back("Q498, Q531: turning tools are not corrected");
      return std::nullopt;
    }
    if (tool.empty()) tool = numberText(number.number());
    return ToolCorrection{.tool = tool, .least = {}, .most = {}};
  }

  const Call& call_;
  Quantity ballRadius_;
  Losses& losses_;
};

}  // namespace

std::vector<MeasuringTask> heidenhainTasks(const Call& call, const Quantity& ballRadius, Losses& losses) {
  return Reader(call, ballRadius, losses).tasks();
}

}  // namespace probewright::conversion
