#include "conversion/dialects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "language/din_iso/block_extent.hpp"
#include "language/din_iso/modal_state.hpp"
#include "language/din_iso/writer.hpp"
#include "language/klartext/block_extent.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/lexer.hpp"
#include "language/klartext/writer.hpp"

namespace probewright::conversion {

using language::Block;
using language::BlockPosition;
using language::Instruction;
using language::Modal;
using language::Move;
using language::Word;
using language::WordMode;
using language::klartext::CommandKind;
using language::klartext::FramePart;
using language::klartext::HeidenhainProgram;
using language::klartext::TransformKind;

namespace {

constexpr std::string_view lastBlockNumber = "N99999999";

/// Calls `use` for each line of the text.
template <class Use>
void forEachLine(std::string_view text, Use use) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    use(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// What comes before the keyword and after the statement of a DIN/ISO block, blanked, so that comments and names
/// are found where Klartext has them.
void blankDinIsoSigns(Block& block) {
  const std::string_view source = block.at(block.source);
  const std::size_t statement = language::din_iso::blockExtent(source).statement;
  const std::size_t keyword = source.size() - language::din_iso::withoutBlockNumber(source).size();
  char* text = block.text.data() + block.source.offset;
  std::fill_n(text, keyword, ' ');
  if (statement < source.size() && text[statement] == '*') text[statement] = ' ';
}

/// True for what an M function, a stop or the like adds to a block.
bool isAddition(const Block& block, const Instruction& instruction) {
  const auto* command = std::get_if<language::Command>(&instruction);
  return std::holds_alternative<language::MachineFunction>(instruction) ||
         std::holds_alternative<language::Stop>(instruction) ||
         std::holds_alternative<language::EndProgram>(instruction) ||
         (command != nullptr && language::klartext::kindOf(block, *command) == CommandKind::CycleCall);
}

/// Watches for DIN/ISO blocks whose meaning depends on what runs before them.
class OrderWatch {
public:
  explicit OrderWatch(HeidenhainProgram& program) {
    Block block;
    Diagnostics ignored;
    for (BlockPosition at = program.begin(); program.parse(at, block, ignored); at = block.next)
      usesIncremental_ = usesIncremental_ || sets(block, "G91");
  }

  /// What the block takes over from blocks that may not be the ones before it; empty if nothing.
  std::string look(const Block& block) {
    std::string relied;
    const bool setsMode = sets(block, "G90") || sets(block, "G91");
    const bool setsPath = std::ranges::any_of(block.instructions, [&block](const Instruction& instruction) {
      const auto* modal = std::get_if<Modal>(&instruction);
      const std::string_view name = modal == nullptr ? std::string_view() : block.at(modal->name);
      return !name.empty() && name.front() == 'G' && name.size() <= 3 && !name.starts_with("G9") && name != "G17" &&
             name != "G18" && name != "G19";
    });
    if (doubtfulPath_ && !setsPath && travels(block)) relied = "the path function";
    if (doubtfulMode_ && usesIncremental_ && hasPlainWords(block))
      relied = relied.empty() ? "G90 or G91" : relied + " and G90 or G91";
    doubtfulPath_ = doubtfulPath_ && !setsPath && relied.empty();
    doubtfulMode_ = doubtfulMode_ && !setsMode && relied.empty();
    for (const Instruction& instruction : block.instructions) {
      const auto* mark = std::get_if<language::LabelMark>(&instruction);
      const auto* call = std::get_if<language::CallLabel>(&instruction);
      const bool subprogram = call != nullptr && !call->repeats.present();
      if ((mark != nullptr && !mark->end) || subprogram || std::holds_alternative<language::CallProgram>(instruction)) {
        doubtfulPath_ = doubtfulMode_ = true;
      }
    }
    return relied;
  }

private:
  static bool sets(const Block& block, std::string_view function) {
    return std::ranges::any_of(block.instructions, [&](const Instruction& instruction) {
      const auto* modal = std::get_if<Modal>(&instruction);
      return modal != nullptr && block.at(modal->name) == function;
    });
  }
  static bool travels(const Block& block) {
    return std::ranges::any_of(block.instructions, [&block](const Instruction& instruction) {
      const auto* move = std::get_if<Move>(&instruction);
      return move != nullptr && move->words.count > 0 && block.at(move->variant) == "G";
    });
  }
  static bool hasPlainWords(const Block& block) {
    const auto plain = [&block](language::WordRange range) {
      for (std::uint32_t i = 0; i < range.count; ++i) {
        const Word& word = block.words[range.first + i];
        if (word.mode == WordMode::Plain && word.address != '#' && word.address != 'R') return true;
      }
      return false;
    };
    return std::ranges::any_of(block.instructions, [&](const Instruction& instruction) {
      if (const auto* move = std::get_if<Move>(&instruction)) {
        return (block.at(move->variant) == "G" || move->kind == language::MoveKind::SetCentre) && plain(move->words);
      }
      const auto* transform = std::get_if<language::Transform>(&instruction);
      if (transform == nullptr) return false;
      const TransformKind kind = language::klartext::kindOf(block, *transform);
      return (kind == TransformKind::DatumShift || kind == TransformKind::Rotation) && plain(transform->words);
    });
  }

  bool usesIncremental_ = false;
  bool doubtfulPath_ = false;
  bool doubtfulMode_ = false;
};

class Converter {
public:
  Converter(HeidenhainProgram& program, bool fromDinIso, bool toDinIso, ToolCycles toolCycles)
      : program_(program), fromDinIso_(fromDinIso), toDinIso_(toDinIso), toolCycles_(toolCycles) {}

  Conversion run() {
    OrderWatch watch(program_);
    Block block;
    for (BlockPosition at = program_.begin(); program_.parse(at, block, result_.mistakes); at = block.next) {
      const FramePart part = program_.framePart(block);
      origin_ = block.position;
      if (!fromDinIso_) {
        write(block, part, block);
        continue;
      }
      const std::string relied = watch.look(block);
      if (!relied.empty() && !toDinIso_) {
        report(block, fmt::format("this block takes {} from the block that runs before it", relied),
               "it is translated as the blocks above it say; check each call of this part of the program");
      }
      state_.resolve(block, resolved_);
      blankDinIsoSigns(resolved_);
      write(resolved_, part, block);
    }
    return std::move(result_);
  }

private:
  void report(const Block& block, std::string message, std::string advice) {
    std::string_view line = block.at(block.source);
    line = trimmedAtEnd(line.substr(0, line.find('\n')), lineBlanks);
    result_.notCarriedOver.push_back({Severity::Warning,
                                      {program_.file(), block.position.line, 1},
                                      std::move(message),
                                      std::string(line),
                                      std::move(advice),
                                      {}});
  }

  void frame(const Block& block, bool begin) {
    for (const Instruction& instruction : block.instructions) {
      const auto* command = std::get_if<language::Command>(&instruction);
      if (command != nullptr) head_ = block.at(command->text);
    }
    if (head_.empty()) head_ = program_.name() + (program_.unit() == language::klartext::Unit::Inch ? " INCH" : " MM");
    const bool inch = head_.ends_with("INCH");
    if (!toDinIso_) {
      line(fmt::format("{} PGM {}", begin ? "BEGIN" : "END", head_), Text::Remark);
      return;
    }
    const std::string_view name = trimmedAtEnd(std::string_view(head_).substr(0, head_.size() - (inch ? 4 : 2)));
    const std::string text = fmt::format("%{} {} *", name, inch ? "G70" : "G71");
    append(begin ? text : fmt::format("{} {}", lastBlockNumber, text));
  }

  /// `original`: the block as it was read, for messages.
  void write(const Block& block, FramePart part, const Block& original) {
    if (part == FramePart::Begin || part == FramePart::End) {
      frame(original, part == FramePart::Begin);
      return;
    }
    if (original.instructions.empty()) {
      comment(block);
      return;
    }
    for (const Block& single : singles(block)) {
      if (!toolCycle(single, original)) statement(single, original);
    }
  }

  /// A cycle that measures tools, in the form that is asked for; false for all other blocks. DIN/ISO has the new form
  /// only.
  bool toolCycle(const Block& block, const Block& original) {
    const bool renewed = toDinIso_ || toolCycles_ == ToolCycles::New;
    if (!renewed && toolCycles_ == ToolCycles::AsWritten) return false;
    const auto form = renewed ? newToolCycle(block) : oldToolCycle(block);
    if (!form) {
      if (!renewed && hasNewToolCycle(block)) {
        report(original, "the old form of this cycle cannot take its clearance height from GLOBAL DEF",
               "write the height, or keep the new form");
      }
      return false;
    }
    statement(form->block, original);
    if (form->status) {
      line(toDinIso_ ? fmt::format("D00 Q{:.0f} P01 +Q199 *", *form->status)
                     : fmt::format("Q{:.0f} = Q199", *form->status),
           Text::Block);
    }
    return true;
  }

  void comment(const Block& block) {
    const std::string_view text = language::klartext::withoutBlockNumber(block.at(block.source));
    bool first = true;
    forEachLine(text, [&](std::string_view rest) {
      rest = trimmedAtEnd(rest, lineBlanks);
      while (rest.ends_with('~'))
        rest = trimmedAtEnd(rest.substr(0, rest.size() - 1));
      const bool marked = rest.empty() || rest.front() == ';' || rest.front() == '*';
      if (first || !rest.empty())
        line((marked ? "" : "; ") + std::string(rest) + (toDinIso_ ? " *" : ""), Text::Remark);
      first = false;
    });
  }

  /// Klartext has one function to a block: a DIN/ISO block with a centre, a tool and a path becomes three.
  std::vector<Block> singles(const Block& block) const {
    Block clean = block;
    std::erase_if(clean.instructions, [&block](const Instruction& instruction) {
      const auto* modal = std::get_if<Modal>(&instruction);
      return modal != nullptr && language::din_iso::isModalFunction(block, *modal);
    });
    const auto mains =
        std::ranges::count_if(clean.instructions, [&block](const auto& i) { return !isAddition(block, i); });
    if (mains <= 1) return {clean};
    std::vector<Block> parts;
    for (const Instruction& instruction : clean.instructions) {
      if (isAddition(block, instruction)) continue;
      Block& part = parts.emplace_back(clean);
      part.instructions = {instruction};
      if (static_cast<std::ptrdiff_t>(parts.size()) < mains) part.source.length = 0;  // the comment goes with the last
    }
    for (const Instruction& instruction : clean.instructions) {
      if (isAddition(block, instruction)) parts.back().instructions.push_back(instruction);
    }
    return parts;
  }

  void statement(const Block& block, const Block& original) {
    if (block.instructions.empty()) {  // nothing but modal functions
      const std::string_view source = block.at(block.source);
      const std::size_t remark = source.find(';');
      if (remark != std::string_view::npos)
        line(std::string(trimmedAtEnd(source.substr(remark), lineBlanks)), Text::Remark);
      return;
    }
    const bool oldMachining = std::ranges::any_of(block.instructions, [&block](const Instruction& instruction) {
      const auto* cycle = std::get_if<language::CycleCall>(&instruction);
      return cycle != nullptr && block.at(cycle->name).starts_with('G');
    });
    if (!toDinIso_ && oldMachining) {
      leaveOut(original, "this form of a machining cycle is not translated into Klartext", "write the cycle anew");
      return;
    }
    if (!toDinIso_) {
      line(language::klartext::writeBlock(block), Text::Block);
      return;
    }
    const Result<std::string> written = language::din_iso::writeBlock(block);
    if (written) {
      line(*written, Text::Block);
      return;
    }
    leaveOut(original, written.error().message, written.error().advice);
  }

  void leaveOut(const Block& original, std::string message, std::string advice) {
    report(original, std::move(message), std::move(advice));
    forEachLine(original.at(original.source), [this](std::string_view rest) {
      line(fmt::format("; NOT CARRIED OVER: {}{}", trimmedAtEnd(rest, lineBlanks), toDinIso_ ? " *" : ""),
           Text::Remark);
    });
  }

  /// Appends the lines of a block with their numbers. Lines after a `~` have none; in remarks it means nothing.
  enum class Text { Block, Remark };
  void line(const std::string& text, Text what) {
    bool continued = false;
    forEachLine(text, [&](std::string_view one) {
      const std::string number = continued   ? std::string()
                                 : toDinIso_ ? fmt::format("N{} ", number_ += 10)
                                             : fmt::format("{} ", number_++);
      append(number + std::string(one));
      continued = what == Text::Block && language::klartext::endsWithContinuation(one);
    });
  }

  void append(const std::string& line) {
    result_.text += line + "\n";
    result_.origins.push_back(origin_);
  }

  HeidenhainProgram& program_;
  BlockPosition origin_;
  bool fromDinIso_;
  bool toDinIso_;
  ToolCycles toolCycles_;
  Conversion result_;
  language::din_iso::ModalState state_;
  Block resolved_;
  std::string head_;
  std::uint64_t number_ = 0;
};

}  // namespace

Conversion betweenDialects(HeidenhainProgram& program, language::ProgramLanguage from, language::ProgramLanguage to,
                           ToolCycles toolCycles) {
  using language::ProgramLanguage;
  return Converter(program, from == ProgramLanguage::DinIso, to == ProgramLanguage::DinIso, toolCycles).run();
}

}  // namespace probewright::conversion
