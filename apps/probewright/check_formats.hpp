#pragma once

#include <map>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"
#include "language/encoding.hpp"

/// What `check` has found, for other programs.
namespace probewright::app {

enum class CheckFormat { Text, Json, Sarif };

/// Gathers the messages about all programs and gives them as one document. Texts become UTF-8, `encoding` being that of
/// the program they are about; lines and columns count from 1, 0 where there is none. Columns of JSON count bytes,
/// those of SARIF the units of UTF-16 (columnKind of section 3.14.17).
class CheckDocument {
public:
  explicit CheckDocument(CheckFormat format) : format_(format) {}

  void add(const Diagnostics& found, language::Encoding encoding);
  /// The bytes of a file that messages are about and that cannot be read again, such as standard input.
  void know(const std::string& file, std::string text) { texts_[file] = std::move(text); }

  /// JSON: an array of objects with severity, file, line, column, message, excerpt, advice, code. SARIF 2.1.0: a run of
  /// Probewright with a result each. Ends with a line feed.
  std::string text() const;

private:
  std::uint32_t inUtf16(const Diagnostic& found, language::Encoding encoding);

  CheckFormat format_;
  std::map<std::string, std::string> texts_;
  Diagnostics all_;
};

}  // namespace probewright::app
