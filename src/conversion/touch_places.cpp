#include "conversion/touch_places.hpp"

namespace probewright::conversion {

void noteTouchPlaces(Output& out, const language::Block& block, const MeasuringTask& task) {
  switch (task.feature) {
    case Feature::Hole:
    case Feature::Spigot:
    case Feature::SpigotPair:
      out.listOnce(block,
                   "CYCLE977 measures the second axis through the middle that it has found in the first one, touch "
                   "probe cycles measure a circle about the place that they expect: touches lie at other places, on a "
                   "true circle with the same results",
                   "move the workpiece, or its origin, to where the program expects it", Severity::Note);
      return;
    case Feature::Pocket:
    case Feature::RectangularSpigot:
      out.listOnce(block,
                   "CYCLE977 measures the second axis through the middle that it has found in the first one, touch "
                   "probe cycles measure a rectangle about the place that they expect: touches lie at other places, "
                   "and results differ where the sides are turned against the axes",
                   "align the workpiece before the cycle", Severity::Note);
      return;
    case Feature::InsideCorner:
      if (task.correction == Correction::None) return;  // touch by touch
      out.listOnce(block,
                   "cycle 415 and CYCLE961 count their points of an inside corner differently: touches lie at other "
                   "places of the same edges",
                   "make sure that the edges are straight there", Severity::Note);
      return;
    case Feature::ProbeOnBall:
      out.listOnce(
          block,
          "cycle 460 and CYCLE976 go round a sphere differently: touches lie at other places, on a true sphere "
          "with the same results",
          "calibrate once more on the control itself", Severity::Note);
      return;
    default:
      return;
  }
}

}  // namespace probewright::conversion
