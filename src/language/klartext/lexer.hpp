#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/text.hpp"

/// The characters of one Klartext block, read from left to right without copying.
namespace probewright::language::klartext {

/// True if `text` ends with the capitals `word` in either case.
constexpr bool endsWithWord(std::string_view text, std::string_view word) {
  if (text.size() < word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (upper(text[text.size() - word.size() + i]) != word[i]) return false;
  }
  return true;
}
/// Bytes of words in any language: ASCII letters and everything beyond ASCII.
constexpr bool isWordByte(char c) { return isLetter(c) || (static_cast<unsigned char>(c) & 0x80U) != 0; }

/// A cursor over the text of a block. Blanks, tabs, line ends after a continuation `~` and, in cycle definitions, the
/// comments after the parameters separate words and are skipped. Keywords are met in either case. The text must
/// outlive the lexer; places are byte offsets into it.
class Lexer {
public:
  /// How a comment ends: at the end of the block, or, in cycle definitions, at the end of its line.
  enum class Comments : std::uint8_t { ToBlockEnd, ToLineEnd };

  explicit Lexer(std::string_view text) : begin_(text.data()), p_(begin_), end_(begin_ + text.size()) {
    lineStart_ = begin_;
  }

  void setComments(Comments comments) { comments_ = comments; }

  /// The next character that is not a separator, in upper case, or 0 at the end of the block.
  char peek() {
    if (p_<end_&& static_cast<unsigned char>(*p_)> ' ' && *p_ != ';' && *p_ != '~') return upper(*p_);
    skipSeparators();
    return p_ < end_ ? upper(*p_) : '\0';
  }
  bool atEnd() { return peek() == '\0'; }

  /// The character right here or `distance` bytes on, no blanks skipped; 0 beyond the end.
  char here(std::size_t distance = 0) const {
    return distance < static_cast<std::size_t>(end_ - p_) ? p_[distance] : '\0';
  }
  void advance(std::size_t count = 1) { p_ += count; }

  /// Skips the character if it comes next.
  bool accept(char wanted) {
    if (peek() != wanted) return false;
    ++p_;
    return true;
  }

  /// Skips the keyword (upper case) if it comes next and no letter follows.
  bool acceptKeyword(std::string_view keyword);
  /// Skips the text (upper case) if it comes next, whatever follows. A blank in it stands for any number of them.
  bool acceptPrefix(std::string_view text);

  /// An unsigned decimal number, if one comes next. Point or comma separate the decimals. Correctly rounded; infinite,
  /// and noted by tooLarge, if no double is as large.
  std::optional<double> number();
  /// Where the first number stands that was too large; nothing if there was none.
  const std::optional<std::size_t>& tooLarge() const { return tooLarge_; }

  /// A quoted text, without its quotes, if one comes next. Straight and typographic quotes are known; an empty
  /// optional if there is none or it isn't closed.
  std::optional<std::string_view> quoted();

  /// Everything up to the comment or the end of the line, trailing blanks and `~` removed.
  std::string_view restOfLine();
  /// Everything up to the comment or the end of the block, continuation lines included.
  std::string_view restOfBlock();
  /// Everything up to the next blank, comment or end of the line.
  std::string_view chunk();

  std::size_t offset() const { return static_cast<std::size_t>(p_ - begin_); }
  void seek(std::size_t offset) { p_ = begin_ + offset; }
  std::size_t offsetOf(std::string_view part) const { return static_cast<std::size_t>(part.data() - begin_); }
  std::string_view text() const { return {begin_, static_cast<std::size_t>(end_ - begin_)}; }

  /// Column (from 1) and line within the block (from 0) of the place the cursor is at.
  std::uint32_t column() const { return static_cast<std::uint32_t>(p_ - lineStart_) + 1; }
  std::uint32_t line() const { return line_; }

  /// Goes to the beginning of the next line; false if there is none.
  bool nextLine();
  /// Limits the lexer to the line the cursor is in, or lifts the limit.
  void limitToLine();
  void liftLimit(std::size_t size) { end_ = begin_ + size; }

private:
  void skipSeparators();
  const char* lineEnd() const;
  std::string_view restUntil(const char* stop);

  const char* begin_;
  const char* p_;
  const char* end_;
  const char* lineStart_;
  std::uint32_t line_ = 0;
  Comments comments_ = Comments::ToBlockEnd;
  std::optional<std::size_t> tooLarge_;
};

/// True if the line (without its end) ends with a continuation sign.
bool endsWithContinuation(std::string_view line);

}  // namespace probewright::language::klartext
