#include "cycles/heidenhain/tool_measuring_settings.hpp"

#include "control/alarm.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::heidenhain::Control;
using control::heidenhain::MachineParameters;

namespace {

ToolMeasuringSettings ofCfgTT(const MachineParameters& parameters) {
  const bool everything = parameters.probingCapability == 0;
  enum Adapts { OnMeasure, OnBoth, Never };
  return {.rotating = everything,
          .standingRadius = everything,
          .teeth = everything,
          .stopsOnCheck = parameters.stopOnCheck,
          .stopsOnMeasurement = parameters.stopOnMeasurement,
          .entersMeasured = parameters.adaptToolTable != Never,
          .entersChecked = parameters.adaptToolTable == OnBoth,
          .oneDirection = parameters.singleDirection,
          .findsRotation = parameters.detectStylusRot && parameters.rectangularContact,
          .tippingTolerance = parameters.rectangularContact ? parameters.tippingTolerance : 0};
}

ToolMeasuringSettings ofMP6500(const MachineParameters& parameters) {
  const auto bit = [&](int number) { return (parameters.mp6500 >> number & 1) != 0; };
  return {.enabled = bit(0),
          .rotating = !bit(1),
          .standingLength = !bit(2),
          .teeth = !bit(1) && !bit(3),
          .tilted = !bit(13),
          .stopsOnCheck = !bit(5),
          .stopsOnMeasurement = !bit(6),
          .entersChecked = !bit(11),
          .oneDirection = bit(8),
          .findsRotation = bit(9)};
}

}  // namespace

ToolMeasuringSettings toolMeasuringSettings(const Control& control) {
  return control.isTNC640() ? ofCfgTT(control.parameters) : ofMP6500(control.parameters);
}

void requireEnabled(const Control& control) {
  const ToolMeasuringSettings settings = toolMeasuringSettings(control);
  if (!settings.enabled) {
    throw Alarm("Function not enabled", "The cycles that measure tools are switched off (MP6500)",
                "set bit 0 of MP6500");
  }
  if (!settings.tilted && control.coordinates.tilt) {
    throw Alarm("Tilted working plane not permitted",
                "Tools are not measured while the working plane is tilted (MP6500, bit 13)",
                "reset PLANE or cycle 19 before the cycle");
  }
}

}  // namespace probewright::cycles::heidenhain
