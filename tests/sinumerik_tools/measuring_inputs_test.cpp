#include "sinumerik_tools/tool_bench.hpp"

/// At which measuring input the probes signal: bits 0 and 16 of MD 52740, and what SD 54652 says beside them.
namespace probewright::testing_support {
namespace {

/// A pin beside the contact travels towards it with MEAS=1 and MEAS=2; R1, R2: whether $AC_MEA says that it was felt.
ToolRun feltAt(int mask, int input) {
  ToolBench bench;
  bench.disc(20);
  bench.add(9, 100, 4);
  bench.datum("$MCS_MEA_FUNCTION_MASK", mask);
  // Down beside the contact, then no further than a little into it.
  const Vector3 from(-24, 0, 20);
  return bench.run(
      9, from,
      fmt::format("G91 G0 Z-24\nMEAS={} G1 X{} F100\nR1=$AC_MEA R2=$A_PROBE[1] R3=$A_PROBE[2]\nG90\n", input, 10.5));
}

TEST(MeasuringInputs, AreThoseOfTheMachineData) {
  constexpr int delivered = 65536;
  const ToolRun usual = feltAt(delivered, 2);
  EXPECT_EQ(usual.code(), "");
  EXPECT_EQ(usual.r(1), 1);
  EXPECT_EQ(usual.r(2), 0);
  EXPECT_EQ(usual.r(3), 1);
  // The tool probe at input 1, the workpiece probe at input 2.
  const ToolRun swapped = feltAt(1, 1);
  EXPECT_EQ(swapped.code(), "");
  EXPECT_EQ(swapped.r(1), 1);
  EXPECT_EQ(swapped.r(2), 1);
  EXPECT_EQ(swapped.r(3), 0);
  // Both at input 1: a cutter in the spindle means the tool probe.
  EXPECT_EQ(feltAt(0, 1).r(1), 1);
  // Nothing at input 2: the pin runs into the contact.
  EXPECT_NE(feltAt(0, 2).code(), "");
}

TEST(MeasuringInputs, OfACounterSpindleIsNamedAsSkippedOnce) {
  for (const bool given : {false, true}) {
    ToolBench bench;
    bench.disc(20);
    bench.add(9, 100, 4);
    if (given) bench.datum("$SNS_MEA_INPUT_TOOL_PROBE_SUB[0]", 1);
    const std::string call = ToolBench::call({{"S_MVAR", 1100000}, {"S_FA", 5}, {"S_TSA", 2}});
    const ToolRun ran = bench.run(9, above, call + call);
    EXPECT_EQ(ran.code(), "");
    EXPECT_EQ(std::ranges::count_if(ran.journal().events,
                                    [](const auto& event) {
                                      return event.kind == control::EventKind::Skipped &&
                                             event.text == "$SNS_MEA_INPUT_TOOL_PROBE_SUB[0] is skipped";
                                    }),
              given ? 1 : 0);
  }
}

}  // namespace
}  // namespace probewright::testing_support
