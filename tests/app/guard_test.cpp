#include "guard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

/// What a subcommand that ends like this leaves: its exit code, and what stands on standard error.
std::pair<int, std::string> ended(const std::function<int()>& command) {
  CaptureStderr();
  const int code = guarded(command);
  return {code, GetCapturedStderr()};
}

TEST(Guard, PassesTheExitCodesOfSubcommandsOn) {
  for (const int code : {0, 1, 2, 3})
    EXPECT_EQ(ended([code] { return code; }), std::pair(code, std::string()));
}

TEST(Guard, TurnsExceptionsIntoExitCodeFour) {
  const auto [code, text] = ended([]() -> int { throw std::out_of_range("index 7 of 5"); });
  EXPECT_EQ(code, 4);
  EXPECT_THAT(text, HasSubstr("internal error: index 7 of 5"));
}

TEST(Guard, TurnsWhatIsNoStandardExceptionIntoExitCodeFour) {
  struct LibraryFailure {};
  const auto [code, text] = ended([]() -> int { throw LibraryFailure(); });
  EXPECT_EQ(code, 4);
  EXPECT_THAT(text, HasSubstr("internal error"));
}

}  // namespace
}  // namespace probewright::app::testing
