#include <set>

#include "cycles_sinumerik/milling_variants.hpp"

/// The lists of results of the manual, for every variant: measured only, with the zero offset and with a tool
/// corrected. What stands in a list is set, nothing else is, and everything has a meaning.
namespace probewright {
namespace {

using namespace testing_support;

using Indices = std::set<int>;

Indices joined(Indices first, const Indices& second) {
  first.insert(second.begin(), second.end());
  return first;
}

Indices range(int from, int to) {
  Indices all;
  for (int i = from; i <= to; ++i)
    all.insert(i);
  return all;
}

enum class Task { MeasureOnly, ZeroOffset, Tool };

/// _OVR of a variant by the tables of chapters 2.3 and 3.3.
Indices listOf(const Variant& variant, Task task) {
  const std::string_view cycle = variant.cycle, name = variant.name;
  Indices list;
  if (cycle == "CYCLE978") {
    const int axis = variant.axes.front();
    list = {0, 1 + axis, 4, 5 + axis, 16, 17 + axis};
    if (task == Task::ZeroOffset) list = joined(list, {28, 30});
    if (task == Task::Tool) list.insert(21);
  } else if (cycle == "CYCLE977" || cycle == "CYCLE979") {
    const bool rectangle = name == "977 pocket" || name == "977 rectangle";
    list = joined(joined(range(0, rectangle ? 3 : 2), range(4, rectangle ? 7 : 6)), range(16, rectangle ? 19 : 18));
    if (task == Task::ZeroOffset) list.insert(28);
    if (task == Task::Tool && rectangle) list = joined(list, {9, 13});
  } else if (cycle == "CYCLE961") {
    return {4, 5, 6, 20, 21, 22};
  } else if (cycle == "CYCLE997") {
    return name == "997 ball" ? joined(range(0, 11), {28}) : range(0, 28);
  } else if (cycle == "CYCLE998") {
    list = name == "998 edge" ? Indices{0, 4, 16, 28, 30} : Indices{0, 1, 4, 5, 16, 17, 28, 30};
    if (task == Task::ZeroOffset) list = joined(list, name == "998 edge" ? Indices{20} : range(20, 23));
  } else if (cycle == "CYCLE995") {
    return joined(range(2, 28), {});
  } else if (name == "976 ring") {
    return joined(range(4, 15), {20, 21, 24, 27, 28});
  } else if (name == "976 ball") {
    return joined(range(4, 22), {24, 27, 28});
  }
  if (task == Task::Tool) list = joined(list, {8, 12, 20, 27, 28, 29, 30, 31});
  return list;
}

Indices integersOf(const Variant& variant, Task task) {
  const std::string_view cycle = variant.cycle;
  if (task == Task::Tool) return {0, 2, 3, 4, 5, 6, 7, 8, 13};
  if (task == Task::MeasureOnly) return {2, 3, 5};
  return cycle == "CYCLE978" || cycle == "CYCLE998" ? Indices{0, 2, 3, 5, 7, 11} : Indices{0, 2, 3, 5, 11};
}

void expectList(const Variant& variant, Task task) {
  Planter plant(31);
  simulation::Truth truth = perfectWorld();
  variant.part(truth, displaced(variant, translation(origin), plant, 0.02, 0.3));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  bench.set("$TC_DP1", {7, 1}, 120);
  for (double& value : bench.control.ovr)
    value = 77;
  for (int& value : bench.control.ovi)
    value = 77;
  const int number = static_cast<int>(valueOf(variant.call, "S_MVAR"));
  const int hundreds = static_cast<int>(task) - number / 100 % 10;
  NamedNumbers call = with(variant.call, {{"S_MVAR", number + 100 * hundreds}, {"S_KNUM", task == Task::ZeroOffset}});
  if (task == Task::Tool || std::string_view(variant.cycle) == "CYCLE995")
    call = with(call, {{"S_KNUM1", 1}, {"_AMODE", 1}, {"S_TUL", 3}, {"S_TLL", -3}});
  bench.start(variant.start);
  bench.run(variant.cycle, call, task == Task::Tool ? NamedTexts{{"S_TNAME", "MILL"}} : NamedTexts{});
  Indices reals, integers;
  for (const control::ResultRecord& result : bench.control.journal.cycles.back().results) {
    EXPECT_FALSE(result.meaning.empty()) << result.name;
    const int index = std::stoi(result.name.substr(5));
    (result.name.starts_with("_OVR[") ? reals : integers).insert(index);
  }
  EXPECT_EQ(reals, listOf(variant, task));
  EXPECT_EQ(integers, integersOf(variant, task));
  for (std::size_t i = 0; i < bench.control.ovr.size(); ++i) {
    // Those between belong to CYCLE996.
    const bool kept = i >= bench.control.firstKept && i < bench.control.afterKept;
    EXPECT_TRUE(reals.contains(static_cast<int>(i)) || bench.control.ovr[i] == (kept ? 77 : 0)) << i;
  }
  for (int i = 0; i < static_cast<int>(bench.control.ovi.size()); ++i)
    EXPECT_TRUE(integers.contains(i) || bench.control.ovi[static_cast<std::size_t>(i)] == 0) << i;
  EXPECT_EQ(bench.control.data.text("_OVS_TNAME", {}), task == Task::Tool ? "MILL" : "");
}

TEST(ResultLists, AreThoseOfTheManual) {
  for (const Variant& variant : everyCall()) {
    const std::string_view cycle = variant.cycle;
    for (const Task task : {Task::MeasureOnly, Task::ZeroOffset, Task::Tool}) {
      if (task == Task::ZeroOffset && !variant.corrects()) continue;
      if (task == Task::Tool && cycle != "CYCLE977" && cycle != "CYCLE978" && cycle != "CYCLE979") continue;
      SCOPED_TRACE(fmt::format("{} task {}", variant.name, static_cast<int>(task)));
      expectList(variant, task);
    }
  }
}

TEST(ResultLists, OfTheOtherCalibrations) {
  const auto block = [](simulation::Truth& truth, const Pose& pose) {
    place(truth, simulation::Box({0, 0, -60}, {100, 100, 0}), pose);
  };
  const struct {
    NamedNumbers call;
    Vector3 start;
    Indices list;
  } cases[] = {
      {{{"S_MVAR", 0}}, {30, 30, 8}, {4, 5, 16, 17, 18, 19, 22, 27, 28}},
      {{{"S_MVAR", 1000000}}, {30, 30, 8}, {4, 5, 16, 17, 18, 19, 22, 27, 28}},
      {{{"S_MVAR", 1004}, {"S_MA", 1}}, {-12, 30, -10}, {4, 5, 8, 9, 10, 11, 12, 13, 14, 15, 20, 21, 24, 27, 28}},
  };
  for (const auto& [call, start, list] : cases) {
    SCOPED_TRACE(call.front().second);
    simulation::Truth truth = perfectWorld();
    block(truth, translation(origin));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.start(start);
    // An angle has no meaning on a surface.
    bench.run("CYCLE976", with(call, {{"S_FA", 6}, {"S_TSA", 4}, {"S_STA1", 20}}));
    Indices reals;
    for (const control::ResultRecord& result : bench.control.journal.cycles.back().results) {
      EXPECT_FALSE(result.meaning.empty()) << result.name;
      if (result.name.starts_with("_OVR[")) reals.insert(std::stoi(result.name.substr(5)));
    }
    EXPECT_EQ(reals, list);
    EXPECT_EQ(bench.ovr(24), 0);
  }
}

}  // namespace
}  // namespace probewright
