#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "machine/description.hpp"

/// Five-axis machines that no ready-made one is: other axes, other orders, other senses of rotation.
namespace probewright::testing_support {

struct OtherMachine {
  std::string name;
  std::string base;  ///< the ready-made machine that it is made of
  std::function<void(machine::MachineDescription&)> change;
};

/// The element of a rotary axis in either chain.
inline machine::ChainElement& elementOf(machine::MachineDescription& machine, const std::string& axis) {
  for (auto* chain : {&machine.tableChain, &machine.spindleChain})
    for (machine::ChainElement& element : *chain)
      if (element.axis && machine.axes[*element.axis].name == axis) return element;
  throw std::logic_error("no axis " + axis);
}

inline std::vector<OtherMachine> otherMachines() {
  using machine::MachineDescription;
  const auto renamed = [](MachineDescription& machine, const char* from, const char* to) {
    machine.axes[*machine.axisIndex(from)].name = to;
  };
  return {
      {"a trunnion whose axes turn the other way", "mill5-table-table",
       [](MachineDescription& machine) {
         for (const char* axis : {"A", "C"})
           elementOf(machine, axis).direction *= -1;
       }},
      {"a trunnion about Y, its axes off the middle", "mill5-table-table",
       [=](MachineDescription& machine) {
         elementOf(machine, "A").direction = -Vector3::UnitY();
         elementOf(machine, "A").point = {30, 0, -540};
         elementOf(machine, "C").point = {-12, 25, 0};
         renamed(machine, "A", "B");
       }},
      {"a trunnion upon a round table", "mill5-table-table",
       [](MachineDescription& machine) { std::swap(machine.tableChain[0], machine.tableChain[1]); }},
      {"a head that swings about an axis of 45 degrees", "mill5-head-table",
       [](MachineDescription& machine) { elementOf(machine, "B").direction = Vector3(0, 1, 1).normalized(); }},
      {"a swinging table and a swinging head", "mill5-head-table",
       [=](MachineDescription& machine) {
         machine::Axis& axis = machine.axes[*machine.axisIndex("C")];
         axis.modulo = false;
         axis.minimum = -100;
         axis.maximum = 100;
         elementOf(machine, "C").direction = -Vector3::UnitX();
         elementOf(machine, "C").point = {0, 10, -560};
         renamed(machine, "C", "A");
       }},
  };
}

}  // namespace probewright::testing_support
