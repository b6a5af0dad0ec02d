#include <gtest/gtest.h>

#include "told.hpp"

/// The unit in which a run's summary shows lengths: that of the main program.
namespace probewright::truth::testing {
namespace {

TEST(UnitsOfASummary, OfASinumerikProgramAreThoseInForceAtItsEnd) {
  World world;
  world.control = "840Dsl";
  world.part = plate("{ z = -480 }");
  for (const std::string metric : {"", "G71\n", "G710\n", "G700\nG710\n"}) {
    const Told told = run(world, metric);
    ASSERT_TRUE(told.finished()) << told.why();
    EXPECT_FALSE(told.outcome.info.inches) << metric;
  }
  for (const std::string inch : {"G70\n", "G700\n", "G710\nG700\n"}) {
    const Told told = run(world, inch);
    ASSERT_TRUE(told.finished()) << told.why();
    EXPECT_TRUE(told.outcome.info.inches) << inch;
  }
}

}  // namespace
}  // namespace probewright::truth::testing
