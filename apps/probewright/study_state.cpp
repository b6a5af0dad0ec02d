#include "study_state.hpp"

#include <string_view>

#include "base/file.hpp"

namespace probewright::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* name = "study.state";
constexpr std::string_view heading = "# probewright study state 1 ";

}  // namespace

Result<std::optional<std::string>> readStudyState(const fs::path& folder, const std::string& mark) {
  std::error_code error;
  const fs::path path = folder / name;
  if (!fs::exists(fs::symlink_status(path, error))) return std::nullopt;
  auto text = readFile(path);
  if (!text) return tl::unexpected(text.error());
  const std::string first = std::string(heading) + mark + "\n";
  if (!text->starts_with(first))
    return fail({path.string(), 1, 1},
                "this is of another study, or another version: program, setup, sources or seed are different",
                "leave out --resume to begin anew");
  return text->substr(first.size());
}

Result<void> writeStudyState(const fs::path& folder, const std::string& mark, const std::string& state) {
  return writeFileAtomically(folder / name, std::string(heading) + mark + "\n" + state);
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

void removeStudyState(const fs::path& folder) {
  std::error_code ignored;
  fs::remove(folder / name, ignored);
}

}  // namespace probewright::app
