#include "conversion/measuring_task.hpp"

namespace probewright::conversion {

bool isInside(Feature feature) {
  return feature == Feature::Hole || feature == Feature::HoleSegment || feature == Feature::Groove ||
         feature == Feature::Pocket || feature == Feature::InsideCorner;
}

bool isRound(Feature feature) {
  return feature == Feature::Hole || feature == Feature::Spigot || feature == Feature::HoleSegment ||
         feature == Feature::SpigotSegment;
}

bool isRectangular(Feature feature) { return feature == Feature::Pocket || feature == Feature::RectangularSpigot; }

bool isCorner(Feature feature) { return feature == Feature::InsideCorner || feature == Feature::OutsideCorner; }

bool isWidth(Feature feature) { return feature == Feature::Groove || feature == Feature::Rib; }

}  // namespace probewright::conversion
