#include "language/klartext/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/number_text.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/probe_words.hpp"
#include "language/constant_division.hpp"
#include "language/klartext/block_extent.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/lexer.hpp"
#include "language/klartext/statement_notes.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::language::klartext {

namespace {

/// Parts of the old block form have words of their own in place of Q parameters.
constexpr std::uint32_t firstProbeWord = cycles::heidenhain::probe_word::result;

/// Q247 of the cycles that touch a circle.
constexpr std::uint32_t steppingAngle = 247;
constexpr double smallestStep = 5;  // degrees

/// Nominal positions and diameters of cycles 1410, 1411 and 1420, which may be texts such as "?30" and "10+0.02".
bool isDimension(std::uint32_t parameter) { return parameter >= 1100 && parameter <= 1117; }

/// Touch probe cycles that the controls have, whether Probewright runs them or not; 500 to 599 belong to machine tool
/// builders.
bool existsOnControls(int number) {
  constexpr std::pair<int, int> ranges[] = {{0, 4},     {9, 9},     {30, 33},   {400, 405}, {408, 427},  {430, 431},
                                            {440, 444}, {450, 463}, {480, 485}, {500, 601}, {1400, 1499}};
  return std::ranges::any_of(ranges, [&](const auto& r) { return number >= r.first && number <= r.second; });
}

class Checker {
public:
  Checker(HeidenhainProgram& program, control::ControlKind kind, ProgramLibrary* library, bool skips, bool foresees)
      : program_(program), kind_(kind), library_(library), notes_(kind), skips_(skips), foresees_(foresees) {}

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
    return number ? label : "\"" + label + "\"";
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

  /// A parameter that a cycle lacks and that is in the next block: the line in between does not end with ~.
  void nameMissingContinuation() {
    for (const auto& [mistake, parameter] : std::exchange(lacking_, {})) {
      for (const Instruction& instruction : block_.instructions) {
        const auto* assign = std::get_if<Assign>(&instruction);
        if (assign == nullptr || block_.variables[assign->variable].index[0].number != parameter) continue;
        found_[mistake].advice =
            fmt::format("it is in line {}, outside the cycle: end the line before it with ~", block_.position.line);
      }
    }
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
    // Labels lie in the block's own text.
    uses_.push_back({std::string(name), block_.position.line, label.offset + 1, lineText(0)});
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
    plainWay_ = false;
    if (mark.end) return;
    const std::string name(block_.at(mark.label));
    const auto [known, added] = labels_.emplace(name, block_.position.line);
    if (added) return;
    reportHere(fmt::format("label {} is defined twice, first in line {}", quoted(name), known->second),
               "give one of the two another number or name");
  }
  void look(const CallLabel& call) {
    plainWay_ = false;
    use(call.label);
  }
  void look(const Jump& jump) {
    plainWay_ = false;
    use(jump.label);
  }
  void look(const CallProgram& call) {
    plainWay_ = false;
    if (!call.nameValue.present()) called(call.name);
  }
  void look(const Command& command) {
    const CommandKind kind = kindOf(block_, command);
    if (kind == CommandKind::Error) {
      reportHere("the control marked this block as wrong", "correct the block and take ERROR = away");
    } else if (const bool selects = kind == CommandKind::SelectProgram || kind == CommandKind::SelectCycle;
               (selects && command.words.count == 0) || kind == CommandKind::ProgramCall) {
      called(command.text);
    }
  }
  void look(const CycleCall& call) {
    if (block_.at(call.name) == "TCH PROBE") measuringCycle(call);
  }
  template <class Other>
  void look(const Other&) {}

  const Node* nodeOf(const Word& word) const {
    return word.value.node >= 0 ? &block_.nodes[static_cast<std::size_t>(word.value.node)] : nullptr;
  }

  std::string nameOf(const cycles::Parameter& parameter) const {
    return fmt::format("{} ({})", parameter.name, parameter.meaning);
  }

  void measuringCycle(const CycleCall& call) {
    const cycles::CycleDefinition* cycle = cycles::heidenhainCycle(call.number);
    if (cycle == nullptr && !existsOnControls(call.number)) {
      reportHere(fmt::format("there is no touch probe cycle {}", call.number),
                 "check its number; list the available cycles with: probewright cycles");
      return;
    }
    if (cycle == nullptr) {
      reportHere(fmt::format("touch probe cycle {} is not available; its parameters are not checked", call.number),
                 "list the available cycles with: probewright cycles", Severity::Warning);
      return;
    }
    if (!cycle->controls.contains(kind_)) {
      reportHere(fmt::format("cycle {} does not exist on the {}", cycle->name, control::name(kind_)),
                 "use another cycle, or choose the other control");
      return;
    }
    const std::span<const Word> words =
        std::span<const Word>(block_.words).subspan(call.parameters.first, call.parameters.count);
    for (const Word& word : words)
      checkWord(*cycle, word);
    if (foresees_) {
      checkTogether(*cycle, words);
      checkState(*cycle);
    }
    for (const cycles::Parameter& parameter : cycle->parameters) {
      const bool needed = parameter.required() && parameter.controls.contains(kind_);
      if (!needed || std::ranges::find(words, parameter.address, &Word::address) != words.end()) continue;
      reportHere(fmt::format("cycle {} lacks {}", cycle->name, nameOf(parameter)),
                 fmt::format("add {} with its value", parameter.name));
      lacking_.emplace_back(found_.size() - 1, parameter.address);
    }
  }

  /// What a word says without the program running.
  std::optional<cycles::Argument> literal(const Word& word) const {
    cycles::Argument argument;
    argument.given = true;
    if (word.value.isLiteral()) {
      argument.number = word.value.number;
      return argument;
    }
    const Node* node = nodeOf(word);
    if (node == nullptr || node->operation != Operation::Text) return std::nullopt;
    argument.isText = true;
    argument.text = block_.at(node->text);
    return argument;
  }

  void checkTogether(const cycles::CycleDefinition& cycle, std::span<const Word> words) {
    const auto wordOf = [&](std::uint32_t address) { return std::ranges::find(words, address, &Word::address); };
    const cycles::heidenhain::KnownValue known = [&](std::uint32_t address) -> std::optional<cycles::Argument> {
      if (const auto word = wordOf(address); word != words.end()) return literal(*word);
      const cycles::Parameter* parameter = cycle.parameter(address);
      if (parameter == nullptr || !parameter->standard) return std::nullopt;
      cycles::Argument standard;
      standard.number = *parameter->standard;
      return standard;
    };
    for (cycles::heidenhain::CallMistake& mistake : cycles::heidenhain::callMistakes(cycle, kind_, known)) {
      const auto word = wordOf(mistake.parameter);
      if (word == words.end()) {
        reportHere(std::move(mistake.message), std::move(mistake.advice), mistake.severity);
      } else {
        reportAt(*word, std::move(mistake.message), std::move(mistake.advice), mistake.severity);
      }
    }
  }

  /// What the blocks before the cycle have left, as far as the way to it is plain.
  void checkState(const cycles::CycleDefinition& cycle) {
    if (!plainWay_) return;
    const auto& conditions = cycles::heidenhain::findEntry(cycle.number)->conditions;
    if (!toolCalled_ && conditions.uses != cycles::heidenhain::Uses::Nothing) {
      const bool ofTool = conditions.uses == cycles::heidenhain::Uses::ToolTouchProbe;
      reportHere("there is no TOOL CALL before this cycle",
                 fmt::format("call the {} first, unless it is in the spindle already or another program calls this one",
                             ofTool ? "tool to be measured" : "touch probe"),
                 Severity::Warning);
      toolCalled_ = true;
    }
    if (kind_ != control::ControlKind::TNC640) return;
    const auto forbidden = cycles::heidenhain::forbiddenTransformations(conditions);
    for (const auto& [number, active] : transforms_) {
      if (!active || !(number == 7 ? forbidden.shift : number == 10 ? forbidden.rotation : forbidden.other)) continue;
      reportHere(fmt::format("cycle {} is refused here: cycle {} is active", cycle.name, number),
                 fmt::format("end cycle {} before it", number), Severity::Warning);
    }
  }

  void look(const ToolCall& call) {
    if (call.number.present() || call.name.present()) toolCalled_ = true;
  }

  /// Cycles 7, 8, 10, 11 and 26: active, ended, or unknown because the program computes their values.
  void look(const Transform& transform) {
    int number = 0;
    switch (kindOf(block_, transform)) {
      case TransformKind::DatumShift:
        number = 7;
        break;
      case TransformKind::Mirror:
        number = 8;
        break;
      case TransformKind::Rotation:
        number = 10;
        break;
      case TransformKind::Scaling:
        number = 11;
        break;
      case TransformKind::AxisScaling:
        number = 26;
        break;
      case TransformKind::PresetByCycle:
        transforms_.clear();
        return;
      // TRANS changes what the cycle of the same name has set.
      case TransformKind::TransDatumAxis:
      case TransformKind::TransDatumTable:
      case TransformKind::TransDatumReset:
        transforms_.erase(7);
        return;
      case TransformKind::TransMirror:
      case TransformKind::TransMirrorReset:
        transforms_.erase(8);
        return;
      case TransformKind::TransRotation:
      case TransformKind::TransRotationReset:
        transforms_.erase(10);
        return;
      case TransformKind::TransScale:
      case TransformKind::TransScaleReset:
        transforms_.erase(11);
        transforms_.erase(26);
        return;
      case TransformKind::Tilting:
      case TransformKind::PlaneSpatial:
      case TransformKind::PlaneProjected:
      case TransformKind::PlaneEuler:
      case TransformKind::PlaneVector:
      case TransformKind::PlanePoints:
      case TransformKind::PlaneRelative:
      case TransformKind::PlaneAxial:
      case TransformKind::PlaneReset:
        return;
    }
    const std::span<const Word> words =
        std::span<const Word>(block_.words).subspan(transform.words.first, transform.words.count);
    if (number == 8) {
      transforms_[8] = !words.empty();
      return;
    }
    const double neutral = number == 7 || number == 10 ? 0 : 1;
    bool active = false;
    for (const Word& word : words) {
      const auto value = literal(word);
      const bool centre = number == 26 && word.address >= 256;
      if (centre) continue;
      if (!value || value->isText || word.mode == WordMode::Incremental || word.address == '#') {
        transforms_.erase(number);
        return;
      }
      active = active || value->number != neutral;
    }
    // Cycle 7 keeps the axes that it does not name.
    if (!active && number == 7 && words.size() < 3) {
      transforms_.erase(number);
    } else {
      transforms_[number] = active;
    }
  }

  void checkWord(const cycles::CycleDefinition& cycle, const Word& word) {
    const cycles::Parameter* parameter = cycle.parameter(word.address);
    if (parameter == nullptr) {
      if (word.address >= firstProbeWord) return;
      reportAt(word, fmt::format("cycle {} has no parameter Q{}", cycle.name, word.address),
               "take it out, or check the number of the cycle");
      return;
    }
    if (!parameter->controls.contains(kind_)) {
      reportAt(
          word,
          fmt::format("{} does not exist in cycle {} of the {}", nameOf(*parameter), cycle.name, control::name(kind_)),
          "take it out");
      return;
    }
    cycles::Argument argument;
    argument.given = true;
    if (word.value.isLiteral()) {
      argument.number = word.value.number;
    } else {
      const Node* node = nodeOf(word);
      if (node == nullptr) return;
      if (node->operation == Operation::Call && node->function == Function::Host && block_.at(node->text) == "PREDEF") {
        if (parameter->predefinable) return;
        reportAt(word, fmt::format("{} cannot be PREDEF", nameOf(*parameter)), "write its value");
        return;
      }
      if (node->operation != Operation::Text) return;  // computed while the program runs
      if (parameter->kind == cycles::ValueKind::Feed) return;
      argument.isText = true;
      argument.text = block_.at(node->text);
    }
    std::string text = cycles::complaint(*parameter, argument);
    if (text.empty() && parameter->address == steppingAngle && std::abs(argument.number) < smallestStep) {
      text = fmt::format("{} cannot be {}", nameOf(*parameter), formatShortest(argument.number));
    }
    if (text.empty() && argument.isText && isDimension(word.address)) {
      const auto dimension = metrology::parseDimension(argument.text);
      if (dimension) return;
      reportAt(word, fmt::format("{} = \"{}\": {}", nameOf(*parameter), argument.text, dimension.error().message),
               dimension.error().advice);
      return;
    }
    if (!text.empty()) reportAt(word, std::move(text), "correct the value");
  }

  HeidenhainProgram& program_;
  control::ControlKind kind_;
  ProgramLibrary* library_;
  StatementNotes notes_;
  std::vector<std::pair<std::size_t, std::uint32_t>> lacking_;  ///< messages and parameters of the last cycle
  Block block_;
  Diagnostics found_;
  std::map<std::string, std::uint64_t> labels_;
  std::vector<Use> uses_;
  std::string first_, last_;
  std::string name_;  ///< of the first block, if it can be read
  std::uint64_t lastLine_ = 0;
  std::map<int, bool> transforms_;  ///< by cycle; absent: unknown or never defined
  bool plainWay_ = true;            ///< no label, jump or call so far: every block above has run once
  bool toolCalled_ = false;
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
