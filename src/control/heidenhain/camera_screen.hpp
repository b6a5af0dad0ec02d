#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/dialog_language.hpp"
#include "control/heidenhain/camera_keys.hpp"
#include "control/heidenhain/camera_monitoring.hpp"

namespace probewright::control::heidenhain {

/// What stands around the screen: a program that runs, or somebody who manages the images without one.
struct CameraScreenPort {
  DialogLanguage language = DialogLanguage::English;
  std::function<void(std::string text)> show;  ///< lines for the operator
  std::function<void(std::string text)> warn;
  std::function<void(const std::string& name, std::string bytes)> file;  ///< a picture of the screen
  /// Takes a picture for REPEAT; nothing if that fails. Null where there is no camera.
  std::function<std::optional<machine::Picture>()> takeAnother;
};

/// The screen on which a control shows the images of a monitoring point, and what its soft keys do. The last image is
/// on it at the beginning.
class CameraScreen {
public:
  /// `references`: how many reference images are wanted (Q617); 0: nobody says. The point must have an image.
  CameraScreen(CameraScreenPort port, MonitoringPoint& point, int references);

  /// Does what the soft keys say, and leaves the screen. Throws Alarm if one of them is none, or a window does not lie
  /// in the image.
  void operate(std::string_view keys, const std::string& question);

  /// Leaves the picture as a file.
  void display();
  /// Name, number of images, mark of the image.
  std::string statusLine() const;
  /// What the control says of its state: that there is no reference image, no area, too few reference images, an error.
  std::string message() const;

private:
  void press(const KeyStroke& stroke);
  void pressWhileConfiguring(const KeyStroke& stroke);
  void mark(ImageKind kind, const std::string& key);
  void remove();
  void draw(const KeyStroke& stroke, std::vector<Window>& windows);
  void erase(const KeyStroke& stroke, std::vector<Window>& windows);
  enum class Images { Shown, All };
  void test(Images which);
  /// Evaluates all images. Settings that change how sensitive the monitoring is wait for CONFIRM.
  enum class Settings { Kept, Changed };
  void evaluate(Settings settings);
  void leave();
  void inactive(const KeyStroke& stroke);

  CameraScreenPort port_;
  MonitoringPoint& point_;
  int references_;
  int shown_ = 0;  ///< number of the image on the screen
  bool left_ = false;
  bool marked_ = false;  ///< a reference image has come or gone since the last evaluation
  /// While CONFIGURE is pressed: as it was before.
  std::optional<MonitoringPoint> before_;
  /// Until new settings are confirmed: as it was before.
  std::optional<MonitoringPoint> unconfirmed_;
};

}  // namespace probewright::control::heidenhain
