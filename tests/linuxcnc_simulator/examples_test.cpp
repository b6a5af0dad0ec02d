#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/linuxcnc_session.hpp"

/// The examples as the documents start them, without a screen.
namespace probewright::testing {
namespace {

class LinuxCncExamples : public ::testing::Test {
protected:
  void SetUp() override {
    if (!session_.needModule("linuxcnc/feel/probewright_feel.so"))
      GTEST_SKIP() << "only root can lend LinuxCNC a module that is not installed";
  }
  std::string start(const std::string& words) const {
    return session_.command("env PROBEWRIGHT_BUILD='" + session_.build().string() + "' '" +
                            (session_.source() / "examples/linuxcnc/start").string() + "' " + words);
  }
  LinuxCncSession session_{PROBEWRIGHT_SOURCE_DIR, PROBEWRIGHT_BUILD_DIR};
};

/// The numbers of the line that begins with `word`.
std::vector<double> line(const std::string& output, const std::string& word) {
  const std::size_t at = output.find("\n" + word + " ");
  if (at == std::string::npos) return {};
  return LinuxCncSession::told("desk: " + output.substr(at + 1), word);
}

constexpr double bound = 300.0 / 60 * 0.001 + 1e-4;  // mm: a servo period at the probing feed
constexpr double pretravel = 0.004;

TEST_F(LinuxCncExamples, FindTheMiddleOfABoreOnTheMill) {
  const std::string output = start("mill3 bore.ngc");
  const auto bore = line(output, "bore");
  ASSERT_EQ(bore.size(), 4U) << output;
  EXPECT_NEAR(bore[0], 1.7, bound) << output;
  EXPECT_NEAR(bore[1], -0.9, bound);
  // Ball radius 3; the signals come by the pretravel too late.
  EXPECT_NEAR(bore[2], -0.9 + 30.01 / 2 - 3 + pretravel, bound);
  EXPECT_NEAR(bore[3], -0.9 - 30.01 / 2 + 3 - pretravel, bound);
}

TEST_F(LinuxCncExamples, TouchTheSamePlaceUprightAndTilted) {
  const std::string output = start("mill5 tilted.ngc");
  const auto top = line(output, "top");
  ASSERT_EQ(top.size(), 2U) << output;
  // The top lies at Z-250, the centre of the ball 3 mm above it. Pretravel acts across the stylus only, and along the
  // way: tilted by 30 degrees a quarter of it.
  EXPECT_NEAR(top[0], -247, bound) << output;
  EXPECT_NEAR(top[1], -247 - pretravel / 4, bound) << output;
}

}  // namespace
}  // namespace probewright::testing
