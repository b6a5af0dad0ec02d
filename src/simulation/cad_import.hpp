#pragma once

#include <future>

#include "base/diagnostic.hpp"
#include "simulation/cad_model.hpp"
#include "simulation/cad_transfer.hpp"
#include "simulation/import_options.hpp"
#include "simulation/imported_part.hpp"

/// The import of a file as its parent process sees it: what the child says and hands over, and what becomes of that.
namespace probewright::simulation {

struct ImportedInChild {
  ImportedPart part;
  std::future<CadModel> exact;  ///< exactModel() of its shape, begun while the child made the elements
};

/// Imports a file in a child process, with further tries where that fails on single faces.
Result<ImportedInChild> importInChild(TransferOrder order, const ImportOptions& options);

}  // namespace probewright::simulation
