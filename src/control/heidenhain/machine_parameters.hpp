#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"

/// The machine parameters that touch probe functions read.
namespace probewright::control::heidenhain {

struct MachineParameters {
  // TNC 640
  double maxTouchFeed = 3000;
  bool checkTiltingAxes = false;
  bool overrideForMeasure = false;
  bool option92 = true;
  // iTNC 530
  double mp6120 = 500;
  double mp6130 = 50;
  double mp6140 = 2;
  double mp6150 = 3000;
  bool mp6151 = false;
  int mp6160 = -1;
  bool mp6165 = false;
  int mp6170 = 1;
  bool mp6166 = false;
  double mp6171 = 0.1;
  double mp6180x = 0, mp6180y = 0, mp6180z = 0;
  double mp6181x = 0, mp6181y = 0, mp6181z = 0;
  double mp6182x = 0, mp6182y = 0, mp6182z = 0;
  double mp6185 = 5, mp6185second = 5, mp6185third = 5;
  int traverseRange = 1;  ///< the one that the PLC has selected
  bool mp7411 = true;
  double mp6360 = 500;
  double mp6361 = 3000;
  int featureLevel = 3;
  int softwareVersion = 8;
  /// The calibration data of the touch probe that are in no table, in effect with MP7411 = 0.
  double calibratedLength = 0, calibratedRadius = 0;
  double calibratedOffset1 = 0, calibratedOffset2 = 0, calibratedAngle = 0;
  double mp6520 = 300;
  double mp6530 = 5;
  double mp6531 = 40;
  double mp6540 = 5;
  double mp6550 = 2000;
  double mp6580x = 0, mp6580y = 0, mp6580z = 0;
  // tool touch probe, both: MP6505, MP6507, MP6510, MP6570, MP6572 and their names on the TNC 640
  int probingDirRadial = 0;
  int probingFeedCalc = 0;
  double measureTolerance1 = 0.005;
  double maxPeriphSpeedMeas = 30;
  double maxSpeed = 1000;
  bool stopOnCheck = true;
  int probingCapability = 0;
  double measureTolerance2 = 0;
  bool minimumSpindleSpeed = false;  ///< spindleSpeedCalc = MinSpindleSpeed
  double lowestSpindleSpeed = 50;
  bool singleDirection = false;  ///< probingRoutine = SingleDirection
  bool stopOnMeasurement = false;
  int adaptToolTable = 1;
  bool detectStylusRot = false;
  double tippingTolerance = 0;
  /// The iTNC 530 has most of these as bits.
  int mp6500 = 97;
  /// Calibration data of the tool touch probe: middle of the upper edge of its contact, machine coordinates, and half
  /// its effective width along main and minor axis.
  double contactX = 0, contactY = 0, contactZ = 0;
  double contactRadius1 = 0, contactRadius2 = 0;
  double contactAngle = 0;  ///< degrees about the tool axis, of a cuboid
  bool rectangularContact = false;
  // kinematics, both: MP6600 to MP6602 and their names on the TNC 640
  double maxModification = 0.05;
  double maxDevCalBall = 0.02;
  int strobeRotaryAxes = -1;
  int codeNumber = 0;
  bool option48 = true, option52 = true, toolCentreOption = true;
  // both: habits of Probewright where the manuals only warn
  bool refuseTransformations = true;
};

/// One parameter as a setup may name it. The table drives reading and documentation.
struct MachineParameterEntry {
  std::string_view name;    ///< "maxTouchFeed", "MP6120"
  std::string_view number;  ///< "122602", several separated by ", "; empty if the name says it
  ControlSet controls;
  double minimum = 0, maximum = 1;
  std::string_view unit;
  std::string_view meaning;
  std::variant<double MachineParameters::*, bool MachineParameters::*, int MachineParameters::*> member;
  /// The key of a probe's [[tool]] in the setup whose value counts where there is no entry.
  std::string_view toolKey = {};
  int bits = 0;  ///< of a number made of bits: those that mean something here
};

std::span<const MachineParameterEntry> machineParameterEntries();

/// Sets the parameter called `name` (its name in any case, or its number) to `value`. Fails, without a place, if there
/// is none on this control or the value is out of range.
Result<void> setMachineParameter(MachineParameters& parameters, ControlKind kind, std::string_view name, double value);

/// docs/machine-parameters.md.
std::string machineParametersPage();

}  // namespace probewright::control::heidenhain
