#pragma once

#include <nlohmann/json_fwd.hpp>

#include "records/readable_text.hpp"
#include "records/truth.hpp"

/// The parts of results.json that tell the truth.
namespace probewright::records {

/// `measured`: the result's own value.
nlohmann::json truthOfResult(const TrueValue& truth, double measured);
nlohmann::json truthOfTouch(const TrueTouch& truth, const ReadableText& text);

/// Everything that belongs to the run as a whole: `entries`, `diagnoses`, `clearance`, `travel`, each where there is
/// something to say.
nlohmann::json truthOfRun(const Truth& truth, const ReadableText& text);

}  // namespace probewright::records
