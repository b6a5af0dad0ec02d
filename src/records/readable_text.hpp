#pragma once

#include <string>

#include "language/encoding.hpp"
#include "records/run_info.hpp"

namespace probewright::records {

/// Turns the texts of a run, bytes as they are in its files, into UTF-8 for people and other programs. What is UTF-8
/// stays as it is; anything else is read in the encoding of the main program, which is found from its whole text, or in
/// the one it looks like if the program is UTF-8 (a mask of FN 16 may not be). Bytes that are not characters become
/// U+FFFD.
class ReadableText {
public:
  explicit ReadableText(const RunInfo& run);

  std::string operator()(const std::string& bytes) const;

private:
  language::Encoding encoding_;
};

}  // namespace probewright::records
