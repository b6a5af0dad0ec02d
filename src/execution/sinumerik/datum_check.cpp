#include "execution/sinumerik/datum_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/measuring_data.hpp"

namespace probewright::execution::sinumerik {

using control::Alarm;

namespace {

constexpr int mostTools = 32000;
constexpr int mostBasicFrames = 16;

void requireIndex(std::string_view name, std::span<const Value> indices, std::size_t place, int first, int last) {
  if (place >= indices.size()) {
    throw Alarm("12400", fmt::format("{} needs {} {}", name, place + 1, place == 0 ? "index" : "indices"),
                fmt::format("the index runs from {} to {}", first, last));
  }
  const auto* number = std::get_if<double>(&indices[place]);
  if (number == nullptr) throw Alarm("12150", fmt::format("index {} of {} is a number", place + 1, name));
  const double index = std::round(*number);
  if (index >= first && index <= last) return;
  throw Alarm(place == 0 ? "17020" : "17030", fmt::format("illegal index {} of {}", *number, name),
              fmt::format("index {} runs from {} to {}", place + 1, first, last));
}

void requireNumber(std::string_view name, const Value* value) {
  if (value != nullptr && language::isText(*value))
    throw Alarm("12150", fmt::format("{} takes a number, not a text", name));
}

/// $TC_DP3, $TC_SCP13, $TC_ECP13: of a tool and one of its edges.
bool isEdgeDatum(std::string_view name) {
  for (const std::string_view stem : {"$TC_DP", "$TC_SCP", "$TC_ECP", "$TC_MOP"})
    if (name.starts_with(stem) && name.size() > stem.size() && name[stem.size()] >= '0' && name[stem.size()] <= '9')
      return true;
  return false;
}

}  // namespace

void requireDatum(std::string_view name, std::span<const Value> indices, const Value* value,
                  const control::sinumerik::DataStore& data) {
  if (isEdgeDatum(name)) {
    requireIndex(name, indices, 0, 1, mostTools);
    requireIndex(name, indices, 1, 1, mostTools);
    return requireNumber(name, value);
  }
  if (name == "$TC_TP2") {
    requireIndex(name, indices, 0, 1, mostTools);
    if (value != nullptr && !language::isText(*value))
      throw Alarm("12150", "$TC_TP2, the name of a tool, takes a text", "write \"NAME\"");
    return;
  }
  if (name == "$P_UIFR") {
    const int count = truncated(data.number("$MC_MM_NUM_USER_FRAMES", {}, 100));
    return requireIndex(name, indices, 0, 0, count - 1);
  }
  if (name == "$P_CHBFR" || name == "$P_NCBFR") {
    // Without a number it is the first one.
    if (!indices.empty() && !language::isText(indices[0])) requireIndex(name, indices, 0, 0, mostBasicFrames - 1);
    return;
  }
  if (!name.starts_with("$S") && !name.starts_with("$M")) return;
  const control::sinumerik::MeasuringDatum* measuring = control::sinumerik::findMeasuringDatum(name);
  if (measuring == nullptr) return;
  if (measuring->elements == 0 && !indices.empty())
    throw Alarm("12400", fmt::format("{} is not an array", name), "write it without an index");
  if (measuring->elements > 0 && !indices.empty()) requireIndex(name, indices, 0, 0, measuring->elements - 1);
  requireNumber(name, value);
}

}  // namespace probewright::execution::sinumerik
