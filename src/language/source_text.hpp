#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"

namespace probewright::language {

/// One line of a program file.
struct SourceLine {
  std::string_view text;   ///< without the line end (LF, CR LF)
  std::uint64_t next = 0;  ///< the offset of the following line
  explicit operator bool() const { return exists; }
  bool exists = false;  ///< false: the offset was at or after the end
};

/// The bytes of a program file, given out line by line. Views stay valid as long as the SourceText (also after it was
/// moved). Small files are read whole; large ones are mapped, and the part that was read lies in the page cache only,
/// so memory stays flat however long the program is. A mapped file must not be cut short by others while it runs;
/// editors and DNC software that write a new file and rename it are harmless.
///
/// A byte order mark of UTF-8 and a DOS end-of-file mark (0x1A) at the very end are not part of any line.
class SourceText {
public:
  /// The file at `path`. Fails if it cannot be read or is UTF-16.
  static Result<SourceText> open(const std::filesystem::path& path);
  /// A text that is in memory already; `file` is its name in messages.
  static SourceText of(std::string file, std::string text);

  SourceText(SourceText&&) noexcept;
  SourceText& operator=(SourceText&&) noexcept;
  ~SourceText();

  const std::string& file() const { return file_; }
  /// The offset of the first line.
  std::uint64_t begin() const { return begin_; }
  /// The offset after the last line.
  std::uint64_t end() const { return end_; }

  /// The line that starts at `offset`.
  SourceLine line(std::uint64_t offset) const;

  /// The bytes first..last, line ends included.
  std::string_view bytes(std::uint64_t first, std::uint64_t last) const;

private:
  struct Storage;
  SourceText(std::string file, std::unique_ptr<Storage> storage);

  std::string file_;
  std::unique_ptr<Storage> storage_;
  const char* data_ = nullptr;
  std::uint64_t begin_ = 0;
  std::uint64_t end_ = 0;
  bool mapped_ = false;
};

/// The name of a program file without its folder and ending: "parts/Ring.H" -> "Ring".
std::string programName(std::string_view file);

}  // namespace probewright::language
