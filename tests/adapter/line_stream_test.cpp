#include "adapter/line_stream.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>

namespace probewright::adapter {
namespace {

/// A signal that comes while the other end reads slowly, of a timer or of a window that changes its size, loses
/// nothing.
TEST(LineStream, SendsALineWholeThoughSignalsInterruptIt) {
  struct sigaction counting {};
  struct sigaction before {};
  static std::atomic<int> caught;
  caught = 0;
  counting.sa_handler = [](int) { ++caught; };
  ASSERT_EQ(sigaction(SIGUSR1, &counting, &before), 0);
  std::array<int, 2> ends{};
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  std::string line(1U << 20U, 'x');
  for (std::size_t i = 0; i < line.size(); ++i)
    line[i] = static_cast<char>('a' + i % 23);
  std::atomic<bool> whole = false, done = false;
  {
    LineStream stream(ends[0]);
    std::thread sender([&] {
      whole = stream.send(line);
      done = true;
    });
    // The buffer is full long before the line ends: until somebody reads each signal meets a waiting send().
    for (int i = 0; i < 20; ++i) {
      ::usleep(2000);
      pthread_kill(sender.native_handle(), SIGUSR1);
    }
    EXPECT_GT(caught, 0);
    EXPECT_FALSE(done) << "it gave up, or nobody had to wait";
    std::string read;
    std::array<char, 65536> bytes{};
    while (read.size() < line.size() + 1) {
      const ssize_t count = ::recv(ends[1], bytes.data(), bytes.size(), done ? MSG_DONTWAIT : 0);
      if (count <= 0) break;
      read.append(bytes.data(), static_cast<std::size_t>(count));
    }
    sender.join();
    EXPECT_TRUE(whole);
    EXPECT_EQ(read, line + "\n");
  }
  close(ends[1]);
  sigaction(SIGUSR1, &before, nullptr);
}

/// Nothing comes in time: that is said, whatever was interrupted before.
TEST(LineStream, SaysThatNothingCameInTime) {
  std::array<int, 2> ends{};
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  LineStream stream(ends[0]);
  std::string line;
  errno = EINTR;
  EXPECT_EQ(stream.receive(line, std::chrono::milliseconds(5), -1), LineStream::Got::Nothing);
  ASSERT_EQ(::send(ends[1], "a\nb", 3, 0), 3);
  EXPECT_EQ(stream.receive(line, std::chrono::milliseconds(1000), -1), LineStream::Got::Line);
  EXPECT_EQ(line, "a");
  errno = EINTR;
  EXPECT_EQ(stream.receive(line, std::chrono::milliseconds(5), -1), LineStream::Got::Nothing) << "half a line";
  close(ends[1]);
  EXPECT_EQ(stream.receive(line, std::chrono::milliseconds(1000), -1), LineStream::Got::Closed);
}

}  // namespace
}  // namespace probewright::adapter
