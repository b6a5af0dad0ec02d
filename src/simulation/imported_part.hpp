#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"

/// A part as its import hands it over: from the process that reads the file, and from the cache.
namespace probewright::simulation {

struct ImportedPart {
  /// Warnings about what is missing or not as it should be; their places have lines, but no file.
  Diagnostics remarks;
  std::string_view shape;     ///< what appendShape() makes of it
  std::string_view elements;  ///< what appendElements() makes of it
  /// Where they lie: most of a large part is not copied.
  std::shared_ptr<const void> storage;
};

std::string toBytes(const ImportedPart& part);
/// Nothing if `bytes` are not what toBytes() made, as far as their layout goes.
std::optional<ImportedPart> partFromBytes(std::string bytes);

}  // namespace probewright::simulation
