#include <cmath>

#include "control/alarm.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters431[] = {
    coordinate(263, "Q263", "first touch, main axis"),
    coordinate(264, "Q264", "first touch, minor axis"),
    coordinate(294, "Q294", "first touch, touch probe axis"),
    coordinate(265, "Q265", "second touch, main axis"),
    coordinate(266, "Q266", "second touch, minor axis"),
    coordinate(295, "Q295", "second touch, touch probe axis"),
    coordinate(296, "Q296", "third touch, main axis"),
    coordinate(297, "Q297", "third touch, minor axis"),
    coordinate(298, "Q298", "third touch, touch probe axis"),
    setUpClearance,
    clearanceHeight,
    measuringLog,
};

constexpr ResultDefinition results431[] = {
    {"Q158", "projection angle of the A axis", result::actual(of::projectionA).main()},
    {"Q159", "projection angle of the B axis", result::actual(of::projectionB).main()},
    {"Q170", "space angle A", result::actual(of::angleX).main()},
    {"Q171", "space angle B", result::actual(of::angleY).main()},
    {"Q172", "space angle C", result::actual(of::angleZ).main()},
    {"Q173", "first touch in the touch probe axis", result::touched(of::position3.number(1))},
    {"Q174", "second touch in the touch probe axis (TNC 640)", result::touched(of::position3.number(2))},
    {"Q175", "third touch in the touch probe axis (TNC 640)", result::touched(of::position3.number(3))},
};

constexpr LogTerm logTerms[] = {
    {"Plane Measuring", "Измерить плоскость", "Mätning plan"},
    {"Projection angle A axis", "Угол проекции оси A", "Projektionsvinkel A-axel"},
    {"Projection angle B axis", "Угол проекции оси B", "Projektionsvinkel B-axel"},
    {"Space angle A", "Пространственный угол A", "Rymdvinkel A"},
    {"Space angle B", "Пространственный угол B", "Rymdvinkel B"},
    {"Space angle C", "Пространственный угол C", "Rymdvinkel C"},
    {"1st measured value", "1-е измеренное значение", "1:a mätvärde"},
    {"2nd measured value", "2-е измеренное значение", "2:a mätvärde"},
    {"3rd measured value", "3-е измеренное значение", "3:e mätvärde"},
};

constexpr CycleDefinition definition = {
    .number = 431,
    .name = "431",
    .title = "MEASURE PLANE",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures the angles of a plane by three touches in the touch probe axis, as projection angles and as space "
        "angles for PLANE SPATIAL.",
    .parameters = parameters431,
    .results = results431,
};

void run(Context& context, const Arguments&) {
  const PlaneWay down = probing::axisDirection(2, -1);
  const PlannedTouch first{{context.q(263), context.q(264), context.q(294)}, down};
  const PlannedTouch second{{context.q(265), context.q(266), context.q(295)}, down};
  const PlannedTouch third{{context.q(296), context.q(297), context.q(298)}, down};
  const auto touches = probing::probePoints(
      context.prober(), {{first}, {second}, {third}},
      {.clearance = context.q(260), .extraClearance = context.q(320), .between = probing::Between::AtClearanceHeight});

  // Ball centres lie on a parallel plane: the angles are the same at any tilt.
  const BallCentre& p1 = touches[0].ballCentre;
  const BallCentre& p2 = touches[1].ballCentre;
  const BallCentre& p3 = touches[2].ballCentre;
  notePlane(context.channel().journal(), std::array{p1.vector(), p2.vector(), p3.vector()}, placesOf(touches));
  const PlaneWay main = p2 - p1;
  const PlaneWay cross = main.cross(p3 - p1);
  if (cross.norm() < 1e-6 * main.norm() * (p3 - p1).norm() || main.norm() < 1e-6) {
    throw control::Alarm("Plane wrongly defined", "The three touches lie on one straight line",
                         "choose points that span a triangle");
  }
  const PlaneWay u = main.normalized();
  PlaneWay n = cross.normalized();
  if (n.z() < 0) {
    n = -n;
    context.warn(
        "The third point lies on the negative side of the line through the first two; the tool axis was turned out of "
        "the part");
  }
  const auto& plane = context.control().coordinates.plane;
  // Space angles count about X, Y and Z, whatever the touch probe axis.
  Matrix3 axes;
  axes.col(plane.main) = plane.xyzFromPlane(u).vector();
  axes.col(plane.minor) = plane.xyzFromPlane(n.cross(u)).vector();
  axes.col(plane.tool) = plane.xyzFromPlane(n).vector();
  const Vector3 space = control::heidenhain::spaceAnglesFromRotation(axes);
  context.result(158, degreesFromRadians(std::atan2(-n.y(), n.z())));
  context.result(159, degreesFromRadians(std::atan2(n.x(), n.z())));
  context.result(170, space.x());
  context.result(171, space.y());
  context.result(172, space.z());
  context.result(173, touches[0].surface.z(), {.nominal = context.q(294)});
  // The older control has one result for the touch probe axis.
  if (context.control().isTNC640()) {
    context.result(174, touches[1].surface.z(), {.nominal = context.q(295)});
    context.result(175, touches[2].surface.z(), {.nominal = context.q(298)});
  }
  const auto angle = [](std::string label, double degrees) {
    return LogLine{std::move(label), degrees, ValueKind::Angle};
  };
  writeLog(context, {.title = "Plane Measuring",
                     .items = {},
                     .measured = {angle("Projection angle A axis", degreesFromRadians(std::atan2(-n.y(), n.z()))),
                                  angle("Projection angle B axis", degreesFromRadians(std::atan2(n.x(), n.z()))),
                                  angle("Space angle A", space.x()),
                                  angle("Space angle B", space.y()),
                                  angle("Space angle C", space.z()),
                                  {"1st measured value", touches[0].surface.z()},
                                  {"2nd measured value", touches[1].surface.z()},
                                  {"3rd measured value", touches[2].surface.z()}},
                     .further = {}});
}

}  // namespace

extern const Entry cycle431 = {.definition = definition, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain
