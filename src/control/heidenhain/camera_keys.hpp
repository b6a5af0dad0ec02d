#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vision/window.hpp"

/// The soft keys that an operator presses while a camera image is on the screen, as one text:
/// "REFERENCE IMAGE; CONFIGURE; DRAW AREA 40 30 200 150; SAVE AND BACK; BACK".
namespace probewright::control::heidenhain {

enum class CameraKey {
  Back,
  Repeat,  ///< stores the image and takes another one
  ReferenceImage,
  ErrorImage,
  Confirm,  ///< settings that make the monitoring more or less sensitive
  SelectImage,
  DeleteImage,
  Evaluate,
  Configure,
  // Below CONFIGURE.
  DrawArea,
  DeleteArea,
  DrawError,
  DeleteError,
  Sensitivity,
  TestImage,
  TestAll,
  ShowAreas,
  ShowAverage,
  SaveAndBack,
  DiscardAndBack,
};

struct KeyStroke {
  CameraKey key = CameraKey::Back;
  vision::Window window;  ///< that is drawn
  double number = 0;      ///< of an image, an area or an error from 1; the sensitivity
  std::string text;       ///< as it was written
};

/// Nothing if a part of the text is not a soft key, or lacks what belongs to it.
std::optional<std::vector<KeyStroke>> keyStrokes(std::string_view text);

/// True for the soft keys below CONFIGURE.
bool configures(CameraKey key);

}  // namespace probewright::control::heidenhain
