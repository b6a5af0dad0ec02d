#include "language/klartext/pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "control/heidenhain/text_table.hpp"

namespace probewright::language::klartext {
namespace {

constexpr int mostPoints = 10000;

/// One element: its name without the number, and its words by their letters. I in front makes a word incremental.
struct Element {
  std::string name;
  std::map<std::string, double> words;
  double at(const std::string& word, double otherwise = 0) const {
    const auto found = words.find(word);
    return found == words.end() ? otherwise : found->second;
  }
};

/// The words that an element must have, and those that it may have.
struct Form {
  std::string_view name;
  std::vector<std::string> needed, possible;
};
const std::vector<Form>& forms() {
  static const std::vector<Form> all = {
      {"POS", {}, {"X", "Y", "Z", "IX", "IY", "IZ"}},
      {"ROW", {"X", "Y", "D", "NUM"}, {"ROT", "Z"}},
      {"PAT", {"X", "Y", "DX", "DY", "NUMX", "NUMY"}, {"ROT", "ROTX", "ROTY", "Z"}},
      {"FRAME", {"X", "Y", "DX", "DY", "NUMX", "NUMY"}, {"ROT", "ROTX", "ROTY", "Z"}},
      {"CIRC", {"X", "Y", "D", "NUM"}, {"START", "Z"}},
      {"PITCHCIRC", {"X", "Y", "D", "NUM"}, {"START", "STEP", "END", "Z"}},
  };
  return all;
}

tl::unexpected<Diagnostic> wrong(std::string reason) {
  return fail(std::move(reason),
              "write elements such as POS1 (X+25 Y+33.5 Z+0) or CIRC1 (X+0 Y+0 D80 START+0 NUM6 Z+0)");
}

/// Cuts the text into elements.
class Reader {
public:
  Reader(std::string_view text, const ParameterValue& parameter) : rest_(text), parameter_(parameter) {}

  Result<std::vector<Element>> elements() {
    std::vector<Element> all;
    for (skip(); !rest_.empty(); skip()) {
      auto element = one();
      if (!element) return tl::unexpected(element.error());
      all.push_back(std::move(*element));
    }
    if (all.empty()) return wrong("PATTERN DEF names no points");
    return all;
  }

private:
  void skip() {
    while (!rest_.empty() && (lineBlanks.find(rest_.front()) != std::string_view::npos || rest_.front() == '~'))
      rest_.remove_prefix(1);
  }
  template <class Of>
  std::string_view take(const Of& of) {
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), of);
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(taken.size());
    return taken;
  }
  static std::string capitals(std::string_view text) {
    std::string all;
    for (const char c : text)
      all += upper(c);
    return all;
  }

  Result<Element> one() {
    Element element;
    element.name = capitals(take(isLetter));
    const auto form = std::ranges::find(forms(), element.name, &Form::name);
    if (form == forms().end()) return wrong(fmt::format("'{}' is not an element of PATTERN DEF", element.name));
    take(isDigit);
    skip();
    if (!rest_.starts_with('(')) return wrong(fmt::format("( is expected after {}", element.name));
    rest_.remove_prefix(1);
    for (skip(); !rest_.starts_with(')'); skip()) {
      const std::string word = capitals(take(isLetter));
      const bool known = std::ranges::count(form->needed, word) + std::ranges::count(form->possible, word) > 0;
      if (!known) return wrong(fmt::format("{} does not take '{}'", element.name, word.empty() ? rest_ : word));
      const auto number = value();
      if (!number) return wrong(fmt::format("a number is expected after {} of {}", word, element.name));
      element.words[word] = *number;
    }
    rest_.remove_prefix(1);
    for (const std::string& word : form->needed) {
      if (!element.words.contains(word)) return wrong(fmt::format("{} lacks {}", element.name, word));
    }
    return element;
  }

  std::optional<double> value() {
    skip();
    double sign = 1;
    if (rest_.starts_with('+') || rest_.starts_with('-')) {
      sign = rest_.front() == '-' ? -1 : 1;
      rest_.remove_prefix(1);
    }
    if (!rest_.empty() && upper(rest_.front()) == 'Q') {
      const std::string name = capitals(take([](char c) { return isLetter(c) || isDigit(c); }));
      return sign * parameter_(name);
    }
    std::string digits(take([](char c) { return isDigit(c) || c == '.' || c == ','; }));
    std::ranges::replace(digits, ',', '.');
    const auto number = parseDecimal(digits);
    return number ? std::optional(sign * *number) : std::nullopt;
  }

  std::string_view rest_;
  const ParameterValue& parameter_;
};

Vector3 direction(double degrees) {
  const double angle = radiansFromDegrees(degrees);
  return {std::cos(angle), std::sin(angle), 0};
}

/// A number of points from 1 up.
std::optional<int> count(const Element& element, const std::string& word) {
  const double value = element.at(word);
  if (!(value >= 1) || value > mostPoints) return std::nullopt;
  return static_cast<int>(std::lround(value));
}

void addGrid(const Element& element, int columns, int rows, std::vector<Vector3>& points) {
  const double turned = element.at("ROT");
  const Vector3 start(element.at("X"), element.at("Y"), element.at("Z"));
  const Vector3 along = direction(turned + element.at("ROTX")) * element.at("DX");
  const Vector3 across = direction(turned + element.at("ROTY") + 90) * element.at("DY");
  const auto at = [&](int column, int row) { return Vector3(start + column * along + row * across); };
  if (element.name == "PAT" || columns == 1 || rows == 1) {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column)
        points.push_back(at(row % 2 == 0 ? column : columns - 1 - column, row));
    }
    return;
  }
  for (int column = 0; column < columns; ++column)
    points.push_back(at(column, 0));
  for (int row = 1; row < rows; ++row)
    points.push_back(at(columns - 1, row));
  for (int column = columns - 2; column >= 0; --column)
    points.push_back(at(column, rows - 1));
  for (int row = rows - 2; row > 0; --row)
    points.push_back(at(0, row));
}

Result<void> add(const Element& element, std::vector<Vector3>& points) {
  const Vector3 start(element.at("X"), element.at("Y"), element.at("Z"));
  if (element.name == "POS") {
    const Vector3 last = points.empty() ? Vector3(Vector3::Zero()) : points.back();
    points.emplace_back(element.at("X", last.x() + element.at("IX")), element.at("Y", last.y() + element.at("IY")),
                        element.at("Z", last.z() + element.at("IZ")));
    return {};
  }
  if (element.name == "PAT" || element.name == "FRAME") {
    const auto columns = count(element, "NUMX"), rows = count(element, "NUMY");
    if (!columns || !rows || *columns * *rows > mostPoints) {
      return wrong(
          fmt::format("NUMX and NUMY of {} must be at least 1, with at most {} points", element.name, mostPoints));
    }
    addGrid(element, *columns, *rows, points);
    return {};
  }
  const auto number = count(element, "NUM");
  if (!number) return wrong(fmt::format("NUM of {} must be from 1 to {}", element.name, mostPoints));
  double step = 360.0 / *number;
  if (element.name == "PITCHCIRC") {
    const bool ends = element.words.contains("END");
    if (ends == element.words.contains("STEP")) return wrong("PITCHCIRC takes either STEP or END");
    step = !ends ? element.at("STEP") : *number == 1 ? 0 : (element.at("END") - element.at("START")) / (*number - 1);
  }
  for (int i = 0; i < *number; ++i) {
    const Vector3 way = element.name == "ROW"
                            ? Vector3(direction(element.at("ROT")) * element.at("D") * i)
                            : Vector3(direction(element.at("START") + i * step) * element.at("D") / 2);
    points.push_back(start + way);
  }
  return {};
}

}  // namespace

Result<std::vector<Vector3>> patternPoints(std::string_view text, const ParameterValue& parameter) {
  const auto elements = Reader(text, parameter).elements();
  if (!elements) return tl::unexpected(elements.error());
  std::vector<Vector3> points;
  for (const Element& element : *elements) {
    const auto added = add(element, points);
    if (!added) return tl::unexpected(added.error());
  }
  return points;
}

Result<std::vector<Vector3>> pointTable(std::string_view bytes, const std::string& file) {
  Diagnostics mistakes;
  const auto table = control::heidenhain::TextTable::parse(bytes, file, mistakes);
  if (!table) return tl::unexpected(table.error());
  std::vector<Vector3> points;
  const double unit = table->unit() == control::heidenhain::TableUnit::Inch ? 25.4 : 1;
  for (const std::string& row : table->keys()) {
    if (table->cell(row, "FADE").value_or("") == "Y") continue;
    Vector3 point = Vector3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      std::string text = table->cell(row, std::string(1, "XYZ"[axis])).value_or("");
      std::ranges::replace(text, ',', '.');
      if (text.empty() || text == "-") continue;
      const auto number = parseDecimal(text);
      if (!number) return fail(fmt::format("row {} of the point table {}: '{}' is not a number", row, file, text));
      point[axis] = *number * unit;
    }
    points.push_back(point);
  }
  if (points.empty()) return fail(fmt::format("the point table {} has no points", file));
  return points;
}

}  // namespace probewright::language::klartext
