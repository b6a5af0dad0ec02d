#pragma once

#include <memory>
#include <string_view>

#include "base/sink.hpp"

namespace probewright::reports {

/// Text on its way into a page: compressed (zlib, RFC 1950) and written as base64, which may stand in any element.
/// Browsers read it with DecompressionStream("deflate").
class PackedText {
public:
  explicit PackedText(const Sink& sink);
  PackedText(const PackedText&) = delete;
  PackedText& operator=(const PackedText&) = delete;
  ~PackedText();

  void add(std::string_view text);
  /// To be called once, at the end.
  void finish();

private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace probewright::reports
