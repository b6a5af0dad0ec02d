#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "control/control_kind.hpp"
#include "setup/setup_document.hpp"
#include "simulation/import_options.hpp"
#include "study/trial.hpp"

namespace probewright::study {

/// A program on the virtual machine of a setup whose numbers vary, as a model for trials.
///
/// The world is built once: trials share its solids and read neither program, setup nor parts again. Only what is made
/// of features whose sizes vary is built anew in each trial. Where beliefs do not vary, each thread checks the program
/// and makes the control's tables once. Programs that the program calls are read where they are called.
///
/// Truth follows the sources. Beliefs stay those of the setup as it is written, for the control does not know what a
/// trial has drawn; sources that are beliefs themselves, and those that are `known`, change them. With a calibration
/// program, what that leaves in the tables goes before; it runs on a machine of its own with the same truth, from the
/// same start, and hands its tables over in a folder of the system's for temporary files.
class ProgramModel {
public:
  struct Options {
    std::optional<control::ControlKind> control;
    simulation::ImportOptions import;  ///< of parts; its stop ends trials, too
  };

  /// Reads the program and builds the world. Null if either fails, or a source is a number that no setup can have;
  /// mistakes go to `diagnostics`.
  static std::unique_ptr<ProgramModel> make(const std::filesystem::path& program, setup::SetupDocument setup,
                                            const Study& study, const Options& options, Diagnostics& diagnostics);
  virtual ~ProgramModel() = default;

  /// One trial. May be called from several threads.
  virtual Outcome run(const Draw& draw) const = 0;

  /// Names of the solids that are built in each trial.
  virtual std::vector<std::string> rebuilt() const = 0;
};

}  // namespace probewright::study
