#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/number_text.hpp"
#include "base/text.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/camera_screen.hpp"
#include "interruption.hpp"
#include "output_folder.hpp"
#include "session/heidenhain/monitoring_files.hpp"
#include "terminal.hpp"

/// Manages what cycles 600 and 601 have stored, as the control does in manual operation.
namespace probewright::app {

namespace fs = std::filesystem;
namespace hh = control::heidenhain;

namespace {

constexpr const char* kindNames[] = {"", "reference", "error"};

void listPoints(const std::vector<hh::MonitoringPoint>& points, const fs::path& folder) {
  if (points.empty()) put(fmt::format("There are no camera images in {}\n", printable(folder.string())), stdout);
  for (const hh::MonitoringPoint& point : points) {
    put(fmt::format("{}  images: {}  reference images: {}  error images: {}  areas: {}  sensitivity: {}\n",
                    fileStem(point), point.images.size(), point.count(hh::ImageKind::Reference),
                    point.count(hh::ImageKind::Error), point.settings.areas.size(),
                    formatShortest(point.settings.sensitivity)),
        stdout);
  }
}

void listImages(const hh::MonitoringPoint& point) {
  for (const vision::Window& area : point.settings.areas)
    put(fmt::format("area  {} {} {} {}\n", area.x, area.y, area.width, area.height), stdout);
  for (const hh::MonitoringImage& image : point.images) {
    put(fmt::format("{}  {:9}  errors found: {}  marked: {}\n", imageFileName(point, image),
                    kindNames[static_cast<std::size_t>(image.kind)], image.found.size(), image.marked.size()),
        stdout);
  }
}

/// The point called "PLATE.OS", or "OS" if there is one only.
hh::MonitoringPoint* pointCalled(std::vector<hh::MonitoringPoint>& points, const std::string& name) {
  hh::MonitoringPoint* found = nullptr;
  for (hh::MonitoringPoint& point : points) {
    if (fileStem(point) == upperCase(name)) return &point;
    if (point.name != upperCase(name)) continue;
    if (found != nullptr) return nullptr;
    found = &point;
  }
  return found;
}

/// Files of the last run stay the set of one run; others are changed one by one.
Result<void> save(const fs::path& folder, const std::map<std::string, std::string>& before,
                  const std::map<std::string, std::string>& after) {
  const std::set<std::string> left = leftByEarlierRun(folder);
  const bool ofRun = std::ranges::all_of(before, [&](const auto& file) { return left.contains(file.first); });
  if (!ofRun) {
    for (const auto& [name, bytes] : after) {
      if (auto written = writeFileAtomically(folder / name, bytes); !written) return written;
    }
    std::error_code error;
    for (const auto& [name, bytes] : before)
      if (!after.contains(name)) fs::remove(folder / name, error);
    return {};
  }
  std::map<std::string, std::string> files = after;
  for (const std::string& name : left) {
    if (files.contains(name) || before.contains(name)) continue;
    auto bytes = readFile(folder / name);
    if (!bytes) return tl::unexpected(bytes.error());
    files.emplace(name, *std::move(bytes));
  }
  const Interruption interruption;
  Output output{folder, {}, {}};
  for (const auto& [name, bytes] : files)
    output.files.emplace_back(name, [&bytes = bytes](const Sink& sink) { sink(bytes); });
  return writeOutput(output, interruption.token());
}

/// Presses the soft keys, and keeps what they have changed.
Result<void> operate(const CameraArguments& arguments, hh::MonitoringPoint& point) {
  const std::map<std::string, std::string> before = session::heidenhain::monitoringFiles(point);
  std::map<std::string, std::string> pictures;
  const auto say = [](const std::string& text) { put(printable(text) + "\n", stdout); };
  hh::CameraScreen screen(
      {.show = say,
       .warn = say,
       .file = [&](const std::string& name, std::string bytes) { pictures[name] = std::move(bytes); },
       .takeAnother = {}},
      point, 0);
  try {
    screen.operate(arguments.keys, fileStem(point));
  } catch (const control::Alarm& alarm) {
    return fail(alarm.text(), alarm.advice());
  }
  for (const auto& [name, bytes] : pictures) {
    if (const auto why = whyNotWritable(arguments.folder, name)) return tl::unexpected(*why);
  }
  std::map<std::string, std::string> after = session::heidenhain::monitoringFiles(point);
  after.merge(pictures);
  return save(arguments.folder, before, after);
}

}  // namespace

int camera(const CameraArguments& arguments) {
  Diagnostics mistakes;
  std::error_code error;
  if (!fs::is_directory(arguments.folder, error)) {
    print({{Severity::Error,
            {},
            fmt::format("there is no folder \"{}\"", arguments.folder.string()),
            {},
            "name the folder that a run has left its tables in",
            {}}});
    return 2;
  }
  std::vector<hh::MonitoringPoint> points = session::heidenhain::readMonitoringFiles(arguments.folder, mistakes);
  print(mistakes);
  if (hasErrors(mistakes)) return 2;
  if (arguments.point.empty()) {
    listPoints(points, arguments.folder);
    return 0;
  }
  hh::MonitoringPoint* point = pointCalled(points, arguments.point);
  if (point == nullptr || point->images.empty()) {
    print({{Severity::Error,
            {},
            fmt::format("there is no monitoring point \"{}\" with images", arguments.point),
            {},
            "name it PROGRAM.POINT; without a name all are listed",
            {}}});
    return 2;
  }
  if (!arguments.keys.empty()) {
    if (const auto done = operate(arguments, *point); !done) {
      print({done.error()});
      return 2;
    }
  }
  listImages(*point);
  return 0;
}

}  // namespace probewright::app
