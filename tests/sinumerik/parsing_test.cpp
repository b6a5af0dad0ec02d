#include <gtest/gtest.h>

#include <random>
#include <string>

#include "language/sinumerik/program.hpp"
#include "sinumerik/samples.hpp"

namespace probewright::language::sinumerik {
namespace {

using namespace language;

/// The first block of `text`, which must be free of mistakes.
Block parseBlock(const std::string& text) {
  const auto program = SinumerikProgram::fromText("test.mpf", text);
  Block block;
  Diagnostics diagnostics;
  EXPECT_TRUE(program->parse(program->begin(), block, diagnostics)) << text;
  for (const Diagnostic& diagnostic : diagnostics)
    ADD_FAILURE() << format(diagnostic);
  return block;
}

Diagnostic mistakeOf(const std::string& text) {
  const auto program = SinumerikProgram::fromText("test.mpf", text);
  Block block;
  Diagnostics diagnostics;
  program->parse(program->begin(), block, diagnostics);
  EXPECT_EQ(diagnostics.size(), 1u) << text;
  EXPECT_TRUE(block.instructions.empty()) << text;
  return diagnostics.empty() ? Diagnostic{} : diagnostics.front();
}

template <class T>
const T& only(const Block& block) {
  EXPECT_EQ(block.instructions.size(), 1u) << block.at(block.source);
  return std::get<T>(block.instructions.at(0));
}

const Node& nodeOf(const Block& block, const Operand& operand) {
  return block.nodes.at(static_cast<std::size_t>(operand.node));
}

TEST(SinumerikParsing, TakesMotionWithItsFunctionsApart) {
  const Block block = parseBlock("n0020 g90g01 x10.5 Y=-3 z-.25 F1200 s=r1 m03 D1 ; to the corner");
  EXPECT_EQ(block.at(block.label), "N0020");
  ASSERT_EQ(block.instructions.size(), 5u);
  EXPECT_EQ(block.at(std::get<Modal>(block.instructions[0]).name), "G90");
  EXPECT_EQ(block.at(std::get<Modal>(block.instructions[1]).name), "S");
  EXPECT_EQ(std::get<MachineFunction>(block.instructions[2]).number, 3);
  EXPECT_EQ(block.at(std::get<Modal>(block.instructions[3]).name), "D");
  const Move& move = std::get<Move>(block.instructions[4]);
  EXPECT_EQ(move.kind, MoveKind::Linear);
  EXPECT_EQ(move.feed.number, 1200);
  ASSERT_EQ(move.words.count, 3u);
  const Word* words = &block.words[move.words.first];
  EXPECT_EQ(words[0].address, addressOf("X"));
  EXPECT_EQ(words[0].value.number, 10.5);
  EXPECT_EQ(words[1].value.number, -3);
  EXPECT_EQ(words[2].value.number, -0.25);
  EXPECT_EQ(words[2].column, 25u);
}

TEST(SinumerikParsing, KnowsHowACoordinateIsMeant) {
  const Block block = parseBlock("G0 X=AC(10) Y=IC(R1) A=DC(30) B=ACP(1) C=ACN(2)");
  const Move& move = only<Move>(block);
  const WordMode modes[] = {WordMode::Absolute, WordMode::Incremental, WordMode::DirectShortest,
                            WordMode::DirectPositive, WordMode::DirectNegative};
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(block.words[move.words.first + i].mode, modes[i]);
}

TEST(SinumerikParsing, ReadsExtendedAddressesAndExponents) {
  const Block block = parseBlock("G1 X1=10 C2=-5EX1 Y3.5EX-2");
  const Move& move = only<Move>(block);
  EXPECT_EQ(addressName(block.words[move.words.first].address), "X1");
  EXPECT_EQ(addressName(block.words[move.words.first + 1].address), "C2");
  EXPECT_EQ(block.words[move.words.first + 1].value.number, -50);
  EXPECT_NEAR(block.words[move.words.first + 2].value.number, 0.035, 1e-17);
}

TEST(SinumerikParsing, NumbersAreReadLikeTheLibraryReadsThem) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    const long long whole = static_cast<long long>(random() % 100000000);
    const std::string text = std::to_string(whole / 1000) + "." + std::to_string(random() % 1000000);
    EXPECT_EQ(only<Move>(parseBlock("X" + text)).words.count, 1u);
    const Block block = parseBlock("X" + text);
    EXPECT_EQ(block.words.front().value.number, std::stod(text)) << text;
  }
}

TEST(SinumerikParsing, CallsCyclesWithOmittedArguments) {
  const Block block = parseBlock("N70 CYCLE977(101,,,1,42.5,,,15,2,0,,,1,\"\",,0,1.01)");
  const CallProgram& call = only<CallProgram>(block);
  EXPECT_TRUE(call.maybeCycle);
  EXPECT_EQ(block.at(call.name), "CYCLE977");
  ASSERT_EQ(call.arguments.count, 17u);
  const Word* words = &block.words[call.arguments.first];
  EXPECT_EQ(words[0].value.number, 101);
  EXPECT_FALSE(words[1].value.present());
  EXPECT_FALSE(words[2].value.present());
  EXPECT_EQ(words[4].value.number, 42.5);
  EXPECT_EQ(nodeOf(block, words[13].value).operation, Operation::Text);
  EXPECT_EQ(words[16].value.number, 1.01);
  EXPECT_EQ(words[16].address, 16u);
}

TEST(SinumerikParsing, OrdersOperatorsAsTheLanguageDoes) {
  // Comparison binds least, then <<, then logic: A + B * C == D is (A + (B * C)) == D.
  const Block block = parseBlock("R1=R2+R3*R4==R5");
  const Assign& assign = only<Assign>(block);
  const Node& equal = nodeOf(block, assign.value);
  EXPECT_EQ(equal.operation, Operation::Equal);
  const Node& sum = nodeOf(block, equal.left);
  EXPECT_EQ(sum.operation, Operation::Add);
  EXPECT_EQ(nodeOf(block, sum.right).operation, Operation::Multiply);

  const Block logic = parseBlock("R1=R2 OR R3 AND R4 B_OR R5");
  const Node& either = nodeOf(logic, only<Assign>(logic).value);
  EXPECT_EQ(either.operation, Operation::Or);
  const Node& both = nodeOf(logic, either.right);
  EXPECT_EQ(both.operation, Operation::And);
  EXPECT_EQ(nodeOf(logic, both.right).operation, Operation::BitOr);

  const Block left = parseBlock("R1=R2-R3-R4");
  EXPECT_EQ(nodeOf(left, nodeOf(left, only<Assign>(left).value).left).operation, Operation::Subtract);
}

TEST(SinumerikParsing, ReadsSeveralStatementsOfOneBlock) {
  const Block block = parseBlock("R1=5 R2=R1*2 G17 G54 T=\"PROBE\" M6 STOPRE");
  ASSERT_EQ(block.instructions.size(), 7u);
  EXPECT_TRUE(std::get<ToolCall>(block.instructions[4]).name.present());
  EXPECT_EQ(std::get<MachineFunction>(block.instructions[5]).number, 6);
  EXPECT_EQ(block.at(std::get<Command>(block.instructions[6]).name), "STOPRE");
}

TEST(SinumerikParsing, ProgramEndComesBehindTheMotion) {
  const Block block = parseBlock("M30 G0 Z100");
  ASSERT_EQ(block.instructions.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<Move>(block.instructions[0]));
  EXPECT_TRUE(std::holds_alternative<EndProgram>(block.instructions[1]));
}

TEST(SinumerikParsing, DeclaresVariablesOfEveryType) {
  const Block block = parseBlock("DEF REAL LEN=12.5, GRID[3,4]=SET(1,2,,4), FILL[10]=REP(7)");
  ASSERT_EQ(block.instructions.size(), 3u);
  const Command& grid = std::get<Command>(block.instructions[1]);
  EXPECT_EQ(block.at(grid.text), "REAL");
  const VariableRef& variable = block.variables[static_cast<std::size_t>(grid.variable)];
  EXPECT_EQ(block.at(variable.name), "GRID");
  EXPECT_EQ(variable.index[0].number, 3);
  EXPECT_EQ(variable.index[1].number, 4);
  EXPECT_EQ(grid.words.count, 4u);
  EXPECT_FALSE(block.words[grid.words.first + 2].value.present());
  for (const char* text : {"DEF INT AB", "DEF BOOL FLAG=TRUE", "DEF CHAR CC='A'", "DEF STRING[32] NAME=\"x;y\"",
                           "DEF AXIS AX1=(X)", "DEF FRAME BFR", "DEF CHAN INT PHU 1 WITHUNIT", "def string[20] a_b"})
    EXPECT_EQ(parseBlock(text).instructions.size(), 1u) << text;
}

TEST(SinumerikParsing, JumpsUnderConditions) {
  const Block block = parseBlock("IF (R1>5) AND (R2<>0) GOTOF LABEL_1");
  const Jump& jump = only<Jump>(block);
  EXPECT_EQ(block.at(jump.label), "LABEL_1");
  EXPECT_EQ(jump.direction, JumpDirection::Forward);
  EXPECT_EQ(nodeOf(block, jump.condition).operation, Operation::And);
  EXPECT_TRUE(only<Jump>(parseBlock("GOTOC NOWHERE")).ignoreMissing);
  EXPECT_EQ(only<Jump>(parseBlock("GOTOS")).direction, JumpDirection::ProgramStart);
  const Block number = parseBlock("GOTOB N100");
  EXPECT_EQ(number.at(only<Jump>(number).label), "N100");
  const Block computed = parseBlock("GOTOF \"LB\"<<R1");
  EXPECT_TRUE(only<Jump>(computed).labelValue.present());
  const Block cases = parseBlock("CASE R1+1 OF 1 GOTOF L_A 2 GOTOF L_B DEFAULT GOTOF N50");
  ASSERT_EQ(cases.instructions.size(), 3u);
  EXPECT_TRUE(std::get<Jump>(cases.instructions[1]).condition.present());
  EXPECT_FALSE(std::get<Jump>(cases.instructions[2]).condition.present());
}

TEST(SinumerikParsing, TakesTheLabelFromAStringVariable) {
  const auto program = SinumerikProgram::fromText("t.mpf", "GOTOF TARGET\nDEF STRING[20] OTHER, TARGET=\"A_B\"\n");
  Block block;
  Diagnostics diagnostics;
  program->parse(program->begin(), block, diagnostics);
  EXPECT_TRUE(only<Jump>(block).labelValue.present());
  EXPECT_EQ(only<Jump>(block).label.length, 0u);
}

TEST(SinumerikParsing, AcceptsEverythingThatProbingProgramsContain) {
  for (const char* text : sampleBlocks)
    parseBlock(text);
}

TEST(SinumerikParsing, KeepsTextsInAnyEncoding) {
  const Block block = parseBlock("MSG(\"\xCF\xF0\xEE\xE2\xE5\xF0\xEA\xE0 \xE4\x22) ; \xB2\xE2");
  const Command& message = only<Command>(block);
  const Word& word = block.words[message.words.first];
  EXPECT_EQ(block.at(nodeOf(block, word.value).text), "\xCF\xF0\xEE\xE2\xE5\xF0\xEA\xE0 \xE4");
}

TEST(SinumerikParsing, NamesEachMistakeWithPlaceAndWayOut) {
  struct Case {
    const char* text;
    std::uint32_t column;
    const char* message;
  };
  for (const Case& c : {
           Case{"N10 G999 X1", 5, "no function G999"},
           Case{"G1 X10 X20", 8, "X appears twice"},
           Case{"G0 G1 X5", 4, "two motions"},
           Case{"IF R1=5 GOTOF A_1", 6, "condition of IF ends at '='"},
           Case{"IF R1==5 R2=3", 10, "after the condition of IF"},
           Case{"R1=", 4, "a value is missing"},
           Case{"R1=(1+2", 8, "')' expected"},
           Case{"MSG(\"abc)", 5, "no closing quotation mark"},
           Case{"R1=SINE(30)", 4, "no function SINE"},
           Case{"R1=SIN(30,2)", 4, "SIN takes 1 argument, but 2 are given"},
           Case{"GOTOF", 6, "needs a destination"},
           Case{"G1 X", 4, "X has no value"},
           Case{"CR 5", 1, "CR needs a value"},
           Case{"DEF FLOAT AA", 5, "type of the variable"},
           Case{"DEF INT IF", 9, "IF is a word of the language"},
           Case{"DEF STRING NAME", 12, "the length of the text"},
           Case{"FOR R1=1 10", 10, "TO expected"},
           Case{"CASE R1 1 GOTOF A_1", 9, "OF expected"},
           Case{"ENDIF R1=1", 7, "nothing may follow ENDIF"},
           Case{"G1 X10 CYCLE977(1)", 8, "is in a block with a motion"},
           Case{"R1 5", 1, "R parameter needs a value"},
           Case{"?5", 1, "'?' cannot begin a statement"},
           Case{"CYCLE977(1 2)", 12, "',' or ')' expected"},
           Case{"TO 5", 1, "no statement begins with TO"},
           Case{"T1 DEFINE AA_B AS R1=5", 4, "DEFINE must be in a block of its own"},
           Case{"TRANS X10 DO M8", 11, "DO must be in a block of its own"},
           Case{"G1 X1 N20", 7, "block number is only allowed at the beginning"},
       }) {
    const Diagnostic mistake = mistakeOf(c.text);
    EXPECT_EQ(mistake.place.column, c.column) << c.text;
    EXPECT_EQ(mistake.place.line, 1u);
    EXPECT_NE(mistake.message.find(c.message), std::string::npos) << c.text << ": " << mistake.message;
    EXPECT_EQ(mistake.excerpt, c.text);
  }
  EXPECT_EQ(mistakeOf("R1=SQRTT(2)").advice, "Did you mean SQRT?");
}

TEST(SinumerikParsing, NamesTheWordThatWasNearlyWritten) {
  const std::vector<std::string_view> words = {"CLEARANCE", "MIRROR", "ATRANS", "GOTOF", "SQRT", "ASIN"};
  // A letter left out, one too many, another one, two exchanged: the word is meant, at the beginning, in it, at its
  // end.
  for (const std::string_view word : words) {
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::string without(word), more(word), other(word), exchanged(word);
      without.erase(i, 1);
      more.insert(i, 1, 'Q');
      other[i] = 'Q';
      if (i > 0) std::swap(exchanged[i - 1], exchanged[i]);
      for (const std::string& written : {without, more, other, exchanged, std::string(word) + "Q"})
        EXPECT_EQ(closestName(written, words), word) << written;
    }
  }
  EXPECT_EQ(closestName("MQRRQR", words), "MIRROR") << "two letters of a longer word";
  EXPECT_EQ(closestName("IRRO", words), "") << "two letters of a short one";
  for (const char* far : {"MQQRQR", "SQ", "QQRR", "CLEAR", "MIRRORQQQ", "X"})
    EXPECT_EQ(closestName(far, words), "") << far;
}

TEST(SinumerikParsing, DeepNestingIsAMistakeNotACrash) {
  const std::string deep = "R1=" + std::string(5000, '(') + "1" + std::string(5000, ')');
  EXPECT_NE(mistakeOf(deep).message.find("nested too deeply"), std::string::npos);
  EXPECT_NE(mistakeOf("R1=" + std::string(5000, '-') + "R1").message.find("nested too deeply"), std::string::npos);
}

TEST(SinumerikStructure, PairsStatementsAndFindsLabels) {
  const auto program = SinumerikProgram::fromText("t.mpf",
                                                  "A_1: R1=0\n"           // 1
                                                  "IF R1==1 GOTOF B_1\n"  // 2
                                                  "if R1==2\n"            // 3
                                                  "N10 WHILE R1<5\n"      // 4
                                                  "R1=R1+1\n"             // 5
                                                  "ENDWHILE ; end\n"      // 6
                                                  "ELSE\n"                // 7
                                                  "REPEAT\n"              // 8
                                                  "UNTIL R1>2\n"          // 9
                                                  "ENDIF\n"               // 10
                                                  "REPEAT A_1 P2\n"       // 11
                                                  "b_1: R1=1\n"           // 12
                                                  "N10 A_1: M30\n");      // 13
  EXPECT_TRUE(program->structure().mistakes().empty());
  std::vector<BlockPosition> lines{{}};
  Block block;
  Diagnostics diagnostics;
  for (BlockPosition at = program->begin(); program->parse(at, block, diagnostics); at = block.next)
    lines.push_back(at);
  const auto lineOf = [&](std::optional<BlockPosition> position) { return position ? position->line : 0; };
  EXPECT_EQ(lineOf(program->counterpart(lines[2])), 0u);
  EXPECT_EQ(lineOf(program->counterpart(lines[3])), 7u);
  EXPECT_EQ(lineOf(program->counterpart(lines[7])), 10u);
  EXPECT_EQ(lineOf(program->counterpart(lines[4])), 6u);
  EXPECT_EQ(lineOf(program->counterpart(lines[6])), 4u);
  EXPECT_EQ(lineOf(program->counterpart(lines[9])), 8u);
  EXPECT_EQ(lineOf(program->findLabel("B_1", lines[2], JumpDirection::Forward)), 12u);
  EXPECT_EQ(lineOf(program->findLabel("B_1", lines[2], JumpDirection::Backward)), 0u);
  EXPECT_EQ(lineOf(program->findLabel("a_1", lines[5], JumpDirection::Backward)), 1u);
  EXPECT_EQ(lineOf(program->findLabel("A_1", lines[5], JumpDirection::ForwardThenBackward)), 13u);
  EXPECT_EQ(lineOf(program->findLabel("N10", lines[5], JumpDirection::Backward)), 4u);
  EXPECT_EQ(lineOf(program->findLabel("N10", lines[5], JumpDirection::Forward)), 13u);
  EXPECT_EQ(lineOf(program->findLabel("N11", lines[5], JumpDirection::ForwardThenBackward)), 0u);
}

TEST(SinumerikStructure, NamesWhatIsNotClosed) {
  const auto program = SinumerikProgram::fromText("t.mpf", "IF R1==1\nWHILE R1<3\nENDIF\nENDFOR\nLOOP\n");
  const Diagnostics& mistakes = program->structure().mistakes();
  ASSERT_EQ(mistakes.size(), 3u);
  EXPECT_EQ(mistakes[0].message, "ENDIF does not close WHILE of line 2");
  EXPECT_EQ(mistakes[0].place.line, 3u);
  EXPECT_EQ(mistakes[1].message, "ENDFOR without FOR");
  EXPECT_EQ(mistakes[2].message, "LOOP is not closed by ENDLOOP");
}

TEST(SinumerikStructure, ReadsTheHeaderOfASubprogram) {
  const auto program = SinumerikProgram::fromText("t.spf",
                                                  "; a comment\nproc Sub_1(real a_1, var int b_1, string[10] "
                                                  "c_1=\"x,y\", bool d_1=true, REAL E_1[2,3]) save\nM17\n");
  const auto& header = program->structure().header();
  ASSERT_TRUE(header);
  EXPECT_EQ(header->name, "SUB_1");
  ASSERT_EQ(header->parameters.size(), 5u);
  EXPECT_TRUE(header->parameters[1].byReference);
  EXPECT_EQ(header->parameters[1].type, Type::Int);
  EXPECT_EQ(header->parameters[2].defaultText, "x,y");
  EXPECT_EQ(header->parameters[3].defaultNumber, 1);
  EXPECT_EQ(header->parameters[4].dimensions, (std::vector<int>{2, 3}));
  EXPECT_EQ(header->attributes, (std::vector<std::string>{"SAVE"}));
}

}  // namespace
}  // namespace probewright::language::sinumerik
