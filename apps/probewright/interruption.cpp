#include "interruption.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

namespace probewright::app {
namespace {

/// The handler's and the watcher's end of a pipe.
std::array<int, 2> ends{-1, -1};

constexpr char kInterrupted = 'i';
constexpr char kOver = 'o';

void tell(char what) { static_cast<void>(write(ends[1], &what, 1) == 1); }

extern "C" void onInterrupt(int) {
  const int before = errno;
  tell(kInterrupted);
  errno = before;
}

}  // namespace

Interruption::Interruption() {
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
  watcher_ = std::thread([this] {
    char what = 0;
    ssize_t count = 0;
    while ((count = read(ends[0], &what, 1)) == 1 || (count < 0 && errno == EINTR)) {
      if (count == 1 && what == kOver) return;
      if (count == 1) source_.request_stop();
    }
  });
  struct sigaction action {};
  action.sa_handler = onInterrupt;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
}

Interruption::~Interruption() {
  std::signal(SIGINT, SIG_DFL);
  tell(kOver);
  watcher_.join();
  for (int& end : ends) {
    close(end);
    end = -1;
  }
}

}  // namespace probewright::app
