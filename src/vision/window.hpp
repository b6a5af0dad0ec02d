#pragma once

namespace probewright::vision {

/// A rectangle of a picture, pixels; x to the right and y down from the upper left corner.
struct Window {
  int x = 0, y = 0;
  int width = 0, height = 0;

  friend bool operator==(const Window&, const Window&) = default;
};

/// True if the two have a pixel in common.
constexpr bool overlap(const Window& a, const Window& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// True if it has pixels, all of them in a picture of that size.
constexpr bool fits(const Window& window, int width, int height) {
  return window.width > 0 && window.height > 0 && window.x >= 0 && window.y >= 0 && window.x <= width - window.width &&
         window.y <= height - window.height;
}

}  // namespace probewright::vision
