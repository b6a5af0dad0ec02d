#include "exchange/formats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <limits>
#include <regex>

#include "reader.hpp"
#include "records/sample_run.hpp"

/// What is exported is read back by programs that are not ours: Python's modules for CSV and XML, openpyxl, libxml2
/// with the published schemas of QIF.
namespace probewright::exchange {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

/// The sample run with the kinds of its results, which say what is exported as what.
control::Journal journal() {
  using control::Along;
  using control::Quantity;
  control::Journal journal = sample::journal();
  for (control::CycleRecord& cycle : journal.cycles) {
    for (control::ResultRecord& result : cycle.results) {
      result.kind.role = control::Role::Actual;
      const auto holds = [&](const char* word) { return result.meaning.find(word) != std::string::npos; };
      result.kind.of = {holds("diameter") ? Quantity::Diameter
                        : holds("length") ? Quantity::Length
                        : holds("angle")  ? Quantity::Angle
                                          : Quantity::Centre,
                        Along::None};
    }
  }
  return journal;
}

Inspection inspection() { return inspectionOf(journal(), sample::runInfo()); }

/// With characters that mean something to formats.
Inspection awkward() {
  records::RunInfo run = sample::runInfo();
  run.partName = "Lager <\"40\" & 50>, größer";
  run.job = {"Lager <\"40\" & 50>, größer",
             "Z-1 <B>",
             "4711\n& 12",
             "00\x01"
             "17",
             "M. Weber",
             "ACME \"AG\""};
  std::string& text = run.programs.front().text;
  const std::string name = "* - MEASURE";
  // U+FFFF is no character: readers of XML refuse it.
  text.replace(text.find(name), name.size(),
               "* - MEASURE \"A,B\" <&>\xEF\xBF\xBF"
               "Bohrung ø");
  return inspectionOf(journal(), run);
}

TEST(Inspection, HasARowForEachValueThatAnswersACycle) {
  const Inspection got = inspection();
  ASSERT_EQ(got.rows.size(), 10U);
  const Row& diameter = got.rows[7];
  EXPECT_EQ(diameter.result, "Q153");
  EXPECT_EQ(diameter.cycle, 4U);
  EXPECT_EQ(diameter.program, "BEARING_BLOCK.H");
  EXPECT_EQ(diameter.line, sample::lineOf("12 TCH PROBE 421"));
  EXPECT_EQ(diameter.actual, 30.0119);
  EXPECT_EQ(diameter.upperLimit, 30.021);
  EXPECT_EQ(got.rows[0].feature, "ALIGN AND SET PRESET");
  EXPECT_EQ(diameter.feature, "MEASURE");
  EXPECT_EQ(got.verdict, control::Verdict::Rework);
}

TEST(Inspection, NamesFeaturesOfSinumerikProgramsByTheirMessages) {
  control::Journal measured;
  for (const std::uint64_t line : {1U, 3U, 6U}) {
    control::CycleRecord cycle = sample::cycle("CYCLE977", "Hole", 0, 1, 1);
    cycle.place = {"A.MPF", line, 1};
    cycle.results = {sample::plain("_OVR[4]", "diameter", 30)};
    measured.cycles.push_back(cycle);
  }
  records::RunInfo run = sample::runInfo();
  run.programs = {{"A.MPF", "CYCLE977()\nN10 MSG(\"BORE A\")\nCYCLE977()\nG0 X1\nmsg()\nCYCLE977()\n"}};
  const Inspection got = inspectionOf(measured, run);
  ASSERT_EQ(got.rows.size(), 3U);
  EXPECT_EQ(got.rows[0].feature, "");
  EXPECT_EQ(got.rows[1].feature, "BORE A");
  EXPECT_EQ(got.rows[2].feature, "");
}

TEST(Inspection, CountsTheTimeOfACycleFromTheStartOfTheRun) {
  const Inspection got = inspection();
  EXPECT_EQ(timeOf(got.rows.front(), got.run), "2026-07-07T16:42:28") << "18:42:10 at +02:00 and 17.9 s";
  records::RunInfo unknown = got.run;
  unknown.startedAt.clear();
  EXPECT_EQ(timeOf(got.rows.front(), unknown), "");
}

TEST(Csv, IsReadBackByPython) {
  for (const Inspection& each : {inspection(), awkward()}) {
    const std::string read = python(
        "import csv, sys\n"
        "for row in csv.DictReader(open(sys.argv[1], newline=\"\", encoding=\"utf-8\")):\n"
        "  print(row[\"feature\"], row[\"result\"], float(row[\"actual\"]), row[\"upper limit\"], row[\"verdict\"], "
        "sep=\"|\")",
        ScratchFile("a.csv", csvText(each)));
    std::string expected;
    for (const Row& row : each.rows)
      expected += row.feature + "|" + row.result + "|";
    EXPECT_EQ(std::ranges::count(read, '\n'), 10);
    EXPECT_THAT(read, HasSubstr(each.rows.back().feature + "|Q155|80.0541|80.03|rework\n"));
    EXPECT_THAT(read, HasSubstr("|Q150|1.5008123||none\n"));
  }
}

TEST(Xlsx, IsReadBackByOpenpyxl) {
  for (const Inspection& each : {inspection(), awkward()}) {
    const Result<std::string> file = xlsxFile(each);
    ASSERT_TRUE(file) << format(file.error());
    const std::string read = python(
        "import openpyxl, sys\n"
        "book = openpyxl.load_workbook(sys.argv[1])\n"
        "rows = list(book[\"Inspection\"].iter_rows(values_only=True))\n"
        "head = rows[0]\n"
        "for row in rows[1:]:\n"
        "  cell = dict(zip(head, row))\n"
        "  print(cell[\"Feature\"], cell[\"Result\"], cell[\"Actual\"], cell[\"Upper limit\"], cell[\"Verdict\"], "
        "sep=\"|\")\n"
        "print({row[0]: row[1] for row in book[\"Run\"].iter_rows(values_only=True)}[\"Part\"])",
        ScratchFile("a.xlsx", *file));
    EXPECT_EQ(std::ranges::count(read, '\n'), 11);
    EXPECT_THAT(read, HasSubstr(each.rows.back().feature + "|Q155|80.0541|80.03|rework\n"));
    EXPECT_THAT(read, HasSubstr("|Q150|1.5008123|None|none\n"));
    EXPECT_THAT(read, HasSubstr(each.run.partName + "\n"));
  }
}

/// No file may have more bytes than this. The signal that asks for it is ignored, so that writing fails.
class SmallFiles {
public:
  explicit SmallFiles(rlim_t most) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{most, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

private:
  rlimit before_{};
  void (*signal_)(int);
};

/// The message is all that is said: the library for workbooks speaks on the standard error output by itself.
TEST(Xlsx, SaysOnceThatItCannotBeWritten) {
  ::testing::internal::CaptureStderr();
  Result<std::string> file = "";
  {
    const SmallFiles small(1000);  // a workbook has more
    file = xlsxFile(inspection());
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  ASSERT_FALSE(file);
  EXPECT_EQ(format(file.error()).find("inspection.xlsx: error: the workbook cannot be written: File too large"), 0U)
      << format(file.error());
  EXPECT_TRUE(xlsxFile(inspection()));
}

std::string validated(const std::string& qif) {
  const ScratchFile file("a.qif", qif);
  const Heard heard =
      hear("'" PROBEWRIGHT_XMLLINT "' --nonet --noout --schema '" PROBEWRIGHT_QIF_SCHEMA "' '" + file.path() + "'");
  return heard.exit == 0 ? "" : heard.text;
}

TEST(Qif, FollowsThePublishedSchemas) {
  EXPECT_EQ(validated(qifText(inspection())), "");
  EXPECT_EQ(validated(qifText(awkward())), "");
  EXPECT_EQ(validated(qifText(inspectionOf(sample::alarmJournal(), sample::alarmRunInfo()))), "");
  EXPECT_EQ(validated(qifText(inspectionOf({}, {}))), "");
  std::string spoilt = qifText(inspection());
  spoilt.replace(spoilt.find("DiameterCharacteristicNominal"), 8, "Diametre");
  EXPECT_NE(validated(spoilt), "") << "the schemas are really asked";
}

/// Each characteristic belongs to the feature of its call, and the results to the job.
TEST(Qif, NamesFeaturesAndTheJob) {
  const std::string read = python(
      "import sys, xml.etree.ElementTree as tree\n"
      "q = \"{http://qifstandards.org/xsd/qif3}\"\n"
      "root = tree.parse(sys.argv[1]).getroot()\n"
      "byId = {node.get(\"id\"): node for node in root.iter() if node.get(\"id\")}\n"
      "for item in root.find(\".//\" + q + \"CharacteristicItems\"):\n"
      "  feature = byId[item.find(q + \"FeatureItemIds\")[0].text]\n"
      "  nominal = byId[feature.find(q + \"FeatureNominalId\").text]\n"
      "  definition = byId[nominal.find(q + \"FeatureDefinitionId\").text]\n"
      "  print(item.find(q + \"Name\").text, feature.find(q + \"FeatureName\").text, definition[0].text, sep=\"|\")\n"
      "trace = root.find(\".//\" + q + \"InspectionTraceability\")\n"
      "print(trace.find(q + \"OrderNumber\").text, trace.find(q + \"InspectionOperator\")[0].text,\n"
      "      [(each.get(\"name\"), each.get(\"value\")) for each in trace.find(q + \"Attributes\")])",
      ScratchFile("a.qif", qifText(awkward())));
  EXPECT_THAT(read,
              HasSubstr("4 421 MEASURE \"A,B\" <&> Bohrung ø: actual value, diameter (Q153)|4 MEASURE \"A,B\" <&> "
                        "Bohrung ø|421 "));
  EXPECT_THAT(read, HasSubstr("& 12 M. Weber [('part', 'Lager <\"40\" & 50>, größer'), ('drawing', 'Z-1 <B>'), "
                              "('serial', '00"));
}

TEST(Qif, TellsWhatWasMeasuredAndItsLimits) {
  const std::string read = python(
      "import sys, xml.etree.ElementTree as tree\n"
      "q = \"{http://qifstandards.org/xsd/qif3}\"\n"
      "root = tree.parse(sys.argv[1]).getroot()\n"
      "byId = {node.get(\"id\"): node for node in root.iter() if node.get(\"id\")}\n"
      "for m in root.iter(q + \"CharacteristicMeasurements\"):\n"
      "  for each in m:\n"
      "    item = byId[each.find(q + \"CharacteristicItemId\").text]\n"
      "    nominal = byId[item.find(q + \"CharacteristicNominalId\").text]\n"
      "    definition = byId[nominal.find(q + \"CharacteristicDefinitionId\").text]\n"
      "    tolerance = definition.find(q + \"Tolerance\")\n"
      "    limits = [] if tolerance is None else [float(tolerance.find(q + n).text) for n in (\"MinValue\", "
      "\"MaxValue\")]\n"
      "    target = nominal.find(q + \"TargetValue\")\n"
      "    print(each.tag[len(q):], float(each.find(q + \"Value\").text), None if target is None else "
      "float(target.text), limits,\n"
      "          each.find(q + \"Status\")[0].text, each.find(q + \"TimeStamp\").text)\n"
      "print(root.find(\".//\" + q + \"InspectionStatusEnum\").text, max(map(int, byId)) == int(root.get(\"idMax\")))",
      ScratchFile("a.qif", qifText(inspection())));
  EXPECT_THAT(read,
              HasSubstr("DiameterCharacteristicMeasurement 30.0119 30.0 [30.0, 30.021] PASS 2026-07-07T16:43:13Z"));
  EXPECT_THAT(read, HasSubstr("LengthCharacteristicMeasurement 80.0541 80.0 [79.97, 80.03] REWORK"));
  EXPECT_THAT(read, HasSubstr("UserDefinedAngularCharacteristicMeasurement 1.5008123 None [] NOT_ANALYZED"));
  EXPECT_THAT(read, HasSubstr("REWORK True\n"));
}

std::string junitRead(const std::string& xml) {
  return python(
      "import sys, xml.etree.ElementTree as tree\n"
      "suite = tree.parse(sys.argv[1]).getroot()[0]\n"
      "print(suite.get(\"tests\"), suite.get(\"failures\"), suite.get(\"errors\"), len(suite.findall(\"testcase\")))\n"
      "for each in suite:\n"
      "  for what in each:\n"
      "    print(what.tag, each.get(\"name\"), each.get(\"line\"), what.get(\"message\"))",
      ScratchFile("junit.xml", xml));
}

TEST(JUnit, HasAFailureForEachValueOutOfTolerance) {
  const std::string read = junitRead(junitText(inspection()));
  EXPECT_THAT(read, HasSubstr("6 1 0 6\n"));
  EXPECT_THAT(read, HasSubstr("failure 5 424 MEASURE: "));
  EXPECT_THAT(read, HasSubstr(std::to_string(sample::lineOf("13 TCH PROBE 424")) +
                              " out of tolerance (rework): Q155 = 80.054100 mm, limits 79.970000 and 80.030000\n"));
}

TEST(JUnit, HasAnErrorForAnAlarmAndForARunThatStops) {
  const std::string read = junitRead(junitText(inspectionOf(sample::alarmJournal(), sample::alarmRunInfo())));
  EXPECT_THAT(read, HasSubstr("2 0 2 2\n"));
  EXPECT_THAT(read, HasSubstr("error 3 412 ALIGN AND SET PRESET: ends without alarm"));
  EXPECT_THAT(read, HasSubstr("error the program runs to its end None Touch point inaccessible"));
  EXPECT_THAT(junitRead(junitText(inspectionOf({}, {}))), HasSubstr("1 0 0 1\n"));
  EXPECT_THAT(junitRead(junitText(awkward())), HasSubstr("MEASURE \"A,B\" <&> Bohrung ø"));
}

/// The keys of a transfer file, as the format's description says: a line each, "K2101/3 value".
std::string dfqRead(const std::string& text) {
  return python(
      "import re, sys\n"
      "bytes = open(sys.argv[1], \"rb\").read()\n"
      "lines = bytes.decode(\"utf-8-sig\").split(\"\\r\\n\")\n"
      "assert lines.pop() == \"\"\n"
      "keys = dict(re.fullmatch(r\"(K\\d{4}(?:/\\d+)?) (.+)\", line).groups() for line in lines)\n"
      "assert len(keys) == len(lines)\n"
      "for n in range(1, int(keys[\"K0100\"]) + 1):\n"
      "  get = lambda key: keys.get(key + \"/\" + str(n))\n"
      "  print(get(\"K2002\"), get(\"K2101\"), get(\"K2110\"), get(\"K2111\"), get(\"K2142\"), get(\"K0001\"), "
      "get(\"K0004\"))\n"
      "print(keys[\"K1001\"])",
      ScratchFile("a.dfq", text));
}

TEST(Dfq, HasNominalsLimitsAndValues) {
  const std::string read = dfqRead(dfqText(inspection()));
  EXPECT_THAT(read, HasSubstr("4 421 MEASURE: actual value, diameter (Q153) 30.0000000 30.0000000 30.0210000 mm "
                              "30.0119000 07.07.2026/16:43:13\n"));
  EXPECT_THAT(read, HasSubstr("(Q150) None None None deg 1.5008123 07.07.2026/16:42:28\n"));
  EXPECT_THAT(read, HasSubstr("Bearing block\n"));
  EXPECT_THAT(dfqText(inspection()), Not(HasSubstr("\xEF\xBB\xBF"))) << "plain text where that suffices";
  const std::string job = dfqText(awkward());
  EXPECT_THAT(dfqRead(job), HasSubstr("Lager <\"40\" & 50>, größer\n"));
  for (const char* key : {"\nK1041 Z-1 <B>\r", "\nK0014/1 00 17\r", "\nK0053/10 4711 & 12\r"})
    EXPECT_THAT(job, HasSubstr(key));
}

/// A zero has no sign, whatever the computation left, and what is not a number is no value.
TEST(Formats, HaveNeitherNegativeZerosNorWhatIsNotANumber) {
  control::Journal all = journal();
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (control::CycleRecord& cycle : all.cycles) {
    for (control::ResultRecord& result : cycle.results) {
      result.value = result.name == "Q151" ? none : result.name == "Q152" ? -1e-13 : -0.0;
      result.nominal = result.name == "Q153" ? none : -0.0;
      result.lowerLimit = -0.0;
      result.upperLimit = result.name == "Q154" ? std::numeric_limits<double>::infinity() : -0.0;
    }
  }
  const Inspection got = inspectionOf(all, sample::runInfo());
  EXPECT_GT(got.rows.size(), 5U);
  EXPECT_TRUE(std::ranges::none_of(got.rows, [](const Row& row) { return row.result == "Q151"; }));
  const std::regex negativeZero(R"([^0-9A-Za-z.]-0(\.0+)?([^.0-9]|$))"), notANumber(R"(\b(nan|inf|NaN|INF)\b)");
  for (const Format& format : formats()) {
    if (format.name == "xlsx") continue;  // a number there is no text
    const std::string text = format.write(got).value();
    std::smatch found;
    EXPECT_FALSE(std::regex_search(text, found, negativeZero)) << format.name << ": " << found.str();
    EXPECT_FALSE(std::regex_search(text, found, notANumber)) << format.name << ": " << found.str();
  }
  const std::string record = recordWith("", got).value();
  EXPECT_FALSE(std::regex_search(record, negativeZero));
}

TEST(Formats, AreFoundByName) {
  ASSERT_NE(formatNamed("QIF"), nullptr);
  EXPECT_EQ(formatNamed("QIF")->file, "inspection.qif");
  EXPECT_EQ(formatNamed("pdf"), nullptr);
}

}  // namespace
}  // namespace probewright::exchange
