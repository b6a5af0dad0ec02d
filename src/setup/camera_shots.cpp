#include "setup/camera_shots.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "session/heidenhain/monitoring_files.hpp"
#include "vision/png.hpp"

namespace probewright::setup {

namespace {

using control::heidenhain::ImageKind;
using control::heidenhain::MonitoringImage;
using control::heidenhain::MonitoringPoint;

/// The points of a run by the names of their files; each is read once.
class Points {
public:
  explicit Points(const session::RunOutcome& outcome) : outcome_(outcome) {}

  /// Null where the run has left no file of that name.
  const MonitoringPoint* named(const std::string& file) {
    const auto known = points_.find(file);
    if (known != points_.end()) return known->second ? &*known->second : nullptr;
    std::optional<MonitoringPoint>& point = points_[file];
    const auto text = outcome_.files.find(file);
    if (text == outcome_.files.end()) return nullptr;
    const auto image = [&](const std::string& name) -> Result<std::string> {
      const auto bytes = outcome_.files.find(name);
      if (bytes == outcome_.files.end()) return fail("there is no image of this name");
      return bytes->second;
    };
    Diagnostics ignored;
    point = session::heidenhain::readMonitoringPoint(text->second, file, image, ignored);
    return point ? &*point : nullptr;
  }

private:
  const session::RunOutcome& outcome_;
  std::map<std::string, std::optional<MonitoringPoint>> points_;
};

reports::CameraShot shotOf(const MonitoringPoint& point, const MonitoringImage& image) {
  reports::CameraShot shot;
  shot.point = fileStem(point);
  shot.number = image.number;
  shot.references = point.count(ImageKind::Reference);
  shot.errors = static_cast<int>(image.found.size());
  shot.taken = image.png;
  const auto average = point.average();
  if (!average) return shot;
  shot.reference = vision::toPng(average->picture());
  if (!point.settings.areas.empty()) shot.evaluated = vision::toPng(image.picture(), point.settings.areas, image.found);
  return shot;
}

}  // namespace

std::vector<reports::CameraShot> cameraShots(const session::RunOutcome& outcome) {
  Points points(outcome);
  std::vector<reports::CameraShot> newestFirst;
  const auto& cycles = outcome.journal.cycles;
  for (std::size_t cycle = cycles.size(); cycle-- > 0 && newestFirst.size() < mostCameraShots;) {
    const auto& writes = cycles[cycle].writes;
    for (auto write = writes.rbegin(); write != writes.rend(); ++write) {
      if (!write->table.ends_with(".VSC")) continue;
      const MonitoringPoint* point = points.named(write->table);
      if (point == nullptr) continue;
      const auto image = std::ranges::find_if(
          point->images, [&](const MonitoringImage& each) { return imageFileName(*point, each) == write->after; });
      if (image == point->images.end()) continue;
      newestFirst.push_back(shotOf(*point, *image));
      newestFirst.back().cycle = static_cast<std::uint32_t>(cycle);
      break;
    }
  }
  return {newestFirst.rbegin(), newestFirst.rend()};
}

}  // namespace probewright::setup
