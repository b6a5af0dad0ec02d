#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "machine/machine.hpp"

/// What a machine with a camera in its working space offers beyond machine.hpp. A machine without one does not
/// implement it.
namespace probewright::machine {

/// A picture in shades of grey: row by row from the upper left corner, one byte a pixel, 0 black to 255 white.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;

  std::uint8_t at(int x, int y) const {
    return grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  friend bool operator==(const Picture&, const Picture&) = default;
};

enum class CameraEnd {
  Done,
  Failed,     ///< no signal, a cover that does not move; `detail` says which
  Cancelled,  ///< a stop was asked for
};

struct CameraResult {
  CameraEnd end = CameraEnd::Done;
  std::string detail;
};

struct PictureResult {
  CameraEnd end = CameraEnd::Done;
  Picture picture;  ///< if it was taken
  std::string detail;
};

/// A camera on the spindle, behind a cover that keeps it clean. Calls as those of Machine: one thread makes them, one
/// after another, and the axes stand meanwhile.
class Camera {
public:
  virtual ~Camera() = default;

  /// Where the machine tool builder wants the axes for a picture of the whole working space; nothing if he has fixed no
  /// such position.
  virtual std::optional<AxisPositions> overviewPosition() const = 0;

  virtual CameraResult openCover() = 0;
  virtual CameraResult closeCover() = 0;
  virtual bool coverOpen() const = 0;

  /// Takes a picture from where the spindle stands. With the cover closed it is dark.
  virtual PictureResult takePicture() = 0;
};

/// A machine that has a camera is one of these, too.
class CameraOwner {
public:
  virtual ~CameraOwner() = default;
  /// Null if it has none.
  virtual Camera* camera() = 0;
};

/// The camera of the machine, or null.
inline Camera* cameraOf(Machine& machine) {
  auto* owner = dynamic_cast<CameraOwner*>(&machine);
  return owner == nullptr ? nullptr : owner->camera();
}

}  // namespace probewright::machine
