#include "base/folder_swap.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <optional>
#include <utility>

#include "base/file.hpp"
#include "base/writable_folder.hpp"

namespace probewright {

namespace fs = std::filesystem;

namespace {

constexpr const char* incomplete = ".probewright-incomplete";
constexpr const char* workName = ".probewright-swap";

/// Where the new set is built: a folder beside the one that it is for.
fs::path besideOf(const fs::path& folder) {
  return folder.parent_path() / fmt::format(".{}.probewright", folder.filename().string());
}

std::vector<std::string> entriesOf(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    names.push_back(entry->path().filename().string());
  return names;
}

bool isFolder(const fs::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
}

bool isThere(const fs::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0;
}

/// True if both names are those of one and the same file; links are not followed.
bool areOne(const fs::path& a, const fs::path& b) {
  struct stat first {
  }, second{};
  return ::lstat(a.c_str(), &first) == 0 && ::lstat(b.c_str(), &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino;
}

bool makeFolder(const fs::path& path, mode_t mode) { return ::mkdir(path.c_str(), mode) == 0; }
bool link(const fs::path& from, const fs::path& to) {
  return ::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), 0) == 0;
}
bool move(const fs::path& from, const fs::path& to) { return ::rename(from.c_str(), to.c_str()) == 0; }
bool moveWhereNothingIs(const fs::path& from, const fs::path& to) {
  return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0;
}
bool takeAway(const fs::path& path) { return ::unlink(path.c_str()) == 0; }

/// The names in a folder reach the disk. File systems without such a thing have nothing to lose.
bool flushFolder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool flushed = ::fsync(descriptor) == 0 || errno == EINVAL;
  const int reason = errno;
  ::close(descriptor);
  errno = reason;
  return flushed;
}

/// Removes a folder of files. Hidden ones go last, and only if all others are gone: they tell the next run that the
/// others are not whole, or whose they are. Without them what is left would count as files of an earlier run.
void removeFolder(const fs::path& folder) {
  bool emptied = true;
  const auto takeAll = [&](const auto& which) {
    for (const std::string& name : entriesOf(folder))
      if (emptied && which(name)) emptied = takeAway(folder / name);
  };
  takeAll([](const std::string& name) { return !name.starts_with('.'); });
  takeAll([](const std::string& name) { return name != incomplete; });
  takeAll([](const std::string& name) { return name == incomplete; });
  if (emptied) ::rmdir(folder.c_str());
}

// ---- files that are on their way ----

/// Writes a file through a buffer and flushes it to disk.
class FileWriter {
public:
  explicit FileWriter(const fs::path& path)
      : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600)) {
    if (descriptor_ < 0) reason_ = errno;
  }
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;
  ~FileWriter() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  void add(std::string_view bytes) {
    constexpr std::size_t part = std::size_t{1} << 18U;
    buffer_ += bytes;
    if (buffer_.size() >= part) empty();
  }

  bool finish() {
    empty();
    if (reason_ == 0 && (::fchmod(descriptor_, 0644) != 0 || ::fsync(descriptor_) != 0)) reason_ = errno;
    if (reason_ == 0) {
      const int closed = ::close(std::exchange(descriptor_, -1));
      if (closed != 0) reason_ = errno;
    }
    errno = reason_;
    return reason_ == 0;
  }

private:
  void empty() {
    if (reason_ == 0 && !writeAll(descriptor_, buffer_)) reason_ = errno;
    buffer_.clear();
  }

  fs::path path_;
  int descriptor_;
  int reason_ = 0;
  std::string buffer_;
};

struct Stopped {};

using Files = std::vector<std::pair<std::string, Content>>;

/// All files into the folder `aside`, from where they will go to `folder`.
Result<void> writeAside(const Files& files, const fs::path& aside, const fs::path& folder,
                        const std::stop_token& stop) {
  for (const auto& [name, content] : files) {
    FileWriter file(aside / name);
    try {
      content([&](std::string_view bytes) {
        if (stop.stop_requested()) throw Stopped();
        file.add(bytes);
      });
    } catch (const Stopped&) {
      return fail(SourcePlace{folder.string(), 0, 0},
                  "the output was interrupted, the files of an earlier run are still there");
    }
    if (!file.finish()) return failErrno(folder / name, "write this file");
  }
  return {};
}

// ---- one folder for the other ----

/// True if the folder is the working folder of a process: it would find itself in a folder that is gone.
bool somebodyStandsIn(const fs::path& folder) {
  const auto own = identityOf(folder);
  const auto standsThere = [&](const fs::path& process) { return identityOf(process / "cwd") == own; };
  if (standsThere("/proc/self")) return true;
  for (const std::string& name : entriesOf("/proc")) {
    if (name.find_first_not_of("0123456789") == std::string::npos && standsThere(fs::path("/proc") / name)) return true;
  }
  return false;
}

bool canBeExchanged(const fs::path& folder) {
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0 || status.st_uid != ::geteuid()) return false;
  if (std::ranges::any_of(entriesOf(folder), [&](const std::string& name) { return isFolder(folder / name); }))
    return false;
  return !somebodyStandsIn(folder);
}

/// What is left of the folder `old`, for which `folder` stands now. Files that were put there at the last moment go
/// over. Hidden files go last: one of them tells which of the others are ours.
void clearOld(const fs::path& old, const fs::path& folder, const std::function<bool(const std::string&)>& isOurs) {
  bool cleared = true;
  const auto clear = [&](const std::string& name) {
    const bool goes = areOne(old / name, folder / name) || isOurs(name);
    cleared = (goes ? takeAway(old / name) : moveWhereNothingIs(old / name, folder / name)) && cleared;
  };
  const std::vector<std::string> names = entriesOf(old);
  for (const std::string& name : names) {
    if (!name.starts_with('.')) clear(name);
  }
  for (const std::string& name : names) {
    if (cleared && name.starts_with('.')) clear(name);
  }
  if (cleared) ::rmdir(old.c_str());
}

enum class Way { Done, NotPossible };

/// Builds the new folder beside the old one, everything else of the old one linked into it, and exchanges them.
Result<Way> exchangeFolders(const FolderLock& lock, const Files& files, const std::set<std::string>& dropped,
                            const std::stop_token& stop) {
  const fs::path& folder = lock.folder();
  const fs::path aside = besideOf(folder);
  struct stat status {};
  if (::fstat(lock.descriptor(), &status) != 0 || !makeFolder(aside, 0700)) return Way::NotPossible;
  const auto undo = [&] {
    const int reason = errno;
    removeFolder(aside);
    errno = reason;
  };
  const int mark = ::open((aside / incomplete).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (mark < 0) {
    undo();
    return failErrno(folder, "write beside this folder");
  }
  ::close(mark);
  if (Result<void> written = writeAside(files, aside, folder, stop); !written) {
    undo();
    return tl::unexpected(std::move(written.error()));
  }
  std::set<std::string> replaced = dropped;
  for (const auto& [name, content] : files)
    replaced.insert(name);
  for (const std::string& name : entriesOf(folder)) {
    if (replaced.contains(name) || link(folder / name, aside / name)) continue;
    undo();
    return Way::NotPossible;
  }
  // Whoever comes next finds this folder, and waits.
  const int descriptor = ::open(aside.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool ready = descriptor >= 0 && (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
                     ::fchmod(descriptor, status.st_mode & 07777) == 0;
  if (ready) takeAway(aside / incomplete);
  const bool flushed = ready && (::fsync(descriptor) == 0 || errno == EINVAL);
  const bool exchanged =
      flushed && ::renameat2(AT_FDCWD, aside.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0;
  if (!exchanged) {
    const int reason = errno;
    undo();
    if (descriptor >= 0) ::close(descriptor);
    errno = reason;
    if (flushed && reason != EIO && reason != ENOSPC && reason != EDQUOT) return Way::NotPossible;
    return failErrno(folder, "write into this folder");
  }
  flushFolder(folder.parent_path());
  clearOld(aside, folder, [&](const std::string& name) { return replaced.contains(name); });
  ::close(descriptor);
  return Way::Done;
}

// ---- within the folder ----

/// While files change within the folder itself, each of them is a symbolic link by way of `current`, which names the
/// folder of the old set or that of the new one: turning it changes all of them at once.
struct WorkFolder {
  explicit WorkFolder(const fs::path& where)
      : folder(where),
        work(where / workName),
        older(work / "old"),
        newer(work / "new"),
        current(work / "current"),
        decided(work / "decided") {}

  fs::path linkTo(const std::string& name) const { return fs::path(workName) / "current" / name; }

  /// Decides that the files of `newer` take their places and `dropped` go: from now on the next run does what this one
  /// does not come to do.
  bool decide(const Files& files, const std::set<std::string>& dropped) const {
    const fs::path aside = work / "deciding";
    FileWriter list(aside);
    for (const auto& [name, content] : files)
      list.add(fmt::format("+{}\n", name));
    for (const std::string& name : dropped)
      list.add(fmt::format("-{}\n", name));
    return list.finish() && flushFolder(newer) && move(aside, decided) && flushFolder(work);
  }

  /// Does what is decided, one file after the other; false, with errno, if that is not possible now.
  bool carryOut() const {
    Result<std::string> list = readFile(decided);
    if (!list) return false;
    for (std::string_view rest = *list; !rest.empty();) {
      const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(end + 1);
      if (line.size() < 2 || line.find('/') != std::string_view::npos) continue;
      const std::string name(line.substr(1));
      if (line.front() == '-') {
        if (!takeAway(folder / name) && errno != ENOENT) return false;
      } else if (isThere(newer / name) && !move(newer / name, folder / name)) {
        return false;
      }
    }
    return flushFolder(folder) && takeAway(decided);
  }

  /// Makes plain files of what are links, and removes what leads nowhere and this folder. What is decided is done.
  void finish() const {
    if (isThere(decided) && !carryOut()) return;
    takeAway(work / "deciding");
    std::error_code error;
    const fs::path target = fs::read_symlink(current, error);
    if (!error) {
      for (const std::string& name : entriesOf(folder)) {
        if (fs::read_symlink(folder / name, error) != linkTo(name) || error) continue;
        const fs::path plain = work / "plain";
        takeAway(plain);
        if (!isThere(work / target / name)) {
          takeAway(folder / name);
        } else if (!link(work / target / name, plain) || !move(plain, folder / name)) {
          return;  // as it is, it can be read, and the next run tries again
        }
      }
      flushFolder(folder);
      takeAway(current);
    }
    for (const fs::path& each : {older, newer})
      removeFolder(each);
    removeFolder(work);
  }

  fs::path folder, work, older, newer, current, decided;
};

bool turnTo(const WorkFolder& at, const char* target) {
  const fs::path turned = at.work / "turned";
  return ::symlink(target, turned.c_str()) == 0 && flushFolder(at.work) && move(turned, at.current);
}

/// The last resort of file systems without links: one file after the other, after a decision that the next run carries
/// out if this one is killed.
Result<void> moveOneByOne(const WorkFolder& at, const Files& files, const std::set<std::string>& dropped) {
  const auto failed = [&] { return failErrno(at.folder, "write into this folder"); };
  if (!at.decide(files, dropped) && !isThere(at.decided)) {
    auto why = failed();
    at.finish();
    return why;
  }
  if (!at.carryOut()) return failed();
  at.finish();
  return {};
}

Result<void> swapWithin(const FolderLock& lock, const Files& files, const std::set<std::string>& dropped,
                        const std::stop_token& stop) {
  const WorkFolder at(lock.folder());
  const auto undo = [&](tl::unexpected<Diagnostic> why) {
    at.finish();
    return why;
  };
  if (!makeFolder(at.work, 0700) || !makeFolder(at.older, 0755) || !makeFolder(at.newer, 0755))
    return undo(failErrno(at.folder, "write into this folder"));
  if (Result<void> written = writeAside(files, at.newer, at.folder, stop); !written)
    return undo(tl::unexpected(std::move(written.error())));
  ::chmod(at.work.c_str(), 0755);
  std::set<std::string> names = dropped;
  for (const auto& [name, content] : files)
    names.insert(name);
  bool linked = true;
  for (const std::string& name : names)
    linked = linked && (!isThere(at.folder / name) || link(at.folder / name, at.older / name));
  linked = linked && flushFolder(at.newer) && flushFolder(at.older) && turnTo(at, "old");
  if (!linked) {
    if (errno == EIO || errno == ENOSPC || errno == EDQUOT) return undo(failErrno(at.folder, "write into this folder"));
    return moveOneByOne(at, files, dropped);
  }
  for (const std::string& name : names) {
    const fs::path turned = at.work / "turned";
    if (::symlink(at.linkTo(name).c_str(), turned.c_str()) != 0 || !move(turned, at.folder / name))
      return undo(failErrno(at.folder / name, "write this file"));
  }
  if (!flushFolder(at.folder) || !turnTo(at, "new")) return undo(failErrno(at.folder, "write into this folder"));
  flushFolder(at.work);
  at.finish();
  return {};
}

// ---- who was killed ----

void clearUp(const fs::path& folder, const std::function<bool(const fs::path&)>& isOurs) {
  const WorkFolder within(folder);
  if (isFolder(within.work)) within.finish();
  const fs::path aside = besideOf(folder);
  if (!isFolder(aside)) return;
  if (isThere(aside / incomplete)) {
    removeFolder(aside);
  } else {
    clearOld(aside, folder, [&](const std::string& name) { return isOurs(aside / name); });
  }
}

}  // namespace

FolderLock::FolderLock(fs::path folder, int descriptor, int made)
    : folder_(std::move(folder)), descriptor_(descriptor), made_(made) {}
FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::move(other.folder_)), descriptor_(std::exchange(other.descriptor_, -1)), made_(other.made_) {}
FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  std::error_code error;
  fs::path folder = folder_;
  for (int i = 0; i < made_ && fs::is_empty(folder, error) && fs::remove(folder, error); ++i)
    folder = folder.parent_path();
  ::close(descriptor_);
}

Result<FolderLock> FolderLock::take(const fs::path& path, const std::function<void()>& onWait,
                                    const std::function<bool(const fs::path&)>& isOurs, const std::stop_token& stop) {
  if (Result<void> writable = checkWritable(path); !writable) return tl::unexpected(std::move(writable.error()));
  std::error_code error;
  int made = 0;
  fs::path missing = fs::weakly_canonical(path, error);
  if (!missing.has_filename()) missing = missing.parent_path();
  for (; !missing.empty() && !fs::exists(missing, error); ++made)
    missing = missing.parent_path();
  fs::create_directories(path, error);
  const fs::path folder = error ? fs::path() : fs::canonical(path, error);
  if (error) {
    return fail({path.string(), 0, 0}, "this folder cannot be made: " + error.message(),
                "name another folder with --out");
  }
  for (bool told = false;;) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    // Whoever made it may have removed it again, as there was nothing to write.
    if (descriptor < 0 && errno == ENOENT && fs::create_directories(folder, error)) continue;
    if (descriptor < 0) return failErrno(path, "open this folder");
    FolderLock lock(folder, descriptor, made);
    while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      if (errno != EWOULDBLOCK) break;  // a file system without locks
      if (onWait && !std::exchange(told, true)) onWait();
      if (stop.stop_requested())
        return fail(SourcePlace{path.string(), 0, 0}, "interrupted: another run writes into this folder");
      ::usleep(20'000);
    }
    // Whoever held it may have exchanged the folder for another one.
    struct stat held {};
    const auto named = identityOf(folder);
    if (::fstat(descriptor, &held) != 0 || !named || *named != FileIdentity{held.st_dev, held.st_ino}) continue;
    clearUp(folder, isOurs);
    return lock;
  }
}

void FolderReading::Closing::operator()(const int* descriptor) const {
  ::close(*descriptor);
  delete descriptor;
}

FolderReading FolderReading::of(const fs::path& path, const std::stop_token& stop,
                                const std::function<void()>& onWait) {
  FolderReading reading;
  const auto begin = std::chrono::steady_clock::now();
  bool told = !onWait;
  const auto waitedLong = [&] {
    constexpr auto patience = std::chrono::seconds(2);
    return !told && std::chrono::steady_clock::now() - begin >= patience && !std::exchange(told, true);
  };
  std::error_code error;
  if (path.empty() || !fs::is_directory(path, error)) return reading;
  // What a killed run has decided, but not done.
  if (isThere(WorkFolder(path).decided))
    static_cast<void>(FolderLock::take(
        path, {}, [](const fs::path&) { return false; }, stop));
  while (!stop.stop_requested()) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return reading;
    reading.held_.reset(new int(descriptor));
    while (::flock(descriptor, LOCK_SH | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      if (errno != EWOULDBLOCK || stop.stop_requested()) return reading;
      if (waitedLong()) onWait();
      ::usleep(20'000);
    }
    struct stat held {};
    const auto named = identityOf(path);
    if (named && ::fstat(descriptor, &held) == 0 && *named == FileIdentity{held.st_dev, held.st_ino}) return reading;
  }
  return reading;
}

bool isOnItsWay(const fs::path& file) {
  std::error_code error;
  const fs::path target = fs::read_symlink(file, error);
  return !error && target == WorkFolder(file.parent_path()).linkTo(file.filename().string());
}

Result<void> swapFiles(const FolderLock& lock, const Files& files, const std::set<std::string>& dropped,
                       const std::stop_token& stop) {
  const std::string* blocked = nullptr;
  for (const auto& [name, content] : files) {
    if (isFolder(lock.folder() / name)) blocked = &name;
  }
  if (blocked != nullptr) {
    return fail(SourcePlace{(lock.folder() / *blocked).string(), 0, 0}, "cannot write this file: a folder has its name",
                "rename the folder, or name another one with --out");
  }
  if (canBeExchanged(lock.folder())) {
    Result<Way> way = exchangeFolders(lock, files, dropped, stop);
    if (!way) return tl::unexpected(std::move(way.error()));
    if (*way == Way::Done) return {};
  }
  return swapWithin(lock, files, dropped, stop);
}

}  // namespace probewright
