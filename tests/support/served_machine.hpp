#pragma once

#include <sys/socket.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "adapter/connection.hpp"
#include "adapter/serve.hpp"

namespace probewright::testing_support {

/// Two ends of a socket.
inline std::pair<adapter::LineStream, adapter::LineStream> streamPair() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) throw std::runtime_error("socketpair");
  return {adapter::LineStream(ends[0]), adapter::LineStream(ends[1])};
}

/// The way to an adapter that plays `machine`, in a thread of its own.
inline adapter::Connection served(std::unique_ptr<machine::Machine> machine) {
  auto [engine, other] = streamPair();
  auto thread = std::make_shared<std::jthread>([machine = std::move(machine), stream = std::move(other)]() mutable {
    adapter::serve(*machine, "served", std::move(stream));
  });
  return {std::move(thread), std::move(engine)};
}

}  // namespace probewright::testing_support
