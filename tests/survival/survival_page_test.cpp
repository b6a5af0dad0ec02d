#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survival/survival_records.hpp"

namespace probewright::survival {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The page lists the clampings that fail, each with its values, its seed and where and why the program stopped.
TEST(SurvivalPage, ListsTheClampingsThatFailIfThereAreAny) {
  const SurvivalInfo info{.program = "P.H", .setup = "plate.toml", .version = "1", .text = "0 BEGIN PGM P MM\n"};
  Survival survival;
  EXPECT_THAT(survivalPage(survival, info), Not(HasSubstr("Clampings that fail")));
  survival.failures = {{.sample = 4,
                        .values = {0.25, -1.5},
                        .noise = 77,
                        .reason = {.why = "no contact <X>", .place = {.file = "P.H", .line = 3, .column = 1}}}};
  const std::string page = survivalPage(survival, info);
  EXPECT_THAT(page, HasSubstr("Clampings that fail"));
  EXPECT_THAT(page, HasSubstr("<tr><td>0.2500</td><td>-1.5000</td><td>77</td><td>3</td>"
                              "<td class=\"t\">no contact &lt;X&gt;</td></tr>"));
}

/// What survives about the middle is framed in the picture, in proportion, if there is anything of the kind.
TEST(SurvivalPage, FramesWhatSurvivesAboutTheMiddle) {
  const SurvivalInfo info{.program = "P.H", .setup = "plate.toml", .version = "1", .text = "0 BEGIN PGM P MM\n"};
  const std::string frame = "style=\"stroke:#10502f";
  Survival survival;
  survival.tolerances.resize(2);
  for (Tolerance& each : survival.tolerances) {
    each.low = -1;
    each.high = 1;
  }
  survival.symmetric = 0;
  EXPECT_THAT(survivalPage(survival, info), Not(HasSubstr(frame)));
  const auto widthOf = [&](double symmetric) {
    survival.symmetric = symmetric;
    const std::string page = survivalPage(survival, info);
    const std::size_t at = page.find("width=\"", page.find(frame));
    EXPECT_NE(page.find(frame), std::string::npos) << symmetric;
    return at == std::string::npos ? 0.0 : std::stod(page.substr(at + 7));
  };
  EXPECT_GT(widthOf(0.25), 10);
  EXPECT_NEAR(widthOf(0.5), 2 * widthOf(0.25), 0.02);
}

/// A picture of two sides shows the parts that hold the middle of the third.
TEST(SurvivalPage, ShowsTheSliceThroughTheMiddle) {
  const SurvivalInfo info{.program = "P.H", .setup = "plate.toml", .version = "1", .text = "0 BEGIN PGM P MM\n"};
  Survival survival;
  survival.tolerances.resize(3);
  for (Tolerance& each : survival.tolerances) {
    each.low = -1;
    each.high = 1;
  }
  survival.parts.resize(2);
  survival.parts[0].box = {{-1, -1, -1}, {1, 1, 0.5}};
  survival.parts[1].box = {{-1, -1, 0.5}, {1, 1, 1}};
  const auto drawn = [&](Verdict first, Verdict second, Verdict counted) {
    survival.parts[0].verdict = first;
    survival.parts[1].verdict = second;
    const std::string page = survivalPage(survival, info), name = counted == Verdict::Proven ? "proven" : "fails";
    std::size_t count = 0;
    for (std::size_t at = page.find("<rect class=\"" + name); at != std::string::npos;
         at = page.find("<rect class=\"" + name, at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(drawn(Verdict::Proven, Verdict::Fails, Verdict::Proven), 3U) << "in the pictures of all three pairs";
  EXPECT_EQ(drawn(Verdict::Proven, Verdict::Fails, Verdict::Fails), 2U) << "not in that of the first two sides";
}

}  // namespace
}  // namespace probewright::survival
