#include "base/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/unfinished.hpp"

namespace probewright {

namespace {

/// Closes the file at the end of its scope.
class Descriptor {
public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

private:
  int number_;
};

const char* adviceFor(int reason) {
  switch (reason) {
    case EACCES:
    case EPERM:
    case EROFS:
      return "change its permissions, or name another file or folder";
    case ENOSPC:
    case EDQUOT:
      return "make room on this disk, or name a folder on another one";
    case EIO:
      return "the disk or the network reports an error; name a folder on another one";
    default:
      return "";
  }
}

/// Why a file of this mode cannot be read; nothing if it can.
std::optional<tl::unexpected<Diagnostic>> whyNotReadable(const std::filesystem::path& path, mode_t mode) {
  const auto refuse = [&](const char* message) {
    return fail(SourcePlace{path.string(), 0, 0}, message, "name a file, or a pipe that a program writes into");
  };
  if (S_ISDIR(mode)) return refuse("this is a folder, a file was expected");
  if (S_ISREG(mode) || S_ISFIFO(mode)) return std::nullopt;
  return refuse("this is a device, a file was expected");
}

/// Waits until the pipe has something to read, or has ended. False, with errno, if the wait was interrupted.
bool awaitPipe(int descriptor) {
  pollfd waited{descriptor, POLLIN, 0};
  return ::poll(&waited, 1, -1) >= 0;
}

}  // namespace

tl::unexpected<Diagnostic> failErrno(const std::filesystem::path& path, std::string_view doing) {
  const int reason = errno;
  return fail(SourcePlace{path.string(), 0, 0}, fmt::format("cannot {}: {}", doing, std::strerror(reason)),
              adviceFor(reason));
}

bool writeAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

Result<std::string> readFile(const std::filesystem::path& path, std::uint64_t most) {
  // Without O_NONBLOCK a pipe that nothing writes into would hold up the program here for ever.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  struct stat status {};
  if (file.number() < 0) {
    if (errno != ENXIO) return failErrno(path, "open this file");
    return fail(SourcePlace{path.string(), 0, 0}, "this is a socket, a file was expected", "name a file");
  }
  if (::fstat(file.number(), &status) != 0) return failErrno(path, "read this file");
  if (auto why = whyNotReadable(path, status.st_mode)) return std::move(*why);
  const bool pipe = S_ISFIFO(status.st_mode);
  const auto tooLarge = [&] {
    return fail(SourcePlace{path.string(), 0, 0}, fmt::format("this file is larger than {} MB", most >> 20U),
                "check that this is the right file");
  };
  std::string bytes;
  if (!pipe && status.st_size > 0) {
    if (static_cast<std::uint64_t>(status.st_size) > most) return tooLarge();
    bytes.reserve(static_cast<std::size_t>(status.st_size));
  }
  for (char part[1 << 16];;) {
    const ssize_t count = ::read(file.number(), part, sizeof part);
    if (count == 0) break;
    if (count < 0 && errno == EAGAIN && pipe) {
      if (!awaitPipe(file.number())) return failErrno(path, "read this pipe");
      continue;
    }
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failErrno(path, "read this file");
    bytes.append(part, static_cast<std::size_t>(count));
    if (bytes.size() > most) return tooLarge();
  }
  if (pipe && bytes.empty()) {
    return fail(SourcePlace{path.string(), 0, 0}, "this is a pipe, and nothing writes into it",
                "name a file, or start the program that writes into the pipe first");
  }
  return bytes;
}

std::optional<FileIdentity> identityOf(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino};
}

Result<void> writeFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return fail(SourcePlace{path.string(), 0, 0}, "cannot write this file: a folder has its name");
  }
  return replaceFile(path, bytes, [] { return Result<void>(); });
}

}  // namespace probewright
