#include "reports/packed_text.hpp"

#include <zlib.h>

#include <array>
#include <stdexcept>
#include <string>

#include "reports/base64.hpp"

namespace probewright::reports {

namespace {

constexpr int level = 6;
constexpr std::size_t bufferSize = std::size_t{3} << 14U;  // whole groups of base64
// zlib counts in 32 bits.
constexpr std::size_t largestPiece = std::size_t{1} << 30U;

}  // namespace

struct PackedText::State {
  explicit State(const Sink& out) : sink(out) {
    if (deflateInit(&stream, level) != Z_OK) throw std::runtime_error("no memory for compression");
    restart();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { deflateEnd(&stream); }

  void restart() {
    stream.next_out = buffer.data();
    stream.avail_out = static_cast<uInt>(buffer.size());
  }

  void write() {
    const std::size_t filled = buffer.size() - stream.avail_out;
    sink(base64(std::string_view(reinterpret_cast<const char*>(buffer.data()), filled)));
    restart();
  }

  /// Compresses what is at stream.next_in. True if the end of the compressed text was reached.
  bool run(int flush) {
    int result = Z_OK;
    do {
      result = deflate(&stream, flush);
      if (stream.avail_out == 0) write();
    } while (stream.avail_in > 0 || (flush == Z_FINISH && result != Z_STREAM_END));
    return result == Z_STREAM_END;
  }

  const Sink& sink;
  z_stream stream{};
  std::array<Bytef, bufferSize> buffer{};
};

PackedText::PackedText(const Sink& sink) : state_(std::make_unique<State>(sink)) {}
PackedText::~PackedText() = default;

void PackedText::add(std::string_view text) {
  while (!text.empty()) {
    const std::string_view piece = text.substr(0, largestPiece);
    // zlib only reads from it.
    state_->stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
    state_->stream.avail_in = static_cast<uInt>(piece.size());
    state_->run(Z_NO_FLUSH);
    text.remove_prefix(piece.size());
  }
}

void PackedText::finish() {
  state_->stream.avail_in = 0;
  state_->run(Z_FINISH);
  state_->write();
}

}  // namespace probewright::reports
