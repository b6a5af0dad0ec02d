#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "conversion/conversion.hpp"
#include "language/block.hpp"

/// The lines of a program that is being written.
namespace probewright::conversion {

class Output {
public:
  explicit Output(std::string file) : file_(std::move(file)) {}

  void line(std::string text) { lines_.push_back(std::move(text)); }
  std::size_t size() const { return lines_.size(); }
  std::string& at(std::size_t index) { return lines_[index]; }
  /// Drops all lines from `size` on.
  void shorten(std::size_t size) { lines_.resize(size); }
  void insert(std::size_t index, const std::vector<std::string>& lines) {
    lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(index), lines.begin(), lines.end());
  }

  /// Lists what of a block is lost or holds only under a condition.
  void list(const language::Block& block, std::string message, std::string advice = {},
            Severity severity = Severity::Warning);
  /// The same, where the message holds for every block of its kind: once a program.
  void listOnce(const language::Block& block, const std::string& message, std::string advice = {},
                Severity severity = Severity::Warning);
  /// Notes, once a word, that a word of dynamics or of the display is left out. `control`: that the program is for.
  void leaveOut(const language::Block& block, std::string_view word, std::string_view control);
  /// Lists it and leaves it as a comment where it happened.
  void lose(const language::Block& block, const std::string& what);
  /// The block stays as a comment.
  void keepAsComment(const language::Block& block, const std::string& message, const std::string& advice);

  const std::vector<std::string>& lines() const { return lines_; }
  Diagnostics& listed() { return listed_; }

private:
  std::string file_;
  std::vector<std::string> lines_;
  Diagnostics listed_;
  std::set<std::string> listedOnce_;
};

}  // namespace probewright::conversion
