// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// LinuxCNC as the program that plans motion sees it: canonical commands, and the status. Lengths here are mm in
/// machine coordinates, one value for each axis that the configuration has.
class Mill {
public:
  using Json = nlohmann::json;
  using Position = std::vector<double>;

  /// Reads axes and units from the configuration.
  void load(const std::string& iniFile);
  const std::string& iniFile() const { return ini_; }
  /// A key of the configuration; empty if it is not there.
  std::string key(const char* section, const char* name) const;
  bool inInches() const { return scale_ == 25.4; }
  /// What the engine is told of the machine; empty, and why, if LinuxCNC is not ready for it.
  Json hello(std::string& why) const;

  /// True in LinuxCNC's motion planner, false in the preview of a screen.
  static bool moves();
  /// Before the first move: mm, machine coordinates, smooth paths.
  void begin();
  /// The line of the program that what follows belongs to: LinuxCNC shows it, and steps from one to the next.
  void atLine(int line) { line_ = line; }
  /// The offsets that LinuxCNC adds to what is programmed; once it has carried out all that came before, of which a
  /// zero offset set anew was one.
  void learnOffsets();
  /// Nothing is under way or queued.
  static bool rests();
  /// Whether LinuxCNC's status tells the offsets that its moves are made with. To be asked while it rests.
  static bool statusIsTrue();
  /// As it was before.
  void end() const;
  /// Queues what the canonical commands keep back to join short lines.
  static void flush();
  /// LinuxCNC's planner begins where the axes stand.
  void synchronize() const;

  Position position() const;
  Position probed() const;
  static bool deflected();
  static bool tripped();
  /// Why LinuxCNC cannot move at all: an emergency stop, switched off; empty if it can.
  static std::string notReady();
  /// Stops the axes; what is queued is forgotten.
  static void stopAxes();
  /// Shows a text on LinuxCNC's screen; a long one as several messages, as LinuxCNC keeps the beginning of each only.
  static void show(const std::string& text);
  /// Shows an error on LinuxCNC's screen, whatever it does at the moment.
  static void tellError(const std::string& text);
  /// M7, M8, M9, and M100 to M199 that the configuration has programs for.
  static std::vector<int> functions();
  static void function(int number);
  static int toolInSpindle();
  static bool hasTool(int number);

  /// LinuxCNC's zero offsets and tools, as the engine is told of them.
  Json tables() const;
  /// The blocks of G-code, in mm, that make them what these are.
  std::vector<std::string> tableBlocks(const Json& tables) const;

  /// Why the target cannot be reached; empty if it can.
  std::string limit(const Position& target) const;
  void feed(double perMinute) const;
  void traverse(const Position& target) const;
  void straight(const Position& target) const;
  /// Towards the target until the probe signals; no signal is no mistake.
  void probe(const Position& target) const;

private:
  /// Why the axes are not those of the joints; empty if they are.
  std::string notIdentity() const;
  struct Axis {
    std::size_t number = 0;  ///< in XYZABCUVW
    double minimum = 0, maximum = 0, rapid = 0, acceleration = 0;
  };
  using Nine = std::array<double, 9>;
  Nine programmed(const Position& target) const;

  std::string ini_, name_;
  std::vector<Axis> axes_;
  double scale_ = 1;  ///< mm for each unit of LinuxCNC
  bool orients_ = false;
  Nine shift_{};  ///< mm, in machine coordinates: zero offset, tool offset, G92
  double rotation_ = 0;
  int line_ = 0;
  int units_ = 0, mode_ = 0;
  double tolerance_ = 0, merging_ = 0;
};
