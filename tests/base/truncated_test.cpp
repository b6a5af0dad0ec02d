#include "base/truncated.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace probewright {
namespace {

TEST(Truncated, LeavesTheDecimalsOut) {
  EXPECT_EQ(truncated(2.9), 2);
  EXPECT_EQ(truncated(-2.9), -2);
  EXPECT_EQ(truncated<std::int64_t>(9007199254740992.0), 9007199254740992);
}

TEST(Truncated, EndsWhereTheIntegersEnd) {
  EXPECT_EQ(truncated(3.3e83), std::numeric_limits<int>::max());
  EXPECT_EQ(truncated(2147483647.5), 2147483647);
  EXPECT_EQ(truncated(2147483648.0), 2147483647);
  EXPECT_EQ(truncated(-3.3e83), std::numeric_limits<int>::min());
  EXPECT_EQ(truncated<std::int64_t>(9223372036854775808.0), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(truncated<std::int64_t>(-1e300), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(truncated(std::numeric_limits<double>::infinity()), std::numeric_limits<int>::max());
  EXPECT_EQ(truncated(std::numeric_limits<double>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace probewright
