#include "language/sinumerik/structure.hpp"

#include <algorithm>

namespace probewright::language::sinumerik {

using namespace language;

namespace {

/// The block without comment and texts, in upper case: texts become empty.
void normalize(std::string_view line, std::string& out) {
  out.clear();
  bool inText = false;
  for (const char c : line) {
    if (c == '"') inText = !inText;
    if (!inText && c == ';') return;
    if (!inText) out += c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  }
}

void skipBlockHead(Cursor& cursor, std::string_view& number) {
  cursor.skipBlanks();
  if (cursor.take('/') && isDigit(cursor.peek())) cursor.advance();
  cursor.skipBlanks();
  const std::size_t start = cursor.offset();
  if ((cursor.peek() == 'N' || cursor.peek() == ':') && isDigit(cursor.peek(1))) {
    cursor.advance();
    cursor.digits();
    number = cursor.since(start);
    if (cursor.take('/') && isDigit(cursor.peek())) cursor.advance();
    cursor.skipBlanks();
  }
}

bool hasWord(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    if (at == 0 || !isNamePart(text[at - 1])) return true;
  }
  return false;
}

struct Pairing {
  Structure closing;
  Structure opening;
  const char* closingName;
  const char* openingName;
};
constexpr Pairing pairings[] = {
    {Structure::EndIf, Structure::If, "ENDIF", "IF"},
    {Structure::EndWhile, Structure::While, "ENDWHILE", "WHILE"},
    {Structure::EndFor, Structure::For, "ENDFOR", "FOR"},
    {Structure::EndLoop, Structure::Loop, "ENDLOOP", "LOOP"},
    {Structure::Until, Structure::Repeat, "UNTIL", "REPEAT"},
};

const Pairing* byOpening(Structure kind) {
  const auto* found = std::find_if(std::begin(pairings), std::end(pairings), [&](const Pairing& p) {
    return p.opening == kind || (kind == Structure::Else && p.opening == Structure::If);
  });
  return found == std::end(pairings) ? nullptr : found;
}

}  // namespace

ProgramStructure::ProgramStructure(const SourceText& text) : file_(text.file()) {
  BlockPosition position{text.begin(), 1};
  for (SourceLine line = text.line(position.offset); line; line = text.line(position.offset)) {
    scanLine(line.text, position);
    position = {line.next, position.line + 1};
  }
  for (const std::size_t index : open_) {
    const Mark& mark = marks_[index];
    const Pairing* pairing = byOpening(mark.kind);
    const SourceLine line = text.line(mark.position.offset);
    complain(mark.position, line.text, std::string(pairing->openingName) + " is not closed by " + pairing->closingName,
             std::string("Write ") + pairing->closingName +
                 " into a block of its own after the last block that belongs to it.");
  }
  open_.clear();
}

void ProgramStructure::complain(BlockPosition position, std::string_view line, std::string message,
                                std::string advice) {
  Diagnostic mistake;
  mistake.place = {file_, position.line, 0};
  const std::size_t first = line.find_first_not_of(" \t");
  mistake.place.column = first == std::string_view::npos ? 1 : static_cast<std::uint32_t>(first) + 1;
  mistake.message = std::move(message);
  mistake.excerpt = std::string(line);
  mistake.advice = std::move(advice);
  mistakes_.push_back(std::move(mistake));
}

void ProgramStructure::scanLine(std::string_view line, BlockPosition position) {
  // Most blocks are motions: a glance at the first characters settles them without a copy.
  std::size_t first = 0;
  while (first < line.size() && (isBlank(line[first]) || line[first] == '/'))
    ++first;
  if (first < line.size() && (line[first] == 'N' || line[first] == 'n' || line[first] == ':')) {
    std::size_t behind = first + 1;
    while (behind < line.size() && (isDigit(line[behind]) || isBlank(line[behind])))
      ++behind;
    if (behind > first + 1) first = behind;
  }
  if (first >= line.size() || line[first] == ';') return;
  const auto letter = [](char c) { return c == '_' || (static_cast<unsigned char>((c & ~32) - 'A') < 26); };
  const bool named = first + 1 < line.size() && letter(line[first]) && letter(line[first + 1]);
  if (!named && line[first] != '/') return;

  normalize(line, upper_);
  Cursor cursor(upper_);
  std::string_view number;
  skipBlockHead(cursor, number);
  std::size_t start = cursor.offset();
  std::string_view name = cursor.name();
  if (name.size() < 2 || !isNameStart(name[1])) return;
  if (cursor.take(':')) {
    labels_.push_back({std::string(name), position});
    positions_[labels_.back().name].push_back(position);
    cursor.skipBlanks();
    start = cursor.offset();
    name = cursor.name();
  }
  cursor.moveTo(start + name.size());
  switch (keywordOf(name)) {
    case Keyword::If:
      if (!hasWord(cursor.rest(), "GOTO")) pair(Structure::If, position, line);
      return;
    case Keyword::Else:
      return pair(Structure::Else, position, line);
    case Keyword::EndIf:
      return pair(Structure::EndIf, position, line);
    case Keyword::While:
      return pair(Structure::While, position, line);
    case Keyword::EndWhile:
      return pair(Structure::EndWhile, position, line);
    case Keyword::For:
      return pair(Structure::For, position, line);
    case Keyword::EndFor:
      return pair(Structure::EndFor, position, line);
    case Keyword::Loop:
      return pair(Structure::Loop, position, line);
    case Keyword::EndLoop:
      return pair(Structure::EndLoop, position, line);
    case Keyword::Until:
      return pair(Structure::Until, position, line);
    case Keyword::Repeat:
      cursor.skipBlanks();
      if (cursor.atEnd()) pair(Structure::Repeat, position, line);
      return;
    case Keyword::Procedure: {
      BlockParser::Header header;
      std::string mistake;
      std::size_t mistakeOffset = 0;
      // Texts were removed above; defaults of STRING parameters need them.
      std::string whole(line);
      for (bool inText = false; char& c : whole) {
        if (c == '"') inText = !inText;
        if (!inText && c == ';') {
          whole.resize(static_cast<std::size_t>(&c - whole.data()));
          break;
        }
        if (!inText && c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
      }
      const std::size_t proc = whole.find("PROC");
      if (!header_ && proc != std::string::npos &&
          BlockParser::parseHeader(std::string_view(whole).substr(proc + 4), header, mistake, mistakeOffset))
        header_ = std::move(header);
      else if (!header_)
        headerMistake_ = std::move(mistake);
      return;
    }
    case Keyword::Declare: {
      const std::string_view rest = cursor.rest();
      const std::size_t at = rest.find("STRING");
      if (at == std::string_view::npos) return;
      Cursor names(rest.substr(at + 6));
      if (names.take('['))
        while (!names.atEnd() && !names.take(']'))
          names.advance();
      while (!names.atEnd()) {
        names.skipBlanks();
        const std::string_view variable = names.name();
        if (!variable.empty()) stringVariables_.emplace_back(variable);
        while (!names.atEnd() && names.peek() != ',')
          names.advance();
        names.take(',');
      }
      return;
    }
    default:
      return;
  }
}

void ProgramStructure::pair(Structure kind, BlockPosition position, std::string_view line) {
  const std::size_t index = marks_.size();
  const auto* closing =
      std::find_if(std::begin(pairings), std::end(pairings), [&](const Pairing& p) { return p.closing == kind; });
  const bool isElse = kind == Structure::Else;
  marks_.push_back({position, kind, Mark::none});
  if (closing == std::end(pairings) && !isElse) {
    open_.push_back(index);
    return;
  }
  const char* name = isElse ? "ELSE" : closing->closingName;
  const char* wanted = isElse ? "IF" : closing->openingName;
  const Structure opening = isElse ? Structure::If : closing->opening;
  const Structure top = open_.empty() ? Structure::EndIf : marks_[open_.back()].kind;
  const bool fits = !open_.empty() && (top == opening || (top == Structure::Else && kind == Structure::EndIf));
  if (!fits) {
    std::string message = std::string(name) + " without " + wanted;
    std::string advice = std::string("Remove it, or write ") + wanted + " before it.";
    if (!open_.empty()) {
      const Mark& other = marks_[open_.back()];
      const Pairing* pairing = byOpening(other.kind);
      message = std::string(name) + " does not close " + pairing->openingName + " of line " +
                std::to_string(other.position.line);
      advice = std::string(pairing->closingName) + " is missing before it.";
      // What it does close, if anything, is closed together with all that was forgotten inside.
      const auto match = std::find_if(open_.rbegin(), open_.rend(), [&](std::size_t i) {
        return marks_[i].kind == opening || (marks_[i].kind == Structure::Else && opening == Structure::If);
      });
      if (match != open_.rend() && !isElse) open_.erase(match.base() - 1, open_.end());
    }
    return complain(position, line, std::move(message), std::move(advice));
  }
  const std::size_t partner = open_.back();
  open_.pop_back();
  marks_[partner].partner = index;
  if (isElse) {
    open_.push_back(index);
  } else {
    marks_[index].partner = partner;
  }
}

std::optional<BlockPosition> ProgramStructure::counterpart(BlockPosition position) const {
  const auto found = std::lower_bound(marks_.begin(), marks_.end(), position.offset,
                                      [](const Mark& mark, auto offset) { return mark.position.offset < offset; });
  if (found == marks_.end() || found->position.offset != position.offset || found->partner == Mark::none)
    return std::nullopt;
  return marks_[found->partner].position;
}

bool ProgramStructure::isStringVariable(std::string_view name) const {
  return std::find(stringVariables_.begin(), stringVariables_.end(), name) != stringVariables_.end();
}

std::optional<BlockPosition> ProgramStructure::find(const SourceText& text, std::string_view label, BlockPosition from,
                                                    JumpDirection direction) {
  const bool isNumber = label.size() > 1 && (label[0] == 'N' || label[0] == ':') && isDigit(label[1]);
  std::string key(label);
  auto found = positions_.find(key);
  if (found == positions_.end()) {
    std::vector<BlockPosition> places;
    if (isNumber) {
      BlockPosition position{text.begin(), 1};
      for (SourceLine line = text.line(position.offset); line; line = text.line(position.offset)) {
        std::string_view number;
        const std::size_t first = line.text.find_first_not_of(" \t/0123456789");
        if (first != std::string_view::npos && (line.text[first] == label[0] || line.text[first] == (label[0] | 32))) {
          normalize(line.text.substr(0, 40), upper_);
          Cursor cursor(upper_);
          skipBlockHead(cursor, number);
          if (number == label) places.push_back(position);
        }
        position = {line.next, position.line + 1};
      }
    }
    found = positions_.emplace(std::move(key), std::move(places)).first;
  }
  const std::vector<BlockPosition>& places = found->second;
  const auto behind = std::upper_bound(places.begin(), places.end(), from.offset,
                                       [](auto offset, const BlockPosition& p) { return offset < p.offset; });
  const auto forward = behind != places.end() ? std::optional(*behind) : std::nullopt;
  const auto backward = behind != places.begin() ? std::optional(*(behind - 1)) : std::nullopt;
  switch (direction) {
    case JumpDirection::Forward:
      return forward;
    case JumpDirection::Backward:
      return backward;
    case JumpDirection::Any:
    case JumpDirection::ForwardThenBackward:
      return forward ? forward : backward;
    case JumpDirection::ProgramStart:
      break;
  }
  return BlockPosition{text.begin(), 1};
}

}  // namespace probewright::language::sinumerik
