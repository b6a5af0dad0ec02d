#pragma once

#include <memory>
#include <optional>

#include "base/diagnostic.hpp"
#include "study/crew.hpp"

namespace probewright::app {

/// The ranks that mpirun has started together, this process among them; leaves them when the last copy goes. Nothing
/// if mpirun has not started this process. Fails if the module for MPI is not beside the program.
struct JoinedRanks {
  study::Ranks ranks;
  std::shared_ptr<void> membership;
};
Result<std::optional<JoinedRanks>> joinRanks();

}  // namespace probewright::app
