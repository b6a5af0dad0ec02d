#include "base/unfinished.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>
#include <tuple>

#include "base/file.hpp"
#include "base/text.hpp"

namespace probewright {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view mark = ".probewright-unfinished-", letters = "XXXXXX";

/// A pattern for mkstemp and mkdtemp.
std::string patternBeside(const fs::path& target) {
  // The names of files have at most 255 bytes.
  constexpr std::size_t most = 200;
  const std::string name = "." + target.filename().string().substr(0, most) + std::string(mark) + std::string(letters);
  return (target.parent_path() / name).string();
}

bool isUnfinished(std::string_view name) {
  if (name.size() < mark.size() + letters.size()) return false;
  const std::string_view end = name.substr(name.size() - letters.size());
  name.remove_suffix(letters.size());
  return name.ends_with(mark) && std::ranges::all_of(end, [](char c) { return isLetter(c) || isDigit(c); });
}

bool lock(int descriptor, int how) {
  int done = 0;
  do
    done = ::flock(descriptor, how);
  while (done != 0 && errno == EINTR);
  return done == 0;
}

/// True if what is open still lies there: neither finished nor removed by another process.
bool liesAt(const fs::path& path, int descriptor) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

/// A file can be open for writing, which some file systems ask of whoever locks it.
MakersLock opened(const fs::path& path) {
  constexpr int flags = O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  const int file = ::open(path.c_str(), O_RDWR | flags);
  return MakersLock(file >= 0 ? file : ::open(path.c_str(), O_RDONLY | O_DIRECTORY | flags));
}

void removeIfLeft(const fs::path& path) {
  const MakersLock held = opened(path);
  struct stat status {};
  if (held.descriptor() < 0 || ::fstat(held.descriptor(), &status) != 0 || status.st_uid != ::geteuid()) return;
  if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return;
  if (!lock(held.descriptor(), LOCK_EX | LOCK_NB)) return;
  if (!liesAt(path, held.descriptor())) return;
  std::error_code error;
  fs::remove_all(path, error);
}

/// A folder of its own, locked; its path is empty if that cannot be done.
std::pair<MakersLock, fs::path> makeFolder(const fs::path& target) {
  std::error_code error;
  if (!target.parent_path().empty()) fs::create_directories(target.parent_path(), error);
  removeUnfinished(target.parent_path());
  while (true) {
    std::string path = patternBeside(target);
    if (::mkdtemp(path.data()) == nullptr) return {MakersLock(), fs::path()};
    MakersLock made = opened(path);
    if (made.descriptor() < 0 && errno == ENOENT) continue;
    if (made.descriptor() < 0) {
      ::rmdir(path.c_str());
      return {MakersLock(), fs::path()};
    }
    static_cast<void>(lock(made.descriptor(), LOCK_EX));
    if (liesAt(path, made.descriptor())) return {std::move(made), path};
  }
}

fs::path inTemporaryFolder() {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  return error ? fs::path() : folder / "scratch";
}

}  // namespace

MakersLock::~MakersLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

MakersLock& MakersLock::operator=(MakersLock&& other) noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

Result<UnfinishedFile> UnfinishedFile::beside(const fs::path& target) {
  if (target.has_parent_path()) {
    std::error_code error;
    fs::create_directories(target.parent_path(), error);
    if (error) return fail(SourcePlace{target.string(), 0, 0}, "cannot create the folder: " + error.message());
  }
  removeUnfinished(target.parent_path());
  while (true) {
    std::string path = patternBeside(target);
    MakersLock made(::mkostemp(path.data(), O_CLOEXEC));
    if (made.descriptor() < 0) return failErrno(target, "write beside this file");
    // Whoever removes what killed ones have left may have come between making and locking.
    static_cast<void>(lock(made.descriptor(), LOCK_EX));
    if (liesAt(path, made.descriptor())) return UnfinishedFile(std::move(made), path, target);
  }
}

UnfinishedFile::UnfinishedFile(MakersLock lock, fs::path path, fs::path target)
    : lock_(std::move(lock)), path_(std::move(path)), target_(std::move(target)) {}

UnfinishedFile::UnfinishedFile(UnfinishedFile&& other) noexcept
    : lock_(std::move(other.lock_)), path_(std::exchange(other.path_, {})), target_(std::move(other.target_)) {}

UnfinishedFile::~UnfinishedFile() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

bool UnfinishedFile::finish() {
  if (::rename(path_.c_str(), target_.c_str()) != 0) return false;
  path_.clear();
  return true;
}

Result<void> replaceFile(const fs::path& path, std::string_view bytes,
                         const std::function<Result<void>()>& beforeReplacing) {
  auto aside = UnfinishedFile::beside(path);
  if (!aside) return tl::unexpected(aside.error());
  const int file = aside->descriptor();
  if (!writeAll(file, bytes) || ::fchmod(file, 0644) != 0 || ::fsync(file) != 0)
    return failErrno(path, "write this file");
  if (Result<void> ready = beforeReplacing(); !ready) return ready;
  return aside->finish() ? Result<void>() : failErrno(path, "write this file");
}

ScratchFolder::ScratchFolder() : ScratchFolder(inTemporaryFolder()) {}

ScratchFolder::ScratchFolder(const fs::path& target) {
  if (!target.empty()) std::tie(lock_, path_) = makeFolder(target);
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;
  if (!path_.empty()) fs::remove_all(path_, error);
}

void removeUnfinished(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (isUnfinished(entry->path().filename().string())) removeIfLeft(entry->path());
  }
}

}  // namespace probewright
