#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <utility>

#include "base/diagnostic.hpp"

/// Files and folders that are gone when their maker has ended, also when it was killed: each is locked as long as its
/// maker lives, and whoever makes the next one in the same folder removes those that nobody holds. Their names end with
/// ".probewright-unfinished-" and six letters or digits. Where the file system knows no locks, nothing is removed.
namespace probewright {

/// Of a file or folder, from its making to the end.
class MakersLock {
public:
  explicit MakersLock(int descriptor = -1) : descriptor_(descriptor) {}
  MakersLock(MakersLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  MakersLock& operator=(MakersLock&& other) noexcept;
  ~MakersLock();
  int descriptor() const { return descriptor_; }

private:
  int descriptor_;
};

/// A file that takes the place of another one when it is whole.
class UnfinishedFile {
public:
  /// An empty file beside `target`; makes missing folders. Fails if that cannot be done.
  static Result<UnfinishedFile> beside(const std::filesystem::path& target);
  UnfinishedFile(UnfinishedFile&& other) noexcept;
  UnfinishedFile& operator=(UnfinishedFile&&) = delete;
  /// Removes it if it has not been finished.
  ~UnfinishedFile();

  const std::filesystem::path& path() const { return path_; }
  /// Open for writing.
  int descriptor() const { return lock_.descriptor(); }
  /// Takes the place of the target, which is replaced in one step. False, with errno, if that cannot be done.
  bool finish();

private:
  UnfinishedFile(MakersLock lock, std::filesystem::path path, std::filesystem::path target);

  MakersLock lock_;
  std::filesystem::path path_, target_;
};

/// Writes the file whole or not at all, as writeFileAtomically() does. `beforeReplacing` is called when the new one is
/// ready on the disk: if it fails, so does this, and the file stays as it was.
Result<void> replaceFile(const std::filesystem::path& path, std::string_view bytes,
                         const std::function<Result<void>()>& beforeReplacing);

/// A folder for files that nobody needs afterwards; only its owner can look into it. Goes with all that is in it.
class ScratchFolder {
public:
  /// Below the system's folder for temporary files (TMPDIR), or beside `target`. The path is empty if it cannot be
  /// made.
  ScratchFolder();
  explicit ScratchFolder(const std::filesystem::path& target);
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }

private:
  MakersLock lock_;
  std::filesystem::path path_;
};

/// Removes from the folder what makers of unfinished files and scratch folders have left who were killed.
void removeUnfinished(const std::filesystem::path& folder);

}  // namespace probewright
