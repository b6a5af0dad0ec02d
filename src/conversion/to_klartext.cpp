#include "conversion/to_klartext.hpp"

#include "conversion/parameter_texts.hpp"
#include "conversion/sinumerik_formulas.hpp"
#include "cycles/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace probewright::conversion {

using namespace language;

namespace {

std::string_view commentOf(std::string_view source) {
  bool inText = false;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source[i] == '"') inText = !inText;
    if (source[i] == ';' && !inText) return source.substr(i);
  }
  return {};
}

}  // namespace

ToKlartext::ToKlartext(language::sinumerik::SinumerikProgram& program, const GlobalData* globalData,
                       control::ControlKind control, const Job* job, const TouchProbe& probe)
    : program_(program),
      control_(control),
      job_(job == nullptr ? Job() : *job),
      out_(program.file()),
      formulas_(globalData),
      graph_(program),
      probe_(probe),
      lackingRows_(program, graph_, job_, selectedOffset) {
  if (job_.shares) formulas_.keepLocal();
}

std::string ToKlartext::axis(std::size_t index) const {
  static constexpr const char* names[] = {"X", "Y", "Z"};
  const std::size_t tool = toolAxis_ == 'X' ? 0 : toolAxis_ == 'Y' ? 1 : 2;
  return names[(tool + 1 + index) % 3];
}

std::optional<std::size_t> ToKlartext::planeIndex(std::uint32_t address) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (addressOf(axis(i)) == address) return i;
  return std::nullopt;
}

void ToKlartext::surveyJob(const Block& block, const Instruction& instruction) {
  const auto* modal = std::get_if<Modal>(&instruction);
  const auto* command = std::get_if<Command>(&instruction);
  feedsPerRevolution_ = feedsPerRevolution_ || (modal != nullptr && block.at(modal->name) == "G95");
  orientsSpindle_ = orientsSpindle_ || (command != nullptr && block.at(command->name) == "SPOS");
  const auto* transform = std::get_if<Transform>(&instruction);
  const bool shifts = transform != nullptr && block.at(transform->name).ends_with("TRANS");
  for (std::uint32_t i = 0; shifts && i < transform->words.count; ++i) {
    const std::string letter = addressName(block.words[transform->words.first + i].address);
    if (letter.size() == 1 && letter[0] >= 'X' && letter[0] <= 'Z')
      shiftsEver_[static_cast<std::size_t>(letter[0] - 'X')] = true;
  }
}

ToKlartext::SelectedUnit ToKlartext::unitOf(const Block& block, const Instruction& instruction) {
  const auto* modal = std::get_if<Modal>(&instruction);
  const std::string_view name = modal == nullptr ? std::string_view() : block.at(modal->name);
  if (name == "G70" || name == "G700") return SelectedUnit::Inch;
  if (name == "G71" || name == "G710") return SelectedUnit::Millimetre;
  return SelectedUnit::None;
}

void ToKlartext::survey() {
  usedResults_ = job_.results;
  bool moved = false;
  Block block;
  for (BlockPosition at = program_.begin(); program_.parse(at, block, result_.mistakes); at = block.next) {
    if (block.at(block.source).find(sharedParametersRemark) != std::string_view::npos) formulas_.knowSharedParameters();
    for (const VariableRef& variable : block.variables) {
      const std::string_view own = variable.space == VariableSpace::User ? block.at(variable.name) : std::string_view();
      measuresAsCycles_ = measuresAsCycles_ || own == "_MEAS_REST";
      if (KlartextFormulas::namesParameter(own)) formulas_.reserve(own.substr(1));
      const bool result = variable.space == VariableSpace::User && block.at(variable.name) == "_OVR";
      if (!result || !variable.index[0].isLiteral()) continue;
      usedResults_.insert(static_cast<int>(variable.index[0].number));
    }
    for (const Instruction& instruction : block.instructions) {
      const auto* function = std::get_if<MachineFunction>(&instruction);
      changesTool_ = changesTool_ || (function != nullptr && function->number == 6);
      surveyJob(block, instruction);
      moved = moved || std::holds_alternative<Move>(instruction) || std::holds_alternative<CallProgram>(instruction);
      units_.add(unitOf(block, instruction));
      if (unitOf(block, instruction) == SelectedUnit::Inch) movesBeforeUnit_ = movesBeforeUnit_ || moved;
    }
  }
  Diagnostics ignored;
  Units ofOthers;
  for (const auto& other : job_.others) {
    Units& units = unitsOf_[upperCase(other->name())];
    for (BlockPosition at = other->begin(); other->parse(at, block, ignored); at = block.next) {
      for (const Instruction& instruction : block.instructions) {
        surveyJob(block, instruction);
        units.add(unitOf(block, instruction));
        ofOthers.add(unitOf(block, instruction));
      }
    }
  }
  // A subprogram that selects no unit counts in that of its callers.
  const bool inherits = job_.called && !units_.inch && !units_.metric;
  unitDoubtful_ = inherits && ofOthers.inch && ofOthers.metric;
  answersInOtherUnit_ = job_.called && !inherits && (units_.inch ? ofOthers.metric : ofOthers.inch);
  if (units_.inch || (inherits && ofOthers.inch && !ofOthers.metric)) millimetre_ = 1 / millimetresOfInch;
}

Conversion ToKlartext::run() {
  survey();
  if (hasErrors(result_.mistakes)) return std::move(result_);
  surveyFlow();
  surveyModes();
  surveyPlaces();
  fromBeyondATurn_ = positionsFromBeyondATurn(program_, graph_, job_);
  if (millimetre_ != 1) formulas_.countInches();
  rounded_.emplace(program_, job_);
  Diagnostics ignored;
  Block block;
  for (BlockPosition at = program_.begin(); program_.parse(at, block, ignored); at = block.next)
    write(block);
  if (!endLabel_.empty()) label(endLabel_);
  for (const std::string& each : givenBack_)
    out_.line(each);
  out_.insert(0, formulas_.globalValues());
  if (sectionsByNumber_) out_.insert(0, {fmt::format("{} = 0", formulas_.define("section under way"))});
  result_.text = numbered();
  result_.notCarriedOver = std::move(out_.listed());
  return std::move(result_);
}

std::string ToKlartext::numbered() const {
  const std::string frame = fmt::format("PGM {} {}", program_.name(), millimetre_ == 1 ? "MM" : "INCH");
  std::string text = fmt::format("0 BEGIN {}\n", frame);
  int number = 1;
  bool continued = false;
  for (const std::string& line : out_.lines()) {
    text += continued ? fmt::format("{}\n", line) : fmt::format("{} {}\n", number++, line);
    continued = line.ends_with('~');
  }
  return text + fmt::format("{} END {}\n", number, frame);
}

void ToKlartext::line(std::string text) { writeWhole({std::move(text)}); }

void ToKlartext::writeWhole(std::vector<std::string> lines) {
  for (std::string& each : formulas_.takePrelude())
    out_.line(std::move(each));
  for (std::string& each : lines)
    out_.line(std::move(each));
}

void ToKlartext::listPositionsRead(const Block& block) {
  const auto isElsewhere = [&](const VariableRef& variable) {
    const std::string_view name = block.at(variable.name);
    if (name != "$AA_IW" && name != "$AA_IM" && name != "$P_EP") return false;
    if (besideMeasured_) return !measuresAsCycles_;
    const Operand& index = variable.index[0];
    const bool isNamed =
        index.node >= 0 && block.nodes[static_cast<std::size_t>(index.node)].operation == Operation::Text;
    const auto which = isNamed ? planeIndex(addressOf(block.at(block.nodes[static_cast<std::size_t>(index.node)].text)))
                               : std::nullopt;
    return which ? beside_.at(*which) : std::ranges::find(beside_, true) != beside_.end();
  };
  // What conversions write themselves: up to a height, never down.
  const bool isUp = block.at(block.source).find("=MAXVAL($AA_IW[") != std::string_view::npos;
  if (isUp || !std::ranges::any_of(block.variables, isElsewhere)) return;
  out_.list(block, "the position is where the measuring cycle has left the probe, which is elsewhere here",
            "move to the place in all three axes before reading it");
}

void ToKlartext::write(const Block& block) {
  const std::string_view source = block.at(block.source);
  const std::string_view remark = trimmed(commentOf(source), lineBlanks);
  if (trimmed(source, lineBlanks).starts_with('%')) return;
  if (const auto found = labels_.find(block.position.offset); found != labels_.end()) label(found->second);
  adopt(block);
  const std::size_t before = out_.size();
  const Frame frame = frame_;
  if (block.skippable && block.skipLevel != 0 && skipLevels_.insert(block.skipLevel).second) {
    out_.list(block,
              fmt::format("block skip /{}: a HEIDENHAIN control has one switch for all blocks with /", block.skipLevel),
              "use / alone");
  }
  listPositionsRead(block);
  try {
    statements(block);
    if (block.instructions.empty() && remark.empty()) {
      if (trimmed(source, lineBlanks).empty()) line(";");
    } else if (!remark.empty()) {
      const bool fits = out_.size() == before + 1 && !out_.at(before).starts_with(';');
      if (fits) {
        out_.at(before) += fmt::format(" {}", remark);
      } else {
        out_.insert(before, {std::string(remark)});
      }
    }
    for (std::size_t i = before; block.skippable && i < out_.size(); ++i)
      if (i == before || !out_.at(i - 1).ends_with('~')) out_.at(i) = fmt::format("/{}", out_.at(i));
  } catch (const NotCarriedOver& reason) {
    out_.shorten(before);
    formulas_.takePrelude();
    forgetPosition();  // it may have been read in what is dropped
    frame_ = frame;
    out_.keepAsComment(block, reason.what(), reason.advice());
  }
  endSections(block);
}

void ToKlartext::statements(const Block& block) {
  if (unitDoubtful_ && !block.instructions.empty()) {
    unitDoubtful_ = false;
    out_.list(block, "this program selects no unit, and others of its job select both: what is written counts in mm",
              "begin the program with G71 or G70");
  }
  listCompensation(block);
  // A tool change is in one block with its M6; suppression of the tool length belongs to a motion on the machine.
  for (const Instruction& each : block.instructions)
    instruction(block, each);
}

void ToKlartext::instruction(const Block& block, const Instruction& instruction) {
  if (const auto* assigned = std::get_if<Assign>(&instruction)) {
    assign(block, *assigned);
  } else if (const auto* each = std::get_if<Jump>(&instruction)) {
    jump(block, *each);
  } else if (const auto* section = std::get_if<RepeatSection>(&instruction)) {
    repeat(block, *section);
  } else if (const auto* called = std::get_if<CallProgram>(&instruction)) {
    call(block, *called);
  } else if (const auto* structure = std::get_if<Structured>(&instruction)) {
    structured(block, *structure);
  } else if (std::holds_alternative<EndProgram>(instruction)) {
    line("M30");
  } else if (const auto* order = std::get_if<Return>(&instruction)) {
    if (order->target.present() || order->levels.present()) {
      throw NotCarriedOver("RET with a destination or a number of levels has no twin in Klartext",
                           "leave the subprogram with a Q parameter that the caller compares");
    }
    if (program_.parse(block.next, *std::make_unique<Block>(), result_.mistakes)) returnEarly();
  } else if (const auto* stop = std::get_if<Stop>(&instruction)) {
    line(stop->optional ? "M1" : "STOP");
  } else if (const auto* travel = std::get_if<Move>(&instruction)) {
    move(block, *travel);
  } else if (const auto* tool = std::get_if<ToolCall>(&instruction)) {
    toolCall(block, *tool);
  } else if (const auto* function = std::get_if<Modal>(&instruction)) {
    modal(block, *function);
  } else if (const auto* auxiliary = std::get_if<MachineFunction>(&instruction)) {
    machineFunction(block, *auxiliary);
  } else if (const auto* change = std::get_if<Transform>(&instruction)) {
    transform(block, *change);
  } else if (const auto* other = std::get_if<Command>(&instruction)) {
    command(block, *other);
  } else {
    throw NotCarriedOver("this block has no twin in Klartext", "write it by hand");
  }
}

/// A jump to the end of the program, where what was called returns.
void ToKlartext::returnEarly() {
  if (!sectionEnds_.empty()) {
    throw NotCarriedOver("a return in a program with repeated sections has no twin in Klartext",
                         "jump to the end of the program");
  }
  if (endLabel_.empty()) endLabel_ = unusedLabel("RETURN");
  goTo(endLabel_);
}

void ToKlartext::toolCall(const Block& block, const ToolCall& call) {
  pendingTool_ =
      call.name.present() ? formulas_.formula(block, call.name) : formulas_.unsignedValue(quantity(block, call.number));
  hasTool_ = isTool(block, call);
  if (!changesTool_) changeTool();
}

void ToKlartext::changeTool() {
  if (pendingTool_.empty()) return;
  if (axisDoubtful_)
    throw NotCarriedOver("the tool axis depends on the path that leads to this block",
                         "program G17, G18 or G19 before it");
  line(fmt::format("TOOL CALL {} {}", pendingTool_, toolAxis_));
  withoutLength_ = measuredWithTool_ = false;
  tool_ = std::exchange(pendingTool_, {});
  forgetPosition();
}

void ToKlartext::modal(const Block& block, const Modal& modal) {
  const std::string_view name = block.at(modal.name);
  const auto words = std::span<const Word>(block.words).subspan(modal.words.first, modal.words.count);
  if (const auto settable = settableOf(name)) {
    if (*settable == 0) throw NotCarriedOver("G500 cancels all settable zero offsets; a preset is always in effect");
    const int row = *settable == 99 ? 0 : *settable;
    activeRow_ = *settable;
    selectedRows_.insert(*settable);
    forgetPosition();
    if (row == 0 && std::exchange(copiesToRow0_, false)) return;
    // On the iTNC 530 row 0 is the preset set by hand; the active one stays selected.
    if (row == 0 && hasRowZero_ && control_ == control::ControlKind::iTNC530) return;
    // Cycle 247 takes the frames of the program back, which stay on a SINUMERIK.
    readFrame();
    if (!frame_.rotation) {
      throw NotCarriedOver(
          "cycle 247 cancels a rotation, and which one is in effect is known only when the program runs",
          "program ROT before this block");
    }
    writeWhole({fmt::format("CYCL DEF 247 {} ~", cycleTitle(247, control_)),
                fmt::format("    Q339=+{} ;{}", row, parameterText(247, 339, control_))});
    restoreFrame();
    return;
  }
  if (const SelectedUnit unit = unitOf(block, modal); unit != SelectedUnit::None)
    selectsMetric_ = unit == SelectedUnit::Millimetre;
  if ((name == "G71" || name == "G710") && millimetre_ != 1) {
    throw NotCarriedOver("this program counts in inches as well, and a HEIDENHAIN program has one unit",
                         "measure in one unit throughout");
  }
  if (name == "G70") {
    out_.list(block, "G70 leaves feeds and system variables in millimetres; in an INCH program they are inches",
              "use G700, or convert the feeds by hand");
  }
  if ((name == "G70" || name == "G700") && std::exchange(movesBeforeUnit_, false)) {
    out_.list(block, "what moves above this block counts as the control begins, in an INCH program in inches",
              "select inches at the beginning of the program");
  }
  if (unitOf(block, modal) != SelectedUnit::None || leavesOut(block, name)) return;
  if (name == "G90" || name == "G91") {
    incremental_ = name == "G91";
    incrementalDoubtful_ = false;
  } else if (name == "G17" || name == "G18" || name == "G19") {
    const char before = std::exchange(toolAxis_, name == "G17" ? 'Z' : name == "G18" ? 'Y' : 'X');
    const bool changes = toolAxis_ != before || std::exchange(axisDoubtful_, false);
    if (changes && !tool_.empty()) line(fmt::format("TOOL CALL {} {}", tool_, toolAxis_));
    forgetPosition();
  } else if (name == "G0" || name == "G1" || name == "G2" || name == "G3") {
    motionDoubtful_ = false;
    motion_ = name == "G0"   ? MoveKind::Rapid
              : name == "G1" ? MoveKind::Linear
              : name == "G2" ? MoveKind::ArcClockwise
                             : MoveKind::ArcCounterclockwise;
  } else if (name == "G40" || name == "G41" || name == "G42") {
    compensationDoubtful_ = false;
    compensation_ = name == "G40" ? "R0" : name == "G41" ? "RL" : "RR";
  } else if (name == "G95") {
    feedOfOtherKind_ = feedOfOtherKind_ || !std::exchange(perRevolution_, true);
    line("M136");
  } else if (name == "G94") {
    feedOfOtherKind_ = feedOfOtherKind_ || std::exchange(perRevolution_, false);
    if (feedsPerRevolution_) line("M137");
  } else if (name == "TRAORI") {
    line("M128");
  } else if (name == "TRAFOOF") {
    line("M129");
  } else if (name == "F" && words.size() == 1) {
    feedOfOtherKind_ = false;
    line(fmt::format("L {}{}", compensation_, feedWord(block, words[0].value)));
  } else if (name == "S" && words.size() == 1 && addressName(words[0].address) == "S") {
    line(fmt::format("TOOL CALL S{}", formulas_.unsignedValue(quantity(block, words[0].value))));
  } else if (name == "D" && words.size() == 1) {
    const Quantity edge = quantity(block, words[0].value);
    withoutLength_ = edge.isNumber() ? std::optional(edge == 0) : std::nullopt;
    if (!(edge == 0) && hasTool_ != std::optional(true)) {
      out_.listOnce(block,
                    "D: a SINUMERIK stops here (alarm 17180) if no tool is in the spindle, the program that is written "
                    "goes on",
                    "call the tool before its edge", Severity::Note);
    }
    if (!(edge == 1 || edge == 0)) out_.lose(block, fmt::format("D{}", sinumerikText(edge)));
  } else {
    throw NotCarriedOver(fmt::format("{} has no twin in Klartext", name), "write it by hand");
  }
}

void ToKlartext::machineFunction(const Block& block, const MachineFunction& function) {
  if (function.argument.present() || function.number < 0) {
    throw NotCarriedOver("M functions of further spindles have no twin in Klartext");
  }
  switch (function.number) {
    case 6:
      return changeTool();
    case 3:
    case 4:
    case 5:
    case 7:
    case 8:
    case 9:
      return line(fmt::format("M{}", function.number));
    case 19:
      if (orientsSpindle_) {
        out_.list(
            block,
            "M19 orients the spindle to the angle of the setting data, on a HEIDENHAIN control to that of the last "
            "cycle 13",
            "write the angle with SPOS");
      }
      return line("M19");
    default:
      throw NotCarriedOver(fmt::format("M{} means something else on a HEIDENHAIN control, or nothing", function.number),
                           "see the machine's own list of M functions");
  }
}

void ToKlartext::blank(const Block& block, const Command& command) {
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  const auto number = [&](std::uint32_t place) {
    const auto found = std::ranges::find(words, place, &Word::address);
    if (found == words.end() || !found->value.isLiteral()) throw NotCarriedOver("this blank has no twin in Klartext");
    return formulas_.value(found->value.number);
  };
  const bool box = block.at(block.source).find("\"BOX\"") != std::string_view::npos && number(4) == "+112";
  if (!box) throw NotCarriedOver("this blank has no twin in Klartext", "it is a picture only");
  line(fmt::format("BLK FORM 0.1 Z X{} Y{} Z{}", number(8), number(9), number(6)));
  line(fmt::format("BLK FORM 0.2 X{} Y{} Z{}", number(10), number(11), number(5)));
}

void ToKlartext::orientSpindle(const Block& block, std::span<const Word> words) {
  if (words.size() > 1) {
    throw NotCarriedOver("SPOS of a spindle by its number has no twin in Klartext",
                         "write SPOS= where the spindle with the tool is meant");
  }
  if (words[0].mode == WordMode::Incremental)
    throw NotCarriedOver("SPOS=IC() turns on from where the spindle stands, cycle 13 takes absolute angles",
                         "write the angle itself");
  Quantity angle = quantity(block, words[0].value);
  // Cycle 13 takes angles from 0 to 360 degrees.
  constexpr double turn = 360;
  if (!angle.isNumber()) {
    const std::string own = formulas_.define("angle of the spindle");
    line(fmt::format("{} = {}", own, spacedExpressionText(angle)));
    line(fmt::format("{0} = {0} - {1} * INT ({0} / {1})", own, turn));
    line(fmt::format("{0} = {0} + {1} * INT ((1 - SGN {0}) / 2)", own, turn));
    angle = Quantity::of(own);
  } else if (angle.number() < 0 || angle.number() > turn) {
    angle = angle.number() - turn * std::floor(angle.number() / turn);
  }
  writeWhole({"CYCL DEF 13.0 ORIENTATION", fmt::format("CYCL DEF 13.1 ANGLE {}", formulas_.value(angle)), "M19"});
}

void ToKlartext::command(const Block& block, const Command& command) {
  const std::string_view name = block.at(command.name);
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  if (name == "DEF") return define(block, command);
  if (name == "MSG") {
    if (words.empty()) return;
    return line(fmt::format("; MSG: {}", formulas_.formula(block, words[0].value)));
  }
  if (name == "SETAL" && !words.empty() && words[0].value.isLiteral()) {
    const int number = static_cast<int>(words[0].value.number);
    const bool goesOn = (number >= 62000 && number < 64000) || number >= 67000;
    if (goesOn) {
      throw NotCarriedOver(fmt::format("SETAL({}) is shown and the program goes on; FN 14 stops it", number),
                           "write a comment or FN 16");
    }
    return line(fmt::format("FN 14: ERROR = {}", number >= 65000 ? number - 64000 : number));
  }
  if (leavesOut(block, name)) return;
  if (name == "WORKPIECE") return blank(block, command);
  if (name == "MEAS") return measuringBlock(block, command);
  if (name == "STOPRE") return line("FN 20: WAIT FOR SYNC");
  if (name == "G4" && !words.empty() && words[0].address == 'F') {
    return writeWhole({"CYCL DEF 9.0 DWELL TIME",
                       fmt::format("CYCL DEF 9.1 DWELL {}", formulas_.unsignedValue(quantity(block, words[0].value)))});
  }
  if (name == "SPOS" && !words.empty()) return orientSpindle(block, words);
  // What a preset is set to acts at once.
  if (name == "G" && trimmed(block.at(block.source), lineBlanks) == selectedAgain) return;
  if (name == "PROC") {
    const std::string_view header = block.at(command.text);
    takeArguments();
    const std::string attributes = fmt::format("{} ", header);
    if (attributes.find(" SAVE ") != std::string::npos) {
      out_.list(block, "SAVE gives the G functions and frames of the caller back at the return, Klartext does not",
                "program what is to be in effect after each call");
    }
    return;
  }
  throw NotCarriedOver(fmt::format("{} has no twin in Klartext", name), "write it by hand");
}

Conversion toKlartext(language::sinumerik::SinumerikProgram& program, const GlobalData* globalData,
                      control::ControlKind control, const Job* job, const TouchProbe& probe) {
  return ToKlartext(program, globalData, control, job, probe).run();
}

}  // namespace probewright::conversion
