#include <string>

#include "conversion/heidenhain_tasks.hpp"

/// Where touch probe cycles leave what they have measured.
namespace probewright::conversion {

Results heidenhainResults(const std::string& cycle, const MeasuringTask& task) {
  const int number = std::stoi(cycle);
  const bool inspects = number >= 420;
  Results results;
  if (isRound(task.feature) || isRectangular(task.feature)) {
    results = {{Meaning::Centre1, "Q151"}, {Meaning::Centre2, "Q152"}};
    results[Meaning::Size1] = isRound(task.feature) ? "Q153" : "Q154";
    if (isRectangular(task.feature)) results[Meaning::Size2] = "Q155";
    if (inspects) {
      results.insert({{Meaning::Centre1Deviation, "Q161"}, {Meaning::Centre2Deviation, "Q162"}});
      results[Meaning::Size1Deviation] = isRound(task.feature) ? "Q163" : "Q164";
      if (isRectangular(task.feature)) results[Meaning::Size2Deviation] = "Q165";
    }
  } else if (isWidth(task.feature)) {
    results = {{Meaning::Coordinate, "Q157"}, {Meaning::Size1, inspects ? "Q156" : "Q166"}};
    if (inspects) results[Meaning::Size1Deviation] = "Q166";
  } else if (task.feature == Feature::BoltCircle) {
    results = {{Meaning::Centre1, "Q151"}, {Meaning::Centre2, "Q152"}, {Meaning::Size1, "Q153"}};
    if (inspects) {
      results.insert({{Meaning::Centre1Deviation, "Q161"}, {Meaning::Centre2Deviation, "Q162"}});
      results[Meaning::Size1Deviation] = "Q163";
    }
  } else if (isCorner(task.feature) || task.feature == Feature::HoleDiagonals) {
    results = {{Meaning::Centre1, "Q151"}, {Meaning::Centre2, "Q152"}};
  } else if (task.feature == Feature::Surface && number != 419) {
    results = {{Meaning::Coordinate, "Q160"}};
  } else if (number == 420) {
    results = {{Meaning::Angle, "Q150"}};
  } else if (number == 431) {
    results = {{Meaning::Angle, "Q158"}, {Meaning::Angle2, "Q159"}};
  } else if (number == 1410) {
    results = {{Meaning::Angle, "Q964"}, {Meaning::AngleDeviation, "Q994"}};
  } else if (number == 1420) {
    results = {{Meaning::Angle, "Q961"}, {Meaning::Angle2, "Q962"}};
  }
  return results;
}

}  // namespace probewright::conversion
