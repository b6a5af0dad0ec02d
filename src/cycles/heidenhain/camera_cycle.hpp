#pragma once

#include <string_view>

#include "control/heidenhain/camera_monitoring.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/parameters.hpp"

/// What cycles 600 and 601 have in common.
namespace probewright::cycles::heidenhain {

namespace parameters {

inline constexpr Parameter monitoringPoint = {
    .name = "QS600",
    .address = 600,
    .meaning = "name of the monitoring point: letters, digits, _ and -; its file has areas and images",
    .kind = ValueKind::Text};

inline constexpr Choice deviationStopChoices[] = {
    {0, "go on; the image is not shown"},
    {1, "stop and show the image on an error, and while reference images are missing"}};
inline constexpr Parameter deviationStop =
    option(309, "Q309", "program stop if an error is found", deviationStopChoices);

inline constexpr Parameter referenceImages = {.name = "Q617",
                                              .address = 617,
                                              .meaning = "reference images that the monitoring needs; guide value: 10",
                                              .kind = ValueKind::Integer,
                                              .minimum = 0,
                                              .maximum = 200};

}  // namespace parameters

inline constexpr ResultDefinition cameraResults[] = {
    {"Q601", "state: 1 no error, 2 error, 3 no monitoring area or too few reference images, 10 camera fault",
     result::status.main()}};

inline constexpr Conditions cameraConditions = {.uses = Uses::Nothing, .under = Transformed::Any, .turningMode = true};

/// Complains about the name of the monitoring point.
void cameraRules(CallRules& call);

/// The camera and what is stored of it. Throws Alarm if the machine has none.
control::heidenhain::CameraMonitoring& cameraOf(Context& context);

enum class CoverAfterwards { Closed, Open };

/// Opens the cover, takes an image where the spindle stands, compares it, shows it if Q309 and its result ask for that;
/// leaves the state in Q601; an error is a verdict, too.
void monitorByCamera(Context& context, CoverAfterwards cover);

}  // namespace probewright::cycles::heidenhain
