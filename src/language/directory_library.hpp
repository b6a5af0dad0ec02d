#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "language/program.hpp"

namespace probewright::language {

/// True if the file lies in `folder` or below it, symbolic links followed; empty: the current folder.
bool liesWithin(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Finds called programs in folders of this machine, as a control finds them on its own disk: capital and small letters
/// are the same, the ending may be left out.
///
/// Names are taken as programs write them: "SUB", "SUB.H", "PARTS\SUB.H", "TNC:\PARTS\SUB.H", "L100",
/// "_N_L100_SPF", "/_N_WKS_DIR/_N_RING_WPD/_N_L100_SPF". A path is looked up below the caller's folder and below
/// each of the further folders; if it is not there, its folders are left out one after the other from the front, so
/// that programs copied from a control need not keep its folders. Neither ".." nor a symbolic link leads out of the
/// folder of the program that called first and the further folders.
class DirectoryLibrary : public ProgramLibrary {
public:
  /// Opens the program file at a path.
  using Open = std::function<Result<std::shared_ptr<Program>>(const std::filesystem::path&)>;

  /// `endings`: with their point and in the order of preference, for instance {".SPF", ".MPF"}. `folders` are
  /// searched after the folder of the caller.
  DirectoryLibrary(std::vector<std::string> endings, Open open, std::vector<std::filesystem::path> folders = {});

  Result<std::shared_ptr<Program>> open(std::string_view name, const Program* caller) override;
  bool exists(std::string_view name, const Program* caller) override;

  /// The file that `caller` means by `name`.
  std::optional<std::filesystem::path> find(std::string_view name, const Program* caller) const;

  /// What names mean, by the caller's file and the name; nothing: no file.
  using Found = std::map<std::pair<std::string, std::string>, std::optional<std::filesystem::path>>;
  /// Looks each name up once, and keeps what it means for whoever else has `found`: runs of the same program.
  void remember(std::shared_ptr<Found> found) { found_ = std::move(found); }

private:
  std::optional<std::filesystem::path> search(std::string_view name, const Program* caller) const;
  std::vector<std::filesystem::path> foldersOf(const Program* caller) const;
  bool isWithinReach(const std::filesystem::path& path) const;

  std::vector<std::string> endings_;
  Open open_;
  std::vector<std::filesystem::path> folders_;
  mutable std::optional<std::filesystem::path> root_;  ///< folder of the program that called first
  std::shared_ptr<Found> found_;
};

}  // namespace probewright::language
