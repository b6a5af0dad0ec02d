#include "control/sinumerik/init_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "base/file.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "control/sinumerik/tool_data.hpp"

namespace probewright::control::sinumerik {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string sample =
    "%_N_INITIAL_INI\n"
    ";$PATH=/_N_WKS_DIR\n"
    "CHANDATA(1)\n"
    "N10 $TC_TP2[1]=\"PROBE_6\"   ; the probe\n"
    "N20 $TC_DP1[1,1]=710 $TC_DP3[1,1]=120.5  $TC_DP6[1,1] = 3.0\n"
    "$TC_DP25[1,1]='H00120000'\n"
    "\t$tc_dp12[1,1]=-1.25EX-2\n"
    "$P_UIFR[1]=CTRANS(X,10,Y,5):CROT(Z,3) ; G54\n"
    "$P_UIFR[2,X,TR]=-12.75\n"
    "$P_UIFR[2,x,fi]=.005\n"
    "$P_UIFR[2,Z,RT]=+45\n"
    "$P_UIFR[2,C,TR]=90\n"
    "$SNS_MEA_WP_BALL_DIAM[0]=SET(6,5.998,4)\n"
    "$MN_SOMETHING_ELSE[2]=TRUE\n"
    "R12=1.5\n"
    "R[13]=2.5\n"
    "_MINE[2,3]=7\n"
    "G0 X10 unknown to this reader\n"
    "$AC_TIMER[1]=$AC_TIME*2\n"
    "R14=R12+1\n"
    "M17\n";

struct Read {
  DataStore store;
  Diagnostics diagnostics;
  InitText text;
};

Read read(std::string_view bytes, int channel = 1) {
  Read result;
  result.text = InitText::parse(bytes, "DATA.INI", result.store, result.diagnostics, channel);
  return result;
}

TEST(InitText, ReadsEveryKindOfValue) {
  const Read result = read(sample);
  const DataStore& store = result.store;
  EXPECT_FALSE(hasErrors(result.diagnostics));
  EXPECT_EQ(store.text("$TC_TP2", {1}), "PROBE_6");
  EXPECT_EQ(store.number("$TC_DP1", {1, 1}), 710);
  EXPECT_EQ(store.number("$TC_DP3", {1, 1}), 120.5);
  EXPECT_EQ(store.number("$TC_DP6", {1, 1}), 3);
  EXPECT_EQ(store.number("$TC_DP25", {1, 1}), 0x120000);
  EXPECT_EQ(store.number("$TC_DP12", {1, 1}), -0.0125);
  EXPECT_EQ(store.number("$P_UIFR", {1, "X", "TR"}), 10);
  EXPECT_EQ(store.number("$P_UIFR", {1, "Z", "RT"}), 3);
  EXPECT_EQ(store.number("$p_uifr", {2, "x", "tr"}), -12.75);
  EXPECT_EQ(store.number("$P_UIFR", {2, "X", "FI"}), 0.005);
  EXPECT_EQ(store.number("$P_UIFR", {2, "X", "SC"}), 1) << "neutral component";
  EXPECT_EQ(store.number("$SNS_MEA_WP_BALL_DIAM", {1}), 5.998);
  EXPECT_EQ(store.number("$SNS_MEA_WP_BALL_DIAM", {2}), 4);
  EXPECT_EQ(store.get("$MN_SOMETHING_ELSE", {2}), DataValue(true));
  EXPECT_EQ(store.number("R", {12}), 1.5);
  EXPECT_EQ(store.number("R13", {}), 2.5);
  EXPECT_EQ(store.number("_MINE", {2, 3}), 7);
  EXPECT_EQ(store.get("R14"), std::nullopt);
  const Frame frame = store.frame("$P_UIFR", {2});
  EXPECT_EQ(frame.translation(), Vector3(-12.745, 0, 0));
  EXPECT_EQ(frame.geometry[2].rotation, 45);
  EXPECT_EQ(frame.get("C", FramePart::Translation), 90);
}

TEST(InitText, NamesWhatItDoesNotUse) {
  const Read result = read(sample);
  std::vector<std::uint64_t> lines;
  for (const Diagnostic& each : result.diagnostics) {
    EXPECT_EQ(each.severity, Severity::Note);
    lines.push_back(each.place.line);
  }
  EXPECT_THAT(lines, ElementsAre(18U, 19U, 20U));
}

TEST(InitText, UnchangedDataGiveTheSameBytes) {
  std::string windows;
  for (const char c : sample)
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const std::string odd =
      "\xEF\xBB\xBF$P_UIFR[1,C,TR]=5\n$P_UIFR[1]=CTRANS()\n$P_UIFR[1,X,TR]=1\nR1=1 R1=2\n\xE4\xFF=3\nM17";
  for (const std::string& bytes : {sample, windows, odd, std::string(), std::string("\n\n"), std::string("M17")}) {
    const Read result = read(bytes);
    EXPECT_EQ(result.text.bytes(), bytes);
    EXPECT_EQ(result.text.updated(result.store).value(), bytes);
  }
}

TEST(InitText, KeepsAByteOrderMarkInFrontOfNewData) {
  DataStore store;
  Diagnostics diagnostics;
  const InitText text = InitText::parse("\xEF\xBB\xBFM02\n", "DATA.INI", store, diagnostics);
  store.set("R", {1}, 2.0);
  EXPECT_EQ(text.updated(store).value_or(""), "\xEF\xBB\xBFR1=2\nM02\n");
}

TEST(InitText, WritesChangedValuesInPlace) {
  Read result = read(sample);
  result.store.set("$TC_DP3", {1, 1}, 121.25);
  result.store.set("$P_UIFR", {1, "Y", "TR"}, 5.5);
  result.store.set("$P_UIFR", {2, "X", "TR"}, -12.8);
  result.store.set("$SNS_MEA_WP_BALL_DIAM", {1}, 6.001);
  result.store.set("R13", {}, 3.5);
  result.store.set("$TC_TP2", {1}, std::string("PROBE_8"));
  std::string expected = sample;
  const auto replace = [&expected](std::string_view from, std::string_view to) {
    const std::size_t at = expected.find(from);
    ASSERT_NE(at, std::string::npos);
    expected.replace(at, from.size(), to);
  };
  replace("120.5", "121.25");
  replace("CTRANS(X,10,Y,5):CROT(Z,3)", "CTRANS(X,10,Y,5.5):CROT(Z,3)");
  replace("-12.75", "-12.8");
  replace("SET(6,5.998,4)", "SET(6,6.001,4)");
  replace("R[13]=2.5", "R[13]=3.5");
  replace("PROBE_6", "PROBE_8");
  EXPECT_EQ(result.text.updated(result.store).value(), expected);
}

TEST(InitText, AddsNewDataBeforeTheEnd) {
  Read result = read("CHANDATA(1)\r\n$TC_DP3[1,1]=5\r\nM17\r\n");
  result.store.set("$TC_DP12", {1, 1}, -0.02);
  result.store.set("$P_UIFR", {10, "X", "TR"}, 4.0);
  result.store.set("$P_UIFR", {9, "X", "TR"}, 3.0);
  EXPECT_EQ(
      result.text.updated(result.store).value(),
      "CHANDATA(1)\r\n$TC_DP3[1,1]=5\r\n$P_UIFR[9,X,TR]=3\r\n$P_UIFR[10,X,TR]=4\r\n$TC_DP12[1,1]=-0.02\r\nM17\r\n");
  const auto frames = [](const DataKey& key) { return key.name == "$P_UIFR"; };
  EXPECT_EQ(result.text.updated(result.store, frames).value(),
            "CHANDATA(1)\r\n$TC_DP3[1,1]=5\r\n$P_UIFR[9,X,TR]=3\r\n$P_UIFR[10,X,TR]=4\r\nM17\r\n");
  Read empty = read("");
  empty.store.set("R1", {}, true);
  EXPECT_EQ(empty.text.updated(empty.store).value(), "R1=TRUE\n");
  empty.store.set("R1", {}, std::string("a\"b"));
  EXPECT_THAT(empty.text.updated(empty.store).error().message, HasSubstr("R1 cannot be written"));
}

TEST(InitText, ChannelsKeepTheirData) {
  const std::string two = "CHANDATA(1)\n$TC_DP3[1,1]=5\nR1=1\nCHANDATA(2)\n$TC_DP3[1,1]=8\nR1=2\nM17\n";
  Read first = read(two, 1);
  Read second = read(two, 2);
  EXPECT_EQ(first.store.number("$TC_DP3", {1, 1}), 5);
  EXPECT_EQ(second.store.number("$TC_DP3", {1, 1}), 8);
  first.store.set("R2", {}, 7.0);
  first.store.set("R1", {}, 9.0);
  EXPECT_EQ(first.text.updated(first.store).value(),
            "CHANDATA(1)\n$TC_DP3[1,1]=5\nR1=9\nR2=7\nCHANDATA(2)\n$TC_DP3[1,1]=8\nR1=2\nM17\n");
  second.store.set("R2", {}, 7.0);
  EXPECT_EQ(second.text.updated(second.store).value(),
            "CHANDATA(1)\n$TC_DP3[1,1]=5\nR1=1\nCHANDATA(2)\n$TC_DP3[1,1]=8\nR1=2\nR2=7\nM17\n");
  Read third = read("R1=1\nM17\n", 3);
  third.store.set("R1", {}, 4.0);
  EXPECT_EQ(third.text.updated(third.store).value(), "R1=1\nCHANDATA(3)\nR1=4\nM17\n");
}

TEST(InitText, TheLastAssignmentCounts) {
  Read result = read("$P_UIFR[1]=CTRANS(X,1,Y,2)\n$P_UIFR[1,X,TR]=3\n");
  EXPECT_EQ(result.store.frame("$P_UIFR", {1}).translation(), Vector3(3, 2, 0));
  Frame frame = result.store.frame("$P_UIFR", {1});
  frame.geometry[0].coarse = 30;
  frame.geometry[1].coarse = 20;
  frame.set("C", FramePart::Translation, 45);
  result.store.setFrame("$P_UIFR", {1}, frame);
  const std::string bytes = result.text.updated(result.store).value();
  EXPECT_EQ(bytes, "$P_UIFR[1]=CTRANS(X,1,Y,20)\n$P_UIFR[1,X,TR]=30\n$P_UIFR[1,C,TR]=45\n");
  EXPECT_EQ(read(bytes).store.frame("$P_UIFR", {1}), frame);
}

std::string firstError(std::string_view line) {
  const Read result = read(line);
  return result.diagnostics.empty() ? "" : format(result.diagnostics.front());
}

/// What is no character is shown as one, but for what ends the line.
TEST(InitText, ShowsALineWithoutWhatEndsIt) {
  for (const char* end : {"", "\r", " ", "\t\r", " \r \r", "?", "\x01 ?"}) {
    const Read result = read(std::string("\x01R1[2 \x02 =5") + end + "\n");
    ASSERT_FALSE(result.diagnostics.empty()) << end;
    EXPECT_EQ(result.diagnostics.front().excerpt, "?R1[2 ? =5") << end;
  }
}

TEST(InitText, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(firstError("R1=1\n$TC_DP3[1,1=5\n"), HasSubstr("DATA.INI:2:8: error: the bracket is not closed"));
  EXPECT_THAT(firstError("$TC_DP3[1,]=5"), HasSubstr(":1:11: error: an index is expected"));
  EXPECT_THAT(firstError("N5 R1="), HasSubstr(":1:7: error: a value is expected"));
  EXPECT_THAT(firstError("R1[2"), HasSubstr("bracket"));
  EXPECT_THAT(firstError("$TC_DP3[1,1] 5"), HasSubstr("'=' expected"));
  EXPECT_THAT(firstError("R1=12,5"), HasSubstr("kept but not used"));
  EXPECT_THAT(firstError("R1='H10'R2=5"), HasSubstr("kept but not used"));
  EXPECT_THAT(firstError("R1=1.2.3"), HasSubstr("\"1.2.3\" is not a number"));
  EXPECT_THAT(firstError("R1=" + std::string(400, '9')), HasSubstr("is not a number"));
  EXPECT_THAT(firstError("R1=1EX999"), HasSubstr("is not a number"));
  EXPECT_THAT(firstError("R1='HXY'"), HasSubstr("is not a number"));
  EXPECT_THAT(firstError("$TC_TP2[1]=\"abc"), HasSubstr("the string is not closed"));
  EXPECT_THAT(firstError("$P_UIFR[1]=CTRANS(X,1"), HasSubstr("',' or ')' expected"));
  EXPECT_THAT(firstError("$P_UIFR[1]=CTRANS(X)"), HasSubstr("',' expected"));
  EXPECT_THAT(firstError("$P_UIFR[1]=CROT(C,1)"), HasSubstr("CROT rotates about geometry axes only"));
  EXPECT_THAT(firstError("$P_UIFR[1]=CSCALE(X,2):CROT(Z,9)"), HasSubstr("shear"));
  EXPECT_THAT(firstError("CHANDATA(x)"), HasSubstr("the number of a channel"));
  const Read result = read("R1=1.2.3\nR2=5\n");
  EXPECT_EQ(result.store.number("R", {2}), 5) << "the lines after a mistake are read";
}

TEST(InitText, NumbersSurvive) {
  std::mt19937_64 random(11);
  Read result = read("M17\n");
  std::vector<double> values;
  for (int i = 0; i < 2000; ++i) {
    const double exponent = std::uniform_real_distribution(-290.0, 290.0)(random);
    const double mantissa = std::uniform_real_distribution(-10.0, 10.0)(random);
    values.push_back(i % 2 == 0 ? mantissa * std::pow(10.0, exponent) : mantissa * 100);
    result.store.set("R", {i}, values.back());
  }
  const Read again = read(result.text.updated(result.store).value());
  EXPECT_THAT(again.diagnostics, IsEmpty());
  for (int i = 0; i < 2000; ++i)
    EXPECT_EQ(again.store.number("R", {i}), values[static_cast<std::size_t>(i)]);
  EXPECT_EQ(parseNumber("'B101'"), 5);
  EXPECT_EQ(parseNumber("'H1aF'"), 0x1af);
  EXPECT_EQ(parseNumber("'hAf'"), 0xaf);
  EXPECT_EQ(parseNumber("+2.5EX2"), 250);
  EXPECT_EQ(parseNumber("1ex-7"), 1e-7);
  for (const char* bad : {"", "EX", "1EX", "'H'", "''", "'", "0x10", "1e5", "nan", "inf", "+-1", "'B2'", "'HG'",
                          "'HFg'", "'D1'", "1EX400"}) {
    EXPECT_EQ(parseNumber(bad), std::nullopt) << bad;
  }
}

TEST(InitText, SurvivesAnyBytes) {
  std::mt19937_64 random(12);
  const std::string alphabet = "$P_UIFR[1]=CTRANS(X,1):CROTSCALEMIRRORN\n\r\t;\"'HB()0123456789.+-EX,R\xE4\xFF ";
  for (int i = 0; i < 4000; ++i) {
    std::string bytes = i % 2 == 0 ? sample : std::string();
    const auto edits = random() % 80;
    for (std::uint64_t k = 0; k < edits; ++k) {
      const std::size_t at = bytes.empty() ? 0 : random() % bytes.size();
      if (random() % 3 == 0 && !bytes.empty()) {
        bytes.erase(at, 1);
      } else {
        bytes.insert(at, 1, alphabet[random() % alphabet.size()]);
      }
    }
    const Read result = read(bytes);
    ASSERT_EQ(result.text.bytes(), bytes);
    ASSERT_EQ(result.text.updated(result.store).value_or(bytes), bytes);
  }
}

TEST(ToolData, AddsUpLengthsAndRadius) {
  Read result = read(
      "$TC_DP1[3,1]=120\n$TC_DP3[3,1]=100\n$TC_DP4[3,1]=10\n$TC_DP5[3,1]=1\n$TC_DP6[3,1]=5\n"
      "$TC_DP12[3,1]=0.1\n$TC_DP15[3,1]=-0.02\n$TC_DP21[3,1]=50\n$TC_SCP13[3,1]=0.001\n$TC_ECP13[3,1]=0.002\n"
      "$TC_SCP23[3,1]=7\n$TC_SCP16[3,1]=0.5\n$TC_TP2[3]=\"Mill "
      "10\"\n$TC_DP1[3,2]=500\n$TC_DP2[3,2]=3\n$TC_DP1[12,1]=710\n");
  const DataStore& store = result.store;
  EXPECT_THAT(toolNumbers(store), ElementsAre(3, 12));
  EXPECT_THAT(toolEdges(store, 3), ElementsAre(1, 2));
  EXPECT_EQ(toolNamed(store, "MILL 10"), 3);
  EXPECT_EQ(toolNamed(store, "DRILL"), std::nullopt);
  EXPECT_EQ(toolEdge(store, 4, 1), std::nullopt);
  const ToolEdge mill = toolEdge(store, 3, 1).value();
  EXPECT_NEAR(mill.totalLength()[0], 150.1, 1e-12);
  EXPECT_NEAR(mill.totalRadius(), 4.98, 1e-12);
  const ToolEdge offset = toolEdge(store, 3, 1, 1).value();
  EXPECT_NEAR(offset.totalLength()[0], 150.103, 1e-12);
  EXPECT_NEAR(offset.totalRadius(), 5.48, 1e-12);
  EXPECT_NEAR(toolEdge(store, 3, 1, 2).value().totalLength()[0], 157.1, 1e-12);
}

TEST(ToolData, LengthsActAsThePlaneSays) {
  ToolEdge mill{.type = 120, .length = {1, 2, 3}};
  EXPECT_EQ(toolVector(WorkingPlane::ofG(17), mill), Vector3(3, 2, 1));
  EXPECT_EQ(toolVector(WorkingPlane::ofG(18), mill), Vector3(2, 1, 3));
  EXPECT_EQ(toolVector(WorkingPlane::ofG(19), mill), Vector3(1, 3, 2));
  ToolEdge turning{.type = 500, .length = {1, 2, 3}};
  EXPECT_EQ(toolVector(WorkingPlane::ofG(18), turning), Vector3(1, 3, 2));
  EXPECT_EQ(toolVector(WorkingPlane::ofG(17), turning), Vector3(2, 1, 3));
  EXPECT_EQ(toolVector(WorkingPlane::ofG(19), turning), Vector3(3, 2, 1));
  EXPECT_EQ(toolVector(WorkingPlane::ofG(18), mill, LengthType::AsTurning), Vector3(1, 3, 2));
}

TEST(MeasuringData, TableIsOrderedAndDefaultsAgreeWithTheMasks) {
  int previous = 0;
  for (const MeasuringDatum& datum : measuringData()) {
    EXPECT_GT(datum.number, previous) << datum.identifier;
    previous = datum.number;
    EXPECT_FALSE(datum.meaning.empty());
    EXPECT_EQ(findMeasuringDatum(datum.identifier), findMeasuringDatum(datum.number)) << "identifiers are unique";
  }
  DataStore store;
  setMeasuringDefaults(store);
  for (const MaskBit& bit : maskBits()) {
    EXPECT_EQ(maskBit(store, bit.identifier, bit.bit), bit.initial) << bit.identifier << " " << bit.bit;
  }
  EXPECT_EQ(store.number("$SCS_MEA_FEED_MEASURE", {}), 300);
  EXPECT_EQ(findMeasuringDatum(54611)->identifier, "$SNS_MEA_WP_FEED");
  EXPECT_EQ(findMeasuringDatum(54655), nullptr) << "dropped in version 4.4";
}

/// The page is the table. To renew it after a change of the table, write measuringDataPage() to docs/measuring-data.md:
/// PROBEWRIGHT_UPDATE_DOCS=1 makes this test do so.
TEST(MeasuringData, ThePageOfTheDocumentationIsCurrent) {
  const std::filesystem::path page = std::filesystem::path(PROBEWRIGHT_SOURCE_DIR) / "docs" / "measuring-data.md";
  if (std::getenv("PROBEWRIGHT_UPDATE_DOCS") != nullptr) {
    ASSERT_TRUE(writeFileAtomically(page, measuringDataPage()));
  }
  EXPECT_EQ(readFile(page).value_or(""), measuringDataPage());
}

TEST(MeasuringData, OldNamesReachTheNewData) {
  DataStore store;
  setMeasuringDefaults(store);
  EXPECT_TRUE(writeGud(store, {"_WP", {1, 0}}, 5.999));
  EXPECT_EQ(store.number("$SNS_MEA_WP_BALL_DIAM", {1}), 5.999);
  EXPECT_EQ(readGud(store, {"_WP", {1, 0}}), 5.999);
  EXPECT_TRUE(writeGud(store, {"_KB", {2, 6}}, -1));
  EXPECT_EQ(store.number("$SNS_MEA_CAL_EDGE_BASE_AX2", {2}), -1);
  EXPECT_TRUE(writeGud(store, {"_CM", {0}}, 60));
  EXPECT_EQ(store.number("$SNS_MEA_CM_MAX_PERI_SPEED", {0}), 60);
  EXPECT_TRUE(writeGud(store, {"_EV", {19}}, 0.01));
  EXPECT_EQ(store.number("$SCS_MEA_EMPIRIC_VALUE", {19}), 0.01);
  EXPECT_FALSE(writeGud(store, {"_EV", {20}}, 0.01));
  EXPECT_EQ(readGud(store, {"_SPEED", {0}}), 50);
  EXPECT_EQ(readGud(store, {"_CHBIT", {2}}), 1);
  EXPECT_TRUE(writeGud(store, {"_CHBIT", {2}}, 0));
  EXPECT_FALSE(maskBit(store, "$SCS_MEA_FUNCTION_MASK", 0));
  EXPECT_FALSE(maskBit(store, "$SCS_MEA_FUNCTION_MASK", 16)) << "one old bit writes both new ones";
  EXPECT_TRUE(maskBit(store, "$SCS_MEA_FUNCTION_MASK", 14));
  EXPECT_TRUE(writeGud(store, {"_CHBIT", {10}}, 4));
  EXPECT_EQ(store.number("$SCS_MEA_RESULT_DISPLAY", {}), 4);
  EXPECT_EQ(readGud(store, {"_CHBIT", {10}}), 4);
  EXPECT_TRUE(writeGud(store, {"_MT_EC_R", {3, 4}}, 0.012));
  EXPECT_EQ(store.number("$SNS_MEA_RESULT_OFFSET_TAB_RAD3", {4}), 0.012);
  EXPECT_TRUE(writeGud(store, {"_MT_EC_L", {6, 0}}, -0.02));
  EXPECT_EQ(store.number("$SNS_MEA_RESULT_OFFSET_TAB_LEN6", {0}), -0.02);
  EXPECT_FALSE(writeGud(store, {"_MT_EC_R", {7, 0}}, 1));
  EXPECT_FALSE(writeGud(store, {"_MT_EC_R", {1, 5}}, 1));
  EXPECT_TRUE(writeGud(store, {"E_MESS_SETT", {1}}, 1));
  EXPECT_TRUE(maskBit(store, "$SCS_MEA_FUNCTION_MASK", 15));
  EXPECT_EQ(readGud(store, {"_OVR", {4}}), std::nullopt);
  EXPECT_EQ(readGud(store, {"_WP", {"X"}}), std::nullopt);
}

TEST(InitText, RefusesIndicesThatNoArrayHas) {
  const auto complaint = [](const std::string& text) {
    DataStore store;
    Diagnostics found;
    InitText::parse(text, "A.INI", store, found);
    if (found.empty()) return std::string();
    EXPECT_EQ(found.front().place.file, "A.INI");
    EXPECT_EQ(found.front().place.line, 2u);
    return found.front().message;
  };
  EXPECT_EQ(complaint("; tools\n$TC_DP3[-1,1]=5\n"), "$TC_DP3 has no element with the index -1");
  EXPECT_EQ(complaint("; tools\n$TC_DP3[99999999999,1]=5\n"), "$TC_DP3 has no element with the index 99999999999");
  EXPECT_EQ(complaint("; tools\n$P_UIFR[-1,X,TR]=5\n"), "$P_UIFR has no element with the index -1");
  EXPECT_EQ(complaint("; tools\nR[10000]=5\n"), "there is no R parameter 10000");
  std::string list = "; tools\nR[0]=SET(0";
  for (int i = 1; i <= 10000; ++i)
    list += ",1";
  EXPECT_EQ(complaint(list + ")\n"), "there is no R parameter 10000");
  EXPECT_EQ(complaint("; tools\n$TC_DP3[32000,9]=5 R[9999]=1 $P_UIFR[99,X,TR]=1\n"), "");
}

TEST(InitText, ArraysWithoutIndexMeanTheirFirstElement) {
  Read result = read("$SNS_MEA_TP_EDGE_DISK_SIZE=7\n$MC_GCODE_RESET_VALUES=2\n$SCS_MEA_EMPIRIC_VALUE=SET(1,2)\nM17\n");
  EXPECT_EQ(result.store.number("$SNS_MEA_TP_EDGE_DISK_SIZE", {0}), 7);
  EXPECT_EQ(result.store.number("$SNS_MEA_TP_EDGE_DISK_SIZE", {}), 7);
  EXPECT_EQ(result.store.number("$SNS_MEA_TP_EDGE_DISK_SIZE", {1}, -1), -1);
  EXPECT_EQ(result.store.number("$MC_GCODE_RESET_VALUES", {0}), 2);
  EXPECT_EQ(result.store.number("$SCS_MEA_EMPIRIC_VALUE", {0}), 1);
  EXPECT_EQ(result.store.number("$SCS_MEA_EMPIRIC_VALUE", {1}), 2);
  result.store.set("$SNS_MEA_TP_EDGE_DISK_SIZE", {0}, 8.0);
  EXPECT_EQ(result.text.updated(result.store).value_or(""),
            "$SNS_MEA_TP_EDGE_DISK_SIZE=8\n$MC_GCODE_RESET_VALUES=2\n$SCS_MEA_EMPIRIC_VALUE=SET(1,2)\nM17\n")
      << "one datum, in its place";
}

TEST(InitText, DataThatAreNoArraysKeepNoIndex) {
  const Read result = read("$SCS_MEA_FEED_MEASURE=200\n$MN_MM_NUM_SUMCORR=4\n_MINE=3\n");
  EXPECT_TRUE(result.store.isSet(DataKey("$SCS_MEA_FEED_MEASURE", {})));
  for (const DataKey& key : result.store.keys())
    EXPECT_THAT(key.indices, IsEmpty()) << key.text();
  EXPECT_EQ(result.store.keys().size(), 3U);
}

}  // namespace
}  // namespace probewright::control::sinumerik
