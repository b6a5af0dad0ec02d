#include "app/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace probewright::app::testing {

namespace fs = std::filesystem;

namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// What lets root pass permissions is not there after the next exec.
void becomeAUser() {
  if (geteuid() != 0) return;
  for (const int privilege : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH, CAP_FOWNER})
    if (prctl(PR_CAPBSET_DROP, privilege) != 0) _exit(126);
}

Answer runProgram(const std::vector<std::string>& words, const std::string& elsewhere, bool ofAUser) {
  const Folder folder;
  const std::string output = elsewhere.empty() ? (folder / "output").string() : elsewhere;
  const std::string errors = (folder / "errors").string();
  std::vector<std::string> all{PROBEWRIGHT_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : all)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(open(output.c_str(), flags, 0600), STDOUT_FILENO);
    dup2(open(errors.c_str(), flags, 0600), STDERR_FILENO);
    setenv("PROBEWRIGHT_CACHE", "off", 1);  // a test leaves nothing in the user's folders
    if (chdir(PROBEWRIGHT_SOURCE_DIR) != 0) _exit(127);
    if (ofAUser) becomeAUser();
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  Answer answer;
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child) {
    ADD_FAILURE() << "the program could not be started";
    return answer;
  }
  if (WIFEXITED(status)) answer.exit = WEXITSTATUS(status);
  if (elsewhere.empty()) answer.output = textOf(output);
  answer.errors = textOf(errors);
  answer.cpuSeconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  answer.peakMegabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  return answer;
}

}  // namespace

Answer probewright(const std::vector<std::string>& words, const std::string& output) {
  return runProgram(words, output, false);
}

Answer probewrightOfAUser(const std::vector<std::string>& words) { return runProgram(words, {}, true); }

Folder::Folder() {
  std::string pattern = (fs::temp_directory_path() / "probewright-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
  path_ = pattern;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::file(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return (path_ / name).string();
}

std::string textOf(const fs::path& path) {
  const std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace probewright::app::testing
