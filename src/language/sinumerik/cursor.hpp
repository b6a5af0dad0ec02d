#pragma once

#include <cstdint>
#include <string_view>

#include "base/text.hpp"

namespace probewright::language::sinumerik {

constexpr bool isNameStart(char c) { return isCapital(c) || c == '_'; }
constexpr bool isNamePart(char c) { return isCapital(c) || c == '_' || isDigit(c); }

/// Walks over one block in upper case without its comment. Reading past the end yields '\0'.
class Cursor {
public:
  Cursor() = default;
  explicit Cursor(std::string_view text) : begin_(text.data()), at_(text.data()), end_(text.data() + text.size()) {}

  bool atEnd() const { return at_ == end_; }
  char peek() const { return at_ < end_ ? *at_ : '\0'; }
  char peek(std::size_t ahead) const { return static_cast<std::size_t>(end_ - at_) > ahead ? at_[ahead] : '\0'; }
  /// Never beyond the end.
  void advance(std::size_t count = 1) { at_ = static_cast<std::size_t>(end_ - at_) > count ? at_ + count : end_; }
  void skipBlanks() {
    while (at_ < end_ && isBlank(*at_))
      ++at_;
  }
  /// Skips blanks and `expected` if it stands there.
  bool take(char expected) {
    skipBlanks();
    if (peek() != expected) return false;
    ++at_;
    return true;
  }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  void moveTo(std::size_t offset) { at_ = begin_ + offset; }
  void moveToEnd() { at_ = end_; }
  std::string_view rest() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }
  std::string_view since(std::size_t from) const {
    return {begin_ + from, static_cast<std::size_t>(at_ - begin_) - from};
  }

  /// Reads a name (letters, digits, underscores) and skips it; empty if none begins here.
  std::string_view name() {
    const char* first = at_;
    if (isNameStart(peek()))
      while (at_ < end_ && isNamePart(*at_))
        ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
  }
  /// The name that begins here, without skipping it.
  std::string_view peekName() const {
    Cursor copy = *this;
    return copy.name();
  }
  std::string_view digits() {
    const char* first = at_;
    while (at_ < end_ && isDigit(*at_))
      ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
  }

  /// Reads an unsigned decimal number, perhaps with the exponent "EX-3". False if none begins here. Correctly rounded;
  /// infinite if no double is as large.
  bool number(double& value);

private:
  const char* begin_ = nullptr;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
};

}  // namespace probewright::language::sinumerik
