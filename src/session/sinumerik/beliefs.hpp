#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/beliefs.hpp"
#include "control/sinumerik/data_store.hpp"
#include "control/sinumerik/init_text.hpp"

namespace probewright::execution::sinumerik {
class GlobalUserData;
}

/// What a SINUMERIK control believes when a program starts.
namespace probewright::session::sinumerik {

/// A SINUMERIK control's data: initialization texts (*.INI, *.TOA, *.UFR, *.GUD, *.SEA...) of the folder of tables,
/// believed tools, calibration data and zero offsets, machine and setting data, and the texts, to be written back.
struct SinumerikData {
  control::sinumerik::DataStore store;
  struct File {
    std::string name;
    control::sinumerik::InitText text;
  };
  std::vector<File> files;
};
/// Lists in them that are longer than a row of their array go on in the next one: `globalData` knows the arrays.
SinumerikData sinumerikData(const control::Beliefs& beliefs, Diagnostics& diagnostics,
                            const execution::sinumerik::GlobalUserData* globalData = nullptr);

/// The names of all data that the control has values for.
std::set<std::string> namesOfData(const control::Beliefs& beliefs);

/// Number of the settable zero offset that is active at the start: 0 is G500.
int activeZeroOffset(const control::Beliefs& beliefs);

}  // namespace probewright::session::sinumerik
