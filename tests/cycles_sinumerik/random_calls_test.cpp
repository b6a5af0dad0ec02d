#include <array>

#include "support/sinumerik_bench.hpp"

/// Calls with any arguments end well or with one alarm that says what to do; what follows is measured as before.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

/// Numbers as careless hands write them: digits of codes, usual lengths, zeros, signs, far too much.
double careless(std::mt19937_64& random, std::string_view name, double good) {
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<std::uint64_t>(count)); };
  switch (pick(6)) {
    case 0:
      return good;
    case 1:
      return 0;
    case 2:
      return -good;
    case 3:
      return name.starts_with("S_MVAR") || name.starts_with("S_KNUM") ? pick(20000000) : pick(13);
    case 4:
      return good + 0.001 * (pick(4001) - 2000);
    default:
      return std::array{1e-9, 0.5, 1e3, -1e3, 9e4, 90.0, -360.0, 7.5}[static_cast<std::size_t>(pick(8))];
  }
}

TEST(RandomCalls, EndWellOrWithAnAlarm) {
  const struct {
    const char* cycle;
    NamedNumbers good;
    Vector3 start;
  } calls[] = {
      {"CYCLE961",
       {{"S_MVAR", 106},
        {"S_KNUM", 1},
        {"S_SETV0", 20},
        {"S_SETV1", 60},
        {"S_SETV2", 40},
        {"S_SETV4", -12},
        {"S_SETV5", -12},
        {"S_STA1", 0},
        {"S_INCA", 90},
        {"S_ID", 0},
        {"S_FA", 12},
        {"S_TSA", 5},
        {"S_NMSP", 1}},
       {-12, -12, -10}},
      {"CYCLE976",
       {{"S_MVAR", 1},
        {"S_PRNUM", 1},
        {"S_SETV", 40},
        {"S_SETV0", 0},
        {"S_MA", 1},
        {"S_MD", 0},
        {"S_FA", 5},
        {"S_TSA", 3},
        {"S_VMS", 200},
        {"S_STA1", 20}},
       {-150, 0, -10}},
      {"CYCLE977",
       {{"S_MVAR", 101}, {"S_KNUM", 1},  {"S_KNUM1", 1},     {"S_SETV", 40}, {"S_SETV0", 40}, {"S_SETV1", 40},
        {"S_FA", 5},     {"S_TSA", 3},   {"S_STA1", 0},      {"S_ID", -10},  {"S_SZA", 10},   {"S_SZO", 10},
        {"S_MA", 1},     {"S_DLNUM", 1}, {"S_TZL", 0.01},    {"S_TDIF", 1},  {"S_TUL", 0.1},  {"S_TLL", -0.1},
        {"S_TMV", 0.2},  {"S_K", 2},     {"S_EVNUM", 10001}, {"_DMODE", 1},  {"_AMODE", 1}},
       {-150, 0, -10}},
      {"CYCLE978",
       {{"S_MVAR", 200},
        {"S_KNUM", 1},
        {"S_KNUM1", 1},
        {"S_PRNUM", 1},
        {"S_SETV", 0},
        {"S_FA", 6},
        {"S_TSA", 3},
        {"S_MA", 1},
        {"S_MD", 1},
        {"S_NMSP", 2},
        {"S_DLNUM", 1},
        {"S_K", 2},
        {"S_EVNUM", 10001},
        {"_AMODE", 1}},
       {-12, 30, -10}},
      {"CYCLE979",
       {{"S_MVAR", 1101},
        {"S_KNUM", 1},
        {"S_SETV", 40},
        {"S_FA", 5},
        {"S_TSA", 3},
        {"S_CPA", -150},
        {"S_CPO", 0},
        {"S_STA1", 0},
        {"S_INCA", 80}},
       {-142, 0, -10}},
      {"CYCLE995",
       {{"S_MVAR", 1102015},
        {"S_SETV", 30},
        {"S_FA", 5},
        {"S_TSA", 3},
        {"S_STA1", 10},
        {"S_DZ", 20},
        {"S_TUL", 0.1},
        {"S_TZL", 0.01},
        {"_AMODE", 1}},
       {150, 150, 40}},
      {"CYCLE997",
       {{"S_MVAR", 1101119},
        {"S_KNUM", 1},
        {"S_SETV", 30},
        {"S_FA", 5},
        {"S_TSA", 3},
        {"S_STA1", 10},
        {"S_INCA", 90},
        {"S_SETV0", 150},
        {"S_SETV1", 150},
        {"S_SETV2", 20},
        {"S_SETV3", 150},
        {"S_SETV4", 150},
        {"S_TNVL", 1}},
       {150, 150, 45}},
      {"CYCLE998",
       {{"S_MVAR", 100105},
        {"S_KNUM", 1},
        {"S_RA", 0},
        {"S_SETV", 0},
        {"S_STA1", 0},
        {"S_INCA", 0},
        {"S_FA", 8},
        {"S_TSA", 5},
        {"S_MA", 201},
        {"S_MD", 1},
        {"S_ID", 40},
        {"S_SETV0", 30},
        {"S_SETV2", 10},
        {"S_SETV3", 30},
        {"S_EVNUM", 1}},
       {-12, 20, -10}},
  };
  std::mt19937_64 random(20260);
  int well = 0, refused = 0;
  for (const auto& [cycle, good, start] : calls) {
    for (int i = 0; i < 150; ++i) {
      simulation::Truth truth = perfectWorld();
      place(truth, simulation::Box({0, 0, -60}, {100, 100, 0}), translation({0, 0, table}));
      place(truth, simulation::Ring(20, 45, -60), translation({-150, 0, table}));
      place(truth, simulation::SolidSphere(Vector3::Zero(), 15), translation({150, 150, table + 20}));
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
      bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
      bench.set("$TC_DP1", {7, 1}, 120);
      NamedNumbers call = good;
      const int changes = i == 0 ? 0 : 1 + static_cast<int>(random() % 3);
      for (int change = 0; change < changes; ++change) {
        auto& [name, value] = call[random() % call.size()];
        value = careless(random, name, value);
      }
      std::string written;
      for (const auto& [name, value] : call)
        written += fmt::format("{}={} ", name, value);
      SCOPED_TRACE(std::string(cycle) + " " + written);
      bench.start(start);
      const execution::RunResult result = bench.tryRun(cycle, call, {{"S_TNAME", "MILL"}});
      if (result.diagnostics.empty()) {
        ++well;
        for (const double value : bench.control.ovr)
          EXPECT_TRUE(std::isfinite(value));
      } else {
        ++refused;
        ASSERT_EQ(result.diagnostics.size(), 1U);
        const Diagnostic& alarm = result.diagnostics.front();
        EXPECT_FALSE(alarm.message.empty());
        EXPECT_FALSE(alarm.advice.empty()) << format(alarm);
        EXPECT_FALSE(alarm.code.empty() && alarm.message.find("triangle") == std::string::npos) << format(alarm);
      }
      for (const auto& write : bench.control.journal.cycles.empty() ? std::vector<control::WriteRecord>()
                                                                    : bench.control.journal.cycles.back().writes) {
        EXPECT_EQ(write.after.find("nan"), std::string::npos) << write.table << write.entry;
        EXPECT_EQ(write.after.find("inf"), std::string::npos) << write.table << write.entry;
      }
    }
  }
  EXPECT_GT(well, 150);
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace probewright
