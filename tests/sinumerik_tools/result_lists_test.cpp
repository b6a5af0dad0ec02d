#include <set>

#include "sinumerik_tools/tool_bench.hpp"

/// The lists of results of the manual for every variant of CYCLE971: what stands in a list is set, nothing else is, and
/// everything has a meaning.
namespace probewright {
namespace {

using namespace testing_support;
using Indices = std::set<int>;

TEST(ToolResultLists, AreThoseOfTheManual) {
  const Indices limits = {27, 28}, checked = {27, 28, 29, 30}, calibration = {2, 3, 5}, tool = {0, 2, 3, 5, 7, 8};
  const struct {
    const char* what;
    int tool;
    NamedNumbers call;
    Indices reals, integers;
  } cases[] = {
      {"side in plus direction", 9, {{"S_MVAR", 0}, {"S_MA", 1}, {"S_MD", 1}}, {10, 11}, calibration},
      {"side in minus direction", 9, {{"S_MVAR", 0}, {"S_MA", 102}, {"S_MD", 2}}, {12, 13}, calibration},
      {"upper face", 9, {{"S_MVAR", 0}, {"S_MA", 3}}, {16, 17}, calibration},
      {"complete", 9, {{"S_MVAR", 100000}}, {8, 9, 10, 11, 12, 13, 14, 15, 16, 17}, calibration},
      {"length", 2, {{"S_MVAR", 1}, {"S_MA", 3}}, {8, 9}, tool},
      {"radius, turning", 2, {{"S_MVAR", 2}, {"S_MA", 1}}, {10, 11}, tool},
      {"lengths of edges", 2, {{"S_MVAR", 102}, {"S_MA", 103}}, {8, 9, 12, 13, 300, 301, 302, 400, 401, 402}, tool},
      {"radii of edges", 2, {{"S_MVAR", 102}, {"S_MA", 1}}, {10, 11, 14, 15, 100, 101, 102, 200, 201, 202}, tool},
  };
  for (const auto& each : cases) {
    SCOPED_TRACE(each.what);
    ToolBench bench;
    bench.disc(10);
    bench.add(9, 80, 5);
    bench.add(2, 80, 10, 3);
    const ToolRun left = bench.measure(beside, with({{"S_PRNUM", 1}, {"S_FA", 3}, {"S_TSA", 2}}, each.call), each.tool);
    Indices reals, integers;
    for (const control::ResultRecord& result : left.cycle().results) {
      EXPECT_FALSE(result.meaning.empty()) << result.name;
      if (result.name.starts_with("_OVR[")) reals.insert(std::stoi(result.name.substr(5)));
      if (result.name.starts_with("_OVI[")) integers.insert(std::stoi(result.name.substr(5)));
    }
    Indices expected = each.reals;
    expected.merge(Indices(each.tool == 9 ? limits : checked));
    EXPECT_EQ(reals, expected);
    EXPECT_EQ(integers, each.integers);
    EXPECT_EQ(left.ovi(2), 971);
    EXPECT_EQ(left.ovi(3), each.call.front().second);
    EXPECT_EQ(left.ovi(5), 1);
  }
}

}  // namespace
}  // namespace probewright
