#include "report_pdf.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

#include "base/file.hpp"
#include "base/unfinished.hpp"

extern char** environ;

namespace probewright::app {

namespace fs = std::filesystem;

namespace {

bool isProgram(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0;
}

/// Runs the program without its output until it ends, at most so long. True if it ended well.
bool runQuietly(const std::vector<std::string>& words, std::chrono::seconds most) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, descriptor, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  const int failed = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return false;
  const auto end = std::chrono::steady_clock::now() + most;
  for (;;) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (ended < 0) return false;
    if (std::chrono::steady_clock::now() > end) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

Result<fs::path> findChromium() {
  constexpr std::string_view advice =
      "install it (Debian: apt-get install chromium), or name it in PROBEWRIGHT_CHROMIUM";
  if (const char* named = std::getenv("PROBEWRIGHT_CHROMIUM"); named != nullptr && *named != '\0') {
    if (isProgram(named)) return fs::path(named);
    return fail(fmt::format("--pdf: PROBEWRIGHT_CHROMIUM names {}, which is not a program", named),
                std::string(advice));
  }
  const char* path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "/usr/bin:/usr/local/bin" : path;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    for (const char* name : {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"}) {
      const fs::path file = fs::path(folders.substr(0, end)) / name;
      if (isProgram(file)) return file;
    }
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return fail("--pdf: the report is printed by Chromium, and there is none here", std::string(advice));
}

Result<std::string> reportPdf(const fs::path& chromium, const Content& html) {
  const ScratchFolder folder;
  if (folder.path().empty()) return fail("--pdf: no folder for temporary files could be made", "look at TMPDIR");
  const fs::path page = folder.path() / "report.html", pdf = folder.path() / "report.pdf";
  std::string text;
  html([&](std::string_view part) { text += part; });
  if (const auto written = writeFileAtomically(page, text); !written) return tl::unexpected(written.error());
  std::vector<std::string> words = {chromium.string(),
                                    "--headless=new",
                                    "--use-angle=swiftshader",
                                    "--enable-unsafe-swiftshader",
                                    "--no-first-run",
                                    "--disable-background-networking",
                                    "--disable-component-update",
                                    "--disable-sync",
                                    "--hide-scrollbars",
                                    "--no-pdf-header-footer",
                                    "--window-size=1400,900",
                                    "--virtual-time-budget=30000",
                                    "--user-data-dir=" + (folder.path() / "browser").string(),
                                    "--print-to-pdf=" + pdf.string()};
  // Chromium refuses to build its sandbox for the superuser.
  if (geteuid() == 0) words.emplace_back("--no-sandbox");
  words.push_back("file://" + page.string() + "#print");
  constexpr std::chrono::seconds longEnough{180};
  const bool ended = runQuietly(words, longEnough);
  Result<std::string> bytes = readFile(pdf);
  if (ended && bytes && bytes->starts_with("%PDF-")) return bytes;
  return fail(fmt::format("--pdf: {} did not print the report", chromium.string()),
              "print report.html from a browser, or name another Chromium in PROBEWRIGHT_CHROMIUM");
}

}  // namespace probewright::app
