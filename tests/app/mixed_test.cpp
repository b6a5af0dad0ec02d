#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "app/mixed_program.hpp"
#include "app/mixed_tool_program.hpp"
#include "app/program.hpp"

/// A long program on a fine part: all results are right, and neither time nor memory runs away.
namespace probewright::app::testing {
namespace {

using nlohmann::json;

constexpr double mostSeconds = 5, mostMegabytes = 300;

/// The results of a run that ends well, in time and memory.
json resultsOf(const Folder& folder, const std::string& program, const std::string& setup) {
  const auto run = [&] {
    return probewright({"run", program, "--setup", setup, "--out", (folder / "out").string(), "--quiet"});
  };
  Answer answer = run();
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  // Other work on the same core or caches takes processor time, too; what a run needs itself is the least that it
  // takes.
  if (PROBEWRIGHT_OPTIMIZED && answer.cpuSeconds >= mostSeconds) answer = run();
  if (PROBEWRIGHT_OPTIMIZED) {
    EXPECT_LT(answer.cpuSeconds, mostSeconds);
    EXPECT_LT(answer.peakMegabytes, mostMegabytes);
  }
  return json::parse(textOf(folder / "out" / "results.json"));
}

json resultsOnPlate(const std::string& control, const std::string& name, const std::string& program) {
  const Folder folder;
  folder.file("plate.stl", mixed::plateStl());
  return resultsOf(folder, folder.file(name, program), folder.file("plate.toml", mixed::plateSetup(control)));
}

/// The values of a result in all cycles of a name.
std::vector<double> valuesOf(const json& results, const std::string& cycle, const std::string& name) {
  std::vector<double> values;
  for (const json& each : results.at("cycles")) {
    if (each.at("name") != cycle) continue;
    for (const json& result : each.at("results")) {
      if (result.at("name") == name) values.push_back(result.at("value"));
    }
  }
  return values;
}

/// The hole is a polygon of 400 sides: 0.6 µm between its flats and corners. The plate is turned by 0.05 degrees, which
/// makes its width of 100 mm longer by 0.04 µm.
TEST(ThousandCycles, MeasureRightInTimeAndMemoryInKlartext) {
  const json results = resultsOnPlate("TNC640", "mixed.h", mixed::klartextProgram(1000));
  EXPECT_EQ(results.at("cycles").size(), 1000U);
  EXPECT_THAT(valuesOf(results, "421", "Q153"), ::testing::Each(::testing::DoubleNear(40, 0.0015)));
  EXPECT_THAT(valuesOf(results, "421", "Q151"), ::testing::Each(::testing::DoubleNear(0.3, 0.0015)));
  EXPECT_THAT(valuesOf(results, "426", "Q156"), ::testing::Each(::testing::DoubleNear(100, 0.001)));
  EXPECT_THAT(valuesOf(results, "427", "Q160"), ::testing::Each(::testing::DoubleNear(0, 1e-5)));
  EXPECT_THAT(valuesOf(results, "420", "Q150"), ::testing::Each(::testing::DoubleNear(0.05, 1e-5)));
  EXPECT_EQ(valuesOf(results, "421", "Q153").size(), 112U);
}

TEST(ThousandCycles, MeasureRightInTimeAndMemoryInSinumerik) {
  const json results = resultsOnPlate("840Dsl", "mixed.mpf", mixed::sinumerikProgram(1000));
  EXPECT_EQ(results.at("cycles").size(), 1000U);
  EXPECT_THAT(valuesOf(results, "CYCLE977", "_OVR[4]"), ::testing::Each(::testing::DoubleNear(40, 0.0015)));
  EXPECT_EQ(valuesOf(results, "CYCLE978", "_OVR[4]").size(), 666U);
}

/// Tools, kinematics and working space, 143 times seven cycles. The turning mill is found at most the feed of a turn,
/// 0.005 mm, too short and too thin. The sphere's middle lies 0.3 and 0.2 mm aside of the preset and 0.2 mm lower.
TEST(ThousandCycles, MeasureToolsAndKinematicsInTimeAndMemory) {
  const Folder folder;
  const json results = resultsOf(folder, folder.file("mix.h", mixed::toolProgram(143)),
                                 folder.file("mix.toml", std::string(mixed::toolSetup)));
  EXPECT_EQ(results.at("cycles").size(), 2U + 143 * 7);
  for (const char* cycle : {"481", "483"})
    EXPECT_THAT(valuesOf(results, cycle, "Q115"), ::testing::Each(::testing::DoubleNear(0, 0.006)));
  EXPECT_THAT(valuesOf(results, "482", "Q116"), ::testing::Each(::testing::DoubleNear(0, 0.006)));
  const std::vector<double> left = valuesOf(results, "451", "Q144");
  ASSERT_EQ(left.size(), 143U);
  EXPECT_THAT(left, ::testing::Each(::testing::DoubleNear(0, 1e-6)));
  EXPECT_NEAR(valuesOf(results, "451", "Q141").front(), 0.0316, 0.01) << "0.03 mm lower, 0.01 mm aside";
  const double reach = 12.5 + 2, pole = std::sqrt(reach * reach - 0.3 * 0.3 - 0.2 * 0.2) - 2 - 0.2;
  EXPECT_THAT(valuesOf(results, "427", "Q160"), ::testing::Each(::testing::DoubleNear(pole, 1e-4)));
  EXPECT_THAT(valuesOf(results, "601", "Q601"), ::testing::Each(1)) << "no error";
}

}  // namespace
}  // namespace probewright::app::testing
