#include "control/heidenhain/camera_monitoring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "base/text.hpp"
#include "vision/png.hpp"

namespace probewright::control::heidenhain {

namespace {

bool isIn(const Window& window, const std::vector<Window>& others) {
  return std::ranges::any_of(others, [&](const Window& other) { return vision::overlap(window, other); });
}

SensitivityChange changeOf(const MonitoringImage& image, const std::vector<Window>& found) {
  const auto stays = [&](const Window& error) { return isIn(error, found); };
  if (!std::ranges::all_of(image.marked, stays) || !std::ranges::all_of(image.found, stays))
    return SensitivityChange::Less;
  const auto known = [&](const Window& error) { return isIn(error, image.found) || isIn(error, image.marked); };
  return std::ranges::all_of(found, known) ? SensitivityChange::None : SensitivityChange::More;
}

/// What remains of a text in the name of a file.
std::string forFiles(std::string text) {
  for (char& c : text) {
    const bool plain = isLetter(c) || isDigit(c) || c == '_' || c == '-' || c == '.';
    if (!plain) c = '_';
  }
  return text;
}

std::vector<Window> errorsBy(const std::shared_ptr<const vision::Average>& average, const machine::Picture& picture,
                             double sensitivity) {
  if (!average || picture.width != average->width() || picture.height != average->height()) return {};
  return average->errorsOf(picture, sensitivity);
}

}  // namespace

machine::Picture MonitoringImage::picture() const {
  auto picture = vision::fromPng(png, fmt::format("image {}", number));
  if (!picture) throw std::logic_error(picture.error().message);
  return *std::move(picture);
}

MonitoringImage& MonitoringPoint::add(const machine::Picture& picture) {
  MonitoringImage image;
  image.number = images.empty() ? 1 : images.back().number + 1;
  image.png = vision::toPng(picture);
  // The number may be that of an image that was deleted.
  if (std::ranges::find(known_.references, image.number) != known_.references.end()) known_ = {};
  image.found = errorsIn(picture);
  images.push_back(std::move(image));
  if (count(ImageKind::Plain) > mostPlainImages)
    images.erase(std::ranges::find(images, ImageKind::Plain, &MonitoringImage::kind));
  return images.back();
}

MonitoringImage* MonitoringPoint::image(int number) {
  const auto found = std::ranges::find(images, number, &MonitoringImage::number);
  return found == images.end() ? nullptr : &*found;
}

int MonitoringPoint::count(ImageKind kind) const {
  return static_cast<int>(std::ranges::count(images, kind, &MonitoringImage::kind));
}

bool MonitoringPoint::configured(int references) const {
  return !settings.areas.empty() && count(ImageKind::Reference) >= std::max(references, 1);
}

std::shared_ptr<const vision::Average> MonitoringPoint::average() const {
  std::vector<int> references;
  for (const MonitoringImage& image : images)
    if (image.kind == ImageKind::Reference) references.push_back(image.number);
  if (known_.references == references && known_.areas == settings.areas) return known_.average;
  std::vector<machine::Picture> pictures;
  for (const MonitoringImage& image : images) {
    if (image.kind != ImageKind::Reference) continue;
    machine::Picture picture = image.picture();
    if (!pictures.empty() && (picture.width != pictures[0].width || picture.height != pictures[0].height)) continue;
    pictures.push_back(std::move(picture));
  }
  std::vector<const machine::Picture*> all;
  all.reserve(pictures.size());
  for (const machine::Picture& picture : pictures)
    all.push_back(&picture);
  known_ = {std::move(references), settings.areas, nullptr};
  if (!all.empty()) known_.average = std::make_shared<const vision::Average>(all, settings.areas);
  return known_.average;
}

std::vector<Window> MonitoringPoint::errorsIn(const machine::Picture& picture) const {
  return errorsBy(average(), picture, settings.sensitivity);
}

std::vector<SensitivityChange> MonitoringPoint::evaluate() {
  const std::shared_ptr<const vision::Average> mean = average();
  std::vector<SensitivityChange> changes;
  for (MonitoringImage& image : images) {
    std::vector<Window> found = errorsBy(mean, image.picture(), settings.sensitivity);
    changes.push_back(changeOf(image, found));
    image.found = std::move(found);
  }
  return changes;
}

std::string fileStem(const MonitoringPoint& point) { return point.program + "." + point.name; }

std::string monitoringFileName(const MonitoringPoint& point) { return fileStem(point) + ".VSC"; }

std::string imageFileName(const MonitoringPoint& point, const MonitoringImage& image) {
  return fmt::format("{}.{:04}.PNG", fileStem(point), image.number);
}

std::string complaintAboutName(std::string_view name) {
  constexpr std::size_t longest = 32;
  if (name.empty()) return "it is empty";
  if (name.size() > longest) return fmt::format("it has more than {} characters", longest);
  const auto fits = [](char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '-'; };
  return std::ranges::all_of(name, fits) ? "" : "names of files take letters, digits, _ and - only";
}

MonitoringPoint& CameraMonitoring::point(const std::string& programPath, std::string_view name) {
  constexpr std::size_t longest = 180;
  const std::string program =
      forFiles(upperCase(std::filesystem::path(programPath).stem().string().substr(0, longest)));
  const std::string capitals = upperCase(name);
  const auto known = std::ranges::find_if(
      points, [&](const MonitoringPoint& each) { return each.program == program && each.name == capitals; });
  if (known != points.end()) return *known;
  MonitoringPoint made;
  made.program = program;
  made.name = capitals;
  points.push_back(std::move(made));
  return points.back();
}

}  // namespace probewright::control::heidenhain
