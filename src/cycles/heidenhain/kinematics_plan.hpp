#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/parameters.hpp"

/// At which positions of the rotary axes cycles 451 and 452 measure, and what their calls have in common.
namespace probewright::cycles::heidenhain {

namespace parameters {

inline constexpr Parameter sphereRadius = {.name = "Q407",
                                           .address = 407,
                                           .meaning = "exact radius of the calibration sphere",
                                           .kind = ValueKind::Length,
                                           .minimum = 0.0001,
                                           .maximum = 99.9999};
inline constexpr Parameter retractHeight = {
    .name = "Q408",
    .address = 408,
    .meaning =
        "height in the untilted workpiece system to which the probe retracts before rotary axes move; 0: it "
        "stays at the sphere",
    .kind = ValueKind::Length,
    .minimum = 0};
inline constexpr Parameter positioningFeed = {.name = "Q253",
                                              .address = 253,
                                              .meaning = "feed rate for pre-positioning",
                                              .kind = ValueKind::Feed,
                                              .minimum = 0.0001,
                                              .predefinable = true,
                                              .feedWords = control::onBothTNC};
inline constexpr Parameter touchReference = angle(380, "Q380", "angle of the first touch about the tool axis", 0, 360);
inline constexpr Parameter sphereTouches = {.name = "Q423",
                                            .address = 423,
                                            .meaning = "number of touches around the sphere",
                                            .kind = ValueKind::Integer,
                                            .minimum = 3,
                                            .maximum = 8};
inline constexpr Choice presetChoices[] = {{0, "stays: it was set into the sphere before"},
                                           {1, "into the sphere before measuring"},
                                           {2, "into the sphere after measuring"},
                                           {3, "into the sphere before and after measuring"}};
inline constexpr Parameter spherePreset = standard(option(431, "Q431", "the active preset", presetChoices), 0);
inline constexpr Parameter overrun =
    standard(angle(432, "Q432", "overrun angle for measuring the backlash; 0: not measured", -3, 3), 0);

constexpr Parameter axisAngle(std::uint32_t number, std::string_view name, std::string_view meaning) {
  return angle(number, name, meaning, -359.999, 359.999);
}
constexpr Parameter axisPoints(std::uint32_t number, std::string_view name, std::string_view meaning) {
  return {.name = name, .address = number, .meaning = meaning, .kind = ValueKind::Integer, .minimum = 0, .maximum = 12};
}
inline constexpr Parameter startA = axisAngle(411, "Q411", "start angle of A"),
                           endA = axisAngle(412, "Q412", "end angle of A"),
                           otherA = axisAngle(413, "Q413", "angle of A while other axes are measured"),
                           pointsA = axisPoints(414, "Q414", "measuring points of A; 0: not measured"),
                           startB = axisAngle(415, "Q415", "start angle of B"),
                           endB = axisAngle(416, "Q416", "end angle of B"),
                           otherB = axisAngle(417, "Q417", "angle of B while other axes are measured"),
                           pointsB = axisPoints(418, "Q418", "measuring points of B; 0: not measured"),
                           startC = axisAngle(419, "Q419", "start angle of C"),
                           endC = axisAngle(420, "Q420", "end angle of C"),
                           otherC = axisAngle(421, "Q421", "angle of C while other axes are measured"),
                           pointsC = axisPoints(422, "Q422", "measuring points of C; 0: not measured");

}  // namespace parameters

/// One axis as the call asks for it.
struct AxisRequest {
  char name = 'A';
  double start = 0, end = 0;
  double incidence = 0;  ///< where it stands while others are measured
  int points = 0;
};
std::array<AxisRequest, 3> axisRequests(const std::function<double(std::uint32_t)>& value);

/// The angles at which an axis is measured, in their order; with a Hirth coupling the nearest of its positions. What
/// comes to lie at 0 is among them.
std::vector<double> measuringAngles(const AxisRequest& request, double hirthGrid = 0);

/// 0 or a full turn, where the reference measurement is made.
bool atReference(double degrees);

/// The series of one axis.
struct AxisSeries {
  std::size_t axis = 0;  ///< index into the machine's axes
  AxisRequest request;
  std::vector<double> angles;  ///< program angles, without the reference at 0
};

struct MeasuringPlan {
  std::vector<AxisSeries> series;    ///< of the axes that are measured, in the order A, B, C
  machine::AxisPositions incidence;  ///< program angles of all rotary axes of the call while another one is measured
};

/// Throws Alarm for what the control refuses: option, tool axis, TCPM, rotary axes away from 0, Hirth axes without a
/// retraction height, a point at 0 on the iTNC 530. Axes that the machine does not have are left out.
MeasuringPlan measuringPlan(Context& context);

/// Alarm unless software option 48 is enabled.
void requireKinematicsOption(Context& context);
/// What cycles 451 to 453 all ask for before they begin, as alarms. On the iTNC 530 M128 and FUNCTION TCPM end here.
void beginKinematicsMeasurement(Context& context);
/// Alarm if the rotary axis has a Hirth coupling and Q408 is 0.
void requireRetraction(Context& context, std::size_t axis);

/// What the manuals advise against: warnings, and on the iTNC 530 the error of a point at 0. `mode`: Q406 of cycle 451,
/// 1 for cycle 452.
void adviseOnPositions(CallRules& call, std::optional<double> mode);

}  // namespace probewright::cycles::heidenhain
