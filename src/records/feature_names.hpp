#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "base/diagnostic.hpp"
#include "records/readable_text.hpp"
#include "records/run_info.hpp"

namespace probewright::records {

/// What programs call the features that they measure: the structure block (`* - TEXT`) or the message (`MSG("TEXT")`)
/// that stands nearest above a call in its program. An empty one ends the name before it.
class FeatureNames {
public:
  FeatureNames(const RunInfo& run, const ReadableText& text);

  /// UTF-8 in one line; empty if the program says nothing, or its text is not known.
  std::string at(const SourcePlace& place) const;

private:
  std::map<std::string, std::map<std::uint64_t, std::string>> names_;  ///< by program and line
};

}  // namespace probewright::records
