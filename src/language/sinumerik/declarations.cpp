#include <algorithm>
#include <array>
#include <cmath>

#include "language/sinumerik/block_parser.hpp"

namespace probewright::language::sinumerik {

using namespace language;

namespace {

/// Words between DEF and the type, or after it, that say where a variable lives and who may change it.
bool isAttribute(std::string_view name) {
  static constexpr std::string_view attributes[] = {"NCK", "CHAN", "SYN", "SYNR", "SYNW", "SYNRW", "PHU",  "LLI",
                                                    "ULI", "APR",  "APW", "APRP", "APWP", "APRB",  "APWB", "TASK"};
  return std::find(std::begin(attributes), std::end(attributes), name) != std::end(attributes);
}

}  // namespace

void BlockParser::parseDeclaration(std::size_t start) {
  Type type = Type::Real;
  TextRef typeText;
  while (!failed_) {
    cursor_.skipBlanks();
    const std::size_t at = cursor_.offset();
    const std::string_view name = cursor_.name();
    if (typeOf(name, type)) {
      typeText = upper(name);
      break;
    }
    if (!isAttribute(name)) {
      return fail(at, "the type of the variable was expected",
                  "Write DEF INT, REAL, BOOL, CHAR, STRING[n], AXIS or FRAME, then the name.");
    }
    cursor_.skipBlanks();
    cursor_.digits();
  }
  Operand length;
  if (type == Type::String) {
    if (!expect('[', "after STRING: the length of the text")) return;
    length = parseExpression();
    if (failed_ || !expect(']', "after the length of the text")) return;
    const bool fits =
        length.number >= 1 && length.number <= longestString && length.number == std::floor(length.number);
    if (length.isLiteral() && !fits)
      return fail(start, "a STRING has 1 to " + std::to_string(longestString) + " characters",
                  "Write DEF STRING[32] NAME.");
  }
  for (;;) {  // attributes with values
    cursor_.skipBlanks();
    if (!isAttribute(cursor_.peekName())) break;
    cursor_.name();
    cursor_.skipBlanks();
    double value = 0;
    parseShortValue(value);
  }
  do
    parseDeclaredVariable(typeText, type, length);
  while (!failed_ && cursor_.take(','));
  if (!failed_) expectEnd("the variables of DEF");
}

void BlockParser::parseDeclaredVariable(TextRef typeText, Type type, Operand length) {
  cursor_.skipBlanks();
  const std::size_t start = cursor_.offset();
  const std::string_view name = cursor_.peekName();
  if (name.empty()) return fail(start, "the name of the variable was expected", "Write DEF REAL WIDTH.");
  if (name.size() < 2 || !isNameStart(name[1]))
    return fail(start, std::string(name) + " cannot name a variable: names begin with two letters or underscores",
                "Choose a longer name for the variable.");
  if (name.size() > 31) return fail(start, "the name of a variable has at most 31 characters");
  if (keywordOf(name) != Keyword::None)
    return fail(start, std::string(name) + " is a word of the language and cannot name a variable",
                "Choose another name for the variable.");
  Command command;
  command.name = block_->add("DEF");
  command.text = typeText;
  const std::uint32_t variable = parseVariable();
  if (failed_) return;
  command.variable = static_cast<std::int32_t>(variable);
  const bool isArray = block_->variables[variable].index[0].present();
  std::array<Word, 257> words;
  std::size_t count = 0;
  const auto addWord = [&](const char* address, Operand value) {
    if (count == words.size()) return fail(start, "this list of first values is too long");
    Word& word = words[count++];
    word = {};
    word.address = addressOf(address);
    word.value = value;
    word.column = static_cast<std::uint32_t>(start) + 1;
  };
  if (type == Type::String) addWord("LEN", length);
  if (cursor_.take('=')) {
    cursor_.skipBlanks();
    const std::string_view filler = cursor_.peekName();
    const bool list = filler == "SET" || filler == "REP" || (isArray && cursor_.peek() == '(');
    if (list) {
      const char* address = filler == "REP" ? "REP" : "SET";
      cursor_.name();
      if (!expect('(', "before the first values")) return;
      do {
        cursor_.skipBlanks();
        const bool omitted = cursor_.peek() == ',' || cursor_.peek() == ')';
        addWord(address, omitted ? Operand{} : parseExpression());
      } while (!failed_ && cursor_.take(','));
      if (failed_ || !expect(')', "after the first values")) return;
    } else {
      addWord("INIT", parseExpression());
      if (failed_) return;
    }
  }
  command.words = {static_cast<std::uint32_t>(block_->words.size()), static_cast<std::uint32_t>(count)};
  block_->words.insert(block_->words.end(), words.begin(), words.begin() + static_cast<std::ptrdiff_t>(count));
  block_->instructions.emplace_back(command);
}

void BlockParser::parseProcedure(std::string_view keyword) {
  Command command;
  command.name = upper(keyword);
  cursor_.skipBlanks();
  const std::size_t offset = cursor_.offset();
  command.text = restOfBlock();
  Header header;
  std::string mistake;
  std::size_t mistakeOffset = 0;
  const std::string_view text = std::string_view(upper_).substr(offset, command.text.length);
  if (!parseHeader(text, header, mistake, mistakeOffset))
    return fail(offset + mistakeOffset, mistake, "Write " + std::string(keyword) + " NAME(REAL WIDTH, VAR INT COUNT).");
  block_->instructions.emplace_back(command);
}

bool BlockParser::parseHeader(std::string_view text, Header& header, std::string& mistake, std::size_t& mistakeOffset) {
  Cursor cursor(text);
  std::size_t word = 0;  // where the last name began
  const auto refuse = [&](std::string why) {
    mistake = std::move(why);
    mistakeOffset = cursor.offset();
    return false;
  };
  const auto refuseWord = [&](std::string why) {
    mistake = std::move(why);
    mistakeOffset = word;
    return false;
  };
  cursor.skipBlanks();
  header.name = std::string(cursor.name());
  if (header.name.empty()) return refuse("the name of the program was expected");
  if (cursor.take('(') && !cursor.take(')')) {
    for (;;) {
      Parameter parameter;
      cursor.skipBlanks();
      word = cursor.offset();
      std::string_view type = cursor.name();
      if (type == "VAR") {
        parameter.byReference = true;
        cursor.skipBlanks();
        word = cursor.offset();
        type = cursor.name();
      }
      if (!typeOf(type, parameter.type)) return refuseWord("the type of a parameter was expected");
      if (parameter.type == Type::String && cursor.take('[')) {
        cursor.skipBlanks();
        const std::string_view digits = cursor.digits();
        if (!digits.empty()) {
          parameter.length = digits.size() > 6 ? longestString + 1 : std::stoi(std::string(digits));
          if (parameter.length < 1 || parameter.length > longestString)
            return refuse("a STRING has 1 to " + std::to_string(longestString) + " characters");
        }
        if (!cursor.take(']')) return refuse("']' expected after the length of the text");
      }
      cursor.skipBlanks();
      word = cursor.offset();
      parameter.name = std::string(cursor.name());
      if (!parameter.name.empty() && (parameter.name.size() < 2 || !isNameStart(parameter.name[1])))
        return refuseWord("the name " + parameter.name +
                          " of a parameter does not begin with two letters or underscores");
      if (cursor.take('[')) {
        do {
          cursor.skipBlanks();
          int size = 0;
          for (const char c : cursor.digits())
            size = size < 100000 ? size * 10 + (c - '0') : size;
          parameter.dimensions.push_back(size);
        } while (cursor.take(','));
        if (!cursor.take(']')) return refuse("']' expected after the dimensions");
      }
      if (cursor.take('=')) {
        cursor.skipBlanks();
        if (cursor.peek() == '"') {
          const std::size_t first = cursor.offset() + 1;
          const std::size_t last = text.find('"', first);
          if (last == std::string_view::npos) return refuse("this text has no closing quotation mark");
          parameter.defaultText = std::string(text.substr(first, last - first));
          cursor.moveTo(last + 1);
        } else {
          const bool negative = cursor.take('-');
          cursor.skipBlanks();
          const std::string_view constant = cursor.peekName();
          if (constant == "TRUE" || constant == "FALSE") {
            cursor.advance(constant.size());
            parameter.defaultNumber = constant == "TRUE" ? 1 : 0;
          } else if (!cursor.number(parameter.defaultNumber) || std::isinf(parameter.defaultNumber)) {
            return refuse("the default of a parameter is a number or a text");
          }
          if (negative) parameter.defaultNumber = -parameter.defaultNumber;
        }
      }
      header.parameters.push_back(std::move(parameter));
      if (cursor.take(',')) continue;
      if (cursor.take(')')) break;
      return refuse("',' or ')' expected between the parameters");
    }
  }
  for (;;) {
    cursor.skipBlanks();
    if (cursor.atEnd()) return true;
    const std::string_view attribute = cursor.name();
    if (attribute.empty()) return refuse("an attribute such as SAVE or DISPLOF was expected");
    header.attributes.emplace_back(attribute);
    if (cursor.take('(')) {
      while (!cursor.atEnd() && cursor.peek() != ')')
        cursor.advance();
      cursor.take(')');
    }
  }
}

}  // namespace probewright::language::sinumerik
