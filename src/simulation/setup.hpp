#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "machine/table_body.hpp"
#include "simulation/import_options.hpp"
#include "simulation/solid_recipe.hpp"
#include "simulation/truth.hpp"

/// A setup: the world a program runs in (the truth) and what the control thinks of it (the beliefs), as a TOML file.
/// docs/setup-format.md describes every key with unit, range and default.
namespace probewright::simulation {

class VirtualMachine;

/// Where the shape of a part or fixture comes from: a file, or features if there is none.
struct SolidSource {
  std::filesystem::path file;  ///< STEP, IGES or STL by its ending
  SolidRecipe recipe;
  SourcePlace place;  ///< of the key that names the file
};

/// A solid that is still to be loaded, and where it truly lies.
struct SetupSolid {
  std::string name;
  SolidRole role = SolidRole::Part;
  SolidSource source;
  Pose tableFromSolid = Pose::Identity();
};

/// What the control believes of a tool. Without keys of its own it believes what is true: a calibrated probe.
struct BelievedTool {
  int number = 0;
  std::string name;
  std::string kind;   ///< "probe", "mill", "drill", "turn"
  double length = 0;  ///< mm; of a probe its effective length: to the ball's lowest point, less the axial pretravel
  double radius = 0;  ///< mm; of a probe its effective ball radius: less the pretravel and the signal delay at `feed`
  bool inSpindle = false;
  Vector3 mount = Vector3::Zero();            ///< mm, as TrueTool::mount
  Vector3 shankDirection = Vector3::UnitZ();  ///< as TrueTool::shankDirection

  // Of a probe, as its control keeps them.
  double axialRadius = 0;      ///< mm; effective ball radius along the stylus
  Vector2 tipOffset = {0, 0};  ///< mm, of the ball from the spindle axis at `calibrationAngle`
  bool trueTipOffset = false;  ///< the setup names no belief: `tipOffset` is the true one, at spindle angle 0
  double starArm = 0;          ///< mm; above 0 a star with balls this far from its middle: `radius` is that of the star
  int probeNumber = 1;         ///< row of the touch probe table, number of the calibration data set
  double feed = 300;           ///< mm/min, of measuring moves
  double rapid = 2000;         ///< mm/min, of moves between touches
  double maximumTravel = 10;   ///< mm
  double setUpClearance = 2;   ///< mm
  double calibrationAngle = 0;  ///< degrees, of the spindle when probing
  bool orient = false;          ///< the spindle turns the probe to the probing direction
};

/// A row of the preset table or a settable zero offset.
struct BelievedFrame {
  int index = 1;     ///< row of the preset table; of zero offsets 1 for G54 to 4 for G57, 5 for G505 to 99 for G599
  std::string name;  ///< "G54"; empty for presets
  Vector3 origin = Vector3::Zero();
  Vector3 rotation = Vector3::Zero();    ///< degrees about X, Y, Z, in this order about fixed axes
  std::map<std::string, double> rotary;  ///< degrees, by the name of the rotary axis
  bool active = false;
};

/// A machine parameter or setting datum, passed on to the control as it is written.
struct SetupParameter {
  std::variant<double, std::string> value;  ///< true and false become 1 and 0
  SourcePlace place;
};

struct Setup {
  std::string file;
  std::vector<std::filesystem::path> inputs;  ///< the files it was read from and those it names, but not the tables
  std::optional<control::ControlKind> control;
  std::filesystem::path tables;  ///< folder with the control's own table files; empty if none

  /// Machine, errors, true tools, start, seed. The solids are added by buildMachine().
  Truth truth;
  std::vector<SetupSolid> solids;
  std::optional<machine::TableBody> table;  ///< of the machine

  std::vector<BelievedTool> tools;
  std::vector<BelievedFrame> presets;
  std::vector<BelievedFrame> zeroOffsets;
  std::map<std::string, SetupParameter> parameters;
  std::map<std::string, std::string> answers;  ///< of the operator, by the name of the question
};

/// The setup that `text` describes. Relative paths in it count from the folder of `file`. Mistakes go to `diagnostics`,
/// all of them; nothing is returned if there are any.
std::optional<Setup> parseSetup(std::string_view text, const std::string& file, Diagnostics& diagnostics);
std::optional<Setup> readSetup(const std::filesystem::path& path, Diagnostics& diagnostics);

/// Loads the solids and puts the machine together.
Result<std::unique_ptr<VirtualMachine>> buildMachine(const Setup& setup, const ImportOptions& import = {});

}  // namespace probewright::simulation
