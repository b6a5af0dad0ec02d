#include <array>

#include "language/sinumerik/block_parser.hpp"

/// Words with an index, a list or an axis that is computed: AX[v]=, PO[X]=(...), POSP[X]=(...), MEASA[X]=(...).
namespace probewright::language::sinumerik {

using namespace language;

/// AX[axis]= is the axis, IP[axis]= its parameter of interpolation: I, J or K.
void BlockParser::parseComputedAxis(std::string_view name, std::size_t start) {
  if (!expect('[', "after AX and IP")) return;
  const bool parameter = name == "IP";
  Word axis;
  axis.address = addressOf(parameter ? "IP[]" : "AX[]");
  axis.column = static_cast<std::uint32_t>(start) + 1;
  axis.value = parseExpression();
  if (failed_ || !expect(']', "after the axis")) return;
  axisWords_.push_back(axis);
  addMoveWord(addressOf(parameter ? "=IP" : "=AX"), start);
}

/// PO[X]=(end,a2,a3...): a polynomial of POLY. Its path is travelled as a straight line, so that the end is what
/// counts.
void BlockParser::parsePolynomial(std::size_t start) {
  if (!expect('[', "after PO")) return;
  cursor_.skipBlanks();
  const std::string_view angle = cursor_.peekName();
  const bool orientation = angle == "PHI" || angle == "PSI" || angle == "THT";
  Operand axis;
  if (orientation) {
    cursor_.advance(angle.size());
  } else {
    axis = parseExpression();
  }
  if (failed_ || !expect(']', "after the axis") || !expect('=', "after PO[axis]")) return;
  const bool list = cursor_.take('(');
  const Operand end = parseExpression();
  while (!failed_ && list && cursor_.take(','))
    parseExpression();
  if (failed_ || (list && !expect(')', "after the coefficients")) || orientation) return;
  const Node* node = axis.node >= 0 ? &block_->nodes[static_cast<std::size_t>(axis.node)] : nullptr;
  const auto column = static_cast<std::uint32_t>(start) + 1;
  if (node != nullptr && node->operation == Operation::AxisName) {
    axisWords_.push_back({addressOf(block_->at(node->text)), WordMode::Plain, end, column, 0});
  } else {
    axisWords_.push_back({addressOf("AX[]"), WordMode::Plain, axis, column, 0});
    axisWords_.push_back({addressOf("=AX"), WordMode::Plain, end, column, 0});
  }
}

void BlockParser::parseMoveWord(std::string_view name, std::size_t start) {
  if (name == "AX" || name == "IP") return parseComputedAxis(name, start);
  if (name == "PO") return parsePolynomial(start);
  if (name == "AP" || name == "RP") polar_ = true;
  cursor_.skipBlanks();
  if (cursor_.peek() != '=') {
    return fail(start, std::string(name) + " needs a value", "Write " + std::string(name) + "=value.");
  }
  if (name == "FAD" && beginsFeedFunction({"PM", "PR"})) {  // per minute, per revolution
    const Operand feed = parseExpression();
    axisWords_.push_back({addressOf(name), WordMode::Plain, feed, static_cast<std::uint32_t>(start) + 1, 0});
    if (!failed_) expect(')', "after the feed");
    return;
  }
  addMoveWord(addressOf(name), start);
}

/// True if "=(value, ...)" stands here.
bool BlockParser::beginsList() const {
  Cursor ahead = cursor_;
  if (!ahead.take('=') || !ahead.take('(')) return false;
  for (int open = 1; !ahead.atEnd() && open > 0; ahead.advance()) {
    const char c = ahead.peek();
    if (c == ',' && open == 1) return true;
    open += c == '(' ? 1 : c == ')' ? -1 : 0;
  }
  return false;
}

void BlockParser::parseSetting(std::string_view name, std::size_t start) {
  // MEAC[X]=(1,2,3), CPLNUM[X,Y]=2: of words that are not carried out only the first value is kept.
  const KeywordEntry* entry = keywordEntry(name);
  const bool skipped = entry != nullptr && entry->effect != Effect::CarriedOut;
  Word index;
  index.address = 1;
  if (cursor_.take('[')) {
    index.value = parseExpression();
    while (!failed_ && skipped && cursor_.take(','))
      parseExpression();
    if (failed_ || !expect(']', "after the index")) return;
  } else if (isDigit(cursor_.peek())) {
    double number = 0;
    takeNumber(number);
    index.value = Operand::of(number);
  }
  cursor_.skipBlanks();
  if (cursor_.peek() != '=')
    return fail(start, std::string(name) + " needs a value", "Write " + std::string(name) + "=value.");
  if (name == "DL" && index.value.present())
    return fail(start, "DL takes no index", "Write DL=1: the number of an additive offset of the edge.");
  if (name == "FA" && !index.value.present()) return fail(start, "FA needs the axis in brackets", "Write FA[X]=value.");
  Word value;
  value.column = static_cast<std::uint32_t>(start) + 1;
  std::array<Word, 2> more;  // POSP[X]=(end,part,mode)
  std::uint32_t count = 0;
  if (name == "POSP") {
    cursor_.advance();
    if (!expect('(', "before the end position")) return;
    value.value = parseExpression();
    while (!failed_ && count < more.size() && cursor_.take(',')) {
      more[count].address = count + 2;
      more[count++].value = parseExpression();
    }
    if (failed_ || !expect(')', "after end position, part and mode")) return;
  } else if (skipped && beginsList()) {
    cursor_.advance();
    expect('(', "before the values");
    value.value = parseExpression();
    while (!failed_ && cursor_.take(','))
      parseExpression();
    if (failed_ || !expect(')', "after the values")) return;
  } else {
    value.value = parseValue(&value.mode);
  }
  if (failed_) return;
  Block& block = *block_;
  if (name.starts_with("POS") && index.value.node >= 0) {
    const Node& axis = block.nodes[static_cast<std::size_t>(index.value.node)];
    const bool named = axis.operation == Operation::AxisName;
    if (named && !takeOnce("the axis " + std::string(block.at(axis.text)), start)) return;
  }
  const auto first = static_cast<std::uint32_t>(block.words.size());
  block.words.push_back(value);
  if (index.value.present()) block.words.push_back(index);
  block.words.insert(block.words.end(), more.begin(), more.begin() + count);
  block.instructions.emplace_back(
      Command{upper(name), {}, -1, {first, static_cast<std::uint32_t>(block.words.size()) - first}});
}

/// MEAS=1, MEAW=-1; for one axis MEASA[X]=(mode,event), MEAWA[X]=(mode,event): further events are accepted and the
/// first one counts.
void BlockParser::parseMeasure(std::string_view name, std::size_t start) {
  const TextRef ref = upper(name);
  Word event;
  event.address = addressOf("MEAS");
  cursor_.skipBlanks();
  if (name.size() == 5) {
    Word axis, mode;
    axis.address = addressOf("MAX");
    mode.address = addressOf("MMO");
    if (!expect('[', "after the axial measuring function")) return;
    axis.value = parseExpression();
    if (failed_ || !expect(']', "after the axis") || !expect('=', "after the axis") || !expect('(', "before the mode"))
      return;
    mode.value = parseExpression();
    if (failed_ || !expect(',', "between mode and probe event")) return;
    event.value = parseExpression();
    while (!failed_ && cursor_.take(','))
      parseExpression();
    if (failed_ || !expect(')', "after the probe events")) return;
    axisWords_.insert(axisWords_.begin(), {event, axis, mode});
  } else {
    if (cursor_.peek() != '=')
      return fail(start, std::string(name) + " needs the number of the probe event",
                  "Write " + std::string(name) + "=1.");
    event.value = parseValue(nullptr);
    axisWords_.insert(axisWords_.begin(), event);
  }
  setOwner(Owner::Command, ref, start);
}

}  // namespace probewright::language::sinumerik
