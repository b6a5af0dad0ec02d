#include "simulation/child_process.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <limits>
#include <new>

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

/// What is freed stays with the process, for what it asks for next: a new page costs more than what is written to it.
void keepFreedMemory() {
#ifdef M_TRIM_THRESHOLD
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // bytes; the most that the library takes
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
  keepFreedMemory();
  const int nowhere = open("/dev/null", O_RDWR);
  if (nowhere < 0) return;
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

/// What begins a line that is about bytes handed over.
constexpr char kHanding = '\x01';

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

/// What a line of the child hands over; nothing if it is not about that, or not true.
HandedBytes handedBy(std::string_view line, int store) {
  std::uint64_t at = 0, size = 0;
  const char* const end = line.data() + line.size();
  const auto [blank, error] = std::from_chars(line.data() + 2, end, at);
  if (error != std::errc{} || blank == end || std::from_chars(blank + 1, end, size).ec != std::errc{}) return {};
  struct stat file {};
  if (size == 0 || fstat(store, &file) != 0 || at + size > static_cast<std::uint64_t>(file.st_size)) return {};
  void* const pages = mmap(nullptr, size, PROT_READ, MAP_SHARED | MAP_POPULATE, store, static_cast<off_t>(at));
  if (pages == MAP_FAILED) throw std::bad_alloc();
  return {std::shared_ptr<const void>(pages, [size](const void* begin) { munmap(const_cast<void*>(begin), size); }),
          std::string_view(static_cast<const char*>(pages), size)};
}

/// The processor's time that a process has used; 0 if it is not there any more.
double processorSecondsOf(pid_t process) {
  clockid_t clock = 0;
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What the parent of a child has of it.
struct Ears {
  int voice;
  int store;
  const std::function<void(std::string_view)>& heard;
  const std::function<bool(double)>& enough;
  const std::function<bool(HandedBytes)>& given;
};

/// How a parent stopped listening.
struct Heard {
  ChildEnd::How how = ChildEnd::How::Finished;
  bool all = false;    ///< there was nothing more to hear
  std::string result;  ///< of the work
};

/// Listens until the child closes its end or has given all, or the parent has enough.
Heard listen(pid_t child, const Ears& ears, const ChildLimits& limits) {
  using Clock = std::chrono::steady_clock;
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.seconds));
  Heard told;
  const std::function<void(std::string_view)> sort = [&](std::string_view line) {
    if (line.size() < 2 || line[0] != kHanding) return ears.heard(line);
    const HandedBytes bytes = handedBy(line, ears.store);
    if (line[1] == '=')
      told.result = bytes.view();
    else if (ears.given && ears.given(bytes))
      told.all = true;
  };
  Lines lines(sort);
  std::array<char, 4096> buffer;
  for (;;) {
    pollfd waiting{ears.voice, POLLIN, 0};
    if (poll(&waiting, 1, 50) > 0) {
      const ssize_t count = read(ears.voice, buffer.data(), buffer.size());
      if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) return told;
      if (count > 0) lines.add({buffer.data(), static_cast<std::size_t>(count)});
    }
    const bool late = !told.all && Clock::now() > end;
    if (!late && !told.all && !ears.enough(processorSecondsOf(child))) continue;
    kill(child, SIGKILL);
    if (!told.all) told.how = late ? ChildEnd::How::OutOfTime : ChildEnd::How::Ended;
    return told;
  }
}

}  // namespace

/// The child's way from its birth to its end.
struct ChildLife {
  [[noreturn]] static void live(const std::function<std::string(const ChildVoice&)>& work, const ChildVoice& voice) {
    try {
      const std::string bytes = work(voice);
      if (!bytes.empty()) voice.hand('=', bytes);
      _exit(0);
    } catch (const std::bad_alloc&) {
      _exit(kExitOutOfMemory);
    } catch (...) {
      _exit(kExitException);
    }
  }
};

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

void ChildVoice::hand(char kind, std::string_view bytes) const {
  struct stat file {};
  if (bytes.empty() || fstat(store_, &file) != 0) return;
  // Pages are what can be handed over without a copy.
  const off_t page = sysconf(_SC_PAGESIZE), at = (file.st_size + page - 1) / page * page;
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = pwrite(store_, bytes.data() + done, bytes.size() - done, at + static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw std::bad_alloc();
    done += static_cast<std::size_t>(count);
  }
  say(std::string{kHanding, kind} + std::to_string(at) + ' ' + std::to_string(bytes.size()));
}

ChildEnd inChild(const std::function<std::string(const ChildVoice&)>& work, const ChildLimits& limits,
                 const std::function<void(std::string_view line)>& heard,
                 const std::function<bool(double processorSeconds)>& enough,
                 const std::function<bool(HandedBytes bytes)>& given) {
  ChildEnd end;
  end.how = ChildEnd::How::NoProcess;
  std::array<int, 2> ends{-1, -1};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    end.result = std::strerror(errno);
    return end;
  }
  Descriptor hear(ends[0]), speak(ends[1]), store(memfd_create("probewright import", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  // What the parent reads cannot go away, whatever a child does that has lost its way.
  if (store.number() >= 0) fcntl(store.number(), F_ADD_SEALS, F_SEAL_SHRINK);
  const pid_t parent = getpid();
  const pid_t child = store.number() < 0 ? -1 : fork();
  if (child < 0) {
    end.result = std::strerror(errno);
    return end;
  }
  if (child == 0) {
    settleIn(parent, limits);
    ChildLife::live(work, ChildVoice(speak.number(), store.number()));
  }
  speak.close();
  Heard told;
  std::exception_ptr failure;
  try {
    told = listen(child, {hear.number(), store.number(), heard, enough, given}, limits);
  } catch (...) {
    failure = std::current_exception();
    kill(child, SIGKILL);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (failure) std::rethrow_exception(failure);
  end.how = told.how;
  end.result = std::move(told.result);
  if (told.how != ChildEnd::How::Finished || told.all) return end;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return end;
  end.how = WIFEXITED(status) && WEXITSTATUS(status) == kExitOutOfMemory ? ChildEnd::How::OutOfMemory
                                                                         : ChildEnd::How::Crashed;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return end;
}

}  // namespace probewright::simulation
