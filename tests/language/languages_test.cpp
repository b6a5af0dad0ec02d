#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "execution/interpreter.hpp"
#include "language/directory_library.hpp"
#include "language/klartext/program.hpp"
#include "language/made_program.hpp"
#include "language/sinumerik/program.hpp"

/// Whole programs of both languages through the interpreter: that front ends and interpreter mean the same.
namespace probewright::execution {
namespace {

using ::testing::HasSubstr;

class Texts : public ProgramLibrary {
public:
  Result<std::shared_ptr<Program>> open(std::string_view name, const Program*) override {
    const auto found = programs.find(std::string(name));
    if (found == programs.end()) return fail("there is no program " + std::string(name));
    return found->second;
  }
  bool exists(std::string_view name, const Program*) override { return programs.count(std::string(name)) > 0; }

  std::map<std::string, std::shared_ptr<Program>> programs;
};

struct Control {
  Texts texts;
  RecordingHost host;
  InterpreterOptions options;

  RunResult klartext(const std::string& text) {
    return Interpreter(texts, host, options).run(std::make_shared<klartext::KlartextProgram>("MAIN.H", text));
  }
  RunResult sinumerik(const std::string& text) {
    return Interpreter(texts, host, options).run(language::sinumerik::SinumerikProgram::fromText("MAIN.MPF", text));
  }
};

std::string explained(const RunResult& result) {
  std::string all;
  for (const Diagnostic& diagnostic : result.diagnostics)
    all += format(diagnostic) + "\n";
  return all;
}

TEST(KlartextRun, LabelsRepeatsAndConditions) {
  Control control;
  const RunResult result = control.klartext(R"(0 BEGIN PGM MAIN MM
1 Q1 = 0
2 LBL 1 ; outer part
3 Q1 = Q1 + 1
4 LBL "INNER"
5 FN 1: Q2 = +Q2 + +1
6 CALL LBL "INNER" REP2
7 CALL LBL 1 REP 3
8 CALL LBL 20
9 QS1 = "A" || "B"
10 FN 9: IF +Q2 EQU +12 GOTO LBL 99
11 Q5 = 1
12 LBL 99
13 FN 10: IF +Q2 NE +12 GOTO LBL 1
14 L Z+100 R0 FMAX M30
15 LBL 20
16 Q3 = SQRT ( Q1 ^ 2 + 9 )
17 CALL LBL 21
18 LBL 0
19 LBL 21
20 Q4 = SIN 30
21 LBL 0
22 END PGM MAIN MM
)");
  EXPECT_EQ(explained(result), "");
  EXPECT_EQ(result.end, RunEnd::Finished);
  EXPECT_EQ(control.host.q(2), 12);
  EXPECT_EQ(control.host.q(3), 5);
  EXPECT_DOUBLE_EQ(control.host.q(4), 0.5);
  EXPECT_EQ(control.host.variables.count(5), 0U);
}

TEST(KlartextRun, CalledProgramsReturn) {
  Control control;
  control.texts.programs["SUB.H"] = std::make_shared<klartext::KlartextProgram>(
      "SUB.H", "0 BEGIN PGM SUB MM\n1 Q1 = Q1 + 1\n2 CALL LBL 1\n3 LBL 1\n4 Q2 = Q2 + 1\n5 LBL 0\n6 END PGM SUB MM\n");
  const RunResult result = control.klartext(
      "0 BEGIN PGM MAIN MM\n1 LBL 1\n2 CALL PGM SUB.H\n3 CALL LBL 1 REP 1\n4 Q3 = 7\n5 END PGM MAIN MM\n");
  EXPECT_EQ(explained(result), "");
  EXPECT_EQ(control.host.q(1), 2);
  EXPECT_EQ(control.host.q(2), 4) << "the subprogram runs once by its call and once in passing, in each of two calls";
  EXPECT_EQ(control.host.q(3), 7);
}

TEST(KlartextRun, AlarmsNameTheBlock) {
  Control control;
  const RunResult result = control.klartext("0 BEGIN PGM MAIN MM\n1 Q1 = 5 / Q2\n2 END PGM MAIN MM\n");
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(explained(result),
            "MAIN.H:2:3: error: the divisor is 0\n    1 Q1 = 5 / Q2\n    compare the divisor with 0 in a block before "
            "this one\n");
}

TEST(SinumerikRun, StructuresNest) {
  Control control;
  const RunResult result = control.sinumerik(R"(N10 R1=0 R2=0
WHILE R1<3
  R1=R1+1
  FOR R5=1 TO 4
    IF R5==2
      R2=R2+10
    ELSE
      R2=R2+1
    ENDIF
  ENDFOR
ENDWHILE
REPEAT
  R3=R3+1
UNTIL R3>=5
LOOP
  R4=R4+1
  IF R4>6 GOTOF OUT
ENDLOOP
OUT: R6=SIN(30)
M30
R7=1
)");
  EXPECT_EQ(explained(result), "");
  EXPECT_EQ(control.host.q(1), 3);
  EXPECT_EQ(control.host.q(2), 39);
  EXPECT_EQ(control.host.q(3), 5);
  EXPECT_EQ(control.host.q(4), 7);
  EXPECT_EQ(control.host.q(5), 5);
  EXPECT_DOUBLE_EQ(control.host.q(6), 0.5);
  EXPECT_EQ(control.host.variables.count(7), 0U);
}

TEST(SinumerikRun, SectionsAndJumps) {
  Control control;
  const RunResult result = control.sinumerik(R"(GOTOF BEGIN_1
SUB: R1=R1+1
SUBEND: R2=R2+1
BEGIN_1: REPEAT SUB SUBEND P=3
AGAIN: R3=R3+1
REPEAT AGAIN P=2
HERE: R4=R4+1
REPEATB HERE P=4
N500 R5=R5+1
IF R5<3 GOTOB N500
GOTOC NOWHERE
CASE R5 OF 2 GOTOF TWO 3 GOTOF THREE DEFAULT GOTOF OTHER
TWO: R6=2
OTHER: R6=9
THREE: R7=3
M2
)");
  EXPECT_EQ(explained(result), "");
  EXPECT_EQ(control.host.q(1), 3);
  EXPECT_EQ(control.host.q(2), 3);
  EXPECT_EQ(control.host.q(3), 3);
  EXPECT_EQ(control.host.q(4), 5);
  EXPECT_EQ(control.host.q(5), 3);
  EXPECT_EQ(control.host.variables.count(6), 0U);
  EXPECT_EQ(control.host.q(7), 3);
}

TEST(SinumerikRun, SubprogramsRepeatAndCyclesAreLeftToTheControl) {
  Control control;
  control.texts.programs["L100"] = language::sinumerik::SinumerikProgram::fromText("L100.SPF", "R1=R1+1\nM17\nR1=99\n");
  const RunResult result = control.sinumerik("L100 P3\nCYCLE978(200,,1)\nM30\n");
  EXPECT_EQ(explained(result), "");
  EXPECT_EQ(control.host.q(1), 3);
  EXPECT_THAT(control.host.protocol, HasSubstr("<L100 L100> <L100 L100> <L100 L100>"));
  EXPECT_THAT(control.host.protocol, HasSubstr("cycle:CYCLE978"));
}

TEST(SinumerikRun, MissingDestinationsHaveTheControlsNumber) {
  Control control;
  const RunResult result = control.sinumerik("R1=1\nGOTOF NOWHERE\nM30\n");
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_THAT(explained(result), HasSubstr("MAIN.MPF:2:1: error: 14080: there is no label NOWHERE after this block"));
}

TEST(BadPrograms, AreMessagesNotEndlessLoopsOrOverflows) {
  // An open bracket up to the end of the line was once read beyond it while the labels were being collected.
  Control control;
  EXPECT_EQ(control.sinumerik("GOTOF AB\nDEF STRING[20 \nAB: M30\n").end, RunEnd::Finished);
  EXPECT_EQ(control.sinumerik("M=99999999999999\n").end, RunEnd::BrokenProgram);
  EXPECT_EQ(control.sinumerik("M2=99999999999999\n").end, RunEnd::BrokenProgram);
  EXPECT_EQ(control.klartext("FN 777777777777777: Q1 = 2\n").end, RunEnd::BrokenProgram);
}

}  // namespace
}  // namespace probewright::execution
