#include "cycles/result_kinds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "cycles/catalogue.hpp"

namespace probewright::cycles {
namespace {

using control::Role;

/// True if some measuring variant leaves both.
bool meet(const ResultDefinition& a, const ResultDefinition& b) {
  return a.variants == 0 || b.variants == 0 || (a.variants & b.variants) != 0;
}

template <class Check>
void forEveryResult(Check check) {
  for (const auto kind : control::allControlKinds) {
    for (const CycleDefinition* cycle : cyclesOf(kind)) {
      for (const ResultDefinition& result : cycle->results)
        check(*cycle, result);
    }
  }
}

// Whoever puts set value, actual value and difference side by side finds one of each.
TEST(ResultKinds, AreUniqueWithinACall) {
  forEveryResult([](const CycleDefinition& cycle, const ResultDefinition& result) {
    if (result.kind.role != Role::Actual && result.kind.role != Role::Set && result.kind.role != Role::Difference)
      return;
    int same = 0;
    for (const ResultDefinition& other : cycle.results) {
      same += other.kind.role == result.kind.role && other.kind.of == result.kind.of && meet(result, other) ? 1 : 0;
    }
    EXPECT_EQ(same, 1) << cycle.name << " " << result.name;
  });
}

TEST(ResultKinds, AgreeWithTheirText) {
  forEveryResult([](const CycleDefinition& cycle, const ResultDefinition& result) {
    const std::string text = result.meaning.whole();
    SCOPED_TRACE(std::string(cycle.name) + " " + std::string(result.name) + " " + text);
    EXPECT_FALSE(result.meaning.label.empty());
    const auto has = [&](const char* word) { return text.find(word) != std::string::npos; };
    EXPECT_EQ(text.starts_with("set "), result.kind.role == Role::Set && !has("expected"));
    EXPECT_EQ(has("upper tolerance limit"), result.kind.role == Role::UpperLimit);
    EXPECT_EQ(has("lower tolerance limit"), result.kind.role == Role::LowerLimit);
    if (text.starts_with("actual ")) {
      EXPECT_EQ(result.kind.role, Role::Actual);
    }
    if (text.starts_with("difference")) {
      EXPECT_EQ(result.kind.role, Role::Difference);
    }
    EXPECT_EQ(has("machine coordinates"), result.kind.of.system == control::System::Machine);
    if (result.kind.role == Role::Actual && has("diameter")) {
      EXPECT_EQ(result.kind.of.quantity, control::Quantity::Diameter);
    }
  });
}

TEST(ResultKinds, TellTheUnit) {
  const ResultDefinition angle{"Q150", "measured angle", result::actual(of::angle)};
  const ResultDefinition diameter{"Q153", "actual diameter", result::actual(of::diameter)};
  const ResultDefinition verdict{"Q180", "1: within tolerance", result::status};
  const ResultDefinition name{"_OVS_TNAME", "name of the corrected tool", result::setting(of::name)};
  EXPECT_EQ(angle.valueKind(), ValueKind::Angle);
  EXPECT_EQ(diameter.valueKind(), ValueKind::Length);
  EXPECT_EQ(verdict.valueKind(), ValueKind::Integer);
  EXPECT_EQ(name.valueKind(), ValueKind::Text);
}

/// CYCLE971 leaves its edges one by one: _OVR[100] to [199] their radius, [200] to [299] its difference, and so on.
TEST(ResultKinds, OfSingleEdgesFollowTheirIndex) {
  const auto cycles = cyclesOf(control::ControlKind::Sinumerik840Dsl);
  const auto cycle = std::ranges::find(cycles, "CYCLE971", &CycleDefinition::name);
  ASSERT_NE(cycle, cycles.end());
  using Meaning = std::pair<Role, control::Characteristic>;
  const auto kindOf = [&](const char* name) {
    const ResultDefinition* found = (*cycle)->result(name, 1);
    return found == nullptr ? std::optional<Meaning>() : Meaning(found->kind.role, found->kind.of);
  };
  for (const char* name : {"_OVR[100]", "_OVR[150]", "_OVR[199]"})
    EXPECT_EQ(kindOf(name), Meaning(Role::Actual, of::radius.number(1))) << name;
  for (const char* name : {"_OVR[200]", "_OVR[299]"})
    EXPECT_EQ(kindOf(name), Meaning(Role::Difference, of::radius.number(1))) << name;
  for (const char* name : {"_OVR[300]", "_OVR[399]"})
    EXPECT_EQ(kindOf(name), Meaning(Role::Actual, of::length1.number(1))) << name;
  for (const char* name : {"_OVR[400]", "_OVR[499]"})
    EXPECT_EQ(kindOf(name), Meaning(Role::Difference, of::length1.number(1))) << name;
  for (const char* name : {"_OVR[99]", "_OVR[500]", "_OVR[100", "_OVI[150]", "_OVR[x]"})
    EXPECT_EQ(kindOf(name), std::nullopt) << name;
  EXPECT_EQ((*cycle)->result("_OVR[100]", 0), nullptr) << "calibration leaves no edges";
}

TEST(ResultKinds, HaveNames) {
  EXPECT_EQ(control::nameOf(Role::Statistic), "statistic");
  EXPECT_EQ(control::nameOf(control::Quantity::Name), "name");
  EXPECT_EQ(control::nameOf(control::Along::Table), "table");
  EXPECT_EQ(control::nameOf(control::System::Machine), "machine");
}

}  // namespace
}  // namespace probewright::cycles
