#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/block_world.hpp"
#include "app/program.hpp"

/// A study of a block on several ranks, which somebody may kill.
namespace probewright::app::testing {

namespace fs = std::filesystem;

inline const std::string clampings = R"(
seed = 3
sensitivity = "none"
[[source]]
name = "clamping"
quantity = "part.pose.x"
distribution = "normal"
mean = 0
standard_deviation = 0.02
[[source]]
name = "height"
quantity = "part.pose.z"
distribution = "uniform"
half_width = 0.1
)";

/// The files of a study, and the words that run it.
class StudyBench {
public:
  std::vector<std::string> words(const std::string& trials, const std::string& out,
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"study",   program_,    "--setup", setup_,    "--study",
                                    study_,    "--trials",  trials,    "--out",   path(out),
                                    "--quiet", "--threads", "1",       "--cache", "off"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string text(const std::string& name) const { return textOf(folder_ / name); }
  const Folder& folder() const { return folder_; }

private:
  Folder folder_;
  std::string program_ = folder_.file("p.h", blockProgram("+20.1", "+19.9"));
  std::string setup_ = folder_.file("s.toml", blockSetup());
  std::string study_ = folder_.file("t.toml", clampings);
};

/// A process that runs beside the test, and is gone with it.
class Launched {
public:
  explicit Launched(std::vector<std::string> words, const std::vector<std::pair<std::string, std::string>>& told = {}) {
    std::vector<char*> arguments;
    for (std::string& word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    if (std::freopen("/dev/null", "w", stdout) == nullptr || std::freopen("/dev/null", "w", stderr) == nullptr)
      _exit(127);
    // In sanitizer builds: plugins of MPI are unloaded with what they hold, and libraries may be loaded ahead.
    setenv("ASAN_OPTIONS", "detect_leaks=0:verify_asan_link_order=0", 1);
    for (const auto& [name, value] : told)
      setenv(name.c_str(), value.c_str(), 1);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  Launched(const Launched&) = delete;
  Launched& operator=(const Launched&) = delete;
  ~Launched() {
    if (ended_) return;
    kill(pid_, SIGKILL);
    wait();
  }
  pid_t pid() const { return pid_; }
  bool ended() {
    if (!ended_) ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
    return ended_;
  }
  /// The exit code; -1 if a signal has ended it.
  int wait() {
    if (!ended_) waitpid(pid_, &status_, 0);
    ended_ = true;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

private:
  pid_t pid_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

/// The field of /proc/PID/stat after the name: "S", the parent's number...
inline std::vector<std::string> statOf(pid_t pid) {
  std::string text = textOf("/proc/" + std::to_string(pid) + "/stat");
  const std::size_t end = text.rfind(')');
  std::vector<std::string> fields;
  if (end == std::string::npos) return fields;
  std::istringstream stream(text.substr(end + 1));
  for (std::string field; stream >> field;)
    fields.push_back(field);
  return fields;
}

/// True if the process is no more, whether or not its parent has asked for its end.
inline bool isGone(pid_t pid) {
  const auto fields = statOf(pid);
  return fields.empty() || fields[0] == "Z" || fields[0] == "X";
}

/// The ranks that mpirun has started.
inline std::vector<pid_t> ranksOf(pid_t launcher) {
  std::vector<pid_t> ranks;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto pid = static_cast<pid_t>(std::stol(name));
    const auto fields = statOf(pid);
    if (fields.size() < 2 || fields[1] != std::to_string(launcher)) continue;
    std::error_code error;
    if (fs::read_symlink(entry.path() / "exe", error) == fs::path(PROBEWRIGHT_PROGRAM)) ranks.push_back(pid);
  }
  return ranks;
}

/// Waits for a state as long as a test may take.
inline bool waitFor(const std::function<bool()>& state) {
  for (int i = 0; i < 30'000; ++i) {
    if (state()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

inline std::vector<std::string> mpirun(int ranks, const std::vector<std::string>& words) {
  std::vector<std::string> all = {"mpirun", "--allow-run-as-root", "--oversubscribe",  "--mca", "btl", "self,vader",
                                  "-n",     std::to_string(ranks), PROBEWRIGHT_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

inline bool hasMpi() { return fs::exists(fs::path(PROBEWRIGHT_PROGRAM).parent_path() / "probewright-mpi.so"); }

}  // namespace probewright::app::testing
