#pragma once

#include <string>

#include "base/diagnostic.hpp"
#include "language/encoding.hpp"

/// What `check` has found, for other programs.
namespace probewright::app {

enum class CheckFormat { Text, Json, Sarif };

/// Gathers the messages about all programs and gives them as one document. Texts become UTF-8, `encoding` being that of
/// the program they are about; columns count bytes from 1, lines from 1, 0 where there is none.
class CheckDocument {
public:
  explicit CheckDocument(CheckFormat format) : format_(format) {}

  void add(const Diagnostics& found, language::Encoding encoding);

  /// JSON: an array of objects with severity, file, line, column, message, excerpt, advice, code. SARIF 2.1.0: a run of
  /// Probewright with a result each. Ends with a line feed.
  std::string text() const;

private:
  CheckFormat format_;
  Diagnostics all_;
};

}  // namespace probewright::app
