#pragma once

#include <chrono>
#include <string>
#include <string_view>

/// Lines of text over a socket: what the protocol of machine adapters travels on.
namespace probewright::adapter {

/// One end of a connected local socket; closes it.
class LineStream {
public:
  /// No line is longer, bytes: a path of many thousand pieces is one line.
  static constexpr std::size_t longestLine = std::size_t{64} << 20U;

  /// Takes the descriptor.
  explicit LineStream(int socket);
  LineStream(LineStream&& other) noexcept;
  LineStream& operator=(LineStream&& other) noexcept;
  LineStream(const LineStream&) = delete;
  LineStream& operator=(const LineStream&) = delete;
  ~LineStream();

  /// Sends the line and its end. False if nobody is at the other end, or takes nothing for 10 s.
  bool send(std::string_view line);

  enum class Got {
    Line,
    Nothing,  ///< in the time given
    Woken,    ///< there is something to read at `wake`
    Closed,   ///< by the other end, by an error, or because a line has no end
  };
  /// The next line without its end. A descriptor `wake` ends the wait, too; -1: there is none.
  Got receive(std::string& line, std::chrono::milliseconds patience, int wake = -1);

  /// Nothing more is sent or received; a receive() under way in another thread returns Closed.
  void hangUp();

private:
  int socket_ = -1;
  std::string read_;          ///< received, not yet given out
  std::size_t searched_ = 0;  ///< of it, without the end of a line
};

}  // namespace probewright::adapter
