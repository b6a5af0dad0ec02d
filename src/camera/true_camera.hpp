#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/primitives.hpp"
#include "machine/description.hpp"

/// What is true of the camera in a virtual working space and of the light there. Plain data; a VirtualCamera is made
/// of it.
namespace probewright::camera {

/// What a lamp is fixed to.
enum class Mounted {
  Bed,      ///< `position` counts in the base frame
  Spindle,  ///< in the spindle frame: a ring light about the camera
};

struct Lamp {
  Vector3 position = Vector3::Zero();  ///< mm
  Mounted on = Mounted::Bed;
  /// What a white surface that faces the lamp sends back, as a part of what the camera shows as white. Does not depend
  /// on the distance.
  double brightness = 0.7;
};

/// How a surface looks.
struct Finish {
  double reflectance = 0.5;  ///< 0 black to 1 white, the same in all directions
  double gloss = 0;          ///< 0 to 1, what is added where a lamp mirrors in it
};

/// What is wrong with a camera.
enum class CameraFault { None, NoSignal, CoverStuck };

/// The camera turns with the spindle head, not with the spindle. Spindle frame at spindle angle 0.
struct TrueCamera {
  Vector3 position = Vector3(0, 0, 0);    ///< mm, of the lens
  Vector3 direction = -Vector3::UnitZ();  ///< in which it looks; unit
  Vector3 up = Vector3::UnitY();          ///< what is up in its pictures; not along `direction`
  int width = 320, height = 240;          ///< pixels
  double fieldOfView = 50;                ///< degrees, from the left to the right edge of a picture without distortion
  /// Of the lens, after Brown: r^2 = x^2 + y^2 in units of the focal length, x' = x (1 + k1 r^2 + k2 r^4) + 2 p1 x y +
  /// p2 (r^2 + 2 x^2), y' alike with p1 and p2 exchanged; k1, k2, p1, p2.
  std::array<double, 4> distortion{};
  double ambient = 0.25;    ///< light from everywhere, as Lamp::brightness
  std::vector<Lamp> lamps;  ///< they throw shadows
  double noise = 1.5;       ///< grey levels, standard deviation of a pixel
  double flicker = 0.005;   ///< standard deviation of the brightness of each lamp, a part of it
  CameraFault fault = CameraFault::None;
  std::map<std::string, Finish> finishes;  ///< by the name of the solid; others look as their role
  /// Where the machine tool builder lets it look at the whole working space.
  std::optional<machine::AxisPositions> overview;
};

}  // namespace probewright::camera
