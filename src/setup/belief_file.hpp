#pragma once

#include <filesystem>
#include <vector>

#include "base/toml_table.hpp"
#include "control/beliefs.hpp"
#include "machine/description.hpp"
#include "session/control_family.hpp"
#include "setup/setup_on_machine.hpp"

/// The believed half of a setup file.
namespace probewright::setup {

/// Reads what the control believes, section by section, into `beliefs`. Relative paths count from `folder`; `machine`
/// has the axes that zero offsets may name.
class BeliefReader {
public:
  BeliefReader(TomlReader& root, std::filesystem::path folder, const machine::MachineDescription& machine,
               control::Beliefs& beliefs, const session::ControlFamilies& families)
      : root_(root), folder_(std::move(folder)), machine_(machine), beliefs_(beliefs), families_(families) {}

  void readControl(const MayBeMissing& mayBeMissing);
  /// [[preset]] and [[zero_offset]].
  void readFrames();
  void readParameters();
  void readAnswers();

private:
  void readTables(TomlReader& control, const MayBeMissing& mayBeMissing);
  void readKinematics(TomlReader& control);
  void readFrame(TomlReader& reader, control::BelievedFrame frame, std::vector<control::BelievedFrame>& frames,
                 const char* idKey);

  TomlReader& root_;
  std::filesystem::path folder_;
  const machine::MachineDescription& machine_;
  control::Beliefs& beliefs_;
  const session::ControlFamilies& families_;
};

}  // namespace probewright::setup
