#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "language/sinumerik/program.hpp"
#include "language/sinumerik/writer.hpp"
#include "sinumerik/samples.hpp"

namespace probewright::language::sinumerik {
namespace {

using namespace language;

/// All that a block means, independent of where it keeps its pieces.
class Meaning {
public:
  explicit Meaning(const Block& block) : block_(block) {}

  std::string text() {
    out_ = fmt::format("[{}]{}", block_.at(block_.label), block_.skippable ? "/" : "");
    for (const Instruction& instruction : block_.instructions) {
      out_ += fmt::format("\n{} ", instruction.index());
      std::visit([this](const auto& each) { put(each); }, instruction);
    }
    return out_;
  }

private:
  void put(TextRef ref) { out_ += fmt::format("<{}>", block_.at(ref)); }
  void put(double number) { out_ += fmt::format(" {}", number); }
  void put(const Operand& operand) {
    if (!operand.present()) {
      out_ += " -";
    } else if (operand.isLiteral()) {
      put(operand.number);
    } else {
      const Node& node = block_.nodes[static_cast<std::size_t>(operand.node)];
      out_ += fmt::format(" ({}:{}", static_cast<int>(node.operation), static_cast<int>(node.function));
      if (node.operation == Operation::Variable) {
        variable(node.a);
      } else if (node.operation == Operation::Call) {
        put(node.text);
        for (std::uint32_t i = 0; i < node.b; ++i)
          put(block_.operands[node.a + i]);
      } else {
        put(node.text);
        put(node.left);
        put(node.right);
      }
      out_ += ")";
    }
  }
  void variable(std::uint32_t index) {
    const VariableRef& variable = block_.variables[index];
    out_ += fmt::format(" v{}", static_cast<int>(variable.space));
    put(variable.name);
    for (const Operand& each : variable.index)
      put(each);
  }
  void put(WordRange range) {
    for (std::uint32_t i = 0; i < range.count; ++i) {
      const Word& word = block_.words[range.first + i];
      out_ += fmt::format(" {}:{}", word.address, static_cast<int>(word.mode));
      put(word.value);
    }
  }
  void put(const Assign& each) {
    variable(each.variable);
    put(each.value);
  }
  void put(const Jump& each) {
    put(each.label);
    put(each.labelValue);
    put(each.condition);
    out_ += fmt::format(" {}{}", static_cast<int>(each.direction), each.ignoreMissing);
  }
  void put(const LabelMark& each) { put(each.label); }
  void put(const CallLabel& each) { put(each.label); }
  void put(const RepeatSection& each) {
    put(each.from);
    put(each.to);
    put(each.times);
    out_ += each.onlyBlock ? "B" : "";
  }
  void put(const CallProgram& each) {
    put(each.name);
    put(each.nameValue);
    put(each.arguments);
    put(each.times);
    out_ += each.maybeCycle ? "?" : "";
  }
  void put(const Return&) {}
  void put(const EndProgram&) {}
  void put(const Structured& each) {
    out_ += fmt::format("{}", static_cast<int>(each.kind));
    put(each.condition);
    if (each.kind == Structure::For) variable(each.variable);
    put(each.from);
    put(each.to);
  }
  void put(const Move& each) {
    out_ += fmt::format("{}{}{}{}", static_cast<int>(each.kind), each.polar, static_cast<int>(each.compensation),
                        each.machineCoordinates);
    put(each.variant);
    put(each.words);
    put(each.feed);
  }
  void put(const ToolCall& each) {
    put(each.number);
    put(each.name);
    put(each.index);
  }
  void put(const Modal& each) {
    put(each.name);
    put(each.words);
  }
  void put(const MachineFunction& each) {
    out_ += fmt::format("{}", each.number);
    put(each.argument);
  }
  void put(const Transform& each) {
    put(each.name);
    put(each.words);
  }
  void put(const CycleCall& each) {
    put(each.name);
    put(each.parameters);
  }
  void put(const Command& each) {
    put(each.name);
    put(each.text);
    if (each.variable >= 0) variable(static_cast<std::uint32_t>(each.variable));
    put(each.words);
  }
  void put(const Stop& each) { out_ += each.optional ? "1" : "0"; }

  const Block& block_;
  std::string out_;
};

Block parseBlock(const std::string& text) {
  const auto program = SinumerikProgram::fromText("test.mpf", text + "\n");
  Block block;
  Diagnostics diagnostics;
  EXPECT_TRUE(program->parse(program->begin(), block, diagnostics));
  for (const Diagnostic& diagnostic : diagnostics)
    ADD_FAILURE() << format(diagnostic);
  return block;
}

std::string rewritten(const std::string& text) {
  const Result<std::string> written = writeBlock(parseBlock(text));
  EXPECT_TRUE(written) << text;
  return written.value_or("");
}

TEST(SinumerikWriter, EverySampleMeansTheSameWhenReadBack) {
  for (const char* text : sampleBlocks) {
    const Block block = parseBlock(text);
    const Result<std::string> written = writeBlock(block);
    ASSERT_TRUE(written) << text;
    EXPECT_EQ(Meaning(parseBlock(*written)).text(), Meaning(block).text()) << text << "\nwritten: " << *written;
  }
}

TEST(SinumerikWriter, WritesAsOneWouldByHand) {
  EXPECT_EQ(rewritten("n10 g01x1.50y=r1*2f100;to P1"), "N10 G1 X1.5 Y=R1*2 F100 ;to P1");
  EXPECT_EQ(rewritten("CYCLE977(101,,,1,42.5,,,15)"), "CYCLE977(101,,,1,42.5,,,15)");
  EXPECT_EQ(rewritten("r1=(r2+1)*3-(r4-r5)"), "R1=(R2+1)*3-(R4-R5)");
  EXPECT_EQ(rewritten("if (r1==1)and(not r2) gotof end_1"), "IF (R1==1) AND NOT R2 GOTOF END_1");
  EXPECT_EQ(rewritten("msg(\"Ring \"<<r1)"), "MSG(\"Ring \"<<R1)");
  EXPECT_EQ(rewritten("def real a_a=-1.5,b_b[2,3]"), "DEF REAL A_A=-1.5,B_B[2,3]");
  EXPECT_EQ(rewritten("x=ic(-5)"), "X=IC(-5)");
  // Arguments that are left out have their comma only where another follows.
  EXPECT_EQ(rewritten("ret(\"LBL\")"), "RET(\"LBL\")");
  EXPECT_EQ(rewritten("ret(\"LBL\",1,,)"), "RET(\"LBL\",1)");
  EXPECT_EQ(rewritten("ret(,,2)"), "RET(,,2)");
  EXPECT_EQ(rewritten("ret(\"LBL\",,,1)"), "RET(\"LBL\",,,1)");
  EXPECT_EQ(rewritten("r1=r2*(-3)"), "R1=R2*(-3)");
  EXPECT_EQ(rewritten("/2 lbl_a: g0 z5"), "/2 LBL_A: G0 Z5");
}

TEST(SinumerikWriter, WritesWholePrograms) {
  const auto program =
      SinumerikProgram::fromText("t.mpf", "%_n_a_mpf\n\n; head\nn10 g0 x1 ; go\nif r1==1\nm30\nendif\n");
  const Result<std::string> text = writeProgram(*program);
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "%_n_a_mpf\n\n; head\nN10 G0 X1 ; go\nIF R1==1\nM30\nENDIF\n");
  const auto broken = SinumerikProgram::fromText("t.mpf", "G0 X1\nG0 X\n");
  EXPECT_EQ(writeProgram(*broken).error().place.line, 2u);
}

TEST(SinumerikWriter, NumbersKeepEveryDigit) {
  for (const double value : {1e-7, 0.1 + 0.2, 123456789.123456789, 5e-324, 1.7976931348623157e308, -2.5e-12, 1e21}) {
    const Block block = parseBlock("R1=" + writeNumber(value));
    EXPECT_EQ(std::get<Assign>(block.instructions.at(0)).value.number, value) << writeNumber(value);
  }
}

TEST(SinumerikWriter, RefusesWhatOnlyOtherLanguagesHave) {
  Block block;
  block.instructions.emplace_back(LabelMark{});
  const Result<std::string> written = writeBlock(block);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("LBL"), std::string::npos);
}

}  // namespace
}  // namespace probewright::language::sinumerik
