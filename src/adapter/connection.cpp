#include "adapter/connection.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "base/number_text.hpp"

extern char** environ;

namespace probewright::adapter {
namespace {

namespace fs = std::filesystem;

bool isSocket(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
}

/// A program that was started. It ends by itself when its connection is closed, and gets time for it.
class AdapterProcess {
public:
  explicit AdapterProcess(pid_t process) : process_(process) {}
  AdapterProcess(const AdapterProcess&) = delete;
  AdapterProcess& operator=(const AdapterProcess&) = delete;
  ~AdapterProcess() {
    if (endsWithin(std::chrono::seconds(5))) return;
    kill(process_, SIGTERM);
    if (endsWithin(std::chrono::seconds(2))) return;
    kill(process_, SIGKILL);
    endsWithin(std::chrono::seconds(2));
  }

private:
  bool endsWithin(std::chrono::milliseconds patience) const {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (true) {
      const pid_t ended = waitpid(process_, nullptr, WNOHANG);
      if (ended == process_ || (ended < 0 && errno != EINTR)) return true;
      if (std::chrono::steady_clock::now() > until) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  pid_t process_;
};

Result<Connection> inherited(const std::string& number) {
  const auto descriptor = parseInteger(number);
  if (!descriptor || *descriptor < 3 || *descriptor > 1'000'000 || !isSocket(static_cast<int>(*descriptor))) {
    return fail(fmt::format("fd:{} is not an open socket", number),
                "start this program with one end of a socket as this file descriptor");
  }
  fcntl(static_cast<int>(*descriptor), F_SETFD, FD_CLOEXEC);
  return Connection{nullptr, LineStream(static_cast<int>(*descriptor))};
}

Result<Connection> atPath(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    return fail(fmt::format("the path of the socket is too long: {}", path), "use one of less than 100 letters");
  std::memcpy(address.sun_path, path.c_str(), path.size());
  const int end = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (end < 0 || ::connect(end, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const int why = errno;
    if (end >= 0) close(end);
    return fail(fmt::format("nothing answers at the socket {}: {}", path, std::strerror(why)),
                "start the machine adapter first");
  }
  return Connection{nullptr, LineStream(end)};
}

/// `name` in the folder of this program if it is there, else as it is.
std::string program(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  std::error_code ignored;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path() / name;
  return access(beside.c_str(), X_OK) == 0 ? beside.string() : name;
}

Result<Connection> started(const std::string& command) {
  std::vector<std::string> words;
  std::istringstream text(command);
  for (std::string word; text >> word;)
    words.push_back(word);
  if (words.empty()) return fail("the machine adapter has no name", "name its program, or linuxcnc");
  words.front() = program(words.front());
  std::array<int, 2> ends{-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return fail(fmt::format("there is no socket for the machine adapter: {}", std::strerror(errno)));
  LineStream stream(ends[0]);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  // A Ctrl-C reaches this program alone, which then has the adapter stop the axes.
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t byDefault;
  sigemptyset(&byDefault);
  sigaddset(&byDefault, SIGINT);
  sigaddset(&byDefault, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &byDefault);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int error = posix_spawnp(&process, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[1]);
  if (error != 0) {
    return fail(fmt::format("the machine adapter {} cannot be started: {}", words.front(), std::strerror(error)),
                "see docs/machine-adapters.md for what can be named");
  }
  return Connection{std::make_shared<AdapterProcess>(process), std::move(stream)};
}

}  // namespace

Result<Connection> connect(const std::string& where) {
  if (where.starts_with("fd:")) return inherited(where.substr(3));
  struct stat status {};
  if (where.find('/') != std::string::npos && stat(where.c_str(), &status) == 0 && S_ISSOCK(status.st_mode))
    return atPath(where);
  return started(where == "linuxcnc" ? "probewright-linuxcnc" : where);
}

}  // namespace probewright::adapter
