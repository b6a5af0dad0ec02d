#include <fmt/format.h>

#include <regex>
#include <set>
#include <sstream>

#include "conversion/twins.hpp"
#include "session/check.hpp"

/// Values that are computed before a block: the block itself stays whole, and no parameter is read before it is set.
namespace probewright::testing_support {
namespace {

::testing::AssertionResult isValid(const std::string& text, ControlKind control) {
  const auto program = session::programOf("A.H", text, ProgramLanguage::Klartext);
  for (const Diagnostic& each : session::checkProgram(*program, control))
    if (each.severity == Severity::Error) return ::testing::AssertionFailure() << format(each) << "\n" << text;
  return ::testing::AssertionSuccess();
}

/// No parameter of the helper (Q1900 to Q1999) is read above the line that sets it.
::testing::AssertionResult setsBeforeItReads(const std::string& text) {
  static const std::regex assignment(R"(^(?:\d+ )?(?:FN 18: SYSREAD )?Q(19\d\d) = )"), parameter(R"(Q(19\d\d))");
  std::set<std::string> known;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    const bool sets = std::regex_search(line, found, assignment);
    const std::string name = sets ? found[1].str() : std::string();
    const std::string values = sets ? found.suffix().str() : line;
    for (std::sregex_iterator each(values.begin(), values.end(), parameter), end; each != end; ++each)
      if (!known.contains((*each)[1])) return ::testing::AssertionFailure() << line << "\nin\n" << text;
    if (sets) known.insert(name);
  }
  return ::testing::AssertionSuccess();
}

void expectWhole(const std::string& blocks, ControlKind control, bool inch = false) {
  const std::string text =
      fmt::format("G17 G90 {}\nT1 M6 D1\nG54\nG0 X0 Y0 Z100\n{}M30\n", inch ? "G700" : "G710", blocks);
  const conversion::Conversion written = converted(text, ProgramLanguage::Sinumerik, control);
  EXPECT_FALSE(hasErrors(written.mistakes)) << text;
  EXPECT_EQ(written.text.find("NOT CARRIED OVER"), std::string::npos) << written.text;
  EXPECT_TRUE(isValid(written.text, control));
  EXPECT_TRUE(setsBeforeItReads(written.text));
}

TEST(WrittenBlocks, ComputeTheClearanceHeightBeforeTheToolIsMeasured) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530})
    for (const bool inch : {false, true})
      for (const int axis : {1, 3})
        for (const char* height : {"R1+100", "2*R1", "MAXVAL(R1,100)", "MAXVAL($AA_IW[Z],100)", "R1", "100"}) {
          SCOPED_TRACE(fmt::format("{} {} {}", axis, height, inch));
          expectWhole(fmt::format("G0 Z={}\nCYCLE971(2,1,1,{},{},,{},15,,,,1)\n", height, axis, axis == 3 ? 0 : 1,
                                  inch ? 0.5 : 15),
                      control, inch);
        }
}

TEST(WrittenBlocks, AreWholeWhereTheirValuesAreExpressions) {
  for (const char* blocks : {
           "G4 F=R1+1\n",
           "SPOS=R1+1\n",
           "TRANS X=R1+1 Y=2*R2\nG0 X0\nTRANS\n",
           "ROT Z=R1+1\nG0 X0\nROT\n",
           "MEAS=1 G1 X=R1+10 Y=R2*2 F=R3+100\n",
           "T=R1+1\nM6\n",
           "G0 X=R1+1 Y=2*R2\nG2 X=R1+20 Y=R2+5 CR=R3+40\n",
           "G2 X=R1+20 Y=R2+5 I=R3+2 J=R4+1\n",
           "IF R1+1>R2*2\nG0 X1\nENDIF\n",
           "CYCLE977(101,10001,,1,R1+20,,,10,R2+5,0,1,1,,,1,\"\",,0,1.01,-1.01,,,,,1,0)\n",
       }) {
    SCOPED_TRACE(blocks);
    expectWhole(blocks, ControlKind::TNC640);
  }
  expectWhole("$P_UIFR[R1+1,X,TR]=R2+3\n$P_UIFR[R1+1,Z,RT]=R2+3\n", ControlKind::TNC640);
}

/// What became of tool measuring cycles is read again on the way back.
TEST(WrittenBlocks, OfToolMeasurementsAreValidThereAndBack) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530})
    for (const bool old : {false, true})
      for (const int kind : {1, 2, 3})
        for (const bool moved : {false, true}) {
          SCOPED_TRACE(fmt::format("{} {} {}", kind, old, moved));
          const std::string cycle =
              old ? fmt::format(
                        "TCH PROBE {0}.0 TOOL\nTCH PROBE {0}.1 CHECK: 0\nTCH PROBE {0}.2 HEIGHT: +100\n"
                        "TCH PROBE {0}.3 PROBING THE TEETH: 1\n",
                        30 + kind)
                  : probe(480 + kind, {{340, 0}, {260, 100}, {341, 1}});
          const std::string text = fmt::format("0 BEGIN PGM A MM\nTOOL CALL 1 Z\n{}{}L Z+200 R0 FMAX\n9 END PGM A MM\n",
                                               moved ? "L Z+50 R0 FMAX\n" : "", cycle);
          const conversion::Conversion there = toSinumerik(text);
          EXPECT_NE(there.text.find("G0 Z=MAXVAL($AA_IW[Z],100)"), std::string::npos) << there.text;
          const conversion::Conversion back = converted(there.text, ProgramLanguage::Sinumerik, control);
          EXPECT_NE(back.text.find("TCH PROBE 48"), std::string::npos) << back.text;
          EXPECT_TRUE(back.notCarriedOver.empty()) << format(back.notCarriedOver.front());
          EXPECT_TRUE(isValid(back.text, control));
          EXPECT_TRUE(setsBeforeItReads(back.text));
        }
}

}  // namespace
}  // namespace probewright::testing_support
