#include "language/directory_library.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"

namespace probewright::language {

namespace {

namespace fs = std::filesystem;

bool sameName(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return upper(x) == upper(y); });
}

/// "_N_L100_SPF" -> "L100.SPF": the control's own form of file names.
std::string plainName(std::string_view name) {
  if (name.size() < 4 || !sameName(name.substr(0, 3), "_N_")) return std::string(name);
  std::string plain(name.substr(3));
  const auto ending = plain.rfind('_');
  if (ending != std::string::npos && ending > 0 && plain.size() - ending == 4) plain[ending] = '.';
  return plain;
}

std::vector<std::string> componentsOf(std::string_view name) {
  if (const auto drive = name.find(':'); drive != std::string_view::npos) name.remove_prefix(drive + 1);
  std::vector<std::string> components;
  while (!name.empty()) {
    const auto separator = name.find_first_of("/\\");
    const std::string_view component = name.substr(0, separator);
    if (component == ".." && !components.empty() && components.back() != "..") {
      components.pop_back();
    } else if (!component.empty() && component != ".") {
      components.push_back(plainName(component));
    }
    name.remove_prefix(separator == std::string_view::npos ? name.size() : separator + 1);
  }
  return components;
}

enum class Entry { Folder, File };

/// The entry of `folder` with this name; the exact one before others, and the first of others in alphabetical order.
std::optional<fs::path> entryOf(const fs::path& folder, const std::string& name, Entry wanted) {
  std::error_code error;
  const auto fits = [&](const fs::path& path) {
    return wanted == Entry::Folder ? fs::is_directory(path, error) : fs::is_regular_file(path, error);
  };
  if (name == "..") return wanted == Entry::Folder ? std::optional(folder / name) : std::nullopt;
  const fs::path exact = folder / name;
  if (fits(exact)) return exact;
  std::optional<fs::path> best;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& path = entry->path();
    if (!sameName(path.filename().string(), name) || !fits(path)) continue;
    if (!best || path < *best) best = path;
  }
  return best;
}

}  // namespace

bool liesWithin(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path inner = fs::canonical(file, error);
  if (error) return false;
  const fs::path outer = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  return !error && std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

DirectoryLibrary::DirectoryLibrary(std::vector<std::string> endings, Open open, std::vector<fs::path> folders)
    : endings_(std::move(endings)), open_(std::move(open)), folders_(std::move(folders)) {}

std::vector<fs::path> DirectoryLibrary::foldersOf(const Program* caller) const {
  std::vector<fs::path> folders;
  if (caller != nullptr) {
    const fs::path folder = fs::path(caller->file()).parent_path();
    folders.push_back(folder.empty() ? fs::path(".") : folder);
  }
  folders.insert(folders.end(), folders_.begin(), folders_.end());
  if (folders.empty()) folders.emplace_back(".");
  return folders;
}

std::optional<fs::path> DirectoryLibrary::find(std::string_view name, const Program* caller) const {
  if (!found_) return search(name, caller);
  const auto [place, isNew] = found_->try_emplace({caller != nullptr ? caller->file() : "", std::string(name)});
  if (isNew) place->second = search(name, caller);
  return place->second;
}

std::optional<fs::path> DirectoryLibrary::search(std::string_view name, const Program* caller) const {
  constexpr std::size_t mostComponents = 64;
  std::vector<std::string> components = componentsOf(name);
  if (components.empty() || components.size() > mostComponents) return std::nullopt;
  if (!root_ && caller != nullptr) root_ = fs::path(caller->file()).parent_path();
  const std::string file = std::move(components.back());
  components.pop_back();
  const bool hasEnding = std::any_of(endings_.begin(), endings_.end(), [&](const std::string& ending) {
    return file.size() > ending.size() && sameName(std::string_view(file).substr(file.size() - ending.size()), ending);
  });
  std::vector<std::string> candidates;
  if (hasEnding) candidates.push_back(file);
  for (const std::string& ending : endings_) {
    if (!hasEnding) candidates.push_back(file + ending);
  }
  const std::vector<fs::path> folders = foldersOf(caller);
  for (std::size_t leftOut = 0; leftOut <= components.size(); ++leftOut) {
    for (const fs::path& folder : folders) {
      std::optional<fs::path> place = folder;
      for (std::size_t i = leftOut; place && i < components.size(); ++i)
        place = entryOf(*place, components[i], Entry::Folder);
      for (std::size_t i = 0; place && i < candidates.size(); ++i) {
        const auto found = entryOf(*place, candidates[i], Entry::File);
        if (found && isWithinReach(*found)) return found->lexically_normal();
      }
    }
  }
  return std::nullopt;
}

/// Below the folder of the first caller, or below one of the further folders.
bool DirectoryLibrary::isWithinReach(const fs::path& path) const {
  if (!root_ && folders_.empty()) return true;
  const auto isAbove = [&](const fs::path& folder) { return liesWithin(path, folder); };
  return (root_ && isAbove(*root_)) || std::any_of(folders_.begin(), folders_.end(), isAbove);
}

Result<std::shared_ptr<Program>> DirectoryLibrary::open(std::string_view name, const Program* caller) {
  if (const auto path = find(name, caller)) return open_(*path);
  std::string where;
  for (const fs::path& folder : foldersOf(caller))
    where += (where.empty() ? "" : ", ") + folder.string();
  std::string endings;
  for (const std::string& ending : endings_)
    endings += (endings.empty() ? "" : ", ") + ending;
  constexpr std::size_t longestQuote = 80;
  const std::string quoted = std::string(name.substr(0, longestQuote)) + (name.size() > longestQuote ? "..." : "");
  return fail("there is no program " + quoted,
              "looked in " + where + " for a file of this name with one of the extensions " + endings);
}

bool DirectoryLibrary::exists(std::string_view name, const Program* caller) { return find(name, caller).has_value(); }

}  // namespace probewright::language
