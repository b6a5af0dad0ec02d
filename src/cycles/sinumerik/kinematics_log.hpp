#pragma once

#include <string>
#include <vector>

#include "control/sinumerik/tool_carrier.hpp"

/// How CYCLE996 shows and keeps the vectors of a swivel data set: in the control's own statements.
namespace probewright::cycles::sinumerik {

using control::sinumerik::DataKey;
using control::sinumerik::DataStore;
using control::sinumerik::ToolCarrier;

struct DatumValue {
  DataKey key;
  double value = 0;
};

/// The offset vectors I1 to I4 of data set `number`, less the fine offsets that count (SD 42974), and, where TRAORI has
/// machine data of its own of the same kind, these. In the order of the numbers.
std::vector<DatumValue> offsetData(const DataStore& store, int number, const ToolCarrier& carrier);

/// The program that enters the vectors: a line a vector, its name as comment; what they were before as comments.
std::string kinematicsProgram(const DataStore& store, int number, const ToolCarrier& before, const ToolCarrier& now);

/// The data set as the control shows it: each vector, and by how much it differs.
std::string kinematicsScreen(int number, const ToolCarrier& before, const ToolCarrier& now);

}  // namespace probewright::cycles::sinumerik
