#include "control/heidenhain/camera_screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "control/alarm.hpp"
#include "vision/png.hpp"

namespace probewright::control::heidenhain {

namespace {

/// What the control says, in the languages that it is known in.
struct ScreenText {
  std::string_view english, russian, swedish, german;
  std::string in(DialogLanguage language) const {
    if (language == DialogLanguage::Russian) return std::string(russian);
    if (language == DialogLanguage::Swedish) return std::string(swedish);
    if (language == DialogLanguage::German) return std::string(german);
    return std::string(english);
  }
};

constexpr ScreenText drawAreas = {
    "Monitoring point not configured: Draw areas!", "Точка мониторинга не сконфигурирована: начертите область!",
    "Övervakningspunkt ej konfigurerad: Rita områden!", "Überwachungspunkt nicht konfiguriert: Bereiche zeichnen!"};
constexpr ScreenText tooFew = {"Too few reference images: Select next action by soft key!",
                               "Слишком мало опорных изображ.: выберите действие прогр. клавишей",
                               "För få referensbilder: Välj nästa åtgärd med softkey!",
                               "Zu wenige Referenzbilder: Nächste Aktion mit Softkey wählen!"};

std::string_view nameOf(SensitivityChange change) {
  switch (change) {
    case SensitivityChange::Less:
      return "errors stored with the image are found no longer: the monitoring is less sensitive";
    case SensitivityChange::More:
      return "errors are found that were not recognized before: the monitoring is more sensitive";
    case SensitivityChange::None:
      break;
  }
  return "no change";
}

}  // namespace

CameraScreen::CameraScreen(CameraScreenPort port, MonitoringPoint& point, int references)
    : port_(std::move(port)), point_(point), references_(references), shown_(point.images.back().number) {}

std::string CameraScreen::message() const {
  const DialogLanguage language = port_.language;
  const int references = point_.count(ImageKind::Reference);
  const auto& found = point_.images.back().found;
  if (references == 0) return "No reference image is available for the comparison";
  if (point_.settings.areas.empty()) return drawAreas.in(language);
  if (!found.empty()) {
    return fmt::format("The image deviates from the reference images in {} place{}", found.size(),
                       found.size() == 1 ? "" : "s");
  }
  return point_.configured(references_) ? "No error" : tooFew.in(language);
}

std::string CameraScreen::statusLine() const {
  const MonitoringImage* image = nullptr;
  for (const MonitoringImage& each : point_.images)
    if (each.number == shown_) image = &each;
  std::string text = fmt::format("{}  reference images: {}", fileStem(point_), point_.count(ImageKind::Reference));
  if (references_ > 0) text += fmt::format(" of {}", references_);
  text += fmt::format("  error images: {}", point_.count(ImageKind::Error));
  if (image != nullptr && image->kind == ImageKind::Reference) text += "  Reference";
  if (image != nullptr && image->kind == ImageKind::Error) text += "  Error";
  return text;
}

void CameraScreen::display() {
  const MonitoringImage* image = point_.image(shown_);
  if (image == nullptr) return;
  std::vector<Window> errors = image->found;
  errors.insert(errors.end(), image->marked.begin(), image->marked.end());
  port_.file(fileStem(point_) + ".SCREEN.PNG", vision::toPng(image->picture(), point_.settings.areas, errors));
}

void CameraScreen::operate(std::string_view keys, const std::string& question) {
  const auto strokes = keyStrokes(keys);
  if (!strokes) {
    throw Alarm("Soft key unknown", fmt::format("'{}' is not a list of soft keys for {}", keys, question),
                "give soft keys between ; such as REFERENCE IMAGE; CONFIGURE; DRAW AREA X Y WIDTH HEIGHT; SAVE AND "
                "BACK; BACK");
  }
  for (const KeyStroke& stroke : *strokes) {
    if (left_) break;
    press(stroke);
  }
  leave();
}

void CameraScreen::press(const KeyStroke& stroke) {
  if (unconfirmed_ && stroke.key != CameraKey::Confirm) {
    point_ = *std::exchange(unconfirmed_, std::nullopt);
    port_.warn("The changed sensitivity is not confirmed: the settings stay as they were");
  }
  if (before_) return configures(stroke.key) ? pressWhileConfiguring(stroke) : inactive(stroke);
  switch (stroke.key) {
    case CameraKey::Back:
      left_ = true;
      break;
    case CameraKey::Repeat:
      if (!port_.takeAnother) return inactive(stroke);
      if (const auto picture = port_.takeAnother()) {
        shown_ = point_.add(*picture).number;
        port_.show(statusLine() + "\n" + message());
      } else {
        left_ = true;
      }
      break;
    case CameraKey::ReferenceImage:
      mark(ImageKind::Reference, stroke.text);
      break;
    case CameraKey::ErrorImage:
      mark(ImageKind::Error, stroke.text);
      break;
    case CameraKey::Confirm:
      if (!unconfirmed_) return inactive(stroke);
      unconfirmed_.reset();
      break;
    case CameraKey::SelectImage:
      if (point_.image(static_cast<int>(stroke.number)) == nullptr) return inactive(stroke);
      shown_ = static_cast<int>(stroke.number);
      break;
    case CameraKey::DeleteImage:
      remove();
      break;
    case CameraKey::Evaluate:
      marked_ = false;
      test(Images::All);
      evaluate(Settings::Kept);
      break;
    case CameraKey::Configure:
      before_ = point_;
      break;
    default:
      inactive(stroke);
  }
}

void CameraScreen::pressWhileConfiguring(const KeyStroke& stroke) {
  auto& areas = point_.settings.areas;
  switch (stroke.key) {
    case CameraKey::DrawArea:
      draw(stroke, areas);
      break;
    case CameraKey::DeleteArea:
      erase(stroke, areas);
      break;
    case CameraKey::DrawError:
      draw(stroke, point_.image(shown_)->marked);
      break;
    case CameraKey::DeleteError:
      erase(stroke, point_.image(shown_)->marked);
      break;
    case CameraKey::Sensitivity:
      if (stroke.number < vision::leastSensitivity || stroke.number > vision::mostSensitivity) return inactive(stroke);
      point_.settings.sensitivity = stroke.number;
      break;
    case CameraKey::TestImage:
      test(Images::Shown);
      break;
    case CameraKey::TestAll:
      test(Images::All);
      break;
    case CameraKey::ShowAreas:
      for (std::size_t i = 0; i < areas.size(); ++i) {
        port_.show(fmt::format("Monitoring area {}: {} {} {} {}", i + 1, areas[i].x, areas[i].y, areas[i].width,
                               areas[i].height));
      }
      break;
    case CameraKey::ShowAverage:
      if (const auto average = point_.average())
        port_.file(fileStem(point_) + ".AVERAGE.PNG", vision::toPng(average->picture(), areas, {}));
      break;
    case CameraKey::SaveAndBack:
      if (before_->settings != point_.settings) {
        evaluate(Settings::Changed);
      } else {
        before_.reset();
      }
      break;
    case CameraKey::DiscardAndBack:
      point_ = *std::exchange(before_, std::nullopt);
      break;
    default:
      inactive(stroke);
  }
}

/// Pressed again the key takes the mark away. An image cannot be both.
void CameraScreen::mark(ImageKind kind, const std::string& key) {
  ImageKind& is = point_.image(shown_)->kind;
  if (is != ImageKind::Plain && is != kind) {
    const std::string other = is == ImageKind::Reference ? "a reference image" : "an error image";
    port_.warn(fmt::format("Soft key {} is inactive: the image is {}", key, other));
    return;
  }
  marked_ = marked_ || kind == ImageKind::Reference;
  is = is == kind ? ImageKind::Plain : kind;
}

void CameraScreen::remove() {
  if (point_.images.size() == 1) {
    port_.warn("Soft key DELETE IMAGE is inactive: it is the only image");
    return;
  }
  const auto image = std::ranges::find(point_.images, shown_, &MonitoringImage::number);
  marked_ = marked_ || image->kind == ImageKind::Reference;
  point_.images.erase(image);
  shown_ = point_.images.back().number;
}

void CameraScreen::draw(const KeyStroke& stroke, std::vector<Window>& windows) {
  const machine::Picture picture = point_.image(shown_)->picture();
  if (!vision::fits(stroke.window, picture.width, picture.height)) {
    throw Alarm("Window outside the image",
                fmt::format("{} {} {} {} {} does not lie in an image of {} x {} pixels", stroke.text, stroke.window.x,
                            stroke.window.y, stroke.window.width, stroke.window.height, picture.width, picture.height),
                "give x, y of the upper left corner, width and height in pixels");
  }
  if (std::ranges::find(windows, stroke.window) == windows.end()) windows.push_back(stroke.window);
}

void CameraScreen::erase(const KeyStroke& stroke, std::vector<Window>& windows) {
  if (stroke.number < 1 || stroke.number > static_cast<double>(windows.size())) return inactive(stroke);
  windows.erase(windows.begin() + static_cast<std::ptrdiff_t>(stroke.number) - 1);
}

void CameraScreen::test(Images which) {
  MonitoringPoint trial = point_;
  const auto changes = trial.evaluate();
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (which == Images::Shown && trial.images[i].number != shown_) continue;
    port_.show(fmt::format("Image {}: {} errors; {}", trial.images[i].number, trial.images[i].found.size(),
                           nameOf(changes[i])));
  }
}

void CameraScreen::evaluate(Settings settings) {
  const auto changes = point_.evaluate();
  bool sensitive = false;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (changes[i] == SensitivityChange::None) continue;
    sensitive = true;
    port_.warn(fmt::format("Image {} of {}: {}", point_.images[i].number, fileStem(point_), nameOf(changes[i])));
  }
  if (settings == Settings::Changed && sensitive) unconfirmed_ = before_;
  before_.reset();
}

void CameraScreen::leave() {
  if (before_) {
    point_ = *std::exchange(before_, std::nullopt);
    port_.warn("The configuration is left without SAVE AND BACK: the settings stay as they were");
  }
  if (unconfirmed_) {
    point_ = *std::exchange(unconfirmed_, std::nullopt);
    port_.warn("The changed sensitivity is not confirmed: the settings stay as they were");
  }
  if (std::exchange(marked_, false)) evaluate(Settings::Kept);
  display();
}

void CameraScreen::inactive(const KeyStroke& stroke) {
  port_.warn(fmt::format("Soft key {} is inactive here", stroke.text));
}

}  // namespace probewright::control::heidenhain
