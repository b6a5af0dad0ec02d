#include "base/writable_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace probewright {

namespace fs = std::filesystem;

namespace {

constexpr const char* wayOut = "change its permissions, or name another folder with --out";

/// errno of a new file in this folder; 0 if there can be one.
int whyNoFileIn(const fs::path& folder) {
  // A file without a name is gone as soon as it is closed, whatever ends this process.
  const int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (file >= 0) {
    ::close(file);
    return 0;
  }
  if (errno == ENOSPC || errno == EDQUOT || errno == EIO) return errno;
  // Not every file system has such files.
  return ::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) == 0 ? 0 : errno;
}

tl::unexpected<Diagnostic> cannotBeMade(const fs::path& folder, const std::string& reason, const char* advice) {
  return fail({folder.string(), 0, 0}, "this folder cannot be made: " + reason, advice);
}

}  // namespace

Result<void> checkWritable(const fs::path& folder) {
  constexpr const char* another = "name another folder with --out";
  if (folder.empty()) return cannotBeMade(folder, "its name is empty", another);
  struct stat status {};
  if (::stat(folder.c_str(), &status) == 0) {
    if (!S_ISDIR(status.st_mode)) return cannotBeMade(folder, "a file has its name", another);
    const int reason = whyNoFileIn(folder);
    if (reason == 0) return {};
    return fail({folder.string(), 0, 0}, std::string("cannot write into this folder: ") + std::strerror(reason),
                wayOut);
  }
  // The folder that is there and that the first of the missing ones would be made in.
  for (fs::path path = folder;;) {
    if (errno != ENOENT) return cannotBeMade(folder, path.string() + ": " + std::strerror(errno), another);
    if (::lstat(path.c_str(), &status) == 0)
      return cannotBeMade(folder,
                          path == folder ? "its name is a symbolic link that leads nowhere"
                                         : path.string() + " is a symbolic link that leads nowhere",
                          another);
    const fs::path above = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (above != path && ::stat(above.c_str(), &status) != 0) {
      path = above;
      continue;
    }
    if (!S_ISDIR(status.st_mode)) return cannotBeMade(folder, above.string() + " is a file", another);
    const int reason = whyNoFileIn(above);
    return reason == 0 ? Result<void>()
                       : cannotBeMade(folder,
                                      "nothing can be written into " + fs::absolute(above).string() + ": " +
                                          std::strerror(reason),
                                      wayOut);
  }
}

}  // namespace probewright
