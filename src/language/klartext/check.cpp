#include "language/klartext/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "base/number_text.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/probe_words.hpp"
#include "language/constant_division.hpp"
#include "language/klartext/block_extent.hpp"
#include "language/klartext/call_check.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/lexer.hpp"
#include "language/klartext/statement_notes.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::language::klartext {

namespace {

class Checker {
public:
  Checker(HeidenhainProgram& program, control::ControlKind kind, ProgramLibrary* library, bool skips, bool foresees)
      : program_(program),
        library_(library),
        notes_(kind),
        calls_(kind, foresees),
        skips_(skips),
        foresees_(foresees) {}

  Diagnostics run() {
    BlockPosition position = program_.begin();
    std::size_t known = 0;  // mistakes in blocks before this one
    while (known = found_.size(), program_.parse(position, block_, found_)) {
      if (skips_ && block_.skippable) {
        found_.resize(known);
        position = block_.next;
        continue;
      }
      nameMissingContinuation();
      if (endsOpen(block_.at(block_.source))) nameOpenEnd();
      for (const Instruction& instruction : block_.instructions)
        std::visit([this](const auto& i) { look(i); }, instruction);
      if (std::optional<ModalMistake> mistake = program_.modalMistake(block_))
        reportAt(mistake->word, std::move(mistake->message), std::move(mistake->advice));
      for (StatementNotes::Note& note : notes_.of(block_))
        reportHere(std::move(note.message), std::move(note.advice), note.severity);
      if (foresees_ && dividesByZero(block_)) {
        reportHere("this divides by 0: the run stops at this block", "correct the divisor", Severity::Warning);
      }
      frame();
      position = block_.next;
    }
    const FrameWords& words = program_.frameWords();
    if (!begun_ && anyBlock_) {
      report(1, 1, fmt::format("the program does not begin with {}", words.begin),
             fmt::format("write {} as its first block", words.beginBlock), first_);
    }
    if (!ended_ && anyBlock_) {
      report(lastLine_, 1, fmt::format("the program does not end with {}", words.end),
             fmt::format("write {} as its last block", words.endBlock), last_);
    }
    for (const Use& use : uses_) {
      if (labels_.contains(use.label)) continue;
      found_.push_back({Severity::Error,
                        {program_.file(), use.line, use.column},
                        fmt::format("there is no label {} in this program", use.label),
                        use.excerpt,
                        fmt::format("define it with {}{} or correct the name", words.label, quoted(use.label)),
                        {}});
    }
    std::ranges::stable_sort(found_, {}, [](const Diagnostic& d) { return d.place.line; });
    return std::move(found_);
  }

private:
  struct Use {
    std::string label;
    std::uint64_t line = 0;
    std::uint32_t column = 0;
    std::string excerpt;
  };

  static std::string quoted(const std::string& label) {
    const bool number = std::ranges::all_of(label, isDigit);
    return number || label.starts_with('"') ? label : "\"" + label + "\"";
  }

  std::string lineText(std::uint32_t below) const {
    std::string_view text = block_.at(block_.source);
    for (; below > 0; --below)
      text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    text = text.substr(0, text.find('\n'));
    text = trimmedAtEnd(text, blanksAndReturn);
    return std::string(text);
  }

  void report(std::uint64_t line, std::uint32_t column, std::string message, std::string advice, std::string excerpt,
              Severity severity = Severity::Error) {
    found_.push_back(
        {severity, {program_.file(), line, column}, std::move(message), std::move(excerpt), std::move(advice), {}});
  }

  void reportHere(std::string message, std::string advice, Severity severity = Severity::Error) {
    report(block_.position.line, columnOf(withoutBlockNumber(block_.at(block_.source))), std::move(message),
           std::move(advice), lineText(0), severity);
  }

  /// A parameter that a cycle lacks and that is in the next block, whether that can be read or not: the line in between
  /// does not end with ~.
  void nameMissingContinuation() {
    if (lacking_.empty()) return;
    std::istringstream lines{std::string(block_.at(block_.source))};
    std::uint64_t number = block_.position.line;
    for (std::string line; std::getline(lines, line); ++number) {
      for (const auto& [mistake, parameter] : lacking_) {
        const std::string_view text = withoutBlockNumber(line);
        const std::string name = fmt::format("Q{}", parameter);
        if (!text.starts_with(name)) continue;
        const std::size_t sign = text.find_first_not_of(" \t", name.size());
        if (sign == std::string_view::npos || text[sign] != '=') continue;
        found_[mistake].advice = fmt::format(
            "it is in line {}, outside the cycle: end {} with ~", number,
            number == block_.position.line ? "the line before it" : fmt::format("line {}", block_.position.line - 1));
      }
    }
    lacking_.clear();
  }

  void nameOpenEnd() {
    const std::string_view text = block_.at(block_.source);
    const auto below = static_cast<std::uint32_t>(std::ranges::count(text, '\n'));
    const std::string line = lineText(below);
    report(block_.position.line + below, static_cast<std::uint32_t>(line.size()),
           "this line ends with ~, but nothing of the block follows", "take the ~ away, or add what is missing", line);
  }

  void reportAt(const Word& word, std::string message, std::string advice, Severity severity = Severity::Error) {
    report(block_.position.line + word.line, word.column, std::move(message), std::move(advice), lineText(word.line),
           severity);
  }

  std::uint32_t columnOf(std::string_view part) const {
    return static_cast<std::uint32_t>(part.data() - block_.at(block_.source).data()) + 1;
  }

  /// The beginning first, the end last.
  void frame() {
    const FramePart part = program_.framePart(block_);
    if (part == FramePart::Nothing) return;
    if (!anyBlock_) first_ = lineText(0);
    last_ = lineText(0);
    lastLine_ = block_.position.line;
    if (part == FramePart::Begin && anyBlock_) {
      reportHere(fmt::format("{} is in the middle of the program", program_.frameWords().begin),
                 "a file holds one program; write the other to its own file");
    }
    if (part == FramePart::Begin && !begun_ && !block_.instructions.empty()) name_ = nameInFrame();
    if (part == FramePart::Begin) begun_ = true;
    if (const std::string name = nameInFrame();
        part == FramePart::End && foresees_ && !name.empty() && !name_.empty() && name != name_) {
      reportHere(fmt::format("the program begins as {} and ends as {}", name_, name),
                 "write the same name and unit in both blocks", Severity::Warning);
    }
    if (ended_ && !behindReported_) {
      behindReported_ = true;
      const std::string_view end = program_.frameWords().end;
      reportHere(fmt::format("this block comes after {} and is never reached", end),
                 fmt::format("move it before {}", end), Severity::Warning);
    }
    if (part == FramePart::End) ended_ = true;
    anyBlock_ = true;
  }

  /// "PART MM" of BEGIN PGM PART MM, END PGM PART MM, %PART G71 *; in capitals, without comment.
  std::string nameInFrame() const {
    std::string_view text = withoutBlockNumber(block_.at(block_.source));
    text = text.substr(0, text.find(';'));
    if (const std::size_t sign = text.find('%'); sign != std::string_view::npos) text.remove_prefix(sign);
    std::vector<std::string> words(1);
    for (const char c : text) {
      if (isBlankOrReturn(c) || c == '\n' || c == '*') {
        if (!words.back().empty()) words.emplace_back();
      } else if (c != '%') {
        words.back() += upper(c);
      }
    }
    std::string name;
    for (const std::string& word : words) {
      const bool frame = word == "BEGIN" || word == "END" || word == "PGM";
      if (!word.empty() && !(frame && name.empty())) name += (name.empty() ? "" : " ") + word;
    }
    return name;
  }

  void use(TextRef label) {
    if (label.length == 0) return;
    const std::string_view name = block_.at(label);
    if (name == "0") {
      reportHere("label 0 ends subprograms and cannot be called", "call the label of a subprogram");
      return;
    }
    // Labels lie in the block's own text, but for names of digits in typographic quotation marks.
    const std::uint32_t column = label.offset < block_.source.length ? label.offset + 1 : 1;
    uses_.push_back({std::string(name), block_.position.line, column, lineText(0)});
  }

  /// A program that is called or selected by its name.
  void called(TextRef name) {
    const std::string_view path = block_.at(name);
    if (library_ == nullptr || path.empty() || library_->exists(path, &program_)) return;
    // Names lie in the block's own text.
    const std::string_view source = block_.at(block_.source);
    const std::string_view before = source.substr(0, std::min(source.find(path), source.size()));
    const auto below = static_cast<std::uint32_t>(std::ranges::count(before, '\n'));
    const std::size_t column = before.size() - (below == 0 ? 0 : before.rfind('\n') + 1);
    report(block_.position.line + below, static_cast<std::uint32_t>(column) + 1,
           fmt::format("there is no program {}", path), "put it beside this program, or check how its name is written",
           lineText(below), Severity::Warning);
  }

  void look(const LabelMark& mark) {
    calls_.wayBranches();
    if (mark.end) return;
    const std::string name(block_.at(mark.label));
    const auto [known, added] = labels_.emplace(name, block_.position.line);
    if (added) return;
    reportHere(fmt::format("label {} is defined twice, first in line {}", quoted(name), known->second),
               "give one of the two another number or name");
  }
  void look(const CallLabel& call) {
    calls_.wayBranches();
    use(call.label);
  }
  void look(const Jump& jump) {
    calls_.wayBranches();
    use(jump.label);
  }
  void look(const CallProgram& call) {
    calls_.wayBranches();
    if (!call.nameValue.present()) called(call.name);
  }
  void look(const Command& command) {
    calls_.follow(block_, command);
    const CommandKind kind = kindOf(block_, command);
    if (kind == CommandKind::Error) {
      reportHere("the control marked this block as wrong", "correct the block and take ERROR = away");
    } else if (const bool selects = kind == CommandKind::SelectProgram || kind == CommandKind::SelectCycle;
               (selects && command.words.count == 0) || kind == CommandKind::ProgramCall) {
      called(command.text);
    }
  }
  void look(const CycleCall& call) {
    if (block_.at(call.name) != "TCH PROBE") return;
    for (CallCheck::Remark& remark : calls_.of(block_, call)) {
      if (remark.word != nullptr) {
        reportAt(*remark.word, std::move(remark.message), std::move(remark.advice), remark.severity);
      } else {
        reportHere(std::move(remark.message), std::move(remark.advice), remark.severity);
      }
      if (remark.lacking) lacking_.emplace_back(found_.size() - 1, *remark.lacking);
    }
  }
  void look(const ToolCall& call) { calls_.follow(call); }
  void look(const Transform& transform) { calls_.follow(block_, transform); }
  template <class Other>
  void look(const Other&) {}

  HeidenhainProgram& program_;
  ProgramLibrary* library_;
  StatementNotes notes_;
  CallCheck calls_;
  std::vector<std::pair<std::size_t, std::uint32_t>> lacking_;  ///< messages and parameters of the last cycle
  Block block_;
  Diagnostics found_;
  std::map<std::string, std::uint64_t> labels_;
  std::vector<Use> uses_;
  std::string first_, last_;
  std::string name_;  ///< of the first block, if it can be read
  std::uint64_t lastLine_ = 0;
  bool anyBlock_ = false;
  bool begun_ = false;
  bool ended_ = false;
  bool behindReported_ = false;
  bool skips_ = false;
  bool foresees_ = true;
};

}  // namespace

Diagnostics checkProgram(HeidenhainProgram& program, control::ControlKind kind, ProgramLibrary* library, bool skips,
                         bool foresees) {
  return Checker(program, kind, library, skips, foresees).run();
}

}  // namespace probewright::language::klartext
