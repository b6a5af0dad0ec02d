// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Probewright as a process of its own: it runs a program and gives its machine orders as lines on a socket
/// (docs/machine-adapters.md).
class EngineProcess {
public:
  using Json = nlohmann::json;

  ~EngineProcess();

  /// Starts `words` with the socket as file descriptor 3. False, and why, if that cannot be done.
  bool start(const std::vector<std::string>& words, std::string& why);
  bool running() const { return socket_ >= 0; }

  enum class Got { Order, Nothing, Ended };
  /// The next order, if it comes in time.
  Got receive(Json& order, int milliseconds);
  void answer(const Json& order, Json answer);
  /// The order takes its time.
  void alive(const Json& order);
  /// Closes the socket: the engine ends by itself, with an alarm if its program was not done.
  void hangUp();
  /// After Ended or hangUp(): its exit code, -1 if it did not end in this time, and what it has said.
  int exitCode(int milliseconds);
  std::string messages() const;

private:
  void send(const std::string& line);

  int socket_ = -1, said_ = -1;
  pid_t process_ = 0;
  int code_ = -1;
  std::string rest_;
};
