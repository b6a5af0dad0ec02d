#pragma once

#include <filesystem>
#include <string>

#include "base/diagnostic.hpp"
#include "control/heidenhain/q_parameters.hpp"

/// QR parameters outlive a program. A run leaves them in a file beside the tables, where the next one reads them:
/// lines such as QR5 = 12.5.
namespace probewright::session::heidenhain {

inline constexpr const char* remanentFile = "QR.TXT";

/// Takes over the parameters of the file in `tables`, if there is one. Mistakes go to `diagnostics`.
void readRemanentParameters(const std::filesystem::path& tables, control::heidenhain::QParameters& q,
                            Diagnostics& diagnostics);

/// The text of the file; empty if no QR parameter has a value.
std::string remanentParametersText(const control::heidenhain::QParameters& q);

}  // namespace probewright::session::heidenhain
