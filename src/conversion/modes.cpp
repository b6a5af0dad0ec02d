#include "conversion/modes.hpp"

#include "cycles/catalogue.hpp"

namespace probewright::conversion {

using namespace language;

std::optional<double> literalOf(const Block& block, const Operand& operand) {
  if (operand.isLiteral()) return operand.number;
  if (!operand.present() || operand.node < 0) return std::nullopt;
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  if (node.operation == Operation::Number) return node.number;
  if (node.operation != Operation::Negate) return std::nullopt;
  const auto value = literalOf(block, node.left);
  return value ? std::optional(-*value) : std::nullopt;
}

bool callsProgram(const Block& block) {
  return std::ranges::any_of(block.instructions, [&](const Instruction& instruction) {
    const auto* call = std::get_if<CallProgram>(&instruction);
    return call != nullptr && cycles::sinumerikCycle(block.at(call->name)) == nullptr &&
           block.at(call->name) != "CYCLE800";
  });
}

std::vector<std::vector<std::size_t>> followers(const FlowGraph& graph, const std::vector<bool>& neutral) {
  std::vector<std::vector<std::size_t>> next(graph.blocks().size());
  graph.forEachFlow([&](std::size_t place) { return neutral[place]; },
                    [&](std::size_t from, std::size_t to) {
                      if (std::ranges::find(next[from], to) == next[from].end()) next[from].push_back(to);
                    });
  return next;
}

}  // namespace probewright::conversion
