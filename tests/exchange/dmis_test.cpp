#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exchange/formats.hpp"
#include "reader.hpp"

/// What --export dmis leaves, read as programs read it that gather files of coordinate measuring machines: line by
/// line, nominal and actual tolerances by their labels.
namespace probewright::exchange {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

/// "C1_1 CORTOL,XAXIS -0.05 0.05 0.012 INTOL" a line for each actual tolerance; the head before them.
std::string dmisRead(const std::string& text) {
  return python(R"py(import re, sys
lines = open(sys.argv[1], encoding="ascii").read().split("\n")
assert re.fullmatch(r"FILNAM/\x27[^\x27]*\x27,05\.2", lines[0]), lines[0]
assert lines[-2:] == ["ENDFIL", ""], lines[-2:]
limits = {}
number = r"([-+]?\d+\.\d+)"
for line in lines[1:-2]:
  if line.startswith("$$"): continue
  head = re.fullmatch(r"(DATE|TIME)=(.+)|UNITS/MM,ANGDEC|\w\w\(\w+\)=(PARTID|PARTSN|OPERID|DMEID)/\x27([^\x27]*)\x27", line)
  if head:
    print(head[2] or head[4] or line)
    continue
  nominal = re.fullmatch(r"T\((\w+)\)=TOL/([A-Z]+(?:,[XYZ]AXIS|,LIMIT)?)," + number + "," + number + "(,PT2PT)?", line)
  if nominal:
    limits[nominal[1]] = nominal[2] + " " + nominal[3] + " " + nominal[4]
    continue
  actual = re.fullmatch(r"TA\((\w+)\)=TOL/([A-Z]+(?:,[XYZ]AXIS)?)," + number + ",(INTOL|OUTOL)(,PT2PT)?", line)
  assert actual, line
  assert limits[actual[1]].startswith(actual[2]), line
  print(actual[1], limits.pop(actual[1]), actual[3], actual[4])
assert not limits
)py",
                ScratchFile("a.dmo", text));
}

Row row(std::size_t cycle, control::Characteristic of, const char* unit, double nominal, double lower, double upper,
        double actual, control::Verdict verdict) {
  Row row;
  row.cycle = cycle;
  row.cycleName = "421";
  row.feature = "BORE 'A' \xC3\xB8";
  row.characteristic = "value";
  row.of = of;
  row.unit = unit;
  row.nominal = nominal;
  row.lowerLimit = lower;
  row.upperLimit = upper;
  row.actual = actual;
  row.verdict = verdict;
  return row;
}

TEST(Dmis, HasANominalAndAnActualToleranceForEachValueWithLimits) {
  using control::Along;
  using control::Quantity;
  using control::Verdict;
  Inspection inspection;
  inspection.run.programs = {{"/parts/BLOCK.H", {}}};
  inspection.run.startedAt = "2026-07-07T18:42:10+02:00";
  inspection.run.partName = "Block \xC3\xA4";
  inspection.run.job.serial = "0017";
  inspection.rows = {
      row(1, {Quantity::Centre, Along::First}, "mm", 50, 49.95, 50.05, 50.012, Verdict::Good),
      row(1, {Quantity::Coordinate, Along::Third}, "mm", -10, -10.1, -9.9, -10.25, Verdict::Scrap),
      row(1, {Quantity::Diameter, Along::None}, "mm", 30, 30, 30.021, 30.0119, Verdict::Good),
      row(3, {Quantity::Width, Along::None}, "mm", 12, 11.99, 12.01, 12.02, Verdict::Rework),
      row(3, {Quantity::Coordinate, Along::Normal}, "mm", 0, -0.1, 0.1, 0.03, Verdict::Good),
      row(3, {Quantity::Angle, Along::Third}, "deg", 30, 29.5, 30.5, 30.25, Verdict::Good),
  };
  Row plain = row(3, {Quantity::Angle, Along::Third}, "deg", 30, 0, 0, 30.25, Verdict::None);
  plain.lowerLimit = plain.upperLimit = std::nullopt;
  inspection.rows.push_back(plain);
  inspection.failures.push_back({4, "427", "MEASURE COORDINATE", "BLOCK.H", "", "Touch point inaccessible", 9});
  const std::string text = dmisText(inspection);
  EXPECT_EQ(dmisRead(text),
            "2026/07/07\n18:42:10\nUNITS/MM,ANGDEC\nBlock ?\n0017\n"
            "C1_1 CORTOL,XAXIS -0.050000 0.050000 0.012000 INTOL\n"
            "C1_2 CORTOL,ZAXIS -0.100000 0.100000 -0.250000 OUTOL\n"
            "C1_3 DIAM 0.000000 0.021000 30.011900 INTOL\n"
            "C3_1 DISTB,LIMIT 11.990000 12.010000 12.020000 OUTOL\n"
            "C3_2 PROFP -0.100000 0.100000 0.030000 INTOL\n"
            "C3_3 ANGL -0.500000 0.500000 0.250000 INTOL\n");
  EXPECT_THAT(text, HasSubstr("$$ 1 421 BORE \"A\" ?: value"));
  EXPECT_THAT(text, HasSubstr("actual 30.250000 deg\n"));
  EXPECT_THAT(text, HasSubstr("$$ 4 427 ended with an alarm: Touch point inaccessible\n"));
}

TEST(Dmis, IsWholeWithoutAnything) { EXPECT_EQ(dmisRead(dmisText({})), "UNITS/MM,ANGDEC\n"); }

}  // namespace
}  // namespace probewright::exchange
