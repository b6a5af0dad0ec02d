#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "conversion/heidenhain_tasks.hpp"
#include "cycles/catalogue.hpp"

/// Measuring tasks written as touch probe cycles.
namespace probewright::conversion {

namespace {

class Writer {
public:
  Writer(const MeasuringTask& task, control::ControlKind control, double setUp)
      : task_(task), control_(control), setUp_(setUp) {}

  Call call() {
    switch (task_.feature) {
      case Feature::Hole:
      case Feature::Spigot:
      case Feature::HoleSegment:
      case Feature::SpigotSegment:
        circle();
        break;
      case Feature::Pocket:
      case Feature::RectangularSpigot:
        rectangle();
        break;
      case Feature::Groove:
      case Feature::Rib:
        width();
        break;
      case Feature::Surface:
        surface();
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
        throw NotCarriedOver("several holes are measured one by one");
      case Feature::ProbeLength:
        call_.cycle = "461";
        set(434, task_.place[2]);
        break;
      case Feature::ProbeInRing:
      case Feature::ProbeOnBall:
        call_.cycle = task_.feature == Feature::ProbeInRing ? "462" : "460";
        set(407, task_.size[0] / 2);
        set(423, 4);
        set(380, task_.angle);
        if (task_.calibratesLength) {
          set(433, 1);
          set(434, task_.place[2]);
        }
        extraClearance();
        break;
    }
    if (task_.log != MeasuringTask::Log::None) set(281, static_cast<int>(task_.log));
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
    if (presets()) return;
    limits();
    if (task_.tool) tool();
  }

  void limits() {
    const bool round = isRound(task_.feature), inside = isInside(task_.feature);
    // A surface measured in the positive direction is that of a recess: its limits are exchanged.
    const bool exchanged = task_.feature == Feature::Surface && task_.sign > 0;
    const int first = isRectangular(task_.feature) ? 284 : !round ? 288 : inside ? 275 : 277;
    for (std::size_t i = 0; i < 2; ++i) {
      if (!task_.limits[i]) continue;
      const int upper = first + 2 * static_cast<int>(i) + (exchanged ? 1 : 0);
      set(upper, task_.size[i] + task_.limits[i]->upper);
      set(exchanged ? upper - 1 : upper + 1, task_.size[i] + task_.limits[i]->lower);
    }
  }

  void tool() {
    const std::string& name = task_.tool->tool;
    const bool number = std::ranges::all_of(name, isDigit);
    if (number && name.size() < 6) {
      set(330, std::stoi(name));
    } else {
      call_.texts["Q330"] = name;
    }
  }

  void begin() {
    const auto cycles = std::ranges::find(centredCycles, task_.feature, &CentredCycles::feature);
    begin(cycles->preset, cycles->inspection);
  }

  void extraClearance() {
    Quantity extra = task_.path - setUp_ * task_.millimetre;
    if (extra.isNumber() && extra.number() < 0) extra = 0;
    if (!extra.isNumber()) {  // only the running program knows whether it is less than 0
      extra = extra / 2 + Quantity::of(fmt::format("ABS ({})", spacedExpressionText(extra / 2)));
    }
    set(320, extra);
  }

  void heights() {
    extraClearance();
    set(260, task_.clearance);
    set(261, task_.place[2]);
    set(301, task_.clearanceBetween ? 1 : 0);
    if (task_.correction == Correction::None) return;
    set(305, task_.row);
    set(303, 1);
  }

  void circle() {
    begin();
    set(262, task_.size[0]);
    set(325, task_.angle);
    set(247, task_.step);
    set(423, task_.touches);
    set(365, 1);
    centre();
  }

  void rectangle() {
    begin();
    for (int i = 0; i < 2; ++i)
      set((presets() ? 323 : 282) + i, task_.size[static_cast<std::size_t>(i)]);
    centre();
  }

  /// Where the feature is expected and, if that is asked for, to get.
  void centre() {
    for (int i = 0; i < 2; ++i) {
      const auto index = static_cast<std::size_t>(i);
      set((presets() ? 321 : 273) + i, task_.place[index]);
      if (presets()) set(331 + i, task_.wish[index].value_or(task_.place[index]));
    }
  }

  void width() {
    const bool inside = isInside(task_.feature);
    begin();
    const auto axis = static_cast<std::size_t>(task_.axis);
    set(311, task_.size[0]);
    set(272, task_.axis + 1);
    if (presets()) {
      set(321, task_.place[0]);
      set(322, task_.place[1]);
      set(405, task_.wish[axis].value_or(task_.place[axis]));
    } else if (inside) {
      set(328, task_.place[0]);
      set(329, task_.place[1]);
    } else {
      Place upper = task_.place, lower = task_.place;
      upper[axis] = upper[axis] + task_.size[0] / 2;
      lower[axis] = lower[axis] - task_.size[0] / 2;
      points(upper, lower);
    }
  }

  void points(const Place& first, const Place& second) {
    set(263, first[0]);
    set(264, first[1]);
    set(265, second[0]);
    set(266, second[1]);
  }

  void surface() {
    const bool alongTool = task_.axis == 2;
    begin(alongTool && task_.sign < 0 ? 417 : 419, 427);
    set(263, task_.place[0]);
    set(264, task_.place[1]);
    set(294, task_.place[2]);
    set(272, task_.axis + 1);
    set(267, task_.sign);
    const auto axis = static_cast<std::size_t>(task_.axis);
    if (presets()) set(333, task_.wish[axis].value_or(task_.place[axis]));
  }

  void edge() {
    const bool turns = task_.correction == Correction::Rotation;
    if (turns && task_.axis == 2) {
      throw NotCarriedOver("no touch probe cycle turns the coordinate system by an angle measured along the tool");
    }
    if (task_.correction == Correction::RotaryAxis) {
      if (!task_.active) {
        throw NotCarriedOver("cycle 1410 corrects the active preset only", "select the zero offset before the cycle");
      }
      return alignment("1410", task_.axis + 1);
    }
    // 400 counts from the unturned axes, 1410 from those in effect, and corrects no other preset.
    if (turns && task_.active && !task_.fromUnturned) return alignment("1410", task_.axis + 1);
    call_.cycle = turns ? "400" : "420";
    heights();
    points(task_.place, task_.further.at(0));
    set(272, task_.axis + 1);
    set(267, task_.sign);
    if (turns) {
      set(307, task_.angle);
      set(305, task_.active ? Quantity(0) : task_.row);
    }
  }

  void alignment(const char* cycle, int axis) {
    call_.cycle = cycle;
    extraClearance();
    set(260, task_.clearance);
    set(372, axis * task_.sign);
    set(1125, task_.clearanceBetween ? 2 : 0);
    set(1121, task_.correction == Correction::RotaryAxis ? 2 : 1);
    const auto position = [this](int number, const Place& place) {
      for (int i = 0; i < 3; ++i)
        set(number + i, place[static_cast<std::size_t>(i)]);
    };
    position(1100, task_.place);
    position(1103, task_.further.at(0));
    if (task_.further.size() > 1) position(1106, task_.further[1]);
  }

  void plane() {
    if (task_.correction != Correction::None) {
      if (!task_.active) {
        throw NotCarriedOver("cycle 1420 turns the active preset only", "select the zero offset before the cycle");
      }
      return alignment("1420", 3);
    }
    call_.cycle = "431";
    heights();
    points(task_.place, task_.further.at(0));
    set(294, task_.place[2]);
    set(295, task_.further[0][2]);
    set(296, task_.further.at(1)[0]);
    set(297, task_.further[1][1]);
    set(298, task_.further[1][2]);
  }

  void corner() {
    const bool inside = isInside(task_.feature);
    call_.cycle = inside ? "415" : "414";
    heights();
    const auto apart = [](const Quantity& from, const Quantity& to) {
      const Quantity distance = to - from;
      if (!distance.isNumber())
        throw NotCarriedOver("the distances of the points are known only when the program runs");
      return distance.number();
    };
    Place first = task_.place, second = task_.further.at(0), third = task_.further.at(1), fourth = task_.further.at(2);
    if (inside) {
      const Quantity main = third[0], minor = first[1];
      set(263, main);
      set(264, minor);
      const bool right = task_.secondSign < 0, up = task_.sign < 0;  // away from the corner into the pocket
      set(308, right ? (up ? 1 : 4) : (up ? 2 : 3));
      // The nearer point of each edge is touched as near as the clearance allows.
      const bool secondFarther = ((second[0] - first[0]).number() > 0) == right;
      const bool fourthFarther = ((fourth[1] - third[1]).number() > 0) == up;
      set(326, ((secondFarther ? second : first)[0] - main) * (right ? 1 : -1));
      set(327, ((fourthFarther ? fourth : third)[1] - minor) * (up ? 1 : -1));
    } else {
      if (apart(first[0], second[0]) < 0) std::swap(first, second);
      if (apart(third[1], fourth[1]) < 0) std::swap(third, fourth);
      set(263, first[0]);
      set(264, first[1]);
      set(326, apart(first[0], second[0]));
      set(296, third[0]);
      set(297, third[1]);
      set(327, apart(third[1], fourth[1]));
    }
    set(304, task_.correction == Correction::OriginAndRotation ? 1 : 0);
    set(331, task_.wish[0].value_or(0));
    set(332, task_.wish[1].value_or(0));
  }

  /// Every parameter of the cycle is in the call, those not set with the value that does nothing.
  void fillUp() {
    const cycles::CycleDefinition* definition = cycles::heidenhainCycle(std::stoi(call_.cycle));
    if (!definition->controls.contains(control_)) {
      throw NotCarriedOver(fmt::format("the {} has no cycle {}", control::name(control_), call_.cycle),
                           "measure and correct by hand, or write for a TNC640");
    }
    const bool fourTouches = call_.number("Q423") == 4 || !call_.has("Q423");
    for (const cycles::Parameter& parameter : definition->parameters) {
      // What every iTNC 530 takes, whatever its software.
      const bool later = control_ == control::ControlKind::iTNC530 && parameter.iTNC530Software > 0;
      if (later || !parameter.controls.contains(control_)) {
        call_.numbers.erase(std::string(parameter.name));
        continue;
      }
      if (parameter.kind == cycles::ValueKind::Text || call_.texts.contains(parameter.name)) continue;
      call_.numbers.try_emplace(std::string(parameter.name), parameter.standard.value_or(0));
    }
    if (!fourTouches && !call_.has("Q423")) {
      throw NotCarriedOver(fmt::format("the {} touches circles four times", control::name(control_)));
    }
    std::erase_if(call_.numbers, [&](const auto& entry) {
      const auto address = static_cast<std::uint32_t>(std::stoi(entry.first.substr(1)));
      return definition->parameter(address) == nullptr;
    });
  }

  const MeasuringTask& task_;
  control::ControlKind control_;
  double setUp_;  ///< SET_UP, mm
  Call call_;
};

}  // namespace

Call heidenhainCall(const MeasuringTask& task, control::ControlKind control, const TouchProbe& probe) {
  return Writer(task, control, probe.setUp).call();
}

}  // namespace probewright::conversion
