// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

extern char** environ;

EngineProcess::~EngineProcess() {
  hangUp();
  exitCode(0);
  if (said_ >= 0) close(said_);
}

bool EngineProcess::start(const std::vector<std::string>& words, std::string& why) {
  std::array<int, 2> ends{};
  said_ = memfd_create("probewright", MFD_CLOEXEC);
  if (said_ < 0 || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    why = std::strerror(errno);
    return false;
  }
  std::vector<char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, said_, 2);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 3);
  // LinuxCNC's signals are not meant for it; it ends when its socket is closed.
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  const int error = posix_spawnp(&process_, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    process_ = 0;
    why = words.front() + ": " + std::strerror(error);
    return false;
  }
  socket_ = ends[0];
  return true;
}

EngineProcess::Got EngineProcess::receive(Json& order, int milliseconds) {
  while (socket_ >= 0) {
    if (const std::size_t end = rest_.find('\n'); end != std::string::npos) {
      order = Json::parse(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
      rest_.erase(0, end + 1);
      if (order.is_object() && order.value("do", "") != "stop") return Got::Order;
      continue;
    }
    pollfd wait{socket_, POLLIN, 0};
    const int ready = poll(&wait, 1, milliseconds);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return Got::Nothing;
    std::array<char, 65536> bytes;
    const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    rest_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return Got::Ended;
}

void EngineProcess::answer(const Json& order, Json answer) {
  answer["id"] = order.at("id");
  send(answer.dump() + "\n");
}

void EngineProcess::alive(const Json& order) { send(Json{{"alive", order.at("id")}}.dump() + "\n"); }

void EngineProcess::send(const std::string& line) {
  for (std::size_t sent = 0; socket_ >= 0 && sent < line.size();) {
    const ssize_t count = ::send(socket_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

void EngineProcess::hangUp() {
  if (socket_ >= 0) close(std::exchange(socket_, -1));
}

int EngineProcess::exitCode(int milliseconds) {
  for (int waited = 0; process_ > 0; waited += 5) {
    int status = 0;
    if (waitpid(process_, &status, WNOHANG) == process_) {
      process_ = 0;
      code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 4;
      break;
    }
    if (waited >= milliseconds) return -1;
    usleep(5000);
  }
  return code_;
}

std::string EngineProcess::messages() const {
  std::string text(8192, '\0');
  const ssize_t count = said_ < 0 ? 0 : pread(said_, text.data(), text.size(), 0);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}
