#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/mixed_program.hpp"
#include "app/program.hpp"

/// A long program on a fine part: all results are right, and neither time nor memory runs away.
namespace probewright::app::testing {
namespace {

using nlohmann::json;

constexpr double mostSeconds = 5, mostMegabytes = 300;

json resultsOf(const std::string& control, const std::string& name, const std::string& program) {
  const Folder folder;
  folder.file("plate.stl", mixed::plateStl());
  const std::string setup = folder.file("plate.toml", mixed::plateSetup(control));
  const Answer answer =
      probewright({"run", folder.file(name, program), "--setup", setup, "--out", (folder / "out").string(), "--quiet"});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  if (PROBEWRIGHT_OPTIMIZED) {
    EXPECT_LT(answer.cpuSeconds, mostSeconds);
    EXPECT_LT(answer.peakMegabytes, mostMegabytes);
  }
  return json::parse(textOf(folder / "out" / "results.json"));
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
  const json results = resultsOf("TNC640", "mixed.h", mixed::klartextProgram(1000));
  EXPECT_EQ(results.at("cycles").size(), 1000U);
  EXPECT_THAT(valuesOf(results, "421", "Q153"), ::testing::Each(::testing::DoubleNear(40, 0.0015)));
  EXPECT_THAT(valuesOf(results, "421", "Q151"), ::testing::Each(::testing::DoubleNear(0.3, 0.0015)));
  EXPECT_THAT(valuesOf(results, "426", "Q156"), ::testing::Each(::testing::DoubleNear(100, 0.001)));
  EXPECT_THAT(valuesOf(results, "427", "Q160"), ::testing::Each(::testing::DoubleNear(0, 1e-5)));
  EXPECT_THAT(valuesOf(results, "420", "Q150"), ::testing::Each(::testing::DoubleNear(0.05, 1e-5)));
  EXPECT_EQ(valuesOf(results, "421", "Q153").size(), 112U);
}

TEST(ThousandCycles, MeasureRightInTimeAndMemoryInSinumerik) {
  const json results = resultsOf("840Dsl", "mixed.mpf", mixed::sinumerikProgram(1000));
  EXPECT_EQ(results.at("cycles").size(), 1000U);
  EXPECT_THAT(valuesOf(results, "CYCLE977", "_OVR[4]"), ::testing::Each(::testing::DoubleNear(40, 0.0015)));
  EXPECT_EQ(valuesOf(results, "CYCLE978", "_OVR[4]").size(), 666U);
}

}  // namespace
}  // namespace probewright::app::testing
