#include "adapter/line_stream.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

namespace probewright::adapter {

LineStream::LineStream(int socket) : socket_(socket) {
  const timeval patience{10, 0};
  setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
}

LineStream::LineStream(LineStream&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      read_(std::move(other.read_)),
      searched_(std::exchange(other.searched_, 0)) {}

LineStream& LineStream::operator=(LineStream&& other) noexcept {
  std::swap(socket_, other.socket_);
  std::swap(read_, other.read_);
  std::swap(searched_, other.searched_);
  return *this;
}

LineStream::~LineStream() {
  if (socket_ >= 0) close(socket_);
}

bool LineStream::send(std::string_view line) {
  std::string text(line);
  text += '\n';
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t sent = ::send(socket_, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    rest.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

LineStream::Got LineStream::receive(std::string& line, std::chrono::milliseconds patience, int wake) {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (true) {
    if (const std::size_t end = read_.find('\n', searched_); end != std::string::npos) {
      line.assign(read_, 0, end);
      read_.erase(0, end + 1);
      searched_ = 0;
      return Got::Line;
    }
    searched_ = read_.size();
    if (read_.size() > longestLine) return Got::Closed;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    std::array<pollfd, 2> waits{{{socket_, POLLIN, 0}, {wake, POLLIN, 0}}};
    const int ready = poll(waits.data(), waits.size(), left.count() > 0 ? static_cast<int>(left.count()) : 0);
    if (ready < 0 && errno == EINTR) continue;
    if (ready < 0) return Got::Closed;
    if (ready == 0) return Got::Nothing;
    // A stop goes first: what has been received by then is still there afterwards.
    if ((waits[1].revents & POLLIN) != 0) return Got::Woken;
    std::array<char, 65536> bytes;
    const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return Got::Closed;
    read_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

void LineStream::hangUp() { shutdown(socket_, SHUT_RDWR); }

}  // namespace probewright::adapter
