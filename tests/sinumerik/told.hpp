#pragma once

#include <string>
#include <vector>

#include "language/sinumerik/check.hpp"
#include "sinumerik/world.hpp"

/// What a run or a check of a SINUMERIK program tells.
namespace probewright::language::sinumerik {

inline Vector3 tip(World& world) { return world.control.channel.position().vector(); }

inline std::vector<std::string> texts(const World& world, control::EventKind kind) {
  std::vector<std::string> found;
  for (const auto& event : world.control.journal.events)
    if (event.kind == kind) found.push_back(event.text);
  return found;
}

/// The first complaint of the check; empty: there is none.
inline std::string mistake(const std::string& text) {
  const auto program = SinumerikProgram::fromText("test.mpf", text);
  const Diagnostics found = check(*program);
  return found.empty() ? "" : found.front().message;
}

}  // namespace probewright::language::sinumerik
