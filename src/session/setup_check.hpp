#pragma once

#include <bitset>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/beliefs.hpp"
#include "language/program.hpp"
#include "machine/description.hpp"
#include "session/control_family.hpp"

namespace probewright::session {

/// What a program names and the control or its machine does not have: tools that are called or corrected, rows of the
/// preset table that are activated, axes that are moved or changed, planes that need rotary axes, swivel data sets.
/// Only what the text says; names and numbers that the run computes are left to it. `machine`: null if it is not known.
Diagnostics checkAgainstSetup(language::Program& program, const Inventory& inventory, std::bitset<10> skipLevels = {},
                              const machine::MachineDescription* machine = nullptr);

/// Whether the virtual machine of a setup with these tools finds the one that a control calls so: by its name, else by
/// its number, where setup or control have no name for it.
bool holdsTool(const std::vector<control::BelievedTool>& tools, int number, std::string_view name);

/// "the setup has 1 PROBE, 2": the first of them.
class Listing {
public:
  void add(const std::string& number, const std::string& name) {
    constexpr std::size_t most = 8;
    if (++count_ > most + 1) return;
    list_ += count_ > most ? " ..." : (list_.empty() ? "" : ", ") + number + (name.empty() ? "" : " " + name);
  }
  std::string text() const { return list_.empty() ? "the setup has none" : "the setup has " + list_; }

private:
  std::string list_;
  std::size_t count_ = 0;
};

}  // namespace probewright::session
