#include "metrology/tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "metrology/iso286.hpp"

namespace probewright::metrology {

namespace {

constexpr double rounding = 1e-9;

/// Reads a dimension from left to right; `column` counts from 1.
class DimensionReader {
public:
  explicit DimensionReader(std::string_view text) : text_(text) {}

  Result<DimensionText> read() {
    DimensionText dimension;
    skipBlanks();
    dimension.unknownPosition = take('?');
    skipBlanks();
    if (!atEnd() && peek() != '@') {
      if (auto wrong = readNominal(dimension)) return tl::unexpected(*wrong);
    }
    skipBlanks();
    if (take('@')) {
      if (dimension.unknownPosition) return wrongHere("a position marked unknown with '?' cannot have an actual value");
      if (auto wrong = readActual(dimension)) return tl::unexpected(*wrong);
    }
    skipBlanks();
    if (!atEnd()) return wrongHere("unexpected text after the dimension");
    if (!dimension.unknownPosition && !dimension.nominal) return wrongHere("a nominal dimension was expected");
    return dimension;
  }

private:
  bool atEnd() const { return position_ >= text_.size(); }
  char peek() const { return text_[position_]; }
  bool take(char c) {
    if (atEnd() || peek() != c) return false;
    ++position_;
    return true;
  }
  void skipBlanks() {
    while (!atEnd() && (peek() == ' ' || peek() == '\t'))
      ++position_;
  }

  tl::unexpected<Diagnostic> wrongHere(std::string message) const {
    SourcePlace place;
    place.column = static_cast<std::uint32_t>(position_ + 1);
    auto failure =
        fail(place, std::move(message),
             "write a dimension as \"10\", \"10+0.02-0.01\", \"10+-0.02\", \"10H7\", \"?10\" or \"10@10.01\"");
    failure.value().excerpt = std::string(text_);
    return failure;
  }

  /// A number with an optional sign.
  std::optional<double> takeNumber() {
    std::size_t end = position_;
    if (end < text_.size() && (text_[end] == '+' || text_[end] == '-')) ++end;
    while (end < text_.size() && (isDigit(text_[end]) || text_[end] == '.' || text_[end] == ','))
      ++end;
    std::string number(text_.substr(position_, end - position_));
    std::replace(number.begin(), number.end(), ',', '.');
    const auto value = parseDecimal(number);
    if (value) position_ = end;
    return value;
  }

  /// "+-", "-+" or the plus-minus sign in UTF-8 or CP1252.
  bool takePlusMinus() {
    for (const std::string_view sign : {"+-", "-+", "\xC2\xB1", "\xB1"}) {
      if (text_.substr(position_).starts_with(sign)) {
        position_ += sign.size();
        return true;
      }
    }
    return false;
  }

  std::optional<Diagnostic> readNominal(DimensionText& dimension) {
    dimension.nominal = takeNumber();
    if (!dimension.nominal) return wrongHere("a nominal dimension was expected").value();
    skipBlanks();
    if (atEnd() || peek() == '@') return std::nullopt;
    if (takePlusMinus()) {
      const auto half = takeNumber();
      if (!half || *half < 0) return wrongHere("a tolerance without sign was expected after plus-minus").value();
      dimension.tolerance = Tolerance{-*half, *half};
      return std::nullopt;
    }
    if (isLetter(peek())) return readClass(dimension);
    if (peek() != '+' && peek() != '-') return wrongHere("a tolerance starts with a sign").value();
    const auto first = takeNumber();
    if (!first) return wrongHere("a tolerance was expected").value();
    double second = 0;
    skipBlanks();
    if (!atEnd() && (peek() == '+' || peek() == '-')) {
      const auto number = takeNumber();
      if (!number) return wrongHere("a second tolerance was expected").value();
      second = *number;
    }
    dimension.tolerance = Tolerance{std::min(*first, second), std::max(*first, second)};
    return std::nullopt;
  }

  std::optional<Diagnostic> readClass(DimensionText& dimension) {
    const std::size_t start = position_;
    while (!atEnd() && isLetter(peek()))
      ++position_;
    const bool hasGrade = !atEnd() && isDigit(peek());
    while (!atEnd() && isDigit(peek()))
      ++position_;
    dimension.toleranceClass = std::string(text_.substr(start, position_ - start));
    auto tolerance = hasGrade ? isoTolerance(*dimension.nominal, dimension.toleranceClass)
                              : generalTolerance(*dimension.nominal, dimension.toleranceClass);
    if (tolerance) {
      dimension.tolerance = *tolerance;
      return std::nullopt;
    }
    Diagnostic wrong = tolerance.error();
    wrong.place.column = static_cast<std::uint32_t>(start + 1);
    wrong.excerpt = std::string(text_);
    return wrong;
  }

  std::optional<Diagnostic> readActual(DimensionText& dimension) {
    skipBlanks();
    if (!atEnd() && (peek() == 'Q' || peek() == 'q')) {
      const std::size_t start = position_++;
      while (!atEnd() && (isDigit(peek()) || isLetter(peek())))
        ++position_;
      dimension.actualParameter = std::string(text_.substr(start, position_ - start));
      dimension.actualParameter[0] = 'Q';
      if (dimension.actualParameter.size() == 1) return wrongHere("a parameter number was expected after Q").value();
      return std::nullopt;
    }
    dimension.actual = takeNumber();
    if (!dimension.actual) return wrongHere("an actual value or a Q parameter was expected after '@'").value();
    return std::nullopt;
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

}  // namespace

Limits limits(double nominal, const Tolerance& tolerance) {
  return {nominal + tolerance.lower, nominal + tolerance.upper};
}

Conformance conformance(double actual, const Limits& limits) {
  if (actual < limits.lower - rounding) return Conformance::Below;
  if (actual > limits.upper + rounding) return Conformance::Above;
  return Conformance::Within;
}

Verdict boreVerdict(double actual, const Limits& limits) {
  switch (conformance(actual, limits)) {
    case Conformance::Below:
      return Verdict::Rework;
    case Conformance::Above:
      return Verdict::Scrap;
    case Conformance::Within:
      break;
  }
  return Verdict::Good;
}

Verdict studVerdict(double actual, const Limits& limits) {
  switch (conformance(actual, limits)) {
    case Conformance::Below:
      return Verdict::Scrap;
    case Conformance::Above:
      return Verdict::Rework;
    case Conformance::Within:
      break;
  }
  return Verdict::Good;
}

Verdict positionVerdict(double actual, const Limits& limits) {
  return conformance(actual, limits) == Conformance::Within ? Verdict::Good : Verdict::Scrap;
}

Verdict worst(Verdict a, Verdict b) { return std::max(a, b); }

Statement statement(double actual, double uncertainty, const Limits& limits) {
  const double reach = std::abs(uncertainty);
  if (conformance(actual - reach, limits) == Conformance::Above ||
      conformance(actual + reach, limits) == Conformance::Below) {
    return Statement::DoesNotConform;
  }
  if (conformance(actual - reach, limits) == Conformance::Within &&
      conformance(actual + reach, limits) == Conformance::Within) {
    return Statement::Conforms;
  }
  return Statement::Undecided;
}

std::optional<Limits> DimensionText::limits() const {
  if (!nominal || !tolerance || !(tolerance->width() > 0)) return std::nullopt;
  return metrology::limits(*nominal, *tolerance);
}

Result<DimensionText> parseDimension(std::string_view text) { return DimensionReader(text).read(); }

Result<Tolerance> generalTolerance(double nominal, std::string_view toleranceClass) {
  struct Step {
    double upTo;
    std::array<double, 4> deviations;  // f, m, c, v; 0 where the standard has none
  };
  static constexpr std::array<Step, 8> steps{{{3, {0.05, 0.1, 0.2, 0}},
                                              {6, {0.05, 0.1, 0.3, 0.5}},
                                              {30, {0.1, 0.2, 0.5, 1}},
                                              {120, {0.15, 0.3, 0.8, 1.5}},
                                              {400, {0.2, 0.5, 1.2, 2.5}},
                                              {1000, {0.3, 0.8, 2, 4}},
                                              {2000, {0.5, 1.2, 3, 6}},
                                              {4000, {0, 2, 4, 8}}}};
  const std::string_view classes = "fmcv";
  const auto column = toleranceClass.size() == 1 ? classes.find(toleranceClass[0]) : std::string_view::npos;
  if (column == std::string_view::npos) {
    return fail(fmt::format("'{}' is not a tolerance class", toleranceClass),
                "write an ISO 286 class with its grade such as H7 or g6, or an ISO 2768-1 class: f, m, c, v");
  }
  const double size = std::abs(nominal);
  const auto step = std::find_if(steps.begin(), steps.end(), [&](const Step& s) { return size <= s.upTo; });
  if (!(size >= 0.5) || step == steps.end() || step->deviations[column] == 0) {
    return fail(
        fmt::format("ISO 2768-1 has no tolerance of class {} for {} mm", toleranceClass, formatShortest(nominal)),
        "give the deviations as numbers");
  }
  return Tolerance{-step->deviations[column], step->deviations[column]};
}

}  // namespace probewright::metrology
