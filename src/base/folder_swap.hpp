#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/sink.hpp"

/// Files that belong together, in a folder that also holds files of others: the old set is replaced by the new one in a
/// single step of the file system. docs/output-folder.md says how.
namespace probewright {

/// One that works on the set of files of a folder; others wait.
class FolderLock {
public:
  /// Makes the folder if it is missing, waits until no other run works on it and, if a run was killed at it, clears
  /// up: afterwards the folder holds the set before or the one after. Fails as checkWritable() does. `onWait` is told
  /// if there is a wait. `isOurs`: whether a file in a folder belongs to the set.
  static Result<FolderLock> take(const std::filesystem::path& folder, const std::function<void()>& onWait,
                                 const std::function<bool(const std::filesystem::path& file)>& isOurs,
                                 const std::stop_token& stop = {});

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  /// Removes what take() has made and nobody has put anything into.
  ~FolderLock();

  /// The folder, its own name and not a symbolic link to it.
  const std::filesystem::path& folder() const { return folder_; }
  int descriptor() const { return descriptor_; }

private:
  FolderLock(std::filesystem::path folder, int descriptor, int made);

  std::filesystem::path folder_;
  int descriptor_;
  int made_ = 0;  ///< so many folders: this one and those above it
};

/// As long as one lives, nobody swaps the files of its folder: what is read there belongs together. Waits for whoever
/// is swapping them now; where a folder is missing or the file system knows no locks, it holds up nobody.
class FolderReading {
public:
  /// `onWait` is told once, after a wait of 2 s.
  static FolderReading of(const std::filesystem::path& folder, const std::stop_token& stop = {},
                          const std::function<void()>& onWait = {});

private:
  struct Closing {
    void operator()(const int* descriptor) const;
  };
  std::unique_ptr<const int, Closing> held_;
};

/// True for a file that another process is replacing just now.
bool isOnItsWay(const std::filesystem::path& file);

/// Writes `files`, in their order, by their names in the folder, and removes `dropped`. Whoever looks, and whatever
/// ends this, sees all of that or nothing of it; everything else in the folder stays as it is. Fails without a trace if
/// something cannot be written or `stop` is asked for.
Result<void> swapFiles(const FolderLock& lock, const std::vector<std::pair<std::string, Content>>& files,
                       const std::set<std::string>& dropped, const std::stop_token& stop = {});

}  // namespace probewright
