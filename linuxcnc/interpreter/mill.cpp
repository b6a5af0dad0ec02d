// SPDX-License-Identifier: GPL-2.0-or-later
#include "mill.hpp"

#include <dlfcn.h>

#include <strings.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string_view>

#include <linuxcnc.h>
#include "canon.hh"
#include "emc_nml.hh"
#include "inifile.hh"

extern int _task;

namespace {

constexpr std::string_view letters = "XYZABCUVW";

/// Corners are passed, and short lines joined, within this: mm, as G64 P0.01 does.
constexpr double tolerance = 0.01;

bool rotary(std::size_t number) { return number >= 3 && number <= 5; }

/// The status that LinuxCNC's planner keeps; screens, which only draw, have none.
const EMC_STAT* status() {
  static EMC_STAT** const place = static_cast<EMC_STAT**>(dlsym(RTLD_DEFAULT, "emcStatus"));
  return _task != 0 && place != nullptr ? *place : nullptr;
}

std::array<double, 9> nine(const EmcPose& pose) {
  return {pose.tran.x, pose.tran.y, pose.tran.z, pose.a, pose.b, pose.c, pose.u, pose.v, pose.w};
}

}  // namespace

bool Mill::moves() { return status() != nullptr; }

std::string Mill::key(const char* section, const char* name) const {
  IniFile file;
  if (!file.Open(ini_.c_str())) return {};
  const char* value = file.Find(name, section);
  return value != nullptr ? value : "";
}

namespace {

/// As LinuxCNC reads [TRAJ]LINEAR_UNITS: a name, or how many units are 1 mm.
double mmPerUnit(const std::string& units) {
  const double perMm = std::strtod(units.c_str(), nullptr);
  if (perMm > 0) return 1 / perMm;
  for (const char* inch : {"in", "inch", "imperial"})
    if (strcasecmp(units.c_str(), inch) == 0) return 25.4;
  return 1;
}

/// Whether [TRAJ]ANGULAR_UNITS are degrees.
bool inDegrees(const std::string& units) {
  return units.empty() || strncasecmp(units.c_str(), "deg", 3) == 0 || std::strtod(units.c_str(), nullptr) == 1;
}

}  // namespace

void Mill::load(const std::string& iniFile) {
  ini_ = iniFile;
  name_ = key("EMC", "MACHINE");
  scale_ = mmPerUnit(key("TRAJ", "LINEAR_UNITS"));
  orients_ = key("PROBEWRIGHT", "SPINDLE_ORIENTS") == "1";
  axes_.clear();
  const std::string named = key("TRAJ", "COORDINATES"), coordinates = named.empty() ? "XYZ" : named;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    if (std::none_of(coordinates.begin(), coordinates.end(), [&](char c) { return std::toupper(c) == letters[i]; }))
      continue;
    const std::string section = std::string("AXIS_") + letters[i];
    const auto number = [&](const char* name, double otherwise) {
      const std::string text = key(section.c_str(), name);
      return (text.empty() ? otherwise : std::strtod(text.c_str(), nullptr)) * (rotary(i) ? 1 : scale_);
    };
    axes_.push_back({i, number("MIN_LIMIT", -1e9), number("MAX_LIMIT", 1e9), number("MAX_VELOCITY", 1) * 60,
                     number("MAX_ACCELERATION", 1)});
  }
}

namespace {

/// The numbered parameters that LinuxCNC's interpreter keeps in a file.
std::map<int, double> parametersIn(const std::string& file) {
  std::map<int, double> values;
  std::ifstream lines(file);
  int number = 0;
  for (double value = 0; lines >> number >> value;)
    values[number] = value;
  return values;
}

constexpr int offsets = 9;

}  // namespace

Mill::Json Mill::tables() const {
  const std::string named = key("RS274NGC", "PARAMETER_FILE"), file = named.empty() ? "rs274ngc.var" : named;
  const auto values = parametersIn((std::filesystem::path(ini_).parent_path() / file).string());
  const auto value = [&](int number) {
    const auto found = values.find(number);
    return found == values.end() ? 0 : found->second;
  };
  Json rows = Json::array(), tools = Json::array();
  for (int row = 1; row <= offsets; ++row) {
    Json origin = Json::array();
    for (const Axis& axis : axes_)
      origin.push_back(value(5201 + 20 * row + static_cast<int>(axis.number)) * (rotary(axis.number) ? 1 : scale_));
    rows.push_back({{"number", row}, {"origin", origin}, {"rotation", value(5210 + 20 * row)}});
  }
  // The spindle comes last: as a rule its tool has a place of its own as well.
  std::set<int> told;
  for (int place = 1; moves() && place <= CANON_POCKETS_MAX; ++place) {
    const CANON_TOOL_TABLE tool = GET_EXTERNAL_TOOL_TABLE(place % CANON_POCKETS_MAX);
    if (tool.toolno <= 0 || !told.insert(tool.toolno).second) continue;
    tools.push_back(
        {{"number", tool.toolno}, {"length", tool.offset.tran.z * scale_}, {"diameter", tool.diameter * scale_}});
  }
  return {{"offsets", rows}, {"tools", tools}};
}

std::vector<std::string> Mill::tableBlocks(const Json& tables) const {
  std::vector<std::string> blocks;
  const auto word = [&](char letter, double value) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), " %c%.9f", letter, value);
    return std::string(text.data());
  };
  for (const Json& row : tables.at("offsets")) {
    std::string block = "G21 G90 G10 L2 P" + std::to_string(row.at("number").get<int>());
    const auto origin = row.at("origin").get<Position>();
    for (std::size_t i = 0; i < axes_.size() && i < origin.size(); ++i)
      block += word(letters[axes_[i].number], origin[i]);
    blocks.push_back(block + word('R', row.at("rotation").get<double>()));
  }
  for (const Json& tool : tables.at("tools")) {
    blocks.push_back("G21 G10 L1 P" + std::to_string(tool.at("number").get<int>()) +
                     word('Z', tool.at("length").get<double>()) + word('R', tool.at("diameter").get<double>() / 2));
  }
  return blocks;
}

std::string Mill::notIdentity() const {
  const std::string kinematics = key("KINS", "KINEMATICS"), name = kinematics.substr(0, kinematics.find(' '));
  if (name == "trivkins" || name == "corexykins" || !moves()) return {};
  // The types that the switchable kinematics of LinuxCNC 2.9 have for identity.
  int identity = -1;
  if (name == "xyzac-trt-kins" || name == "xyzbc-trt-kins" || name == "5axiskins")
    identity = kinematics.find("identityfirst") == std::string::npos ? 1 : 0;
  if (name == "xyzab_tdr_kins") identity = 0;
  if (identity < 0) return "programs of measuring cycles need kinematics that can be switched to identity, not " + name;
  double type = -1;
  if (std::FILE* pin = popen("halcmd -s getp motion.switchkins-type 2>/dev/null", "r"); pin != nullptr) {
    if (std::fscanf(pin, "%lf", &type) != 1) type = -1;
    pclose(pin);
  }
  return type == identity ? "" : "LinuxCNC's kinematics are those of the tool tip: switch to identity kinematics first";
}

Mill::Json Mill::hello(std::string& why) const {
  why = notIdentity();
  if (!why.empty()) return {};
  // Zero offsets are machine coordinates: LinuxCNC may run without homing, but what is found then counts for nothing.
  for (int joint = 0; moves() && joint < status()->motion.traj.joints; ++joint)
    if (status()->motion.joint[joint].homed == 0) why = "the axes of LinuxCNC are not homed";
  if (!why.empty()) return {};
  if (axes_.empty()) {
    why = "the configuration of LinuxCNC names no axes in [TRAJ]COORDINATES";
    return {};
  }
  if (!inDegrees(key("TRAJ", "ANGULAR_UNITS"))) {
    why = "measuring programs need a configuration that counts angles in degrees ([TRAJ]ANGULAR_UNITS)";
    return {};
  }
  Json axes = Json::array();
  for (const Axis& axis : axes_) {
    axes.push_back({{"name", std::string(1, letters[axis.number])},
                    {"kind", rotary(axis.number) ? "rotary" : "linear"},
                    {"minimum", axis.minimum},
                    {"maximum", axis.maximum},
                    {"rapid", axis.rapid},
                    {"acceleration", axis.acceleration}});
  }
  Json answer = {
      {"protocol", 1},
      {"adapter", "LinuxCNC"},
      {"configuration", ini_},
      {"machine", {{"name", name_}, {"axes", axes}, {"spindleOrients", orients_}, {"toolChange", position()}}},
      {"functions", functions()},
      {"asks", moves()},
      {"draws", !moves()},
      {"looksAhead", true},
      {"compact", true},
      {"position", position()}};
  if (moves()) answer["joins"] = tolerance;
  if (key("PROBEWRIGHT", "SHARE_TABLES") != "0") answer["tables"] = tables();
  return answer;
}

void Mill::begin() {
  units_ = GET_EXTERNAL_LENGTH_UNIT_TYPE();
  mode_ = GET_EXTERNAL_MOTION_CONTROL_MODE();
  tolerance_ = GET_EXTERNAL_MOTION_CONTROL_TOLERANCE();
  merging_ = GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE();
  USE_LENGTH_UNITS(CANON_UNITS_MM);
  SET_FEED_REFERENCE(CANON_XYZ);
  SET_FEED_MODE(0, 0);
  SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, tolerance);
  // The engine joins them already: LinuxCNC would add as much again. A screen draws each line.
  SET_NAIVECAM_TOLERANCE(0);
  if (!moves()) {
    // What a screen draws is in machine coordinates; the offsets that it has set up belong to G-code.
    SET_G5X_OFFSET(1, 0, 0, 0, 0, 0, 0, 0, 0, 0);
    SET_G92_OFFSET(0, 0, 0, 0, 0, 0, 0, 0, 0);
    SET_XY_ROTATION(0);
    USE_TOOL_LENGTH_OFFSET(EmcPose{});
  }
  synchronize();
}

namespace {

/// Turned about Z; degrees.
std::array<double, 9> turned(std::array<double, 9> place, double degrees) {
  const double angle = degrees * M_PI / 180, x = place[0], y = place[1];
  place[0] = x * std::cos(angle) - y * std::sin(angle);
  place[1] = x * std::sin(angle) + y * std::cos(angle);
  return place;
}

/// Where the axes stand as the canonical commands have it, with the offsets that they move by; in their unit.
std::array<double, 9> programPlace() {
  return {GET_EXTERNAL_POSITION_X(), GET_EXTERNAL_POSITION_Y(), GET_EXTERNAL_POSITION_Z(),
          GET_EXTERNAL_POSITION_A(), GET_EXTERNAL_POSITION_B(), GET_EXTERNAL_POSITION_C(),
          GET_EXTERNAL_POSITION_U(), GET_EXTERNAL_POSITION_V(), GET_EXTERNAL_POSITION_W()};
}

}  // namespace

void Mill::learnOffsets() {
  shift_ = {};
  rotation_ = 0;
  const EMC_STAT* now = status();
  if (now == nullptr) return;
  // The status may not know what moves are made with: an emergency stop or an abort throws away what is queued to be
  // told to it. The canonical commands know, and tell it by where they believe the axes to be.
  rotation_ = now->task.rotation_xy;
  const Nine axes = nine(now->motion.traj.position), program = turned(programPlace(), rotation_);
  for (std::size_t i = 0; i < shift_.size(); ++i)
    shift_[i] = axes[i] * (rotary(i) ? 1 : scale_) - program[i];
}

bool Mill::rests() {
  const EMC_STAT* now = status();
  return now != nullptr && now->status == RCS_DONE && now->motion.traj.inpos && now->motion.traj.queue == 0;
}

bool Mill::statusIsTrue() {
  const EMC_STAT* now = status();
  if (now == nullptr) return true;
  const Nine g5x = nine(now->task.g5x_offset), tool = nine(now->task.toolOffset), g92 = nine(now->task.g92_offset);
  Nine place = nine(now->motion.traj.position);
  for (std::size_t i = 0; i < place.size(); ++i)
    place[i] -= g5x[i] + tool[i];
  place = turned(place, -now->task.rotation_xy);
  const Nine own = programPlace();
  const CANON_UNITS units = GET_EXTERNAL_LENGTH_UNIT_TYPE();
  const double unit = units == CANON_UNITS_INCHES ? 25.4 : units == CANON_UNITS_CM ? 10 : 1;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const double told = (place[i] - g92[i]) / (rotary(i) ? 1 : now->motion.traj.linearUnits);
    if (std::abs(told - own[i] * (rotary(i) ? 1 : unit)) > 1e-6) return false;
  }
  return true;
}

void Mill::end() const {
  // Tolerances are in the units that they were told in.
  USE_LENGTH_UNITS(static_cast<CANON_UNITS>(units_));
  SET_MOTION_CONTROL_MODE(static_cast<CANON_MOTION_MODE>(mode_), tolerance_);
  SET_NAIVECAM_TOLERANCE(merging_);
}

void Mill::flush() { FINISH(); }

void Mill::synchronize() const {
  // What reads the position also tells the canonical commands where they begin.
  if (moves()) GET_EXTERNAL_POSITION_X();
}

namespace {
std::vector<double> chosen(const std::array<double, 9>& all, const std::vector<std::size_t>& numbers, double scale) {
  std::vector<double> values;
  for (const std::size_t i : numbers)
    values.push_back(all[i] * (rotary(i) ? 1 : scale));
  return values;
}
}  // namespace

Mill::Position Mill::position() const {
  std::vector<std::size_t> numbers;
  for (const Axis& axis : axes_)
    numbers.push_back(axis.number);
  const EMC_STAT* now = status();
  return chosen(now != nullptr ? nine(now->motion.traj.position) : Nine{}, numbers, scale_);
}

Mill::Position Mill::probed() const {
  std::vector<std::size_t> numbers;
  for (const Axis& axis : axes_)
    numbers.push_back(axis.number);
  const EMC_STAT* now = status();
  return chosen(now != nullptr ? nine(now->motion.traj.probedPosition) : Nine{}, numbers, scale_);
}

bool Mill::deflected() { return moves() && status()->motion.traj.probeval != 0; }
bool Mill::tripped() { return moves() && status()->motion.traj.probe_tripped; }
std::string Mill::notReady() {
  if (!moves()) return {};
  if (status()->io.aux.estop != 0) return "LinuxCNC is in emergency stop";
  constexpr int on = 4;
  return static_cast<int>(status()->task.state) == on ? "" : "LinuxCNC's machine is switched off";
}
void Mill::stopAxes() {
  using Abort = int (*)();
  if (const auto abort = reinterpret_cast<Abort>(dlsym(RTLD_DEFAULT, "_Z14emcMotionAbortv"));
      moves() && abort != nullptr)
    abort();
}

void Mill::show(const std::string& text) {
  constexpr std::size_t longest = 240;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.size();
    if (end - at > longest) {
      end = text.rfind('\n', at + longest);
      if (end == std::string::npos || end <= at) end = text.rfind(' ', at + longest);
      if (end == std::string::npos || end <= at)
        // Not within a character of UTF-8.
        for (end = at + longest; (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U;)
          --end;
    }
    std::string part = text.substr(at, end - at);
    MESSAGE(part.data());
    at = end < text.size() && (text[end] == '\n' || text[end] == ' ') ? end + 1 : end;
  }
}

void Mill::tellError(const std::string& text) {
  using Tell = int (*)(int number, const char* format, ...);
  if (const auto tell = reinterpret_cast<Tell>(dlsym(RTLD_DEFAULT, "_Z16emcOperatorErroriPKcz")); tell != nullptr) {
    tell(0, "%s", text.substr(0, 250).c_str());
  } else {
    CANON_ERROR("%s", text.c_str());
  }
}

std::vector<int> Mill::functions() {
  std::vector<int> numbers = {7, 8, 9};
  for (int i = 0; moves() && i < USER_DEFINED_FUNCTION_NUM; ++i) {
    if (USER_DEFINED_FUNCTION[i] != nullptr) numbers.push_back(100 + i);
  }
  return numbers;
}

void Mill::function(int number) {
  if (number == 7) MIST_ON();
  if (number == 8) FLOOD_ON();
  if (number == 9) {
    MIST_OFF();
    FLOOD_OFF();
  }
  if (number >= 100) USER_DEFINED_FUNCTION[number - 100](number - 100, 0, 0);
}

int Mill::toolInSpindle() { return moves() ? std::max(0, status()->io.tool.toolInSpindle) : 0; }

bool Mill::hasTool(int number) {
  for (int place = 0; place < CANON_POCKETS_MAX; ++place) {
    if (GET_EXTERNAL_TOOL_TABLE(place).toolno == number) return true;
  }
  return false;
}

std::string Mill::limit(const Position& target) const {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (target[i] >= axes_[i].minimum && target[i] <= axes_[i].maximum) continue;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "software limit of %c: %.3f is not between %.3f and %.3f",
                  letters[axes_[i].number], target[i], axes_[i].minimum, axes_[i].maximum);
    return text.data();
  }
  return {};
}

/// What has to be programmed with the offsets of LinuxCNC to reach machine coordinates.
Mill::Nine Mill::programmed(const Position& target) const {
  Nine all{};
  for (std::size_t i = 0; i < axes_.size(); ++i)
    all[axes_[i].number] = target[i];
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] -= shift_[i];
  return turned(all, -rotation_);
}

void Mill::feed(double perMinute) const { SET_FEED_RATE(perMinute); }

void Mill::traverse(const Position& target) const {
  const Nine p = programmed(target);
  STRAIGHT_TRAVERSE(line_, p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8]);
}

void Mill::straight(const Position& target) const {
  const Nine p = programmed(target);
  STRAIGHT_FEED(line_, p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8]);
}

void Mill::probe(const Position& target) const {
  const Nine p = programmed(target);
  // LinuxCNC keeps the touch before until it is told to forget it.
  TURN_PROBE_ON();
  // 1: without a signal it is no error (G38.3).
  STRAIGHT_PROBE(line_, p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], 1);
  TURN_PROBE_OFF();
}
