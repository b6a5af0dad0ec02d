#include <set>

#include "lathe_tools/tool_bench.hpp"

/// The lists of results of the manual for every kind of tool of CYCLE982: what stands in a list is set, nothing else
/// is, and everything has a meaning.
namespace probewright {
namespace {

using namespace testing_support;
using Indices = std::set<int>;

TEST(LatheToolResultLists, AreThoseOfTheManual) {
  const Indices calibration = {2, 3, 5}, tool = {0, 2, 3, 5, 7, 8};
  const struct {
    const char* what;
    int tool;
    const char* call;
    Indices reals, integers;
  } cases[] = {
      {"calibrating Z in minus direction", 5, "CYCLE982(0,,1,1,2,,5,1)", {8, 9, 27, 28}, calibration},
      {"calibrating X in minus direction", 5, "CYCLE982(0,,1,2,2,,5,1)", {12, 13, 27, 28}, calibration},
      {"turning tool, completely", 5, "CYCLE982(2,0,1,,,,5,1)", {8, 9, 10, 11, 27, 28, 29, 30}, tool},
      {"turning tool along X", 5, "CYCLE982(1,0,1,2,,,5,1)", {8, 9, 27, 28, 29, 30}, tool},
      {"mill, completely", 6, "CYCLE982(2,0,1,,,,5,1,,,,,,1,,,102)", {8, 9, 10, 11, 12, 13, 27, 28, 29, 30}, tool},
      {"radius of a mill", 6, "CYCLE982(1001,0,1,2,,,5,1)", {12, 13, 27, 28, 29, 30}, tool},
      {"drill along Z", 7, "CYCLE982(1,0,1,1,,,5,1,,,,,,1,,,202)", {10, 11, 27, 28, 29, 30}, tool},
  };
  for (const auto& each : cases) {
    SCOPED_TRACE(each.what);
    setup::Setup setup = toolSetup();
    add(setup, turningTool(5, 3, {80, 40}, 0.8), "turn");
    add(setup, rotatedTool(6, false, {60, 90}, 8), "mill");
    add(setup, rotatedTool(7, false, {60, 90}, 5), "drill");
    LatheBench bench(setup);
    for (double& value : bench.control.ovr)
      value = 77;
    for (int& value : bench.control.ovi)
      value = 77;
    bench.run(measuring(each.tool, {445, 190}, each.call));
    Indices reals, integers;
    for (const control::ResultRecord& result : bench.control.journal.cycles.back().results) {
      EXPECT_FALSE(result.meaning.empty()) << result.name;
      if (result.name.starts_with("_OVR[")) reals.insert(std::stoi(result.name.substr(5)));
      if (result.name.starts_with("_OVI[")) integers.insert(std::stoi(result.name.substr(5)));
    }
    EXPECT_EQ(reals, each.reals);
    EXPECT_EQ(integers, each.integers);
    EXPECT_EQ(bench.ovi(2), 982);
    EXPECT_EQ(bench.ovi(5), 1);
    for (int i = 0; i < 32; ++i)
      EXPECT_TRUE(reals.contains(i) || bench.control.ovr[static_cast<std::size_t>(i)] == 0) << i;
    for (int i = 0; i < 20; ++i)
      EXPECT_TRUE(integers.contains(i) || bench.control.ovi[static_cast<std::size_t>(i)] == 0) << i;
  }
}

}  // namespace
}  // namespace probewright
