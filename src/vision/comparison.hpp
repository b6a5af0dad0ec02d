#pragma once

#include <span>
#include <vector>

#include "machine/camera.hpp"
#include "vision/window.hpp"

/// Whether a picture shows what reference pictures show.
namespace probewright::vision {

using machine::Picture;

/// How sensitive a comparison can be set.
inline constexpr double leastSensitivity = 0.1, mostSensitivity = 10;

/// The average of the reference pictures and how much they differ from each other, pixel by pixel.
///
/// A pixel deviates where the picture differs from the average by more than `5 / sensitivity` times
///
///     sqrt(s^2 + 2^2 + (0.35 * g)^2)    grey levels,
///
/// s the standard deviation of the reference pictures there, 2 the noise of a camera that is always assumed, g the
/// slope of the average picture: edges may be off by about a third of a pixel. Before, noise is smoothed (Gauss,
/// one pixel), and each picture is made as bright as the first one by one factor over all monitoring areas (0.5 to 2):
/// a lamp that has become weaker is not an error. Single pixels and lines one pixel wide are dropped, places at most
/// two pixels apart become one, and an error has at least 6 / sensitivity pixels.
class Average {
public:
  /// `references` must be at least one, all of one size. Pixels outside of all areas count for nothing.
  Average(std::span<const Picture* const> references, std::vector<Window> areas);

  int width() const { return width_; }
  int height() const { return height_; }
  /// The average picture itself.
  Picture picture() const;

  /// Where `picture`, which must have the same size, deviates within the areas: the rectangles about each place, the
  /// largest first.
  std::vector<Window> errorsOf(const Picture& picture, double sensitivity) const;

private:
  int width_ = 0, height_ = 0;
  std::vector<Window> areas_;
  std::vector<float> mean_;
  std::vector<float> spread_;  ///< squared, what is permitted without the factor
};

}  // namespace probewright::vision
