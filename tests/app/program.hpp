#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The built program, run as a user runs it.
namespace probewright::app::testing {

/// What came back.
struct Answer {
  int exit = -1;          ///< -1: ended by a signal
  std::string output;     ///< standard output
  std::string errors;     ///< standard error
  double cpuSeconds = 0;  ///< of the process, user and system
  double peakMegabytes = 0;
};

/// Runs probewright with these words; its working folder is the root of the sources.
/// Its standard output goes into the answer, or to the file `output`.
Answer probewright(const std::vector<std::string>& words, const std::string& output = {});

/// The same as somebody whom permissions of files and folders hold, also if root runs the test.
Answer probewrightOfAUser(const std::vector<std::string>& words);

/// A folder of one test, empty at its start and gone at its end.
class Folder {
public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// Writes a file and returns its path.
  std::string file(const std::string& name, const std::string& text) const;

private:
  std::filesystem::path path_;
};

/// The whole file; empty if there is none.
std::string textOf(const std::filesystem::path& path);

/// The names in a folder, sorted.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

}  // namespace probewright::app::testing
