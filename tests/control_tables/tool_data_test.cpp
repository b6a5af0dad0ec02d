#include "control/sinumerik/tool_data.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

/// Tool data of a SINUMERIK: which of them add up to the size of an edge.
namespace probewright::control::sinumerik {
namespace {

/// Each in a decimal place of its own: geometry, wear, adapter, additive and setup offset of the DL that is asked for.
TEST(ToolData, AddUpWithTheOffsetsOfTheirDl) {
  DataStore store;
  store.set("$TC_DP1", {3, 2}, 120.0);
  for (int length = 0; length < 3; ++length) {
    store.set(fmt::format("$TC_DP{}", 3 + length), {3, 2}, 100.0 + length);
    store.set(fmt::format("$TC_DP{}", 12 + length), {3, 2}, 0.1);
    store.set(fmt::format("$TC_DP{}", 21 + length), {3, 2}, 0.02);
  }
  store.set("$TC_DP6", {3, 2}, 5.0);
  store.set("$TC_DP15", {3, 2}, 0.1);
  for (int dl = 1; dl <= 9; ++dl) {
    for (const int parameter : {3, 4, 5, 6}) {
      store.set(fmt::format("$TC_SCP{}", 10 * dl + parameter), {3, 2}, 0.001 * dl);
      store.set(fmt::format("$TC_ECP{}", 10 * dl + parameter), {3, 2}, 0.0001 * dl);
    }
  }
  for (int dl = 0; dl <= 7; ++dl) {
    SCOPED_TRACE(dl);
    const auto edge = toolEdge(store, 3, 2, dl);
    ASSERT_TRUE(edge);
    const double offset = dl <= 6 ? 0.0011 * dl : 0;  // an edge has 1 to 6
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(edge->totalLength()[i], 100.12 + static_cast<double>(i) + offset, 1e-12);
    EXPECT_NEAR(edge->totalRadius(), 5.1 + offset, 1e-12);
  }
  EXPECT_FALSE(toolEdge(store, 3, 1));
  EXPECT_FALSE(toolEdge(store, 2, 2));
}

TEST(ToolData, OfSizesAreKnownByTheirNames) {
  const std::set<int> sizes = {3, 4, 5, 6, 12, 13, 14, 15, 21, 22, 23};
  for (int parameter = 0; parameter <= 26; ++parameter)
    EXPECT_EQ(isToolSize(fmt::format("$TC_DP{}", parameter)), sizes.contains(parameter)) << parameter;
  for (const char* name : {"$TC_SCP13", "$TC_SCP66", "$TC_ECP13", "$TC_ECP66"})
    EXPECT_TRUE(isToolSize(name)) << name;
  for (const char* name :
       {"$TC_DPX", "$TC_SCP3", "$TC_SCP9", "$TC_SCP12", "$TC_SCP22", "$TC_SCP100", "$TC_TP2", "$TC_DP"})
    EXPECT_FALSE(isToolSize(name)) << name;
  EXPECT_EQ(offsetNumber("$TC_SCP13"), 1);
  EXPECT_EQ(offsetNumber("$TC_ECP66"), 6);
  // Each DL has the parameters 3 to 11.
  EXPECT_EQ(offsetNumber("$TC_SCP21"), 1);
  EXPECT_EQ(offsetNumber("$TC_ECP31"), 2);
  EXPECT_EQ(offsetNumber("$TC_ECP71"), 6);
  for (const char* name : {"$TC_SCP12", "$TC_SCP22", "$TC_ECP72", "$TC_SCP73"})
    EXPECT_EQ(offsetNumber(name), std::nullopt) << name;
  EXPECT_EQ(additiveOffsetName(2, 4), "$TC_SCP24");
  EXPECT_EQ(setupOffsetName(6, 3), "$TC_ECP63");
}

}  // namespace
}  // namespace probewright::control::sinumerik
