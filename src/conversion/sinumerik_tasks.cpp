#include "conversion/sinumerik_tasks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace probewright::conversion {

namespace {

constexpr int holeUnits = 1;

/// S_MVAR of CYCLE977, units.
int units977(Feature feature) {
  switch (feature) {
    case Feature::Spigot:
      return 2;
    case Feature::Groove:
      return 3;
    case Feature::Rib:
      return 4;
    case Feature::Pocket:
      return 5;
    case Feature::RectangularSpigot:
      return 6;
    default:
      return holeUnits;
  }
}

Feature feature977(int units) {
  static constexpr Feature features[] = {Feature::Hole, Feature::Spigot, Feature::Groove,
                                         Feature::Rib,  Feature::Pocket, Feature::RectangularSpigot};
  if (units < 1 || units > 6) throw NotCarriedOver("this variant of CYCLE977 (S_MVAR) is not known");
  return features[units - 1];
}

/// Reads one call.
class Reader {
public:
  Reader(const Call& call, const Place& start, const Quantity& ballRadius, Losses& losses)
      : call_(call), start_(start), ballRadius_(ballRadius), losses_(losses) {}

  MeasuringTask task() {
    if (call_.cycle == "CYCLE977") return cycle977();
    if (call_.cycle == "CYCLE979") return cycle979();
    throw NotCarriedOver(fmt::format("{} has no twin on a HEIDENHAIN control", call_.cycle),
                         "docs/conversion.md lists the cycles that both controls have");
  }

private:
  Quantity number(std::string_view name) const { return call_.number(name); }

  MeasuringTask begun(Feature feature) {
    MeasuringTask task;
    task.feature = feature;
    task.place = start_;
    task.place[2] = start_[2] + ballRadius_;
    task.clearance = start_[2];
    task.path = number("S_FA");
    correction(task);
    if (call_.digit("S_MVAR", 5) != 0 && call_.cycle != "CYCLE961") {
      losses_.push_back("S_MVAR: the probe measures as it was calibrated, without turning the spindle");
    }
    if (number("S_NMSP").number() > 1) losses_.push_back("S_NMSP: each point is measured once");
    return task;
  }

  void correction(MeasuringTask& task) {
    const int kind = call_.digit("S_MVAR", 3);
    if (kind == 2) {
      losses_.push_back("the tool (S_TNAME) is not corrected");
      return;
    }
    if (kind != 1 || number("S_KNUM") == 0) return;
    task.correction = Correction::Origin;
    const int code = call_.integer("S_KNUM");
    const int which = code / 1000 % 10;
    if (which == 9) {
      task.active = true;
    } else if (which == 0 && code % 1000 >= 1 && code % 1000 <= 99) {
      task.row = code % 1000;
    } else {
      throw NotCarriedOver(fmt::format("S_KNUM = {} corrects a base or system frame, which a HEIDENHAIN control does "
                                       "not have",
                                       code),
                           "correct a settable zero offset: S_KNUM = 10001 is G54");
    }
  }

  MeasuringTask cycle977() {
    MeasuringTask task = begun(feature977(call_.digit("S_MVAR", 1)));
    const bool zone = call_.digit("S_MVAR", 4) == 1;
    if (zone || !isInside(task.feature)) {
      task.place[2] = task.place[2] + number("S_ID");
      task.clearanceBetween = true;
    }
    task.size[0] = number(isRectangular(task.feature) ? "S_SETV0" : "S_SETV");
    task.size[1] = number("S_SETV1");
    task.angle = number("S_STA1");
    task.step = 90;
    if (isWidth(task.feature)) task.axis = call_.integer("S_MA") - 1;
    if (!isRound(task.feature) && !(task.angle == 0)) {
      throw NotCarriedOver("S_STA1: HEIDENHAIN cycles measure this feature along the axes only",
                           "turn the coordinate system in front of the cycle");
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (isWidth(task.feature) && i != static_cast<std::size_t>(task.axis)) continue;
      if (task.correction == Correction::Origin) task.wish[i] = task.place[i];
    }
    return task;
  }

  MeasuringTask cycle979() {
    MeasuringTask task = begun(call_.digit("S_MVAR", 1) == 2 ? Feature::SpigotSegment : Feature::HoleSegment);
    task.place[0] = number("S_CPA");
    task.place[1] = number("S_CPO");
    task.size[0] = number("S_SETV");
    task.angle = number("S_STA1");
    task.step = number("S_INCA");
    task.touches = call_.digit("S_MVAR", 4) == 1 ? 4 : 3;
    if (task.correction == Correction::Origin) task.wish = {task.place[0], task.place[1], std::nullopt};
    return task;
  }

  const Call& call_;
  const Place& start_;
  Quantity ballRadius_;
  Losses& losses_;
};

/// Makes one call.
class Writer {
public:
  Writer(const MeasuringTask& task, const Quantity& ballRadius, Losses& losses)
      : task_(task), ballRadius_(ballRadius), losses_(losses) {}

  SinumerikPassage passage() {
    switch (task_.feature) {
      case Feature::Hole:
      case Feature::Spigot:
      case Feature::Groove:
      case Feature::Rib:
      case Feature::Pocket:
      case Feature::RectangularSpigot:
        cycle977();
        break;
      case Feature::HoleSegment:
      case Feature::SpigotSegment:
        cycle979();
        break;
      default:
        throw NotCarriedOver("no measuring cycle of a SINUMERIK measures this");
    }
    return std::move(passage_);
  }

private:
  void set(const std::string& name, const Quantity& value) { passage_.call.numbers[name] = value; }
  /// Height of the tip when the ball's centre is at the measuring height.
  Quantity tip() const { return task_.place[2] - ballRadius_; }

  void begin(const std::string& cycle, int variant) {
    passage_.call.cycle = cycle;
    passage_.start = task_.place;
    passage_.start[2] = tip();
    const bool corrects = task_.correction == Correction::Origin || task_.correction == Correction::Rotation;
    set("S_MVAR", variant + (corrects ? 100 : 0));
    set("S_PRNUM", 1);
    set("S_FA", task_.path);
    set("S_NMSP", 1);
    if (!corrects) return;
    set("S_KNUM", task_.active ? Quantity(19000) : task_.row + 10000);
  }

  void cycle977() {
    const bool fromAbove = !isInside(task_.feature) || task_.clearanceBetween;
    const bool zone = isInside(task_.feature) && fromAbove;
    begin("CYCLE977", units977(task_.feature) + (zone ? 1000 : 0));
    if (fromAbove) {
      passage_.start[2] = task_.clearance;
      set("S_ID", tip() - task_.clearance);
    }
    if (isRectangular(task_.feature)) {
      set("S_SETV0", task_.size[0]);
      set("S_SETV1", task_.size[1]);
    } else {
      set("S_SETV", task_.size[0]);
    }
    set("S_STA1", isRound(task_.feature) ? task_.angle : Quantity());
    if (isWidth(task_.feature)) set("S_MA", task_.axis + 1);
    set("S_TSA", task_.path * 2);
  }

  void cycle979() {
    const bool inside = isInside(task_.feature);
    begin("CYCLE979", (inside ? 1 : 2) + (task_.touches == 4 ? 1000 : 0));
    if (!task_.step.isNumber() || !task_.angle.isNumber()) {
      throw NotCarriedOver("the angles of the touches are known only when the program runs");
    }
    const double step = task_.step.number();
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
    set("S_TSA", task_.path * 2);
    const double angle = task_.angle.number() * std::numbers::pi / 180;
    const Quantity radius =
        inside ? task_.size[0] / 2 - task_.path - ballRadius_ : task_.size[0] / 2 + task_.path + ballRadius_;
    passage_.start[0] = task_.place[0] + radius * std::cos(angle);
    passage_.start[1] = task_.place[1] + radius * std::sin(angle);
    if (task_.clearanceBetween) {
      losses_.push_back("the probe stays at the measuring height between the touches (Q301)");
    }
  }

  const MeasuringTask& task_;
  Quantity ballRadius_;
  Losses& losses_;
  SinumerikPassage passage_;
};

}  // namespace

MeasuringTask sinumerikTask(const Call& call, const Place& start, const Quantity& ballRadius, Losses& losses) {
  return Reader(call, start, ballRadius, losses).task();
}

std::array<std::optional<Quantity>, 3> sinumerikEnd(const Call& call, const MeasuringTask& task, const Place& start,
                                                    const Results& results) {
  std::array<std::optional<Quantity>, 3> end = {start[0], start[1], start[2]};
  const auto measured = [&](Meaning meaning) -> std::optional<Quantity> {
    const auto found = results.find(meaning);
    return found == results.end() ? std::nullopt : std::optional(Quantity::of(found->second));
  };
  if (call.cycle == "CYCLE977") {
    // In the middle of the feature, at the height of the start.
    if (isWidth(task.feature)) {
      end[static_cast<std::size_t>(task.axis)] = measured(Meaning::Coordinate);
    } else {
      end[0] = measured(Meaning::Centre1);
      end[1] = measured(Meaning::Centre2);
    }
  } else {
    end[0] = end[1] = std::nullopt;
  }
  return end;
}

SinumerikPassage sinumerikPassage(const MeasuringTask& task, const Quantity& ballRadius, Losses& losses) {
  return Writer(task, ballRadius, losses).passage();
}

Results sinumerikResults(const std::string&, const MeasuringTask& task) {
  Results results;
  if (isRound(task.feature)) {
    results = {{Meaning::Size1, "_OVR[4]"},
               {Meaning::Centre1, "_OVR[5]"},
               {Meaning::Centre2, "_OVR[6]"},
               {Meaning::Size1Deviation, "_OVR[16]"},
               {Meaning::Centre1Deviation, "_OVR[17]"},
               {Meaning::Centre2Deviation, "_OVR[18]"}};
  }
  return results;
}

}  // namespace probewright::conversion
