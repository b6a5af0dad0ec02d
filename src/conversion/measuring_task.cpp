#include "conversion/measuring_task.hpp"

namespace probewright::conversion {

bool isInside(Feature feature) {
  return feature == Feature::Hole || feature == Feature::HoleSegment || feature == Feature::Groove ||
         feature == Feature::Pocket;
}

bool isRound(Feature feature) {
  return feature == Feature::Hole || feature == Feature::Spigot || feature == Feature::HoleSegment ||
         feature == Feature::SpigotSegment;
}

bool isRectangular(Feature feature) { return feature == Feature::Pocket || feature == Feature::RectangularSpigot; }

bool isWidth(Feature feature) { return feature == Feature::Groove || feature == Feature::Rib; }

}  // namespace probewright::conversion
