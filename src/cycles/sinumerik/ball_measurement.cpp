#include "cycles/sinumerik/ball_measurement.hpp"

#include <vector>

#include "cycles/fit_records.hpp"
#include "metrology/fits.hpp"

namespace probewright::cycles::sinumerik {
namespace {

class Ball {
public:
  Ball(Context& context, const BallPlan& plan)
      : context_(context),
        plan_(plan),
        prober_(context.prober()),
        toucher_(context, plan.alignProbe ? Method::ProbeAligned : Method::Standard) {}

  /// The middle of the equator in the plane, found by touches at the height of `about`.
  Vector2 equator(const PartPoint& about) {
    // Along the axes: minus 1st axis first, then on to plus, by way of minus 2nd.
    const double first = plan_.round ? plan_.startAngle : 180, step = plan_.round ? plan_.step : 90;
    std::vector<Vector2> centres;
    points_.clear();
    for (const probing::PlannedTouch& touch :
         probing::planCircle(about, plan_.diameter, first, step, plan_.points, Side::Outside)) {
      if (plan_.round && !centres.empty()) prober_.moveOnArc(about, step);
      points_.push_back(this->touch(touch));
      centres.push_back((points_.back().surface - touch.direction * prober_.ballRadius()).inPlane());
      if (!plan_.round) prober_.moveHeightTo(plan_.safeHeight);
    }
    prober_.moveHeightTo(plan_.safeHeight);
    const auto fit = metrology::fitCircle(centres, withCofactors);
    if (!fit) context_.alarm(61316, fit.error().message);
    context_.channel().journal().fit(recordOf(*fit, placesOf(points_)));
    return fit->shape.centre;
  }

  /// Height of the pole.
  double pole(const Vector2& over, double expected) {
    prober_.moveInPlane({over.x(), over.y(), 0});
    points_.push_back(
        prober_.measure({over.x(), over.y(), expected}, -PlaneWay::unit(2), plan_.path, context_.repetitions()));
    prober_.moveHeightTo(plan_.safeHeight);
    return points_.back().surface.z();
  }

  /// The diameter by a touch on the minus side of the 1st axis.
  double diameter(const PartPoint& centre) {
    points_.push_back(
        touch({.surface = centre - PlaneWay::unit(0) * plan_.diameter / 2, .direction = PlaneWay::unit(0)}));
    prober_.moveHeightTo(plan_.safeHeight);
    return 2 * (centre.x() - points_.back().surface.x());
  }

  void finish(const PartPoint& over) {
    std::vector<Vector3> surface;
    for (const MeasuredPoint& point : points_)
      surface.push_back(point.surface.vector());
    noteSphere(context_.channel().journal(), surface, placesOf(points_));
    toucher_.finish();
    prober_.moveInPlane(tipAt(over));
  }

private:
  /// `planned` at the height of the ball's centre; down to it from the safe height first.
  MeasuredPoint touch(const probing::PlannedTouch& planned) {
    PartPoint setpoint = planned.surface;
    if (!prober_.probe().lengthToCentre) setpoint[2] -= prober_.ballRadius() * prober_.toolAxis().z();
    if (prober_.position().z() > setpoint.z() + 1e-6) {
      prober_.moveInPlane(toucher_.startOf(setpoint, planned.direction, plan_.path));
      prober_.moveHeightTo(setpoint.z());
    }
    return toucher_.measure(setpoint, planned.direction, plan_.path);
  }

  Context& context_;
  const BallPlan& plan_;
  probing::SinumerikProber& prober_;
  Toucher toucher_;
  std::vector<MeasuredPoint> points_;  ///< of the last round: equator, pole, then the one for the diameter
};

}  // namespace

MeasuredBall measureBall(Context& context, const BallPlan& plan) {
  Ball ball(context, plan);
  MeasuredBall result{.centre = plan.centre, .diameter = plan.diameter};
  for (int pass = 0; pass < (plan.repeat ? 2 : 1); ++pass) {
    const Vector2 middle = ball.equator(result.centre);
    const double pole = ball.pole(middle, result.centre.z() + plan.diameter / 2);
    result.centre = {middle.x(), middle.y(), pole - plan.diameter / 2};
  }
  if (plan.findDiameter) {
    result.diameter = ball.diameter(result.centre);
    result.centre[2] += (plan.diameter - result.diameter) / 2;
  }
  ball.finish(result.centre);
  return result;
}

}  // namespace probewright::cycles::sinumerik
