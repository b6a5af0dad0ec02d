#include "cycles/heidenhain/free_measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "control/alarm.hpp"
#include "control/stopped_place.hpp"
#include "cycles/heidenhain/probe_words.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using machine::MeasureEnd;

namespace {

constexpr double touched = 1, notTouched = -1;

}  // namespace

void measureFreely(Context& context, const FreeMeasurement& measurement) {
  Control& control = context.control();
  auto& channel = context.channel();
  const int first = context.option(probe_word::result);
  if (!control::heidenhain::QParameters::exists(first + 3)) {
    throw Alarm("Parameter number wrong", fmt::format("Q{} leaves no room for four results", first),
                "use a number up to 1996");
  }
  const Eigen::Affine3d machineFromProgram = context.machineFromProgram();
  const Matrix3 programFromDirection =
      measurement.directionInMachine ? Matrix3(machineFromProgram.linear().inverse()) : Matrix3(Matrix3::Identity());
  const double scale = (programFromDirection * measurement.direction.normalized()).norm();
  const Vector3 inProgram = programFromDirection * measurement.direction;
  if (!(inProgram.norm() > 0)) {
    throw Alarm("Probing direction not defined", "The vector of the probing direction has no length",
                "give at least one of IX, IY and IZ");
  }
  const ProgramWay direction(inProgram.normalized() * (measurement.distance < 0 ? -1 : 1));
  const double distance = std::abs(measurement.distance) * scale;
  const probing::HeidenhainProbe probe = activeProbe(control, Calibrated::NotYet);
  const ProgramPlace start = channel.position();
  const auto result = channel.measureTo(start + direction * distance, machine::Feed::at(context.q(probe_word::feed)),
                                        machine::Sensor::TouchProbe);

  control::TouchRecord record;
  const ProgramWay toBall = probing::alongTool(channel, probe.ballRadius);
  record.target = (start + toBall + direction * distance).vector();
  record.direction = direction.vector();
  record.seconds = channel.seconds();
  const auto note = [&](std::string outcome) {
    record.outcome = std::move(outcome);
    channel.journal().touch(record);
  };
  double status = notTouched;
  auto ball = ballAt(channel.position(), toBall);
  switch (result.end) {
    case MeasureEnd::Touched: {
      const control::Touch touch = channel.touchFrom(result);
      ball = ballAt(touch.tip, toBall);
      if (measurement.withTipOffset) {
        const control::WorkingPlane& plane = control.coordinates.plane;
        ball += plane.xyzFromPlane(probing::HeidenhainProber(channel, plane, probe).tipOffsetNow());
      }
      record.ballCentre = ball.vector();
      record.surface = partAt(ball, direction * probing::inProgramUnits(channel, probe.ballRadius, direction)).vector();
      record.latched = touch.latched;
      record.spindle = probing::spindlePlace(channel, touch.latched).vector();
      note("touched");
      status = touched;
      break;
    }
    case MeasureEnd::NoContact:
      note("no contact");
      break;
    case MeasureEnd::DeflectedAtStart:
      note("deflected");
      if (measurement.alarmIfDeflected) {
        throw Alarm("Stylus already in contact",
                    control::deflectedAtStart(channel, "The stylus is deflected before probing begins", result.detail),
                    "move the probe away, or set the error mode to 1");
      }
      // The older control tells this state from a missing touch.
      status = control.isTNC640() ? notTouched : 2;
      break;
    case MeasureEnd::NotReady:
      note("not ready");
      throw Alarm("Touch probe not ready",
                  result.detail.empty() ? "There is no touch probe in the spindle" : result.detail,
                  "call the touch probe with TOOL CALL before the cycle, and see that it is switched on");
    case MeasureEnd::AxisLimit:
      note("limit");
      throw Alarm(channel.alarms.limit, result.detail, "shorten DIST, or begin the measurement elsewhere");
    case MeasureEnd::Collision:
    case MeasureEnd::Cancelled:  // the channel throws it, and what is refused
    case MeasureEnd::Refused:
      note("collision");
      throw Alarm(channel.alarms.collision, result.detail);
  }
  if (result.end != MeasureEnd::DeflectedAtStart) {
    const ProgramPlace now = channel.position();
    const double back = std::min(context.q(probe_word::retraction), (now - start).norm());
    channel.retractTo(now - direction * back, machine::Feed::rapidTraverse());
  }
  const Vector3 shown = measurement.resultInMachine ? Vector3(machineFromProgram * ball.vector()) : ball.vector();
  constexpr std::array along = {of::centreX, of::centreY, of::centreZ};
  for (int i = 0; i < 3; ++i) {
    control.q.setQ(first + i, shown[i] / control.mainUnit);
    control::ResultRecord value;
    value.name = fmt::format("Q{}", first + i);
    value.meaning = value.label = fmt::format("ball centre, {}", "XYZ"[i]);
    value.kind = result::actual(along[static_cast<std::size_t>(i)]).main();
    value.value = shown[i] + 0.0;  // no -0
    value.unit = "mm";
    context.record().results.push_back(std::move(value));
  }
  control.q.setQ(first + 3, status);
  control::ResultRecord told;
  told.name = fmt::format("Q{}", first + 3);
  told.meaning = "1: touched, -1: not";
  told.value = status;
  context.record().results.push_back(std::move(told));
}

}  // namespace probewright::cycles::heidenhain
