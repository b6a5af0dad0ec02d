#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/diagnostic.hpp"

/// Where a study whose ranks hand in sums has come to, in its output folder: to go on after an interruption.
namespace probewright::app {

/// Nothing if there is no such file. Fails if it is of another study than `mark` says, something else, or damaged.
Result<std::optional<std::string>> readStudyState(const std::filesystem::path& folder, const std::string& mark);
/// `beforeReplacing` as of replaceFile().
Result<void> writeStudyState(const std::filesystem::path& folder, const std::string& mark, const std::string& state,
                             const std::function<Result<void>()>& beforeReplacing);

/// Why the file must not be written there: something else has its name. Nothing if it may.
std::optional<Diagnostic> whyNotStudyState(const std::filesystem::path& folder);
/// SHA-256, in hexadecimal digits.
std::string digestOf(const std::string& text);

/// Removes what whyNotStudyState() lets write.
void removeStudyState(const std::filesystem::path& folder);

}  // namespace probewright::app
