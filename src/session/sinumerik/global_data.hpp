#pragma once

#include <filesystem>

#include "base/diagnostic.hpp"
#include "execution/sinumerik/global_data.hpp"

namespace probewright::session::sinumerik {

/// What the definition files of global user data declare (SGUD.DEF, MGUD.DEF, UGUD.DEF, GUD4.DEF...; also under their
/// names in archives, _N_UGUD_DEF) that lie in `tables`, the setup's folder of table files, and beside the program
/// `program`. Where both have a file of one name, that of `tables` counts. Mistakes go to `diagnostics`.
execution::sinumerik::GlobalUserData globalUserData(const std::filesystem::path& program,
                                                    const std::filesystem::path& tables, Diagnostics& diagnostics);

}  // namespace probewright::session::sinumerik
