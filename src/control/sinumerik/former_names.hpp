#pragma once

#include <optional>
#include <string_view>

#include "control/sinumerik/data_store.hpp"

/// Names that machine and setting data of the measuring cycles had in version 2.6, before version 4.4 gathered them in
/// masks or moved them: $SCS_MEA_COLLISION_MONITORING, $MNS_J_MEA_MEASURING_FEED. Programs of that time read and write
/// what is in their place now.
namespace probewright::control::sinumerik {

/// True for the name of such a datum, in capitals.
bool isFormerName(std::string_view name);

/// Reads the datum; of a bit for workpieces and one for tools the first. Nothing if `key` is not such a datum.
std::optional<double> readFormer(const DataStore& store, const DataKey& key);

/// Writes the datum, of two bits both; false if `key` is not such a datum.
bool writeFormer(DataStore& store, const DataKey& key, double value);

}  // namespace probewright::control::sinumerik
