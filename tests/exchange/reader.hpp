#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

/// Other programs that read what was written.
namespace probewright::exchange::testing {

/// A file that is gone at the end of the test.
class ScratchFile {
public:
  ScratchFile(const std::string& name, const std::string& bytes) {
    std::string folder = (std::filesystem::temp_directory_path() / "exchange-test-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) ADD_FAILURE() << "no temporary folder";
    folder_ = folder;
    std::ofstream(path_ = folder_ / name, std::ios::binary) << bytes;
  }
  ~ScratchFile() { std::filesystem::remove_all(folder_); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  std::string path() const { return path_.string(); }

private:
  std::filesystem::path folder_, path_;
};

struct Heard {
  int exit = -1;
  std::string text;  ///< standard output and error
};

inline Heard hear(const std::string& command) {
  Heard heard;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return heard;
  std::array<char, 4096> buffer{};
  for (std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe); n > 0;
       n = fread(buffer.data(), 1, buffer.size(), pipe))
    heard.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  heard.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return heard;
}

/// What a Python program prints that gets the file as its first word.
inline std::string python(const std::string& program, const ScratchFile& file) {
  const Heard heard = hear("'" PROBEWRIGHT_PYTHON "' -c '" + program + "' '" + file.path() + "'");
  EXPECT_EQ(heard.exit, 0) << heard.text;
  return heard.text;
}

}  // namespace probewright::exchange::testing
