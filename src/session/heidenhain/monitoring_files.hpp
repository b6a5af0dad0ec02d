#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/heidenhain/camera_monitoring.hpp"

/// The data of the control's camera outlive a program: for each monitoring point a run leaves a file *.VSC and its
/// images as PNG beside the tables, where the next one reads them.
namespace probewright::session::heidenhain {

/// The monitoring points whose files are in the folder of tables. Mistakes go to `diagnostics`.
std::vector<control::heidenhain::MonitoringPoint> readMonitoringFiles(const std::filesystem::path& tables,
                                                                      Diagnostics& diagnostics);

/// The bytes of an image by the name of its file.
using ImageBytes = std::function<Result<std::string>(const std::string& name)>;

/// The monitoring point that the text of its file `path` describes; nothing, and why in `diagnostics`, if it does not.
std::optional<control::heidenhain::MonitoringPoint> readMonitoringPoint(const std::string& text,
                                                                        const std::filesystem::path& path,
                                                                        const ImageBytes& images,
                                                                        Diagnostics& diagnostics);

/// All files of a point, by name.
std::map<std::string, std::string> monitoringFiles(const control::heidenhain::MonitoringPoint& point);

}  // namespace probewright::session::heidenhain
