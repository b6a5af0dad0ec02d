#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "conversion/to_sinumerik.hpp"
#include "cycles/catalogue.hpp"
#include "language/program_language.hpp"
#include "language/sinumerik/check.hpp"

/// Labels, jumps, subprograms and calls of HEIDENHAIN programs in the language of a SINUMERIK.
namespace probewright::conversion {

using namespace language;

namespace {

constexpr int deepestCall = 21;  ///< levels: no subprogram, and the 20 that may be nested

/// Letters, digits and underscores of the text; everything else becomes an underscore.
std::string identifierFrom(std::string_view text) {
  std::string name = upperCase(text);
  for (char& c : name)
    if (!isLetter(c) && !isDigit(c)) c = '_';
  return name;
}

std::string withoutEnding(std::string_view path) {
  path = trimmed(path, lineBlanks);
  if (const std::size_t slash = path.find_last_of("/\\:"); slash != std::string_view::npos)
    path.remove_prefix(slash + 1);
  return std::string(path.substr(0, path.rfind('.')));
}

}  // namespace

std::string ToSinumerik::labelName(std::string_view label) {
  const auto found = labelNames_.find(label);
  if (found != labelNames_.end()) return found->second;
  std::string name = fmt::format("LBL_{}", identifierFrom(label).substr(0, 20));
  const auto taken = [&] {
    return std::ranges::any_of(labelNames_, [&](const auto& entry) {
      return entry.second == name || entry.second == name + "_END" || name == entry.second + "_END";
    });
  };
  while (taken())
    name += '_';
  labelNames_.emplace(label, name);
  return name;
}

void ToSinumerik::jump(const Block& block, const Jump& jump) {
  if (jump.label.length == 0) throw NotCarriedOver("a computed label has no twin on a SINUMERIK");
  const std::string target = labelName(block.at(jump.label));
  if (!jump.condition.present()) return out_.line(fmt::format("GOTO {}", target));
  out_.line(fmt::format("IF {} GOTO {}", formulas_.formula(block, jump.condition), target));
}

void ToSinumerik::surveyFlow() {
  if (graph_.subprogramsAreStretches()) return;
  // The program keeps where its subprograms return to, and counts its repetitions, one set of counts a subprogram.
  std::size_t parts = 0;
  const std::vector<FlowBlock>& blocks = graph_.blocks();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!blocks[i].called.empty()) returnsOf_.emplace(blocks[i].position.offset, returnsOf_.size() + 1);
    if (!blocks[i].parts.empty()) countsOf_.emplace(blocks[i].position.offset, parts++);
  }
  keepsStack_ = true;
  callStack_ = {fmt::format("DEF INT _LBL_DEPTH, _LBL_BACK[{}]", deepestCall)};
  if (parts > 0) callStack_.push_back(fmt::format("DEF REAL _LBL_REP[{},{}]", parts, deepestCall));
}

void ToSinumerik::mark(const Block& block, const LabelMark& mark) {
  forgetPosition();
  if (!oneCentre_) centre_ = {};
  lastMove_ = 0;
  if (mark.end) {
    if (keepsStack_) return goBack();
    for (const std::string& label : openLabels_)
      if (calledLabels_.contains(label)) out_.line(fmt::format("{}_END:", labelName(label)));
    openLabels_.clear();
    return;
  }
  openLabels_.emplace_back(block.at(mark.label));
  out_.line(labelName(block.at(mark.label)) + ":");
}

void ToSinumerik::goBack() {
  if (returnsOf_.empty()) return;
  out_.line("IF _LBL_DEPTH>0");
  out_.line("  _LBL_DEPTH=_LBL_DEPTH-1");
  for (std::size_t i = 1; i <= returnsOf_.size(); ++i)
    out_.line(fmt::format("  IF _LBL_BACK[_LBL_DEPTH]=={0} GOTO LBLBACK_{0}", i));
  out_.line("ENDIF");
}

void ToSinumerik::callLabel(const Block& block, const CallLabel& call) {
  if (call.label.length == 0) throw NotCarriedOver("a computed label has no twin on a SINUMERIK");
  const std::string name = labelName(block.at(call.label));
  const auto count = countsOf_.find(block.position.offset);
  const auto way = returnsOf_.find(block.position.offset);
  if (call.repeats.present() && count != countsOf_.end()) {
    const std::string text = fmt::format("_LBL_REP[{},_LBL_DEPTH]", count->second);
    out_.line(fmt::format("IF {}==0", text));
    out_.line(fmt::format("  {}={}", text, sinumerikText(quantity(block, call.repeats) + 1)));
    out_.line("ENDIF");
    out_.line(fmt::format("{0}={0}-1", text));
    out_.line(fmt::format("IF {}>=1 GOTO {}", text, name));
    out_.line(fmt::format("{}=0", text));
  } else if (call.repeats.present()) {
    const Quantity times = quantity(block, call.repeats);
    out_.line(fmt::format("REPEAT {} P{}{}", name, times.isNumber() ? "" : "=", sinumerikText(times)));
  } else if (way != returnsOf_.end()) {
    out_.line(fmt::format("_LBL_BACK[_LBL_DEPTH]={}", way->second));
    out_.line("_LBL_DEPTH=_LBL_DEPTH+1");
    for (std::size_t i = 0; i < countsOf_.size(); ++i)
      out_.line(fmt::format("_LBL_REP[{},_LBL_DEPTH]=0", i));
    out_.line(fmt::format("GOTO {}", name));
    out_.line(fmt::format("LBLBACK_{}:", way->second));
  } else {
    out_.line(fmt::format("REPEAT {0} {0}_END", name));
  }
  forgetPosition();
  if (!oneCentre_) centre_ = {};
  lastMove_ = 0;
}

std::string_view ToSinumerik::unitWord() const { return program_.unit() == klartext::Unit::Inch ? "G700" : "G710"; }

std::optional<klartext::Unit> ToSinumerik::unitOf(std::string_view name) const {
  for (const auto& other : job_.others) {
    const auto* program = dynamic_cast<const klartext::HeidenhainProgram*>(other.get());
    if (program != nullptr && upperCase(withoutEnding(other->file())) == name) return program->unit();
  }
  return std::nullopt;
}

bool ToSinumerik::cyclesAnswerInOtherUnit() const {
  return job_.called && std::ranges::any_of(job_.others, [&](const auto& other) {
           const auto* program = dynamic_cast<const klartext::HeidenhainProgram*>(other.get());
           return program != nullptr && program->unit() != program_.unit();
         });
}

namespace {

/// The name alone in a block calls a program, and not a cycle of the control.
bool callsProgramByName(const std::string& name) {
  if (cycles::sinumerikCycle(name) != nullptr || sinumerik::isMeasuringCycle(name) || sinumerik::isSkippedCycle(name) ||
      sinumerik::isCycleWithoutEffect(name) || name == "CYCLE800")
    return false;
  Block block;
  Diagnostics mistakes;
  const auto program = programFromText("", name, ProgramLanguage::Sinumerik);
  program->parse(program->begin(), block, mistakes);
  if (!mistakes.empty() || block.instructions.size() != 1) return false;
  const auto* call = std::get_if<CallProgram>(&block.instructions.front());
  return call != nullptr && block.at(call->name) == name;
}

}  // namespace

void ToSinumerik::callProgram(const Block& block, const CallProgram& call) {
  if (call.name.length == 0) throw NotCarriedOver("a program whose name is computed has no twin on a SINUMERIK");
  const std::string name = withoutEnding(block.at(call.name));
  if (name.size() < 2 || identifierFrom(name) != upperCase(name) || isDigit(name[0]))
    throw NotCarriedOver(fmt::format("{} is not a valid name of a SINUMERIK program", name),
                         "names begin with two letters or an underscore and have letters, digits and underscores");
  if (!callsProgramByName(upperCase(name)))
    throw NotCarriedOver(fmt::format("{} means something else in a SINUMERIK program than a call", name),
                         "give the program another name, which begins with two letters");
  out_.line(upperCase(name));
  spindle_.reset();
  // G700 and G710 of the called program stay in effect after it, its INCH or MM does not.
  if (unitOf(upperCase(name)) != program_.unit()) out_.line(std::string(unitWord()));
  out_.list(block, fmt::format("program {} is called as it stands", upperCase(name)),
            "convert it too; it must be an .SPF",
            job_.programs.contains(upperCase(name)) ? Severity::Note : Severity::Warning);
  forgetPosition();
  if (!oneCentre_) centre_ = {};
}

}  // namespace probewright::conversion
