#include "operator_terminal.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>

#include "console.hpp"

namespace probewright::app {

namespace {

void show(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace

std::optional<std::string> OperatorTerminal::line() {
  constexpr int milliseconds = 50;
  while (!stop_.stop_requested()) {
    if (const std::size_t end = typed_.find('\n'); end != std::string::npos) {
      std::string line = typed_.substr(0, end);
      typed_.erase(0, end + 1);
      return line;
    }
    pollfd input{STDIN_FILENO, POLLIN, 0};
    const int ready = poll(&input, 1, milliseconds);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    std::array<char, 4096> part{};
    const ssize_t count = ready < 0 ? -1 : read(STDIN_FILENO, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count > 0) {
      typed_.append(part.data(), static_cast<std::size_t>(count));
      continue;
    }
    if (typed_.empty()) return std::nullopt;
    return std::exchange(typed_, {});
  }
  return std::nullopt;
}

bool OperatorTerminal::goesOn(const std::string& text) {
  show(fmt::format("\n{}\nContinue? [Y/n] ", printable(text)));
  while (const auto line = this->line()) {
    if (line->empty() || *line == "y" || *line == "Y") return true;
    if (*line == "n" || *line == "N") return false;
    show("y or n? ");
  }
  return false;
}

std::optional<std::string> OperatorTerminal::answer(const control::Question& question) {
  if (isatty(STDIN_FILENO) == 0) return std::nullopt;
  show(fmt::format("\n{}: {}\n> ", printable(question.name), question.wanted));
  while (auto line = this->line()) {
    if (question.understood(*line)) return line;
    show(fmt::format("\"{}\" cannot be read as an answer\n> ", printable(*line)));
  }
  return std::nullopt;
}

}  // namespace probewright::app
