/// Loaded before a program (LD_PRELOAD), counts its calls that change files and lets one of them fail.
///   FAIL_AT=n     the n-th, from 1
///   FAIL_HOW=kill the process is killed in front of it; otherwise the number of an error that the call returns
///   FAIL_SYNC=n   the n-th fsync, from 1, fails with EIO
///   FAIL_LINKS=1  as on a file system that knows neither links nor exchanging: those calls fail with EPERM, uncounted
///   FAIL_COUNT=f  the number of calls goes to the file f when the process ends
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

long calls = 0, syncs = 0;

long number(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? 0 : std::strtol(text, nullptr, 10);
}

/// True if this call is to fail; errno says how.
bool fails() {
  if (++calls != number("FAIL_AT")) return false;
  const char* how = std::getenv("FAIL_HOW");
  if (how == nullptr || std::strcmp(how, "kill") == 0) {
    ::kill(::getpid(), SIGKILL);
    ::pause();
  }
  errno = std::atoi(how);
  return true;
}

bool refusesLinks() {
  if (number("FAIL_LINKS") == 0) return false;
  errno = EPERM;
  return true;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool isRegular(int descriptor) {
  struct stat status {};
  return descriptor > 2 && ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

__attribute__((destructor)) void report() {
  const char* path = std::getenv("FAIL_COUNT");
  if (path == nullptr) return;
  char text[32];
  const int length = std::snprintf(text, sizeof text, "%ld", calls);
  const long file = ::syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file >= 0) ::syscall(SYS_write, file, text, length);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    va_list rest;
    va_start(rest, flags);
    mode = va_arg(rest, mode_t);
    va_end(rest);
    if (fails()) return -1;
  }
  return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (isRegular(descriptor) && fails()) return -1;
  return ::syscall(SYS_write, descriptor, bytes, size);
}
int fsync(int) {
  if (++syncs == number("FAIL_SYNC")) {
    errno = EIO;
    return -1;
  }
  return fails() ? -1 : 0;  // a process that is killed loses nothing that it has written
}
int fchmod(int descriptor, mode_t mode) { return fails() ? -1 : real<int(int, mode_t)>("fchmod")(descriptor, mode); }
int chmod(const char* path, mode_t mode) { return fails() ? -1 : real<int(const char*, mode_t)>("chmod")(path, mode); }
int mkdir(const char* path, mode_t mode) { return fails() ? -1 : real<int(const char*, mode_t)>("mkdir")(path, mode); }
int rmdir(const char* path) { return fails() ? -1 : real<int(const char*)>("rmdir")(path); }
int unlink(const char* path) { return fails() ? -1 : real<int(const char*)>("unlink")(path); }
int symlink(const char* target, const char* path) {
  if (refusesLinks()) return -1;
  return fails() ? -1 : real<int(const char*, const char*)>("symlink")(target, path);
}
int linkat(int from, const char* path, int to, const char* name, int flags) {
  if (refusesLinks()) return -1;
  return fails() ? -1 : real<int(int, const char*, int, const char*, int)>("linkat")(from, path, to, name, flags);
}
int rename(const char* from, const char* to) {
  return fails() ? -1 : real<int(const char*, const char*)>("rename")(from, to);
}
int renameat2(int from, const char* path, int to, const char* name, unsigned flags) {
  if (refusesLinks()) return -1;
  return fails() ? -1
                 : real<int(int, const char*, int, const char*, unsigned)>("renameat2")(from, path, to, name, flags);
}
}
