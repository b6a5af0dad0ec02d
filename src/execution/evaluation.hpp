#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "execution/host.hpp"
#include "execution/names.hpp"
#include "language/block.hpp"
#include "language/value.hpp"

namespace probewright::execution {

/// Computes the operands of one block. Throws control::Alarm for what a control refuses (division by zero, a text where
/// a number is needed, a function outside its domain); the interpreter adds the block as place. Numbers are IEEE
/// doubles, truth is 1 and 0, angles are degrees; sine, cosine and tangent are exact at multiples of 90 degrees. AND
/// and OR leave their right side alone when the left one decides. Operations on bits and IntegerDivide round their
/// operands to integers of 32 bits. No memory is allocated as long as no text takes part.
class Evaluation {
public:
  Evaluation(const Program& program, const Block& block, Host& host) : program_(program), block_(block), host_(host) {}

  const Program& program() const { return program_; }
  const Block& block() const { return block_; }
  Host& host() { return host_; }

  Value value(const Operand& operand);
  /// Never infinite and never NaN.
  double number(const Operand& operand);
  bool truth(const Operand& operand) { return number(operand) != 0; }
  /// The text, or a number as the control shows it.
  std::string text(const Operand& operand);
  /// The text of a variable whose number shows as a text: Host::shownText. Nothing for every other operand.
  std::optional<std::string> shownText(const Operand& operand);
  /// The number, or `otherwise` if the operand is absent.
  double numberOr(const Operand& operand, double otherwise) { return operand.present() ? number(operand) : otherwise; }
  std::string_view at(TextRef ref) const { return block_.at(ref); }
  std::span<const Word> words(WordRange range) const {
    return std::span<const Word>(block_.words).subspan(range.first, range.count);
  }
  SourcePlace place() const;

private:
  Value evaluate(const Node& node);
  double evaluateNumber(const Node& node);
  double compute(const Node& node);
  double compare(const Node& node);
  double callNumber(const Node& node);
  Value callHost(const Node& node);
  /// An operand inside an expression: may be infinite.
  double operand(const Operand& operand);
  std::int32_t integer(const Operand& operand);
  /// True if the operand certainly is a number.
  bool isNumeric(const Operand& operand) const;
  [[noreturn]] void refuse(Refusal refusal, std::string text, std::string advice = {}) const;

  const Program& program_;
  const Block& block_;
  Host& host_;
  int depth_ = 0;
};

}  // namespace probewright::execution
