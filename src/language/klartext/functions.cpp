#include <fmt/format.h>

#include "language/klartext/parser.hpp"

/// FN 0 to FN 38. Assignments and jumps become Assign and Jump; all others a Command "FNn" for the host.
namespace probewright::language::klartext {

bool BlockParser::function() {
  const std::optional<double> written = lexer_.number();
  if (!written || *written > 38) return error("a number from 0 to 38 is expected after FN");
  const int number = static_cast<int>(*written);
  lexer_.accept(':');
  return functionBody(number);
}

bool BlockParser::functionBody(int number) {
  switch (number) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
    case 5:
    case 6:
    case 7:
    case 8:
    case 13:
      return functionAssignment(number);
    case 9:
    case 10:
    case 11:
    case 12:
      return functionJump(number);
    case 17:
    case 18:
      return functionSystemData(number);
    case 23:
    case 24:
      return functionCircle(number);
    case 25:
      return functionPreset();
    case 27:
    case 28:
      return functionTable(number);
    case 19:
    case 29:
      return functionPlc(number);
    case 14:
    case 15:
    case 16:
    case 20:
    case 21:
    case 22:
    case 26:
    case 37:
    case 38:
      return functionText(number);
    default:
      return error("there is no function FN with this number", "FN 0 to 29, 37 and 38 are known");
  }
}

Operand BlockParser::call(Function function, std::initializer_list<Operand> arguments) {
  Node node;
  node.operation = Operation::Call;
  node.function = function;
  node.a = static_cast<std::uint32_t>(block_.operands.size());
  node.b = static_cast<std::uint32_t>(arguments.size());
  block_.operands.insert(block_.operands.end(), arguments);
  return push(node);
}

/// What FN 1 to 8 and 13 compute of their values; FN 5 to 7 take `left` alone.
Operand BlockParser::functionResult(int number, Operand left, Operand right) {
  switch (number) {
    case 1:
      return binary(Operation::Add, left, right);
    case 2:
      return binary(Operation::Subtract, left, right);
    case 3:
      return binary(Operation::Multiply, left, right);
    case 4:
      return binary(Operation::Divide, left, right);
    case 5:
      return call(Function::Sqrt, {left});
    case 6:
      return call(Function::Sin, {left});
    case 7:
      return call(Function::Cos, {left});
    case 8:
      return call(Function::RootSumOfSquares, {left, right});
    default:
      return callHost("ANG", {left, right});
  }
}

bool BlockParser::functionAssignment(int number) {
  const std::optional<std::uint32_t> target = variableIndex();
  if (!target) return false;
  if (number == 0 && lexer_.acceptKeyword("SET")) return setUndefined(*target);
  if (!expect('=', "the parameter")) return false;
  static constexpr std::array<std::string_view, 14> signs = {"",    "+",   "-", "*", "DIV", "SQRT", "SIN",
                                                             "COS", "LEN", "",  "",  "",    "",     "ANG"};
  const std::string_view sign = signs[static_cast<std::size_t>(number)];
  std::optional<Operand> result;
  if (number == 0) {
    // A text may be assigned to a QS parameter in this form as well.
    const std::optional<std::string_view> text = lexer_.quoted();
    result = text ? textOperand(ref(*text)) : value("the parameter");
  } else if (number >= 5 && number <= 7) {
    if (!lexer_.acceptPrefix(sign)) return error(std::string(sign) + " is expected here");
    const std::optional<Operand> argument = value(sign);
    if (argument) result = functionResult(number, *argument, {});
  } else {
    const std::optional<Operand> left = value("the first value");
    if (!left) return false;
    if (!lexer_.acceptPrefix(sign) && !(number == 4 && lexer_.accept('/'))) {
      return error(std::string(sign) + " is expected between the two values");
    }
    const std::optional<Operand> right = value("the second value");
    if (right) result = functionResult(number, *left, *right);
  }
  if (!result) return false;
  emit(Assign{*target, *result});
  return expectEnd();
}

/// FN 0: Q5 SET UNDEFINED.
bool BlockParser::setUndefined(std::uint32_t target) {
  if (!lexer_.acceptKeyword("UNDEFINED")) return error("UNDEFINED is expected after SET");
  emit(Command{constant(nameOf(CommandKind::SetUndefined)), {}, static_cast<std::int32_t>(target), {}});
  return expectEnd();
}

/// TABDATA READ Q1 = PRESET COLUMN "X" KEY "3", TABDATA WRITE TOOL COLUMN "DL" KEY "5" = +Q1, TABDATA ADD likewise: the
/// table as text; words COL, KEY, VAL.
bool BlockParser::tableData() {
  Command command;
  std::optional<CommandKind> kind;
  for (const CommandKind way : {CommandKind::TabdataRead, CommandKind::TabdataWrite, CommandKind::TabdataAdd}) {
    if (!kind && lexer_.acceptKeyword(nameOf(way).substr(8))) kind = way;
  }
  if (!kind) return error("READ, WRITE or ADD is expected after TABDATA");
  const bool reads = kind == CommandKind::TabdataRead;
  if (reads) {
    const std::optional<std::uint32_t> target = variableIndex();
    if (!target || !expect('=', "the parameter")) return false;
    command.variable = static_cast<std::int32_t>(*target);
  }
  lexer_.peek();
  const std::size_t start = lexer_.offset();
  while (isLetter(lexer_.here()) || lexer_.here() == '-')
    lexer_.advance();
  const std::string_view table = lexer_.text().substr(start, lexer_.offset() - start);
  if (table.empty()) return error("the table is expected here: TOOL, PRESET, CORR-TCS or CORR-WPL");
  command.text = ref(table);
  const std::size_t first = block_.words.size();
  for (const std::string_view key : {"COLUMN", "KEY"}) {
    if (!lexer_.acceptKeyword(key))
      return error(fmt::format("{} with a name in quotation marks is expected here", key));
    const std::optional<Operand> named = textOrVariable(key);
    if (!named) return false;
    addWord(addressOf(key.substr(0, 3)), *named);
  }
  if (!reads) {
    if (!expect('=', "the key")) return false;
    const std::optional<std::string_view> text = lexer_.quoted();
    const std::optional<Operand> written = text ? textOperand(ref(*text)) : value("the entry");
    if (!written) return false;
    addWord(addressOf("VAL"), *written);
  }
  command.name = constant(nameOf(*kind));
  command.words = wordsSince(first);
  emit(command);
  return expectEnd();
}

/// IS DEFINED or IS UNDEFINED after the parameter that was read last.
std::optional<Operand> BlockParser::definedCondition() {
  const bool undefined = lexer_.acceptKeyword("UNDEFINED");
  if (!undefined && !lexer_.acceptKeyword("DEFINED")) {
    error("DEFINED or UNDEFINED is expected after IS");
    return std::nullopt;
  }
  Node node;
  node.operation = Operation::Undefined;
  node.a = static_cast<std::uint32_t>(block_.variables.size() - 1);
  const Operand condition = push(node);
  if (undefined) return condition;
  Node invert;
  invert.operation = Operation::Not;
  invert.left = condition;
  return push(invert);
}

/// The comparison of FN 9 to 12 with what stands next: a value or a text.
std::optional<Operand> BlockParser::comparison(int number, Operand left, std::string_view what) {
  static constexpr std::array<Operation, 4> operations = {Operation::Equal, Operation::NotEqual, Operation::Greater,
                                                          Operation::Less};
  const std::optional<std::string_view> text = lexer_.quoted();
  const std::optional<Operand> right = text ? textOperand(ref(*text)) : value(what);
  if (!right) return std::nullopt;
  return binary(operations[static_cast<std::size_t>(number - 9)], left, *right);
}

bool BlockParser::functionJump(int number) {
  static constexpr std::array<std::string_view, 4> comparisons = {"EQU", "NE", "GT", "LT"};
  const std::string_view sign = comparisons[static_cast<std::size_t>(number - 9)];
  if (!lexer_.acceptKeyword("IF")) return error("IF is expected here");
  const bool isVariable = variableFollows() || (lexer_.peek() == '+' && upper(lexer_.here(1)) == 'Q');
  const std::optional<Operand> left = value("the first value");
  if (!left) return false;
  std::optional<Operand> condition;
  if (isVariable && lexer_.acceptKeyword("IS")) {
    condition = definedCondition();
  } else {
    if (!lexer_.acceptPrefix(sign)) return error(std::string(sign) + " is expected between the two values");
    condition = comparison(number, *left, "the second value");
  }
  if (!condition) return false;
  Jump jump;
  jump.condition = *condition;
  if (!lexer_.acceptPrefix("GOTO")) return error("GOTO LBL is expected after the condition");
  if (!lexer_.acceptPrefix("LBL")) return error("LBL is expected after GOTO");
  if (!labelName(jump.label, jump.labelValue)) return false;
  emit(jump);
  return expectEnd();
}

/// ID.., and NR.. and IDX.. as far as they stand there.
bool BlockParser::systemDatum() {
  if (!lexer_.acceptPrefix("ID")) return error("ID with the group of the system datum is expected here");
  if (!word(addressOf("ID"), "ID")) return false;
  while (lexer_.peek() == 'N' || lexer_.peek() == 'I') {
    if (lexer_.acceptPrefix("NR")) {
      if (!word(addressOf("NR"), "NR")) return false;
    } else if (lexer_.acceptPrefix("IDX")) {
      if (!word(addressOf("IDX"), "IDX")) return false;
    } else {
      return error("NR or IDX is expected here");
    }
  }
  return true;
}

/// FN 17: SYSWRITE ID990 NR10 IDX0 = +5, FN 18: SYSREAD Q5 = ID210 NR4 IDX3. Words ID, NR, IDX and VAL.
bool BlockParser::functionSystemData(int number) {
  Command command;
  const std::string_view keyword = number == 17 ? "SYSWRITE" : "SYSREAD";
  if (!lexer_.acceptPrefix(keyword)) return error(std::string(keyword) + " is expected here");
  if (number == 18) {
    const std::optional<std::uint32_t> target = variableIndex();
    if (!target || !expect('=', "the parameter")) return false;
    command.variable = static_cast<std::int32_t>(*target);
  }
  const std::size_t first = block_.words.size();
  if (!systemDatum()) return false;
  if (number == 17) {
    if (!expect('=', "the system datum")) return false;
    const std::optional<Operand> written = formula();
    if (!written) return false;
    addWord(addressOf("VAL"), *written);
  }
  command.words = wordsSince(first);
  command.name = constant(nameOf(number == 17 ? CommandKind::Fn17 : CommandKind::Fn18));
  emit(command);
  return expectEnd();
}

/// FN 23 and 24: Q20 = CDATA Q30, the circle through 3 or 4 points.
bool BlockParser::functionCircle(int number) {
  Command command;
  const std::optional<std::uint32_t> target = variableIndex();
  if (!target || !expect('=', "the parameter")) return false;
  command.variable = static_cast<std::int32_t>(*target);
  if (!lexer_.acceptPrefix("CDATA")) return error("CDATA is expected here");
  const std::optional<VariableRef> source = variable();
  if (!source) return false;
  const std::size_t first = block_.words.size();
  addWord(0, source->index[0]);
  command.words = wordsSince(first);
  command.name = constant(nameOf(number == 23 ? CommandKind::Fn23 : CommandKind::Fn24));
  emit(command);
  return expectEnd();
}

/// FN 25: PRESET = X/+Q1/+0: axis, reference coordinate, new value.
bool BlockParser::functionPreset() {
  if (!lexer_.acceptPrefix("PRESET")) return error("PRESET is expected here");
  if (!expect('=', "PRESET")) return false;
  const char axis = lexer_.peek();
  if (axis == '\0' || std::string_view("XYZABCUVW").find(axis) == std::string_view::npos) {
    return error("an axis is expected after PRESET =");
  }
  lexer_.advance();
  const std::size_t first = block_.words.size();
  if (!expect('/', "the axis") || !word(addressOf({&axis, 1}), "the coordinate")) return false;
  if (!expect('/', "the coordinate") || !word(addressOf("VAL"), "the new value")) return false;
  emit(Command{constant(nameOf(CommandKind::Fn25)), {}, -1, wordsSince(first)});
  return expectEnd();
}

/// FN 27: TABWRITE 5/"RADIUS,DEPTH" = Q5, FN 28: TABREAD Q10 = 6/"X,Y,D": row and column names.
bool BlockParser::functionTable(int number) {
  Command command;
  const std::string_view keyword = number == 27 ? "TABWRITE" : "TABREAD";
  if (!lexer_.acceptPrefix(keyword)) return error(std::string(keyword) + " is expected here");
  std::optional<std::uint32_t> variable;
  if (number == 28) {
    variable = variableIndex();
    if (!variable || !expect('=', "the parameter")) return false;
  }
  const std::size_t first = block_.words.size();
  if (!word(0, "the row") || !expect('/', "the row")) return false;
  const std::optional<std::string_view> columns = lexer_.quoted();
  if (!columns) return error("the names of the columns in quotation marks are expected here");
  command.text = ref(*columns);
  if (number == 27) {
    if (!expect('=', "the columns")) return false;
    if (variableFollows()) {
      variable = variableIndex();
      if (!variable) return false;
    } else if (const std::optional<std::string_view> text = lexer_.quoted()) {
      addWord(1, textOperand(ref(*text)));
    } else if (!word(1, "the value")) {
      return false;
    }
  }
  if (variable) command.variable = static_cast<std::int32_t>(*variable);
  command.words = wordsSince(first);
  command.name = constant(nameOf(number == 27 ? CommandKind::Fn27 : CommandKind::Fn28));
  emit(command);
  return expectEnd();
}

bool BlockParser::functionPlc(int number) {
  const std::uint32_t most = mostPlcValues(number);
  const std::size_t first = block_.words.size();
  if (!lexer_.acceptPrefix("PLC")) return error("PLC is expected here");
  if (!expect('=', "PLC")) return false;
  std::uint32_t count = 0;
  do {
    if (count == most) return error(fmt::format("FN {} hands over at most {} values", number, most));
    if (!word(++count, "PLC")) return false;
  } while (lexer_.accept('/'));
  emit(Command{constant(nameOf(functionCommand(number))), {}, -1, wordsSince(first)});
  return expectEnd();
}

/// Functions whose text the host reads itself: FN 14: ERROR = 254 as a word, all others as they stand.
bool BlockParser::functionText(int number) {
  if (number == 14) {
    const std::size_t first = block_.words.size();
    if (!lexer_.acceptPrefix("ERROR")) return error("ERROR = with the number of the message is expected here");
    if (!expect('=', "ERROR")) return false;
    if (!word(0, "the number of the message")) return false;
    emit(Command{constant(nameOf(CommandKind::Fn14)), {}, -1, wordsSince(first)});
    return expectEnd();
  }
  struct Keyword {
    int number;
    std::string_view text;
  };
  static constexpr std::array<Keyword, 7> keywords = {
      {{15, "PRINT"}, {16, "F-PRINT"}, {20, "WAIT FOR"}, {26, "TABOPEN"}, {37, "EXPORT"}, {38, "SEND"}, {0, ""}}};
  for (const Keyword& keyword : keywords) {
    if (keyword.number == number && !lexer_.acceptPrefix(keyword.text)) {
      return error(std::string(keyword.text) + " is expected here");
    }
  }
  return textCommand(functionCommand(number));
}

}  // namespace probewright::language::klartext
