#include <gtest/gtest.h>

#include "study/program_bench.hpp"

/// The studies of the examples, with few trials: every source reaches the program, and no trial comes to an alarm.
namespace probewright::study::testing {
namespace {

struct Example {
  const char *study, *program, *setup;
};
void PrintTo(const Example& example, std::ostream* out) { *out << example.study; }

class ExampleStudies : public ::testing::TestWithParam<Example> {};

TEST_P(ExampleStudies, RunAndVary) {
  const std::filesystem::path root = PROBEWRIGHT_EXAMPLES;
  Diagnostics mistakes;
  auto document = setup::SetupDocument::read(root / GetParam().setup, mistakes);
  ASSERT_TRUE(document) << format(mistakes.front());
  auto study = readStudy(root / "studies" / GetParam().study, document->table(), mistakes);
  ASSERT_TRUE(study) << format(mistakes.front());
  study->trials = 8;
  study->sensitivityTrials = 10;
  const toml::table table = document->table();
  const auto model = ProgramModel::make(root / GetParam().program, std::move(*document), *study, {}, mistakes);
  ASSERT_TRUE(model) << format(mistakes.front());
  const StudyResult result = runStudy(*study, table, [&](const Draw& draw) { return model->run(draw); }, {});
  EXPECT_EQ(result.finished, 8U) << (result.stops.empty() ? "" : result.stops.front().why);
  EXPECT_TRUE(result.diagnostics.empty()) << format(result.diagnostics.front());
  EXPECT_FALSE(result.correlated.empty()) << "nothing varies";
}

INSTANTIATE_TEST_SUITE_P(All, ExampleStudies,
                         ::testing::Values(Example{"plate.toml", "first/plate.h", "first/plate.toml"},
                                           Example{"set-up.toml", "programs/housing.h", "setups/housing-tnc640.toml"},
                                           Example{"angle.toml", "studies/angle.h", "first/plate.toml"},
                                           Example{"calibrated.toml", "first/plate.h", "studies/calibrated.setup.toml"},
                                           Example{"turning.toml", "programs/shaft.mpf", "setups/shaft-lathe.toml"},
                                           Example{"tool.toml", "programs/tool.h", "setups/tool-tnc640.toml"},
                                           Example{"kinematics.toml", "programs/kinematics.h",
                                                   "setups/kinematics-tnc640.toml"}),
                         [](const auto& each) {
                           std::string name;
                           for (const char c : std::string(each.param.study))
                             if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
                           return name;
                         });

}  // namespace
}  // namespace probewright::study::testing
