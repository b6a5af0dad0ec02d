#include "execution/sinumerik/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/init_text.hpp"
#include "execution/format_field.hpp"
#include "language/sinumerik/cursor.hpp"

namespace probewright::execution::sinumerik {

using control::Alarm;
using control::sinumerik::AxisValue;
using control::sinumerik::Frame;

namespace {

/// Access to arguments with the control's alarms.
class Arguments {
public:
  Arguments(std::string_view function, std::span<const Value> values) : function_(function), values_(values) {}

  std::size_t count() const { return values_.size(); }
  double number(std::size_t index) const {
    if (index < values_.size()) {
      if (const auto* number = std::get_if<double>(&values_[index])) return *number;
    }
    throw Alarm("14020", fmt::format("{} needs a number as argument {}", function_, index + 1));
  }
  const std::string& text(std::size_t index) const {
    if (index < values_.size()) {
      if (const auto* text = std::get_if<std::string>(&values_[index])) return *text;
    }
    throw Alarm("14020", fmt::format("{} needs a text as argument {}", function_, index + 1));
  }
  /// A character: a text of one character or its code.
  char character(std::size_t index) const {
    if (index < values_.size()) {
      if (const auto* code = std::get_if<double>(&values_[index]))
        return static_cast<char>(static_cast<unsigned char>(*code));
    }
    const std::string& text = this->text(index);
    if (text.size() != 1) throw Alarm("14020", fmt::format("{} looks for one character, not a text", function_));
    return text.front();
  }

private:
  std::string_view function_;
  std::span<const Value> values_;
};

double placeOf(std::size_t found) { return found == std::string::npos ? -1 : static_cast<double>(found); }

std::string changeCase(std::string text, char first, char last, int shift) {
  for (char& c : text)
    if (c >= first && c <= last) c = static_cast<char>(c + shift);
  return text;
}

Value subString(const Arguments& arguments) {
  const std::string& text = arguments.text(0);
  const double from = arguments.number(1);
  if (!(from >= 0) || from > static_cast<double>(text.size())) return std::string();
  const double length = arguments.count() > 2 ? arguments.number(2) : static_cast<double>(text.size());
  if (length < 0)
    throw Alarm("14020", fmt::format("SUBSTR cannot take {} characters", length), "characters are counted from 0");
  return text.substr(static_cast<std::size_t>(from),
                     static_cast<std::size_t>(std::min(length, static_cast<double>(text.size()))));
}

/// `unit`: mm in one unit of lengths.
Value frameFunctionValue(std::string_view name, const Arguments& arguments, double unit) {
  std::vector<AxisValue> axes;
  if (name == "CRPL") {  // CRPL(plane, angle): 1 about Z, 2 about Y, 3 about X; 0 is refused
    const double plane = arguments.number(0);
    if (plane != 1 && plane != 2 && plane != 3) throw Alarm("14020", "CRPL knows the planes 1 (G17), 2 (G18), 3 (G19)");
    axes.push_back({plane == 1 ? "Z" : plane == 2 ? "Y" : "X", arguments.number(1)});
    return frameValue(*control::sinumerik::frameFunction("CROT", axes));
  }
  const bool valueless = name == "CMIRROR";
  const bool length = name == "CTRANS" || name == "CFINE";
  for (std::size_t i = 0; i < arguments.count(); i += valueless ? 1 : 2) {
    const std::string& axis = arguments.text(i);
    const double factor = length && control::sinumerik::geometryAxisOf(axis) ? unit : 1;
    axes.push_back({axis, valueless ? 1 : factor * arguments.number(i + 1)});
  }
  const auto frame = control::sinumerik::frameFunction(name, axes);
  if (!frame) throw Alarm("14020", frame.error().message, frame.error().advice);
  return frameValue(*frame);
}

}  // namespace

Value frameValue(const Frame& frame) { return control::sinumerik::frameExpression(frame); }

Frame frameOf(const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  const auto refuse = [] { return Alarm("12150", "a frame was expected here", "write CTRANS(X,10) and the like"); };
  if (text == nullptr) throw refuse();
  Frame whole;
  bool first = true;
  Cursor cursor(*text);
  while (first || cursor.take(':')) {
    const std::string_view function = cursor.name();
    std::vector<AxisValue> axes;
    if (function.empty() || !cursor.take('(')) throw refuse();
    while (!cursor.take(')')) {
      const std::string axis(cursor.name());
      double value_ = 0;
      if (axis.empty()) throw refuse();
      if (function != "CMIRROR") {
        if (!cursor.take(',')) throw refuse();
        const bool negative = cursor.take('-');
        if (!cursor.number(value_)) throw refuse();
        if (negative) value_ = -value_;
      }
      axes.push_back({axis, value_});
      cursor.take(',');
    }
    const auto frame = control::sinumerik::frameFunction(function, axes);
    if (!frame) throw refuse();
    const auto chained = control::sinumerik::chain(whole, *frame);
    if (!chained) throw Alarm("18314", chained.error().message, chained.error().advice);
    whole = *chained;
    first = false;
  }
  if (!cursor.atEnd()) throw refuse();
  return whole;
}

std::string formatText(std::string_view format, std::span<const Value> arguments) {
  std::string out;
  std::size_t next = 0;
  const Arguments values("SPRINT", arguments);
  constexpr FormatLimits limits = {.flags = "0", .width = 200, .decimals = 17};
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '%') {
      out += format[i];
      continue;
    }
    if (i + 1 < format.size() && format[i + 1] == '%') {
      out += '%';
      ++i;
      continue;
    }
    const FormatField field = readField(format, ++i, limits);
    const int decimals = field.decimals ? static_cast<int>(*field.decimals) : 6;
    const char kind = i < format.size() ? static_cast<char>(format[i] & ~32) : '\0';
    std::string part;
    switch (kind) {
      case 'D':
        part = fmt::format("{:.0f}", std::floor(values.number(next) + 0.5));
        break;
      case 'F':
        part = formatFixed(values.number(next), decimals);
        break;
      case 'E':
        part = fmt::format("{:.{}E}", values.number(next), decimals);
        break;
      case 'G':
        part = fmt::format("{:.{}G}", values.number(next), decimals);
        break;
      case 'X':
        part = fmt::format("{:X}", static_cast<std::uint32_t>(truncated<std::int64_t>(values.number(next))));
        break;
      case 'B':
        part = values.number(next) != 0 ? "TRUE" : "FALSE";
        break;
      case 'C':
        part = std::string(1, values.character(next));
        break;
      case 'S':
      case 'P':
        part = next < arguments.size() && !language::isText(arguments[next]) ? numberText(values.number(next))
                                                                             : values.text(next);
        if (field.decimals) part.resize(std::min(part.size(), *field.decimals));
        break;
      default:
        throw Alarm("14020",
                    fmt::format("SPRINT does not know the format %{}", i < format.size() ? format.substr(i, 1) : ""),
                    "use %d, %f, %e, %g, %s, %x, %b or %c");
    }
    ++next;
    out += filled(std::move(part), field, kind != 'S' && kind != 'C' ? Content::Number : Content::Text);
  }
  return out;
}

std::string numberText(double value) {
  constexpr int digits = 10;
  if (!std::isfinite(value)) return formatShortest(value);
  const double size = std::abs(value);
  // What lies after the tenth digit, or the tenth decimal place, is noise of computing.
  const int before = size < 1 ? 0 : static_cast<int>(std::floor(std::log10(size))) + 1;
  std::string text = formatFixed(value, std::max(digits - before, 0));
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

int wholeNumber(double value) { return static_cast<int>(std::lround(std::clamp(value, -2e9, 2e9))); }

std::optional<Value> callFunction(std::string_view name, std::span<const Value> values,
                                  const FunctionQuestions& questions) {
  const Arguments arguments(name, values);
  if (name == "SPRINT") return formatText(arguments.text(0), values.subspan(1));
  if (name == "STRLEN") return static_cast<double>(arguments.text(0).size());
  if (name == "INDEX") return placeOf(arguments.text(0).find(arguments.character(1)));
  if (name == "RINDEX") return placeOf(arguments.text(0).rfind(arguments.character(1)));
  if (name == "MINDEX") return placeOf(arguments.text(0).find_first_of(arguments.text(1)));
  if (name == "MATCH") return placeOf(arguments.text(0).find(arguments.text(1)));
  if (name == "SUBSTR") return subString(arguments);
  if (name == "TOUPPER") return changeCase(arguments.text(0), 'a', 'z', -32);
  if (name == "TOLOWER") return changeCase(arguments.text(0), 'A', 'Z', 32);
  if (name == "STRING") return language::isText(values[0]) ? values[0] : Value(numberText(arguments.number(0)));
  if (name == "ISNUMBER") return control::sinumerik::parseNumber(trimmed(arguments.text(0))).has_value() ? 1.0 : 0.0;
  if (name == "NUMBER") {
    const auto number = control::sinumerik::parseNumber(trimmed(arguments.text(0)));
    if (!number)
      throw Alarm("14020", fmt::format("NUMBER: \"{}\" is not a number", arguments.text(0)), "ask ISNUMBER first");
    return *number;
  }
  if (name == "AXNAME") {
    const std::string axis = changeCase(arguments.text(0), 'a', 'z', -32);
    if (!questions.isAxis(axis)) throw Alarm("14020", fmt::format("AXNAME: there is no axis {}", axis));
    return axis;
  }
  if (name == "AXSTRING") return arguments.text(0);
  if (name == "ISAXIS") {
    const double axis = arguments.number(0);
    return axis >= 1 && axis <= 3 && questions.isAxis(axis == 1 ? "X" : axis == 2 ? "Y" : "Z") ? 1.0 : 0.0;
  }
  if (name == "ISVAR") return questions.isVariable(arguments.text(0)) ? 1.0 : 0.0;
  if (name == "ISFILE") return questions.isFile(arguments.text(0)) ? 1.0 : 0.0;
  if (name == "MODAXVAL") {
    if (!questions.isAxis(changeCase(arguments.text(0), 'a', 'z', -32)))
      throw Alarm("14020", fmt::format("MODAXVAL: there is no axis {}", arguments.text(0)));
    return arguments.number(1) - 360 * std::floor(arguments.number(1) / 360);
  }
  // D numbers are those of the cutting edges.
  if (name == "GETDNO") return arguments.number(1);
  if (name == "GETT") return static_cast<double>(questions.toolNumber(arguments.text(0)));
  if (name == "SPI" || name == "AXTOSPI" || name == "QU") return values.front();
  if (name == "CHAIN") {
    const auto chained = control::sinumerik::chain(frameOf(values[0]), frameOf(values[1]));
    if (!chained) throw Alarm("18314", chained.error().message, chained.error().advice);
    return frameValue(*chained);
  }
  if (name == "INVFRAME") {
    const auto inverse =
        control::sinumerik::frameFromTransform(control::sinumerik::transform(frameOf(values[0])).inverse());
    if (!inverse) throw Alarm("18314", inverse.error().message, inverse.error().advice);
    return frameValue(*inverse);
  }
  if (name == "CTRANS" || name == "CFINE" || name == "CROT" || name == "CROTS" || name == "CSCALE" ||
      name == "CMIRROR" || name == "CRPL")
    return frameFunctionValue(name, arguments, questions.frameUnit);
  return std::nullopt;
}

}  // namespace probewright::execution::sinumerik
