#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"

/// A STEP file (ISO 10303-21) as text: what can be known of it before anybody builds a shape from it.
namespace probewright::simulation {

struct StepEntity {
  std::uint64_t line = 0;
  std::string_view type;  ///< "ADVANCED_FACE"; empty where several types are in one entity
};

struct StepText {
  std::map<std::uint64_t, StepEntity> entities;  ///< by the number after #
  /// The first entity that refers to one that is not there: its number, and which one it looks for; 0 if there is none.
  std::uint64_t dangling = 0;
  std::uint64_t missing = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> references;  ///< which entity refers to which, in their order
};

/// An entity that refers to itself, directly or through others; 0 if there is none.
std::uint64_t circularEntity(const StepText& text);

/// Reads the entities of a STEP file. Refused: a file that is not a STEP file or is cut short, brackets that are nested
/// deeper than any part needs or never closed, texts without an end, two entities of one number, no section HEADER or
/// DATA, or one with parameters (the second edition of the standard). What stands between the brackets is not looked
/// at. A text ends at a quote before a comma, a bracket or a semicolon; any other one, as in 5'x6', is a letter of it,
/// as OpenCASCADE takes it. Keywords may be small. `bytes` must outlive the result. A stop ends it with a mistake.
Result<StepText> scanStep(std::string_view bytes, const std::string& file, const std::stop_token& stop = {});

/// A number that is larger than all that can be computed with, 1.E400, and its line.
struct EndlessNumber {
  std::string_view text;
  std::uint64_t line = 0;
};

/// The first one in a STEP or IGES file, between commas or brackets. OpenCASCADE may go round in it for ever.
std::optional<EndlessNumber> endlessNumber(std::string_view bytes);

/// The text of a STEP file with the exponents of its numbers in capitals, 1.E-5: OpenCASCADE takes 1.e-5 for 1.
std::string withCapitalExponents(std::string bytes);

}  // namespace probewright::simulation
