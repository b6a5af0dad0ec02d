#include "study_state.hpp"

#include <fmt/format.h>
#include <openssl/sha.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "base/file.hpp"
#include "base/unfinished.hpp"

namespace probewright::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* name = "study.state";
constexpr std::string_view heading = "# probewright study state ";

/// The first line says what the file is, of which study, and what must follow: numbers that were damaged are not taken.
std::string firstLine(const std::string& mark, const std::string& state) {
  return fmt::format("{}2 {} {}\n", heading, mark, digestOf(state));
}

}  // namespace

Result<std::optional<std::string>> readStudyState(const fs::path& folder, const std::string& mark) {
  std::error_code error;
  const fs::path path = folder / name;
  if (!fs::exists(fs::symlink_status(path, error))) return std::nullopt;
  auto text = readFile(path);
  if (!text) return tl::unexpected(text.error());
  if (!text->starts_with(fmt::format("{}2 {} ", heading, mark)))
    return fail({path.string(), 1, 1},
                "this is of another study, or another version: program, setup, sources or seed are different",
                "leave out --resume to begin anew");
  const std::size_t end = std::min(text->find('\n'), text->size() - 1) + 1;
  std::string state = text->substr(end);
  if (text->substr(0, end) != firstLine(mark, state))
    return fail({path.string(), 2, 1}, "this file is damaged: it is not as it was written",
                "leave out --resume to begin anew");
  return state;
}

Result<void> writeStudyState(const fs::path& folder, const std::string& mark, const std::string& state,
                             const std::function<Result<void>()>& beforeReplacing) {
  return replaceFile(folder / name, firstLine(mark, state) + state, beforeReplacing);
}

std::optional<Diagnostic> whyNotStudyState(const fs::path& folder) {
  std::error_code error;
  const fs::path path = folder / name;
  if (!fs::exists(fs::symlink_status(path, error))) return std::nullopt;
  const auto text = fs::is_regular_file(path, error) ? readFile(path) : Result<std::string>("");
  if (text && text->starts_with(heading)) return std::nullopt;
  return fail({path.string(), 0, 0}, "this file is not of a study, and stays as it is",
              "move it, or choose another folder with --out")
      .value();
}

std::string digestOf(const std::string& text) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data());
  std::string hex;
  for (const unsigned char byte : digest)
    hex += fmt::format("{:02x}", byte);
  return hex;
}

void removeStudyState(const fs::path& folder) {
  std::error_code ignored;
  fs::remove(folder / name, ignored);
}

}  // namespace probewright::app
