#include "conversion/heidenhain_tasks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "cycles/catalogue.hpp"

namespace probewright::conversion {

namespace {

/// Reads one call.
class Reader {
public:
  Reader(const Call& call, const Quantity& ballRadius, Losses& losses)
      : call_(call), ballRadius_(ballRadius), losses_(losses) {}

  std::vector<MeasuringTask> tasks() {
    switch (std::atoi(call_.cycle.c_str())) {
      case 412:
        return preset(circle(Feature::Hole, 321, 322));
      case 413:
        return preset(circle(Feature::Spigot, 321, 322));
      case 421:
        return inspection(circle(Feature::Hole, 273, 274), {{{275, 276}}});
      case 422:
        return inspection(circle(Feature::Spigot, 273, 274), {{{277, 278}}});
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
  bool asked(int number) const { return call_.has(nameOf(number)) && !(q(number) == 0); }

  /// Heights and way of approach, which nearly all cycles have.
  MeasuringTask begun(Feature feature) const {
    MeasuringTask task;
    task.feature = feature;
    task.path = q(320) + assumedSetUp;
    task.clearance = q(260);
    task.place[2] = q(261);
    task.clearanceBetween = call_.has("Q301") && option(301) == 1;
    return task;
  }

  MeasuringTask circle(Feature feature, int centre1, int centre2) const {
    MeasuringTask task = begun(feature);
    task.place[0] = q(centre1);
    task.place[1] = q(centre2);
    task.size[0] = q(262);
    task.angle = q(325);
    task.step = q(247);
    task.touches = call_.has("Q423") ? option(423) : 4;
    const bool square = task.touches == 4 && task.step.isNumber() && std::abs(task.step.number()) == 90;
    if (!square) task.feature = isInside(feature) ? Feature::HoleSegment : Feature::SpigotSegment;
    return task;
  }

  /// Where a presetting cycle writes to.
  void target(MeasuringTask& task) const {
    task.correction = Correction::Origin;
    task.row = q(305);
    const int table = call_.has("Q303") ? option(303) : -1;
    const bool datumTable = table == 0 && !(task.row == 0);
    if (datumTable || (table == -1 && !(task.row == 0))) {
      throw NotCarriedOver("the result goes to a datum table, which a SINUMERIK does not have",
                           "let the cycle write to the preset table: Q303 = 1");
    }
  }

  /// The task sets the preset, and after it the one in the touch probe axis if Q381 asks for that.
  std::vector<MeasuringTask> preset(MeasuringTask task) const {
    target(task);
    task.wish = {q(331), q(332), std::nullopt};
    return withToolAxis(std::move(task));
  }

  std::vector<MeasuringTask> withToolAxis(MeasuringTask task) const {
    std::vector<MeasuringTask> tasks = {task};
    if (asked(381)) {
      MeasuringTask surface = begun(Feature::Surface);
      surface.place = {q(382), q(383), q(384)};
      surface.axis = 2;
      surface.sign = -1;
      target(surface);
      surface.wish[2] = q(333);
      // The point of touch is given in coordinates before the first correction, which are gone by then.
      if (task.wish[0] && task.row == surface.row) {
        for (std::size_t i = 0; i < 2; ++i)
          if (task.wish[i]) surface.place[i] = surface.place[i] + (*task.wish[i] - task.place[i]);
      }
      tasks.push_back(surface);
    }
    return tasks;
  }

  std::vector<MeasuringTask> inspection(MeasuringTask task, const std::vector<LimitNumbers>& limits) {
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const Quantity upper = q(limits[i].upper), lower = q(limits[i].lower);
      if (upper == 0 && lower == 0) continue;
      task.limits[i] = Limits{upper - task.size[i], lower - task.size[i]};
    }
    for (const int number : {279, 280}) {
      if (asked(number)) losses_.push_back(fmt::format("Q{} (tolerance of the centre) is not monitored", number));
    }
    logAndTool(task);
    return {task};
  }

  void logAndTool(MeasuringTask& task) {
    if (asked(281)) losses_.push_back("Q281: no measuring log is written");
    if (asked(330) || !call_.text("Q330").empty()) losses_.push_back("Q330: no tool is monitored");
    task.stops = asked(309);
  }

  const Call& call_;
  Quantity ballRadius_;
  Losses& losses_;
};

/// Makes one call.
class Writer {
public:
  Writer(const MeasuringTask& task, Losses& losses) : task_(task), losses_(losses) {}

  Call call() {
    switch (task_.feature) {
      case Feature::Hole:
      case Feature::Spigot:
      case Feature::HoleSegment:
      case Feature::SpigotSegment:
        circle();
        break;
      default:
        throw NotCarriedOver("no touch probe cycle measures this");
    }
    fillUp();
    return std::move(call_);
  }

private:
  void set(int number, const Quantity& value) { call_.numbers[fmt::format("Q{}", number)] = value; }
  bool presets() const { return task_.correction == Correction::Origin; }

  void begin(int preset, int inspection) {
    if (task_.correction == Correction::Rotation) {
      throw NotCarriedOver("no touch probe cycle that measures this turns the coordinate system");
    }
    call_.cycle = std::to_string(presets() ? preset : inspection);
    heights();
  }

  void heights() {
    Quantity extra = task_.path - assumedSetUp;
    if (extra.isNumber() && extra.number() < 0) extra = 0;
    set(320, extra);
    set(260, task_.clearance);
    set(261, task_.place[2]);
    set(301, task_.clearanceBetween ? 1 : 0);
  }

  void target() {
    set(305, task_.row);
    set(303, 1);
  }

  void circle() {
    const bool inside = isInside(task_.feature);
    begin(inside ? 412 : 413, inside ? 421 : 422);
    set(262, task_.size[0]);
    set(325, task_.angle);
    set(247, task_.step);
    set(423, task_.touches);
    set(365, 1);
    if (presets()) {
      set(321, task_.place[0]);
      set(322, task_.place[1]);
      target();
      set(331, task_.wish[0].value_or(task_.place[0]));
      set(332, task_.wish[1].value_or(task_.place[1]));
    } else {
      set(273, task_.place[0]);
      set(274, task_.place[1]);
      limits(0, inside ? 275 : 277, inside ? 276 : 278);
    }
  }

  void limits(std::size_t size, int upper, int lower) {
    const auto& given = task_.limits[size];
    set(upper, given ? task_.size[size] + given->upper : Quantity());
    set(lower, given ? task_.size[size] + given->lower : Quantity());
    set(309, task_.stops ? 1 : 0);
  }

  /// Every parameter of the cycle stands in the call, those not set with the value that does nothing.
  void fillUp() {
    const cycles::CycleDefinition* definition = cycles::heidenhainCycle(std::stoi(call_.cycle));
    for (const cycles::Parameter& parameter : definition->parameters) {
      if (parameter.kind == cycles::ValueKind::Text) continue;
      call_.numbers.try_emplace(std::string(parameter.name), parameter.standard.value_or(0));
    }
    std::erase_if(call_.numbers, [&](const auto& entry) {
      const auto address = static_cast<std::uint32_t>(std::stoi(entry.first.substr(1)));
      return definition->parameter(address) == nullptr;
    });
  }

  const MeasuringTask& task_;
  Losses& losses_;
  Call call_;
};

}  // namespace

std::vector<MeasuringTask> heidenhainTasks(const Call& call, const Quantity& ballRadius, Losses& losses) {
  return Reader(call, ballRadius, losses).tasks();
}

Call heidenhainCall(const MeasuringTask& task, Losses& losses) { return Writer(task, losses).call(); }

Results heidenhainResults(const std::string& cycle, const MeasuringTask& task) {
  const int number = std::stoi(cycle);
  Results results;
  if (isRound(task.feature)) {
    results = {{Meaning::Centre1, "Q151"}, {Meaning::Centre2, "Q152"}, {Meaning::Size1, "Q153"}};
    if (number == 421 || number == 422) {
      results.insert({{Meaning::Centre1Deviation, "Q161"},
                      {Meaning::Centre2Deviation, "Q162"},
                      {Meaning::Size1Deviation, "Q163"}});
    }
  }
  return results;
}

}  // namespace probewright::conversion
