#include "execution/interpreter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "language/made_program.hpp"

namespace probewright::execution {
namespace {

using ::testing::HasSubstr;
using Blocks = std::vector<Make>;

struct Bench {
  MadeLibrary library;
  RecordingHost host;
  InterpreterOptions options;

  RunResult run(Blocks blocks) { return run(library.add("MAIN", std::move(blocks))); }
  RunResult run(std::shared_ptr<Program> program) {
    return Interpreter(library, host, options).run(std::move(program));
  }
};

std::string text(const RunResult& result) {
  std::string all;
  for (const Diagnostic& diagnostic : result.diagnostics)
    all += format(diagnostic) + "\n";
  return all;
}

TEST(Interpreter, CarriesOutBlocksAndTheirInstructionsInOrder) {
  Bench bench;
  const RunResult result = bench.run({Make().say("a").say("b"), Make(), Make().assign(1, 7).say("c")});
  EXPECT_EQ(result.end, RunEnd::Finished);
  EXPECT_TRUE(result.diagnostics.empty());
  EXPECT_EQ(result.blocks, 3U);
  EXPECT_EQ(bench.host.protocol, "<MAIN a b c MAIN> ");
  EXPECT_EQ(bench.host.q(1), 7);
}

TEST(Interpreter, EndsWithTheProgramEvenIfBlocksFollow) {
  Bench bench;
  bench.run({Make().say("a"), Make().add(EndProgram{}), Make().say("b")});
  EXPECT_EQ(bench.host.protocol, "<MAIN a MAIN> ");
}

// ---- HEIDENHAIN labels ----

TEST(LabelCalls, ReturnBehindTheCall) {
  Bench bench;
  // 1 call, 2 rest of the main program, 3 end, subprogram behind it.
  bench.run({Make().callLabel("1"), Make().say("main"), Make().callLabel("1"), Make().add(EndProgram{}),
             Make().label("1"), Make().say("sub"), Make().label("0"), Make().say("never")});
  EXPECT_EQ(bench.host.protocol, "<MAIN sub main sub MAIN> ");
}

TEST(LabelCalls, Nest) {
  Bench bench;
  bench.run({Make().callLabel("1"), Make().say("end"), Make().add(EndProgram{}), Make().label("1"), Make().say("1a"),
             Make().callLabel("2"), Make().say("1b"), Make().label("0"), Make().label("2"), Make().say("2"),
             Make().label("0")});
  EXPECT_EQ(bench.host.protocol, "<MAIN 1a 2 1b end MAIN> ");
}

TEST(LabelCalls, GoOnWithTheInstructionsBehindThemInTheirBlock) {
  Bench bench;
  bench.run({Make().callLabel("1").say("rest"), Make().add(EndProgram{}), Make().label("1"), Make().say("sub"),
             Make().label("0")});
  EXPECT_EQ(bench.host.protocol, "<MAIN sub rest MAIN> ");
}

TEST(LabelZero, MeansNothingWithoutACall) {
  Bench bench;
  bench.run({Make().label("1"), Make().say("a"), Make().label("0"), Make().say("b")});
  EXPECT_EQ(bench.host.protocol, "<MAIN a b MAIN> ");
}

TEST(PartRepeats, RunTheFirstTimeAndThenAsOftenAsProgrammed) {
  Bench bench;
  bench.run({Make().label("1"), Make().count(1), Make().callLabel("1", 3), Make().say("on")});
  EXPECT_EQ(bench.host.q(1), 4);
  EXPECT_EQ(bench.host.protocol, "<MAIN on MAIN> ");
}

TEST(PartRepeats, NestAndCountAnewEachTime) {
  Bench bench;
  // The inner part runs 1 + 2 times in each of the 1 + 4 passes of the outer one.
  bench.run({Make().label("15"), Make().count(1), Make().label("20"), Make().count(2), Make().callLabel("20", 2),
             Make().callLabel("15", 4)});
  EXPECT_EQ(bench.host.q(1), 5);
  EXPECT_EQ(bench.host.q(2), 15);
}

TEST(PartRepeats, RepeatASubprogramCall) {
  Bench bench;
  bench.run({Make().label("10"), Make().callLabel("12"), Make().callLabel("10", 2), Make().add(EndProgram{}),
             Make().label("12"), Make().count(1), Make().label("0")});
  EXPECT_EQ(bench.host.q(1), 3);
}

TEST(PartRepeats, WithinASubprogramCountAnewWithEveryCall) {
  Bench bench;
  bench.run({Make().callLabel("1"), Make().callLabel("1"), Make().add(EndProgram{}), Make().label("1"),
             Make().label("2"), Make().count(1), Make().callLabel("2", 2), Make().label("0")});
  EXPECT_EQ(bench.host.q(1), 6);
}

TEST(PartRepeats, OfZeroTimesDoNotJump) {
  Bench bench;
  bench.run({Make().label("1"), Make().count(1), Make().callLabel("1", 0)});
  EXPECT_EQ(bench.host.q(1), 1);
}

// ---- jumps ----

TEST(Jumps, FollowTheirCondition) {
  Bench bench;
  Make loop;
  loop.jump("A", loop.binary(Operation::Less, loop.value(1), 5));
  const RunResult result = bench.run({Make().assign(1, 0), Make().plainLabel("A").count(1), loop, Make().say("on")});
  EXPECT_EQ(bench.host.q(1), 5);
  EXPECT_EQ(result.blocks, 1 + 5 + 5 + 1U);
}

TEST(Jumps, ComputeTheirLabel) {
  Bench bench;
  Make named, numbered;
  named.add(Jump{{}, named.binary(Operation::Concatenate, named.text("L"), named.value(1)), {}});
  numbered.add(Jump{{}, numbered.value(1), {}});
  bench.run({Make().assign(1, 12), named, Make().say("never"), Make().plainLabel("L12").say("text"), numbered,
             Make().say("never"), Make().plainLabel("12").say("number")});
  EXPECT_EQ(bench.host.protocol, "<MAIN text number MAIN> ");
}

TEST(Jumps, KnowDirections) {
  Bench bench;
  Make again;
  again.jump("A", again.binary(Operation::Less, again.value(1), 2), JumpDirection::Backward);
  bench.run(
      {Make().jump("A", {}, JumpDirection::Forward), Make().say("never"), Make().plainLabel("A").count(1), again});
  EXPECT_EQ(bench.host.q(1), 2);
}

TEST(Jumps, ToTheProgramStart) {
  Bench bench;
  Make start;
  start.add(Jump{{}, {}, start.binary(Operation::Less, start.value(1), 3), JumpDirection::ProgramStart});
  bench.run({Make().count(1), start});
  EXPECT_EQ(bench.host.q(1), 3);
}

TEST(Jumps, WithoutLabelAreAnAlarmOrLeftOut) {
  Bench bench;
  RunResult result = bench.run({Make(), Make().jump("NOWHERE")});
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(
      format(result.diagnostics.at(0)),
      "MAIN.prg:2:1: error: 14080: there is no label NOWHERE in this program\n    block 2\n    check how the label is "
      "written");
  Make silent;
  silent.add(Jump{silent.block.add("NOWHERE"), {}, {}, JumpDirection::Any, true});
  Bench second;
  result = second.run({silent, Make().say("on")});
  EXPECT_EQ(result.end, RunEnd::Finished);
  EXPECT_EQ(second.host.protocol, "<MAIN on MAIN> ");
}

// ---- SINUMERIK sections ----

TEST(Sections, RepeatUpToTheStatementItself) {
  Bench bench;
  bench.run({Make().plainLabel("A").count(1), Make().count(2), Make().repeat("A", "", 3), Make().say("on")});
  EXPECT_EQ(bench.host.q(1), 4);
  EXPECT_EQ(bench.host.q(2), 4);
  EXPECT_EQ(bench.host.protocol, "<MAIN on MAIN> ");
}

TEST(Sections, RepeatBetweenTwoLabelsWithBothBlocks) {
  Bench bench;
  bench.run({Make().plainLabel("A").count(1), Make().plainLabel("E").count(2), Make().count(3),
             Make().repeat("A", "E", 2), Make().say("on")});
  EXPECT_EQ(bench.host.q(1), 3);
  EXPECT_EQ(bench.host.q(2), 3);
  EXPECT_EQ(bench.host.q(3), 1);
}

TEST(Sections, MayLieBehindTheStatement) {
  Bench bench;
  bench.run({Make().repeat("A", "E", 2), Make().say("on"), Make().add(EndProgram{}), Make().plainLabel("A").count(1),
             Make().plainLabel("E").count(2)});
  EXPECT_EQ(bench.host.q(1), 2);
  EXPECT_EQ(bench.host.q(2), 2);
  EXPECT_EQ(bench.host.protocol, "<MAIN on MAIN> ");
}

TEST(Sections, EndAtEndlabel) {
  Bench bench;
  bench.run(
      {Make().plainLabel("A").count(1), Make().plainLabel("ENDLABEL"), Make().count(2), Make().repeat("A", "", 3)});
  EXPECT_EQ(bench.host.q(1), 4);
  EXPECT_EQ(bench.host.q(2), 1);
}

TEST(Sections, EndAtTheStatementIfTheirEndLabelLiesBehindIt) {
  Bench bench;
  bench.run({Make().plainLabel("A").count(1), Make().repeat("A", "ENDLABEL", 2), Make().repeat("A", "E", 1),
             Make().plainLabel("E"), Make().plainLabel("ENDLABEL").count(2)});
  // 1 + 2 passes, then the section up to the second REPEAT, which holds the first with its 2 passes, once more.
  EXPECT_EQ(bench.host.q(1), 6);
  EXPECT_EQ(bench.host.q(2), 1);
  Bench missing;
  EXPECT_THAT(text(missing.run({Make().plainLabel("A"), Make().repeat("A", "E", 1)})), HasSubstr("no end label E"));
}

TEST(Sections, OfOneBlock) {
  Bench bench;
  bench.run({Make().plainLabel("A").count(1), Make().count(2), Make().repeat("A", "", 5, true)});
  EXPECT_EQ(bench.host.q(1), 6);
  EXPECT_EQ(bench.host.q(2), 1);
}

TEST(Sections, Nest) {
  Bench bench;
  // In each of the 1 + 2 passes block B runs once and is then repeated 3 times.
  bench.run({Make().plainLabel("A").count(1), Make().plainLabel("B").count(2), Make().repeat("B", "", 3, true),
             Make().repeat("A", "", 2)});
  EXPECT_EQ(bench.host.q(1), 3);
  EXPECT_EQ(bench.host.q(2), 12);
}

TEST(Sections, AreLeftByAJump) {
  Bench bench;
  Make out;
  out.jump("OUT", out.binary(Operation::GreaterEqual, out.value(1), 3));
  bench.run({Make().plainLabel("A").count(1), out, Make().repeat("A", "", 10), Make().say("never"),
             Make().plainLabel("OUT").say("out"), Make().say("on")});
  EXPECT_EQ(bench.host.q(1), 3);
  EXPECT_EQ(bench.host.protocol, "<MAIN out on MAIN> ");
}

// ---- structured statements ----

TEST(Structures, IfTakesOneBranch) {
  for (const double value : {0.0, 1.0}) {
    Bench bench;
    Make condition;
    condition.structure(Structure::If, condition.value(1));
    bench.run({Make().assign(1, value), condition, Make().say("then"), Make().structure(Structure::Else),
               Make().say("else"), Make().structure(Structure::EndIf), Make().say("on")});
    EXPECT_EQ(bench.host.protocol, value != 0 ? "<MAIN then on MAIN> " : "<MAIN else on MAIN> ");
  }
}

TEST(Structures, IfWithoutElse) {
  Bench bench;
  bench.run({Make().structure(Structure::If, Operand::of(0)), Make().say("then"), Make().structure(Structure::EndIf),
             Make().say("on")});
  EXPECT_EQ(bench.host.protocol, "<MAIN on MAIN> ");
}

TEST(Structures, LoopsNest) {
  Bench bench;
  // WHILE Q1 < 3 / FOR Q2 = 1 TO 4 / REPEAT / Q3 + 1 / UNTIL Q3 is a multiple of 2
  Make loop, until;
  loop.structure(Structure::While, loop.binary(Operation::Less, loop.value(1), 3));
  until.structure(Structure::Until,
                  until.binary(Operation::Equal, until.binary(Operation::Modulo, until.value(3), 2), 0));
  const RunResult result =
      bench.run({loop, Make().count(1), Make().loopFor(2, Operand::of(1), Operand::of(4)), Make().count(4),
                 Make().structure(Structure::Repeat), Make().count(3), until, Make().structure(Structure::EndFor),
                 Make().structure(Structure::EndWhile), Make().say("on")});
  EXPECT_EQ(text(result), "");
  EXPECT_EQ(bench.host.q(1), 3);
  EXPECT_EQ(bench.host.q(2), 5) << "the first value above the limit";
  EXPECT_EQ(bench.host.q(4), 12);
  EXPECT_EQ(bench.host.q(3), 24);
  EXPECT_EQ(bench.host.protocol, "<MAIN on MAIN> ");
}

TEST(Structures, ForMayRunNever) {
  Bench bench;
  bench.run({Make().loopFor(1, Operand::of(3), Operand::of(2)), Make().say("never"),
             Make().structure(Structure::EndFor), Make().say("on")});
  EXPECT_EQ(bench.host.q(1), 3);
  EXPECT_EQ(bench.host.protocol, "<MAIN on MAIN> ");
}

TEST(Structures, LoopIsLeftByAJump) {
  Bench bench;
  Make out;
  out.jump("OUT", out.binary(Operation::Greater, out.value(1), 9));
  bench.run({Make().structure(Structure::Loop), Make().count(1), out, Make().structure(Structure::EndLoop),
             Make().plainLabel("OUT").say("out")});
  EXPECT_EQ(bench.host.q(1), 10);
}

TEST(Structures, WithoutCounterpartAreAnAlarm) {
  Bench bench;
  const RunResult result = bench.run({Make().structure(Structure::While, Operand::of(0))});
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_THAT(text(result), HasSubstr("MAIN.prg:1:1: error: this statement has no counterpart"));
}

// ---- programs ----

TEST(ProgramCalls, ReturnAtEveryKindOfEnd) {
  for (const Instruction& end : {Instruction(EndProgram{}), Instruction(Return{}), Instruction(Stop{})}) {
    Bench bench;
    bench.library.add("SUB", {Make().say("sub"), Make().add(end)});
    bench.run({Make().callProgram("SUB").say("rest"), Make().say("on"), Make().add(EndProgram{})});
    EXPECT_EQ(bench.host.protocol, "<MAIN <SUB sub SUB> rest on MAIN> ");
  }
}

TEST(ProgramCalls, RepeatWithArgumentsComputedAnew) {
  Bench bench;
  bench.library.add("SUB", {Make().count(1)});
  Make call;
  call.block.words.push_back({0, WordMode::Plain, call.value(1)});
  call.add(CallProgram{call.block.add("SUB"), {}, {0, 1}, Operand::of(3)});
  bench.run({call, Make().say("on")});
  EXPECT_EQ(bench.host.q(1), 3);
  EXPECT_EQ(bench.host.q(100), 2);
  EXPECT_EQ(bench.host.protocol, "<MAIN <SUB SUB> <SUB SUB> <SUB SUB> on MAIN> ");
}

TEST(ProgramCalls, LeaveOpenSubprogramsOfTheCalledProgram) {
  Bench bench;
  bench.library.add("SUB", {Make().callLabel("1"), Make().say("never"), Make().label("1"), Make().add(EndProgram{})});
  bench.run({Make().callLabel("5"), Make().say("on"), Make().add(EndProgram{}), Make().label("5"),
             Make().callProgram("SUB"), Make().say("back"), Make().label("0")});
  EXPECT_EQ(bench.host.protocol, "<MAIN <SUB SUB> back on MAIN> ");
}

TEST(ProgramCalls, PreferAProgramToACycle) {
  Bench bench;
  bench.library.add("CYCLE977", {Make().say("own")});
  bench.run({Make().callProgram("CYCLE977", 1, true), Make().callProgram("CYCLE978", 1, true)});
  EXPECT_EQ(bench.host.protocol, "<MAIN <CYCLE977 own CYCLE977> cycle:CYCLE978 MAIN> ");
}

TEST(ProgramCalls, OfAMissingProgramSayWhy) {
  Bench bench;
  const RunResult result = bench.run({Make().callProgram("NONE")});
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(text(result), "MAIN.prg:1:1: error: there is no program NONE\n    block 1\n    look at the name\n");
}

// ---- ends ----

TEST(Ends, AlarmComesWithPlaceAndCalls) {
  Bench bench;
  bench.library.add("SUB", {Make(), Make().callLabel("1"), Make().label("1"), Make().say("alarm")});
  const RunResult result = bench.run({Make(), Make(), Make().callProgram("SUB")});
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(text(result),
            "SUB.prg:4:1: error: 4711: the axis is stuck\n    block 4\n    free it\n"
            "SUB.prg:2: note: the subprogram was called here\n"
            "MAIN.prg:3: note: program SUB was called here\n");
  EXPECT_EQ(bench.host.protocol, "<MAIN <SUB SUB> MAIN> ") << "every level is left";
}

TEST(Ends, BrokenBlocksEndTheRunWithTheirMessage) {
  Bench bench;
  const auto program = bench.library.add("MAIN", {Make().say("a"), Make().say("b")});
  program->brokenLine = 2;
  const RunResult result = bench.run(program);
  EXPECT_EQ(result.end, RunEnd::BrokenProgram);
  EXPECT_EQ(text(result), "MAIN.prg:2:3: error: a number was expected\n    L XY\n");
  EXPECT_EQ(bench.host.protocol, "<MAIN a MAIN> ");
}

TEST(Ends, EndlessLoopsReachTheStepLimit) {
  Bench bench;
  bench.options.stepLimit = 1001;
  const RunResult result = bench.run({Make().plainLabel("A").count(1), Make().jump("A")});
  EXPECT_EQ(result.end, RunEnd::StepLimit);
  EXPECT_EQ(result.blocks, 1001U);
  EXPECT_EQ(bench.host.q(1), 501);
  EXPECT_THAT(text(result), HasSubstr("stopped after 1001 blocks"));
}

TEST(Ends, EndlessRecursionsReachTheNestingLimit) {
  Bench bench;
  bench.options.programDepth = 16;
  bench.library.add("SUB", {Make().count(1), Make().callProgram("SUB")});
  RunResult result = bench.run({Make().callProgram("SUB")});
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_THAT(result.diagnostics.at(0).message, HasSubstr("more than 16 programs"));
  EXPECT_EQ(bench.host.q(1), 15) << "the main program is the first level";

  Bench labels;
  labels.options.sectionDepth = 8;
  result = labels.run({Make().label("1"), Make().count(1), Make().callLabel("1")});
  EXPECT_EQ(result.end, RunEnd::Alarm);
  EXPECT_THAT(result.diagnostics.at(0).message, HasSubstr("more than 8 subprograms"));
  EXPECT_EQ(labels.host.q(1), 9);
}

TEST(Ends, CancelFromOutsideAndFromTheHost) {
  std::stop_source source;
  Bench bench;
  bench.options.stop = source.get_token();
  source.request_stop();
  RunResult result = bench.run({Make().say("a")});
  EXPECT_EQ(result.end, RunEnd::Cancelled);
  EXPECT_EQ(bench.host.protocol, "<MAIN MAIN> ");

  Bench second;
  result = second.run({Make(), Make().say("cancel"), Make().say("never")});
  EXPECT_EQ(result.end, RunEnd::Cancelled);
  EXPECT_THAT(text(result), HasSubstr("MAIN.prg:2:1: note"));
}

// ---- operator ----

TEST(SkippedBlocks, DependOnTheirLevel) {
  Make plain, third;
  plain.say("0").block.skippable = true;
  third.say("3").block.skippable = true;
  third.block.skipLevel = 3;
  Bench off;
  off.run({plain, third});
  EXPECT_EQ(off.host.protocol, "<MAIN 0 3 MAIN> ");
  Bench on;
  on.options.skipLevels.set(3);
  on.run({plain, third});
  EXPECT_EQ(on.host.protocol, "<MAIN 0 MAIN> ");
  Bench left;
  left.host.leftOut = {1};
  left.run({plain, third});
  EXPECT_EQ(left.host.protocol, "<MAIN 3 MAIN> ") << "the host may leave blocks out";
}

// ---- effort ----

TEST(Effort, LoopsAreParsedAndSearchedOnce) {
  Bench bench;
  Make loop;
  loop.jump("A", loop.binary(Operation::Less, loop.value(1), 10000));
  const auto program = bench.library.add("MAIN", {Make().plainLabel("A").count(1), Make().callLabel("S"), loop,
                                                  Make().add(EndProgram{}), Make().label("S"), Make().label("0")});
  bench.run(program);
  EXPECT_EQ(bench.host.q(1), 10000);
  EXPECT_LE(program->parsed, 2 * 6) << "once when it streams by, once to be kept";
  EXPECT_LE(program->searches, 2 * 2);
}

TEST(Effort, LoopsLargerThanTheCacheStayCorrect) {
  Bench bench;
  Blocks blocks;
  blocks.push_back(Make().label("1"));
  for (int i = 0; i < 9000; ++i)
    blocks.push_back(Make().count(1));
  blocks.push_back(Make().callLabel("1", 3));
  bench.run(std::move(blocks));
  EXPECT_EQ(bench.host.q(1), 36000);
}

}  // namespace
}  // namespace probewright::execution
