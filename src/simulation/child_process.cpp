#include "simulation/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <new>

#include "base/file.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PROBEWRIGHT_ADDRESS_SANITIZER 1
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define PROBEWRIGHT_ADDRESS_SANITIZER 1
#endif

namespace probewright::simulation {
namespace {

constexpr int kExitOutOfMemory = 90;
constexpr int kExitException = 91;

class Descriptor {
public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

private:
  int number_;
};

/// What limitMemory() has granted; 0: no limit.
std::uint64_t grantedBytes = 0;

void limitMemory(std::uint64_t bytes) {
#ifdef PROBEWRIGHT_ADDRESS_SANITIZER
  static_cast<void>(bytes);  // the sanitizer's own tables take far more address space than memory
#else
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;  // the address space that this process has already
  const std::uint64_t most = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit limit{most, most};
  if (setrlimit(RLIMIT_AS, &limit) == 0) grantedBytes = bytes;
#endif
}

/// Everything that a child does before its work.
void settleIn(pid_t parent, const ChildLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kExitException);  // it has died already
  for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPIPE, SIGHUP})
    std::signal(signal, SIG_DFL);
  const rlimit noCore{0, 0};
  setrlimit(RLIMIT_CORE, &noCore);
  limitMemory(limits.bytes);
  const int nowhere = open("/dev/null", O_RDWR);
  if (nowhere < 0) return;
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

std::string pathOf(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

[[noreturn]] void live(const std::function<std::string(const ChildVoice&)>& work, int voice, int result) {
  try {
    const std::string bytes = work(ChildVoice(voice));
    std::ofstream file(pathOf(result), std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    _exit(file.good() ? 0 : kExitOutOfMemory);
  } catch (const std::bad_alloc&) {
    _exit(kExitOutOfMemory);
  } catch (...) {
    _exit(kExitException);
  }
}

/// Gives the lines of a stream of bytes to `heard`, however they come in.
class Lines {
public:
  explicit Lines(const std::function<void(std::string_view)>& heard) : heard_(heard) {}

  void add(std::string_view bytes) {
    pending_ += bytes;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = pending_.find('\n', begin)) != std::string::npos; begin = end + 1)
      heard_(std::string_view(pending_).substr(begin, end - begin));
    pending_.erase(0, begin);
  }

private:
  const std::function<void(std::string_view)>& heard_;
  std::string pending_;
};

/// The processor's time that a process has used; 0 if it is not there any more.
double processorSecondsOf(pid_t process) {
  clockid_t clock = 0;
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Listens until the child closes its end; how it ended if that was by the parent's will.
ChildEnd::How listen(pid_t child, int voice, const ChildLimits& limits,
                     const std::function<void(std::string_view)>& heard, const std::function<bool(double)>& enough) {
  using Clock = std::chrono::steady_clock;
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.seconds));
  Lines lines(heard);
  std::array<char, 4096> buffer;
  for (;;) {
    pollfd waiting{voice, POLLIN, 0};
    if (poll(&waiting, 1, 50) > 0) {
      const ssize_t count = read(voice, buffer.data(), buffer.size());
      if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) return ChildEnd::How::Finished;
      if (count > 0) lines.add({buffer.data(), static_cast<std::size_t>(count)});
    }
    const bool late = Clock::now() > end;
    if (!late && !enough(processorSecondsOf(child))) continue;
    kill(child, SIGKILL);
    return late ? ChildEnd::How::OutOfTime : ChildEnd::How::Ended;
  }
}

}  // namespace

bool ranShortOfMemory() {
  rlimit limit{};
  if (grantedBytes == 0 || getrlimit(RLIMIT_AS, &limit) != 0) return false;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kilobytes = 0;
    if (word == "VmPeak:" && status >> kilobytes) return kilobytes * 1024 + grantedBytes / 4 > limit.rlim_cur;
  }
  return false;
}

void ChildVoice::say(std::string_view line) const {
  std::string text(line.substr(0, 1000));
  std::replace(text.begin(), text.end(), '\n', ' ');
  text += '\n';
  // Shorter than what a pipe takes in one piece, so lines of several threads do not mix.
  static_cast<void>(write(descriptor_, text.data(), text.size()) == 0);
}

ChildEnd inChild(const std::function<std::string(const ChildVoice&)>& work, const ChildLimits& limits,
                 const std::function<void(std::string_view line)>& heard,
                 const std::function<bool(double processorSeconds)>& enough) {
  ChildEnd end;
  end.how = ChildEnd::How::NoProcess;
  std::array<int, 2> ends{-1, -1};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    end.result = std::strerror(errno);
    return end;
  }
  Descriptor hear(ends[0]), speak(ends[1]), result(memfd_create("probewright import", MFD_CLOEXEC));
  const pid_t parent = getpid();
  const pid_t child = result.number() < 0 ? -1 : fork();
  if (child < 0) {
    end.result = std::strerror(errno);
    return end;
  }
  if (child == 0) {
    settleIn(parent, limits);
    live(work, speak.number(), result.number());
  }
  speak.close();
  end.how = listen(child, hear.number(), limits, heard, enough);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (end.how != ChildEnd::How::Finished) return end;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    Result<std::string> bytes = readFile(pathOf(result.number()));
    if (bytes) end.result = std::move(*bytes);
    return end;
  }
  end.how = WIFEXITED(status) && WEXITSTATUS(status) == kExitOutOfMemory ? ChildEnd::How::OutOfMemory
                                                                         : ChildEnd::How::Crashed;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return end;
}

}  // namespace probewright::simulation
