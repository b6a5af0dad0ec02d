#pragma once

#include <string>

#include "language/block.hpp"
#include "language/host.hpp"
#include "language/value.hpp"

namespace probewright::language {

/// Computes the operands of one block. Throws control::Alarm for what a control refuses (division by zero, a text where
/// a number is needed, a function outside its domain), with the block as place.
class Evaluation {
public:
  Evaluation(const Program& program, const Block& block, Host& host) : program_(program), block_(block), host_(host) {}

  const Program& program() const { return program_; }
  const Block& block() const { return block_; }
  Host& host() { return host_; }

  Value value(const Operand& operand);
  double number(const Operand& operand);
  bool truth(const Operand& operand) { return number(operand) != 0; }
  std::string text(const Operand& operand);
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
  Value call(const Node& node);

  const Program& program_;
  const Block& block_;
  Host& host_;
};

}  // namespace probewright::language
