#include "session/heidenhain/monitoring_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/file.hpp"
#include "base/number_text.hpp"
#include "base/text.hpp"
#include "base/toml_table.hpp"
#include "session/table_files.hpp"
#include "vision/png.hpp"

namespace probewright::session::heidenhain {

namespace hh = control::heidenhain;
namespace fs = std::filesystem;
using hh::ImageKind;
using hh::MonitoringImage;
using hh::MonitoringPoint;
using vision::Window;

namespace {

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> words = {"plain", "reference", "error"};
  return words;
}

/// Four numbers each: x, y, width, height.
std::vector<Window> readWindows(TomlReader& reader, const char* key) {
  std::vector<Window> windows;
  const auto numbers = reader.numbers(key, 0, {0, vision::largestPicture});
  if (!numbers) return windows;
  const bool whole = std::ranges::all_of(*numbers, [](double value) { return value == std::floor(value); });
  if (numbers->size() % 4 != 0 || !whole) {
    reader.report(key, fmt::format("\"{}\" has whole numbers, four for each window", key),
                  "Write x, y, width, height in pixels");
    return windows;
  }
  const auto at = [&](std::size_t i) { return static_cast<int>((*numbers)[i]); };
  for (std::size_t i = 0; i < numbers->size(); i += 4)
    windows.push_back({at(i), at(i + 1), at(i + 2), at(i + 3)});
  return windows;
}

std::string windowsText(const std::vector<Window>& windows) {
  std::string text;
  for (const Window& window : windows) {
    text += fmt::format("{}{}, {}, {}, {}", text.empty() ? "" : ",  ", window.x, window.y, window.width, window.height);
  }
  return "[" + text + "]";
}

std::optional<MonitoringImage> readImage(TomlReader& reader, const MonitoringPoint& point, const fs::path& folder,
                                         const ImageBytes& images, Diagnostics& diagnostics) {
  MonitoringImage image;
  reader.require("number");
  image.number = static_cast<int>(reader.integer("number", 1, 999999).value_or(0));
  image.kind = static_cast<ImageKind>(reader.choice("kind", kinds()).value_or(0));
  image.marked = readWindows(reader, "marked");
  image.found = readWindows(reader, "found");
  reader.finish();
  if (!point.images.empty() && image.number <= point.images.back().number) {
    reader.report("number", "the images must be in the order of their numbers");
    return std::nullopt;
  }
  const std::string name = imageFileName(point, image);
  auto bytes = images(name);
  if (!bytes) {
    diagnostics.push_back(std::move(bytes.error()));
    return std::nullopt;
  }
  if (auto picture = vision::fromPng(*bytes, (folder / name).string()); !picture) {
    diagnostics.push_back(std::move(picture.error()));
    return std::nullopt;
  }
  image.png = std::move(*bytes);
  return image;
}

}  // namespace

std::optional<MonitoringPoint> readMonitoringPoint(const std::string& text, const fs::path& path,
                                                   const ImageBytes& images, Diagnostics& diagnostics) {
  const auto table = parseToml(text, path.string(), diagnostics);
  if (!table) return std::nullopt;
  const std::size_t before = diagnostics.size();
  TomlReader reader(*table, "", path.string(), diagnostics);
  MonitoringPoint point;
  point.program = reader.requiredText("program").value_or("");
  point.name = reader.requiredText("point").value_or("");
  point.settings.sensitivity =
      reader.number("sensitivity", {vision::leastSensitivity, vision::mostSensitivity}).value_or(1);
  point.settings.areas = readWindows(reader, "areas");
  if (diagnostics.size() == before && monitoringFileName(point) != upperCase(path.filename().string())) {
    reader.report("point", fmt::format("program and point belong to a file {}", monitoringFileName(point)),
                  "Give the file its name back");
  }
  for (TomlReader& entry : reader.tables("image")) {
    if (auto image = readImage(entry, point, path.parent_path(), images, diagnostics))
      point.images.push_back(*std::move(image));
  }
  reader.finish();
  return diagnostics.size() == before ? std::optional(std::move(point)) : std::nullopt;
}

std::vector<MonitoringPoint> readMonitoringFiles(const fs::path& tables, Diagnostics& diagnostics) {
  std::vector<MonitoringPoint> points;
  if (tables.empty()) return points;
  for (const fs::path& path : tableFiles(tables, diagnostics)) {
    if (upperCase(path.extension().string()) != ".VSC") continue;
    const auto text = contents(path, diagnostics);
    if (!text) continue;
    const auto image = [&](const std::string& name) { return readFile(path.parent_path() / name); };
    if (auto point = readMonitoringPoint(*text, path, image, diagnostics)) points.push_back(*std::move(point));
  }
  return points;
}

std::map<std::string, std::string> monitoringFiles(const MonitoringPoint& point) {
  std::map<std::string, std::string> files;
  std::string text = fmt::format(
      "# Monitoring point of a camera. Windows are x, y, width, height in pixels.\n"
      "program = \"{}\"\npoint = \"{}\"\nsensitivity = {}\nareas = {}\n",
      point.program, point.name, formatShortest(point.settings.sensitivity), windowsText(point.settings.areas));
  for (const MonitoringImage& image : point.images) {
    text += fmt::format("\n[[image]]\nnumber = {}\nkind = \"{}\"\n", image.number,
                        kinds()[static_cast<std::size_t>(image.kind)]);
    if (!image.marked.empty()) text += fmt::format("marked = {}\n", windowsText(image.marked));
    if (!image.found.empty()) text += fmt::format("found = {}\n", windowsText(image.found));
    files[imageFileName(point, image)] = image.png;
  }
  files[monitoringFileName(point)] = std::move(text);
  return files;
}

}  // namespace probewright::session::heidenhain
