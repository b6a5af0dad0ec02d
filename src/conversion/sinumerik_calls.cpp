#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conversion/sinumerik_formulas.hpp"
#include "conversion/sinumerik_tasks.hpp"

/// Measuring tasks written as measuring cycles of a SINUMERIK.
namespace probewright::conversion {

namespace {

constexpr double leastSafeAngle = 5, mostSafeAngle = 45;  ///< degrees that an edge or a plane may be off
constexpr double largestCommonBall = 6;                   ///< diameter, mm

/// S_MVAR of CYCLE977, units.
int units977(Feature feature) {
  return static_cast<int>(std::ranges::find(features977, feature) - features977.begin()) + 1;
}

class Writer {
public:
  Writer(const MeasuringTask& task, const Quantity& ballRadius, Losses& losses)
      : task_(task), ballRadius_(ballRadius), losses_(losses), path_(task.path) {
    // Where a longer way to the place is free: the original program has come that way.
    const bool free = isInside(task.feature) || (task.feature == Feature::Surface && task.axis == 2) ||
                      task.feature == Feature::Plane || isCorner(task.feature);
    const bool begins = task.feature == Feature::Edge;  // both touches from where the original ones begin
    if (free) path_ = larger(task.path, task.beyond);
    passage_.looksFarEnough = free || begins || !farther(task.beyond, task.path);
  }

  SinumerikPassage passage() {
    switch (task_.feature) {
      case Feature::Hole:
      case Feature::Spigot:
      case Feature::Groove:
      case Feature::Rib:
      case Feature::Pocket:
      case Feature::RectangularSpigot:
        requireSizes();
        cycle977();
        break;
      case Feature::HoleSegment:
      case Feature::SpigotSegment:
        requireSizes();
        cycle979();
        break;
      case Feature::Surface:
        cycle978();
        break;
      case Feature::Edge:
        edge();
        break;
      case Feature::Plane:
        plane();
        break;
      case Feature::InsideCorner:
      case Feature::OutsideCorner:
        corner();
        break;
      case Feature::HolePair:
      case Feature::SpigotPair:
      case Feature::BoltCircle:
      case Feature::HoleDiagonals:
        throw NotCarriedOver("no SINUMERIK cycle measures several holes");
      case Feature::ProbeLength:
      case Feature::ProbeInRing:
      case Feature::ProbeOnBall:
        cycle976();
        break;
    }
    requirePath();
    return std::move(passage_);
  }

private:
  using Rest = SinumerikPassage::Rest;

  static Quantity larger(const Quantity& one, const Quantity& other) {
    if (other == 0) return one;
    if (one.isNumber() && other.isNumber()) return std::max(one.number(), other.number());
    return Quantity::of(fmt::format("MAXVAL({},{})", sinumerikText(one), sinumerikText(other)));
  }
  static bool farther(const Quantity& one, const Quantity& other) {
    const Quantity difference = one - other;
    return !difference.isNumber() || difference.number() > 1e-9;
  }
  /// What lies at the end of the path on one side and at its beginning on the other is off by that angle at most.
  double safeAngle(double distance) const {
    const Quantity reach = task_.path + task_.beyond;
    if (!reach.isNumber()) return mostSafeAngle;
    const double angle = std::ceil(std::atan2(reach.number(), distance) * 180 / std::numbers::pi);
    return std::clamp(angle, leastSafeAngle, mostSafeAngle);
  }

  /// CYCLE977 and CYCLE979 refuse a set value of 0; touch probe cycles take it. Between walls that lie no farther
  /// apart than the ball's diameter there is no measuring path; touch probe cycles begin in the middle then.
  void requireSizes() {
    const std::size_t sizes = isRectangular(task_.feature) ? 2 : 1;
    double least = largestCommonBall * task_.millimetre + 1;
    for (std::size_t i = 0; i < sizes; ++i)
      if (task_.size[i].isNumber()) least = std::min(least, task_.size[i].number());
    if (least <= 0)
      throw NotCarriedOver("the nominal size is 0, which no SINUMERIK cycle takes", "write the nominal size there");
    if (isInside(task_.feature) && least <= largestCommonBall * task_.millimetre) {
      losses_.push_back(fmt::format(
          "a ball may be as large as the nominal size of {}: the SINUMERIK stops there, a touch probe cycle measures",
          numberText(least)));
    }
  }
  /// Touch probe cycles begin at the expected surface where SET_UP and Q320 are 0.
  void requirePath() const {
    const Quantity path = passage_.call.number("S_FA");
    if (!path.isNumber() || path.number() > 0) return;
    throw NotCarriedOver("Q320 and SET_UP add up to 0, and no SINUMERIK cycle takes a measuring path (S_FA) of 0",
                         "program a set-up clearance Q320, or tell by --set-up what SET_UP is");
  }

  void set(const std::string& name, const Quantity& value) { passage_.call.numbers[name] = value; }
  Quantity& start(std::size_t i) { return (*passage_.start)[i]; }
  /// Height of the tip when the ball's centre is at the measuring height.
  Quantity tip() const { return task_.place[2] - ballRadius_; }
  /// The number, or the reason why the task has no twin.
  static double known(const Quantity& value, const char* what) {
    if (!value.isNumber()) throw NotCarriedOver(fmt::format("{} known only when the program runs", what));
    return value.number();
  }

  /// `corrects`: the cycle itself corrects the zero offset.
  void begin(const std::string& cycle, int variant, bool corrects) {
    passage_.call.cycle = cycle;
    passage_.start = task_.place;
    start(2) = tip();
    set("S_MVAR", variant + (corrects ? 100 : 0));
    set("S_PRNUM", 1);
    set("S_FA", path_);
    set("S_NMSP", 1);
    if (corrects) set("S_KNUM", task_.active ? Quantity(19000) : task_.row + 10000);
  }
  void begin(const std::string& cycle, int variant) {
    const bool corrects = task_.correction == Correction::Origin;
    // Of a rectangle SINUMERIK cycles take the mean of both sides, touch probe cycles the first one.
    // With a tolerance they correct from its middle, touch probe cycles from the nominal size.
    const bool fromMiddle = task_.limits[0] && !aboutNominal() && task_.feature != Feature::Surface;
    const bool correctsTool = task_.tool && !isRectangular(task_.feature) && !fromMiddle;
    passage_.correctsTool = correctsTool;
    const auto limits = corrects || correctsTool ? std::nullopt : commonLimits();
    begin(cycle, variant + (correctsTool || limits ? 200 : 0), corrects);
    if (corrects) passage_.rest = Rest::ShiftFromPlace;
    if (correctsTool) correctTool();
    if (!limits) return;
    // The task of a tool correction without a tool: the cycle compares with the tolerance, and corrects nothing.
    set("S_KNUM1", 0);
    set("S_TUL", limits->upper);
    set("S_TLL", limits->lower);
    set("_AMODE", 1);
    passage_.judges = true;
    passage_.middle = (limits->upper + limits->lower) / 2;
    if (!passage_.middle.isNumber() || !path_.isNumber()) return;
    path_ = path_ + std::abs(passage_.middle.number());  // it looks about the middle
    set("S_FA", path_);
  }

  /// The limits, if the cycle can compare with them: it has one pair for all sizes.
  std::optional<Limits> commonLimits() const {
    if (!task_.limits[0]) return std::nullopt;
    Limits limits = *task_.limits[0];
    if (!limits.areCertain()) return std::nullopt;
    if (isRectangular(task_.feature)) {
      const auto& second = task_.limits[1];
      if (!second || !second->areCertain() || !(second->upper == limits.upper) || !(second->lower == limits.lower))
        return std::nullopt;
    }
    if (!(limits.upper - limits.lower).isNumber()) return std::nullopt;
    if ((limits.upper - limits.lower).number() < 0) {
      if (task_.feature != Feature::Surface) return std::nullopt;
      std::swap(limits.upper, limits.lower);  // in which direction there is material follows from the touch
    }
    // The cycle looks for the surface about the middle of the tolerance.
    constexpr double besidePath = 0.1;
    const Quantity middle = (limits.upper + limits.lower) / 2;
    const bool near =
        middle.isNumber() && task_.path.isNumber() && std::abs(middle.number()) <= besidePath * task_.path.number();
    if (!near) return std::nullopt;
    return limits;
  }

  /// HEIDENHAIN cycles know none: as large as the reach, or as the whole feature.
  Quantity safeArea() const {
    if (pathInside() == path_ || !task_.size[0].isNumber() || !path_.isNumber()) return path_ * 2;
    return std::max({path_.number() * 2, task_.size[0].number(), task_.size[1].number()});
  }

  /// S_FA, shortened where the way to the place in front of a wall would lead beyond the middle.
  Quantity pathInside() const {
    if (!isInside(task_.feature) && task_.feature != Feature::ProbeInRing) return path_;
    constexpr double largestBall = 12;
    Quantity width = task_.size[0];
    if (isRectangular(task_.feature) && width.isNumber() && task_.size[1].isNumber()) {
      width = std::min(width.number(), task_.size[1].number());
    }
    const Quantity room = width / 2 - path_;
    const bool wide = room.isNumber() && room.number() > largestBall / 2 * task_.millimetre;
    if (wide) return path_;
    Quantity path =
        Quantity::of(fmt::format("MINVAL({},{})", sinumerikText(path_), sinumerikText(width / 2 - ballRadius_)));
    if (isRectangular(task_.feature) && !(width == task_.size[1]) && !width.isNumber()) {
      path = Quantity::of(
          fmt::format("MINVAL({},{})", sinumerikText(path), sinumerikText(task_.size[1] / 2 - ballRadius_)));
    }
    return path;
  }

  bool aboutNominal() const {
    const Limits& limits = *task_.limits[0];
    return limits.areCertain() && limits.upper == -limits.lower && limits.upper.isNumber() && limits.upper.number() > 0;
  }

  /// In the wear of its first edge, by the whole difference.
  void correctTool() {
    set("S_KNUM1", 1);
    passage_.call.texts["S_TNAME"] = task_.tool->tool;
    if (!task_.limits[0] || !aboutNominal()) return;  // a tolerance would move the set value to its middle
    set("S_TUL", task_.limits[0]->upper);
    set("S_TLL", task_.limits[0]->lower);
    set("_AMODE", 1);
  }

  void cycle977() {
    const bool fromAbove = !isInside(task_.feature) || task_.clearanceBetween;
    const bool zone = isInside(task_.feature) && fromAbove;
    begin("CYCLE977", units977(task_.feature) + (zone ? 1000 : 0));
    if (fromAbove) {
      start(2) = task_.clearance;
      set("S_ID", tip() - task_.clearance);
    }
    const Quantity over = task_.clearance - task_.place[2];
    if (!isInside(task_.feature) && over.isNumber() && over.number() <= 0)
      losses_.push_back(
          "Q260: CYCLE977 begins over the middle at this height, which is not above the measuring height");
    if (isRectangular(task_.feature)) {
      set("S_SETV0", task_.size[0]);
      set("S_SETV1", task_.size[1]);
    } else {
      set("S_SETV", task_.size[0]);
    }
    set("S_STA1", isRound(task_.feature) ? task_.angle : Quantity());
    if (isWidth(task_.feature)) set("S_MA", task_.axis + 1);
    set("S_FA", pathInside());
    set("S_TSA", safeArea());
  }

  void cycle978() {
    begin("CYCLE978", 0);
    const auto axis = static_cast<std::size_t>(task_.axis);
    if (task_.axis == 2) {
      if (task_.sign > 0) throw NotCarriedOver("a touch from below is not converted");
      start(2) = task_.clearance;
    } else {
      start(axis) = task_.place[axis] - (path_ + ballRadius_) * task_.sign;
    }
    set("S_SETV", task_.place[axis]);
    set("S_MA", task_.axis + 1);
    set("S_MD", task_.sign > 0 ? 1 : 2);
    set("S_TSA", path_ * 2);
  }

  void cycle979() {
    const bool inside = isInside(task_.feature);
    begin("CYCLE979", (inside ? 1 : 2) + (task_.touches == 4 ? 1000 : 0));
    const double step = known(task_.step, "the step from touch to touch is");
    const double angle = known(task_.angle, "the angle of the first touch is") * std::numbers::pi / 180;
    if (std::abs(step) > 360.0 / task_.touches) {
      throw NotCarriedOver(
          fmt::format("CYCLE979 measures {} points at most {} degrees apart", task_.touches, 360 / task_.touches),
          "choose a smaller stepping angle Q247");
    }
    set("S_SETV", task_.size[0]);
    set("S_CPA", task_.place[0]);
    set("S_CPO", task_.place[1]);
    set("S_STA1", task_.angle);
    set("S_INCA", task_.step);
    set("S_TSA", safeArea());
    const Quantity path = pathInside();
    set("S_FA", path);
    const Quantity back = path + ballRadius_;
    const Quantity radius = task_.size[0] / 2 + back * (inside ? -1 : 1);
    start(0) = task_.place[0] + radius * std::cos(angle);
    start(1) = task_.place[1] + radius * std::sin(angle);
    staysDown();
  }

  void staysDown() {
    if (task_.clearanceBetween) {
      losses_.push_back("Q301: the probe stays at the measuring height between the touches");
    }
  }

  void edge() {
    begin("CYCLE998", 5, task_.correction == Correction::Rotation);
    const auto axis = static_cast<std::size_t>(task_.axis), along = static_cast<std::size_t>(task_.along);
    Place first = task_.place, second = task_.further.at(0);
    double distance = known(second[along] - first[along], "the distance of the two points is");
    if (distance == 0) throw NotCarriedOver("the two points lie at the same place along the edge");
    if (distance < 0) {
      std::swap(first, second);
      distance = -distance;
    }
    const double rise = known(second[axis] - first[axis], "the expected slope is");
    const bool against = (axis == 0 && along == 1) || (axis == 2 && along == 0);
    const double expected = std::atan2(rise, distance) * 180 / std::numbers::pi * (against ? -1 : 1);
    const bool rotates = task_.correction == Correction::Rotation || task_.correction == Correction::RotaryAxis;
    const Quantity set_ = rotates ? sinumerikEdgeAngle(task_, task_.angle) : Quantity(expected);
    // Both touches begin at the same height, whatever the set angle, and reach as far as those of the touch probe.
    set("S_MVAR", passage_.call.number("S_MVAR") + 100000);
    const Quantity path = task_.path + std::abs(rise);
    set("S_FA", larger(task_.path, (task_.path + task_.beyond) / 2) + std::abs(rise));
    if (set_.isNumber() && std::abs(set_.number()) > 45) {
      throw NotCarriedOver("CYCLE998 aligns edges by at most 45 degrees");
    }
    passage_.start = first;
    start(2) = first[2] - ballRadius_;
    if (axis == 2) {
      if (task_.sign > 0) throw NotCarriedOver("a touch from below is not converted");
      start(2) = first[2] + path;
    } else {
      start(axis) = first[axis] - (path + ballRadius_) * task_.sign;
    }
    set("S_RA", 0);
    set("S_STA1", set_);
    set("S_TSA", safeAngle(distance));
    set("S_MA", static_cast<double>((along + 1) * 100 + axis + 1));
    set("S_MD", task_.sign > 0 ? 1 : 2);
    set("S_ID", distance);
    staysDown();
  }

  void plane() {
    begin("CYCLE998", 6, task_.correction == Correction::Rotation);
    const Place& first = task_.place;
    const auto apart = [&](std::size_t point, std::size_t axis) {
      return known(task_.further.at(point)[axis] - first[axis], "the distance of the points is");
    };
    if (std::abs(apart(0, 1)) > 1e-9 || !(apart(0, 0) > 0) || !(apart(1, 1) > 0)) {
      throw NotCarriedOver("CYCLE998 takes the second point along the main axis and the third beyond both",
                           "choose points with Q266 = Q264, Q265 > Q263 and Q297 > Q264");
    }
    // The plane through the three expected points: z = rise1 x + rise2 y.
    const double rise1 = apart(0, 2) / apart(0, 0);
    const double rise2 = (apart(1, 2) - rise1 * apart(1, 0)) / apart(1, 1);
    const double length = std::sqrt(1 + rise1 * rise1 + rise2 * rise2);
    constexpr double degrees = 180 / std::numbers::pi;
    set("S_STA1", std::asin(rise2 / length) * degrees);
    set("S_INCA", -std::atan(rise1) * degrees);
    set("S_TSA", safeAngle(std::min(apart(0, 0), apart(1, 1))));
    set("S_SETV0", apart(0, 0));
    set("S_SETV2", apart(1, 0));
    set("S_SETV3", apart(1, 1));
    // All touches begin at the same height.
    const double highest = std::max({0.0, apart(0, 2), apart(1, 2)}),
                 lowest = std::min({0.0, apart(0, 2), apart(1, 2)});
    set("S_MVAR", passage_.call.number("S_MVAR") + 100000);
    set("S_FA", path_ + (highest - lowest));
    start(2) = first[2] + path_ + (highest - lowest);
    if (!task_.clearanceBetween) return;
    // With a protection zone the probe goes up between the points to where the cycle began.
    const Quantity down = task_.clearance - start(2);
    if (down.isNumber() && down.number() <= 0) return;  // it is there already
    set("S_MVAR", passage_.call.number("S_MVAR") + 1000);
    set("S_SETV", down);
    start(2) = task_.clearance;
  }

  void corner() {
    const bool turns = task_.correction == Correction::OriginAndRotation;
    const bool inside = isInside(task_.feature);
    begin("CYCLE961", (inside ? 7 : 8) + 10 + (task_.clearanceBetween ? 1000 : 0), turns);
    if (!turns) passage_.rest = Rest::ShiftFromMeasured;
    std::array<Place, 4> starts = {task_.place, task_.further.at(0), task_.further.at(1), task_.further.at(2)};
    const Quantity back = task_.path + ballRadius_;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t axis = i < 2 ? 1 : 0;
      starts[i][axis] = starts[i][axis] - back * (i < 2 ? task_.sign : task_.secondSign);
    }
    // The first edge becomes the positive main axis. A distance that contains the ball's radius has the sign of its
    // number, or it would be no distance.
    if ((starts[1][0] - starts[0][0]).number() < 0) std::swap(starts[0], starts[1]);
    // Inside, the nearest points of both edges are begun from one place, which is also the pole of the others.
    if (inside) std::swap(starts[2], starts[3]);
    for (std::size_t i = 0; i < 4; ++i) {
      set(fmt::format("S_SETV{}", 2 * i), starts[i][0]);
      set(fmt::format("S_SETV{}", 2 * i + 1), starts[i][1]);
    }
    set("S_SETV8", task_.wish[0].value_or(0));
    set("S_SETV9", task_.wish[1].value_or(0));
    const auto length = [&](std::size_t from, std::size_t to, std::size_t axis) {
      return std::abs((starts[to][axis] - starts[from][axis]).number());
    };
    set("S_TSA", safeAngle(std::min(length(0, 1, 0), length(2, 3, 1))));
    start(0) = starts[0][0];
    start(1) = starts[0][1];
    if (task_.clearanceBetween) {
      start(2) = task_.clearance;
      set("S_ID", tip() - task_.clearance);
    }
  }

  void cycle976() {
    passage_.call.cycle = "CYCLE976";
    set("S_PRNUM", 1);
    set("S_NMSP", 1);
    set("S_FA", task_.path);
    set("S_TSA", task_.path);
    set("S_MA", 3);
    set("S_MD", 1);
    switch (task_.feature) {
      case Feature::ProbeLength:
        set("S_MVAR", 1000000);
        set("S_SETV", task_.place[2]);
        break;
      case Feature::ProbeInRing:
        set("S_FA", pathInside());
        set("S_MVAR", task_.angle == 0 ? 2 : 100002);
        set("S_SETV", task_.size[0]);
        set("S_STA1", task_.angle);
        break;
      default:
        set("S_MVAR", 3 + (task_.angle == 0 ? 0 : 100000) + (task_.calibratesLength ? 1000000 : 0));
        set("S_SETV", task_.size[0]);
        if (task_.calibratesLength) set("S_SETV0", task_.place[2] + task_.size[0] / 2);
        set("S_STA1", task_.angle);
        break;
    }
  }

  const MeasuringTask& task_;
  Quantity ballRadius_;
  Losses& losses_;
  Quantity path_;  ///< S_FA: as far before the place as after it
  SinumerikPassage passage_;
};

}  // namespace

SinumerikPassage sinumerikPassage(const MeasuringTask& task, const Quantity& ballRadius, Losses& losses) {
  return Writer(task, ballRadius, losses).passage();
}

}  // namespace probewright::conversion
