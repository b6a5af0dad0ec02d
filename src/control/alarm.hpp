#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "base/diagnostic.hpp"

namespace probewright::control {

/// The block of a program: its line, from 1, and the byte where it begins.
struct AlarmPlace {
  std::string file;
  std::uint64_t line = 0;
  std::uint64_t offset = 0;
};

/// What a control shows when it stops a program: thrown by whatever cannot go on, caught by the interpreter, which
/// stops the axes and the program. Nothing that the alarm interrupts is written to tables.
class Alarm : public std::runtime_error {
public:
  /// `code`: the control's own number or short name ("61301", "Touch point inaccessible"); `text`: one sentence;
  /// `advice`: what the user can do; may be empty.
  Alarm(std::string code, std::string text, std::string advice = {})
      : std::runtime_error(code.empty() ? text : code + " " + text),
        code_(std::move(code)),
        text_(std::move(text)),
        advice_(std::move(advice)) {}
  const std::string& code() const { return code_; }
  const std::string& text() const { return text_; }
  const std::string& advice() const { return advice_; }
  /// The block at fault, where it is not the one that is being carried out.
  const std::optional<AlarmPlace>& place() const { return place_; }
  void setPlace(AlarmPlace place) { place_ = std::move(place); }

private:
  std::string code_, text_, advice_;
  std::optional<AlarmPlace> place_;
};

/// The user asked to stop.
class Cancelled : public std::runtime_error {
public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// What a run leaves behind has reached its limit: see Journal.
class RecordFull : public std::runtime_error {
public:
  RecordFull() : std::runtime_error("the record of the run is full") {}
};

}  // namespace probewright::control
