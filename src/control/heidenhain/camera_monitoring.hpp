#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "machine/camera.hpp"
#include "vision/comparison.hpp"
#include "vision/window.hpp"

/// What a control with Visual Setup Control keeps of its camera: for each monitoring point of a program the images that
/// were taken there, and how they are compared.
namespace probewright::control::heidenhain {

using vision::Window;

/// What an image has been marked as; it is one of them only.
enum class ImageKind {
  Plain,
  Reference,  ///< a safe situation: takes part in the average
  Error,      ///< a bad one
};

struct MonitoringImage {
  int number = 0;  ///< of its file, from 1
  ImageKind kind = ImageKind::Plain;
  std::vector<Window> marked;  ///< errors that the operator has drawn
  std::vector<Window> found;   ///< errors that the last evaluation has found
  std::string png;

  machine::Picture picture() const;
};

struct MonitoringSettings {
  std::vector<Window> areas;  ///< where errors count, of all images of the point
  double sensitivity = 1;     ///< vision::leastSensitivity to vision::mostSensitivity
  friend bool operator==(const MonitoringSettings&, const MonitoringSettings&) = default;
};

/// What other settings or other reference images make of an image.
enum class SensitivityChange {
  None,  ///< all errors stored with the image are found again, and no others
  Less,  ///< an error stored with it is found no longer
  More,  ///< an error is found that was not recognized before
};

/// One monitoring file: that of a name (QS600) in a program.
class MonitoringPoint {
public:
  /// Images that are not marked: of more than these the oldest are forgotten.
  static constexpr int mostPlainImages = 20;
  static constexpr int mostImages = 999;

  std::string program;  ///< the main program without folder and extension, in capitals
  std::string name;     ///< in capitals
  MonitoringSettings settings;
  std::vector<MonitoringImage> images;

  /// Stores a picture after the others. Evaluates it as far as that is possible.
  MonitoringImage& add(const machine::Picture& picture);
  MonitoringImage* image(int number);

  int count(ImageKind kind) const;
  /// True if an area is defined and there are as many reference images; at least one.
  bool configured(int references) const;

  /// The average of the reference images; null without them.
  std::shared_ptr<const vision::Average> average() const;
  /// The errors in a picture with these settings: none without reference images.
  std::vector<Window> errorsIn(const machine::Picture& picture) const;

  /// Evaluates all images anew, and says for each what has changed against what was stored with it.
  std::vector<SensitivityChange> evaluate();

private:
  /// The last average, and of what: decoding all reference images takes time.
  struct Known {
    std::vector<int> references;
    std::vector<Window> areas;
    std::shared_ptr<const vision::Average> average;
  };
  mutable Known known_;
};

/// "PLATE.OS": the beginning of the names of all files of a point.
std::string fileStem(const MonitoringPoint& point);
/// "PLATE.OS.VSC", which holds everything but the pictures.
std::string monitoringFileName(const MonitoringPoint& point);
/// "PLATE.OS.0003.PNG".
std::string imageFileName(const MonitoringPoint& point, const MonitoringImage& image);

/// Why a text is not a name of a monitoring point; empty if it is one.
std::string complaintAboutName(std::string_view name);

/// The camera and the monitoring files of all programs.
struct CameraMonitoring {
  machine::Camera* camera = nullptr;
  std::vector<MonitoringPoint> points;

  /// The point of that name; a new one, after the others, if there is none.
  MonitoringPoint& point(const std::string& programPath, std::string_view name);
};

}  // namespace probewright::control::heidenhain
