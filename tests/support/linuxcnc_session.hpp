#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

/// A real LinuxCNC, headless, for one test. Root starts it as the user nobody in namespaces of its own: its services
/// listen on a loopback that nobody else sees, and nothing of it outlives the test. Anybody else starts it as it is.
namespace probewright::testing {

class LinuxCncSession {
public:
  LinuxCncSession(const std::filesystem::path& source, const std::filesystem::path& build) : apart_(getuid() == 0) {
    std::string name = (std::filesystem::temp_directory_path() / "probewright-linuxcnc-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    outside_ = name;
    source_ = apart_ ? "/mnt/source" : source;
    build_ = apart_ ? "/mnt/build" : build;
    mounts_ = {{source, source_}, {build, build_}, {outside_, folder()}};
    std::filesystem::copy(source / "tests/support/desk.py", outside_ / "desk.py");
  }
  ~LinuxCncSession() {
    std::error_code ignored;
    std::filesystem::remove_all(outside_, ignored);
  }
  LinuxCncSession(const LinuxCncSession&) = delete;
  LinuxCncSession& operator=(const LinuxCncSession&) = delete;

  /// Where things lie as LinuxCNC sees them: the sources, the build, the folder of the session.
  std::filesystem::path source() const { return source_; }
  std::filesystem::path build() const { return build_; }
  std::filesystem::path folder() const { return apart_ ? std::filesystem::path("/mnt/session") : outside_; }
  /// The folder of the session as the test sees it.
  std::filesystem::path outside() const { return outside_; }

  void write(const std::string& name, const std::string& text) const { std::ofstream(outside_ / name) << text; }
  /// The script that is the display: Python, `desk` is a Desk.
  void display(const std::string& script) const {
    write("display.py", "#!/usr/bin/python3\nfrom desk import *\ndesk = Desk()\n" + script);
    std::filesystem::permissions(outside_ / "display.py", std::filesystem::perms(0755));
  }

  /// A realtime module of the build that the session needs, by its path there. False if it cannot be had: who is not
  /// root needs it installed.
  bool needModule(const std::string& path) {
    modules_.push_back(path);
    return apart_ || std::filesystem::exists("/usr/lib/linuxcnc/modules" / std::filesystem::path(path).filename());
  }

  /// LinuxCNC's user gets a shell and the folder of the session as home, so that a server can log him in. False if that
  /// cannot be: who is not root has the account that he has.
  bool needAccount() {
    if (!apart_) return false;
    write("passwd", "root:x:0:0::/root:/bin/sh\nnobody:x:65534:65534::" + folder().string() + ":/bin/sh\n");
    // A password that no text gives, of an account that is not locked.
    write("shadow", "nobody:none:19000:0:99999:7:::\n");
    for (const char* file : {"passwd", "shadow"})
      asRoot_ += "mount --bind '" + (folder() / file).string() + "' /etc/" + file + " && ";
    return true;
  }

  /// Runs LinuxCNC with this configuration until its display ends. What all of it has printed.
  std::string run(const std::string& ini, int seconds = 300) const {
    return command("linuxcnc -r '" + ini + "'", seconds);
  }

  /// Runs a command of the shell as LinuxCNC's user, in the folder of the session, which is its home.
  std::string command(const std::string& words, int seconds = 300) const {
    std::string inner = "cd '" + folder().string() + "' && export HOME='" + folder().string() + "' && ";
    std::string command;
    if (apart_) {
      for (const auto& [from, to] : mounts_)
        command += "mkdir -p '" + to.string() + "' && mount --bind '" + from.string() + "' '" + to.string() + "' && ";
      command = "ip link set lo up && mount -t tmpfs tmpfs /mnt && " + command + modulesCommand() +
                "mount -t tmpfs tmpfs /dev/shm && mount -t tmpfs tmpfs /tmp && chown -R 65534:65534 '" +
                folder().string() + "' && " + asRoot_ + inner + "setpriv --reuid 65534 --regid 65534 --clear-groups " +
                words;
      // The first process of the namespaces stays root's: it dies with its parent, and all others with it.
    } else {
      command = inner + "exec " + words;
    }
    const std::string script = outside_.string() + ".sh";
    std::ofstream(script) << "#!/bin/sh\n" + command + "\n";
    const std::string apart = apart_ ? "unshare --net --ipc --mount --pid --fork --kill-child --mount-proc " : "";
    // On one computer, outside of namespaces, one LinuxCNC runs at a time.
    const std::string turn =
        apart_ ? ""
               : "flock '" + (std::filesystem::temp_directory_path() / "probewright-linuxcnc.lock").string() + "' ";
    std::string output;
    const std::string whole = turn + "timeout --kill-after=5 " + std::to_string(seconds) + " " + apart +
                              "env -i PATH=\"$PATH\" sh '" + script + "' 2>&1 </dev/null";
    FILE* pipe = popen(whole.c_str(), "r");
    std::array<char, 4096> buffer{};
    for (std::size_t read = 0; (read = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      output.append(buffer.data(), read);
    pclose(pipe);
    std::filesystem::remove(script);
    return output;
  }

  /// The numbers behind "desk: WORD" in what a session has printed; empty if that was never told.
  static std::vector<double> told(const std::string& output, const std::string& word) {
    std::vector<double> numbers;
    const std::string begin = "desk: " + word + " ";
    const std::size_t place = output.find(begin);
    if (place == std::string::npos) return numbers;
    const char* at = output.c_str() + place + begin.size();
    for (char* end = nullptr; *at != '\n' && *at != 0; at = end) {
      const double number = std::strtod(at, &end);
      if (end == at) break;
      numbers.push_back(number);
      while (*end == ' ')
        ++end;
    }
    return numbers;
  }

private:
  /// LinuxCNC loads realtime modules from one folder: for this session it holds those of `modules_` as well.
  std::string modulesCommand() const {
    if (modules_.empty()) return {};
    std::string command = "cp -r /usr/lib/linuxcnc/modules /mnt/modules && ";
    for (const std::string& module : modules_)
      command += "cp '" + (build_ / module).string() + "' /mnt/modules && ";
    return command + "mount --bind /mnt/modules /usr/lib/linuxcnc/modules && ";
  }

  struct Mount {
    std::filesystem::path from, to;
  };
  bool apart_;
  std::filesystem::path outside_, source_, build_;
  std::vector<Mount> mounts_;
  std::vector<std::string> modules_;
  std::string asRoot_;  ///< commands before LinuxCNC's user begins
};

}  // namespace probewright::testing
