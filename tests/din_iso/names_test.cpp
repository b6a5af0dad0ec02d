#include <gtest/gtest.h>

#include <random>

#include "language/din_iso/program.hpp"
#include "language/din_iso/writer.hpp"

namespace probewright::language::din_iso::testing {
namespace {

/// The file that the second block of the text names in a call or a selection; nothing if it names none or is refused.
std::optional<std::string> namedFile(const std::string& text, Block& block) {
  DinIsoProgram program("a.i", text);
  Block first;
  Diagnostics mistakes;
  if (!program.parse(program.begin(), first, mistakes)) return std::nullopt;
  mistakes.clear();
  if (!program.parse(first.next, block, mistakes) || !mistakes.empty() || block.instructions.size() != 1) {
    return std::nullopt;
  }
  if (const auto* call = std::get_if<CallProgram>(&block.instructions.front())) {
    if (call->nameValue.present()) return std::nullopt;
    return std::string(block.at(call->name));
  }
  const auto* command = std::get_if<Command>(&block.instructions.front());
  if (command == nullptr || command->words.count > 0) return std::nullopt;
  return std::string(block.at(command->text));
}

TEST(Names, OfFilesAreWrittenSoThatTheyReadTheSame) {
  const std::string bytes = "AQS5.I:%<>~*;\" \t\x85\x93\x94\xE2\x80\x9C\\/-_G70g71";
  std::mt19937_64 random(8);
  int read = 0;
  for (const std::string head : {"%", "%:", "%:PGM: ", "%:TAB:", "G39 P01 "}) {
    for (int i = 0; i < 20000; ++i) {
      std::string name;
      for (std::uint64_t length = 1 + random() % 7; length > 0; --length)
        name += bytes[random() % bytes.size()];
      Block block, again;
      const auto named = namedFile("%A G71 *\n" + head + name + "\n", block);
      if (!named) continue;
      ++read;
      const Result<std::string> written = writeBlock(block);
      ASSERT_TRUE(written) << head << name;
      EXPECT_EQ(namedFile("%A G71 *\n" + *written + "\n", again), named) << head << name << " became " << *written;
    }
  }
  EXPECT_GT(read, 10000);
}

}  // namespace
}  // namespace probewright::language::din_iso::testing
