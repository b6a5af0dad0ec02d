#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "adapter/remote_machine.hpp"
#include "support/served_machine.hpp"

namespace probewright::adapter {

inline const char* const greeting =
    R"("protocol":1,"adapter":"test","machine":{"name":"m","axes":[{"name":"X","kind":"linear"},{"name":"Y","kind":"linear"},{"name":"Z","kind":"linear"}]},"position":[0,0,0],"functions":[8])";

/// An adapter that answers each order with the next of its lines; `$` in it stands for the order's number. A line "hang
/// up" ends it; without further lines it says nothing.
class Adapter {
public:
  explicit Adapter(std::vector<std::string> answers) {
    auto [engine, own] = testing_support::streamPair();
    engine_ = std::make_unique<LineStream>(std::move(engine));
    thread_ = std::jthread([this, answers = std::move(answers), stream = std::move(own)]() mutable {
      std::string line;
      std::size_t next = 0;
      while (true) {
        const LineStream::Got got = stream.receive(line, std::chrono::milliseconds(5000));
        if (got != LineStream::Got::Line) return;
        const Json order = parseLine(line);
        heard.push_back(text(order, "do"));
        if (next == answers.size()) continue;
        std::string answer = answers[next++];
        if (answer == "hang up") return;
        for (std::size_t at = 0; (at = answer.find('$', at)) != std::string::npos;)
          answer.replace(at, 1, std::to_string(order.value("id", 0)));
        if (!stream.send(answer)) return;
      }
    });
  }

  Result<std::unique_ptr<RemoteMachine>> greet(Patience patience = {}) {
    return RemoteMachine::greet({nullptr, std::move(*engine_)}, patience);
  }

  std::vector<std::string> heard;  ///< read it after end()
  void end() { thread_.join(); }

private:
  std::unique_ptr<LineStream> engine_;
  std::jthread thread_;
};

inline std::vector<std::string> after(std::vector<std::string> answers) {
  answers.insert(answers.begin(), R"({"id":$,)" + std::string(greeting) + "}");
  return answers;
}

}  // namespace probewright::adapter
