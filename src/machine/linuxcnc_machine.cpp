#include "machine/linuxcnc_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string_view>

#include "base/text.hpp"
#include "machine/linuxcnc_ini.hpp"

namespace probewright::machine {

namespace {

constexpr std::string_view allLetters = "XYZABCUVW";
constexpr double farthest = 1e6;   // mm or degrees; no machine is larger
constexpr double endless = 10000;  // mm, assumed where the configuration has no limits

/// In capitals, without blanks and quotation marks.
std::string plainWord(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (!isBlank(c) && c != '"') result += upper(c);
  return result;
}

/// What a module of kinematics needs to become chains.
struct Kinematics {
  std::string_view name;
  std::string_view letters;  ///< of the joints, where the configuration does not say
  bool perJoint = true;      ///< the joints are the axes of the machine; false: only [AXIS_L] counts
  bool identity = false;     ///< it says nothing of rotary axes
};

constexpr std::array<Kinematics, 8> knownKinematics = {{
    {.name = "trivkins", .letters = "XYZABCUVW", .identity = true},
    {.name = "corexykins", .letters = "XYZABCUVW", .perJoint = false, .identity = true},
    {.name = "xyzac-trt-kins", .letters = "XYZAC"},
    {.name = "xyzbc-trt-kins", .letters = "XYZBC"},
    {.name = "xyzab_tdr_kins", .letters = "XYZAB"},
    {.name = "5axiskins", .letters = "XYZBCW"},
    {.name = "maxkins", .letters = "XYZABCUVW"},
    {.name = "gentrivkins", .letters = "XYZABCUVW", .identity = true},
}};

constexpr std::array<std::pair<std::string_view, std::string_view>, 14> otherKinematics = {{
    {"genhexkins", "a hexapod"},
    {"genserkins", "a robot arm"},
    {"pumakins", "a robot arm"},
    {"scarakins", "a SCARA robot"},
    {"scorbot-kins", "a robot arm"},
    {"lineardeltakins", "a delta robot"},
    {"rotarydeltakins", "a delta robot"},
    {"tripodkins", "a tripod"},
    {"pentakins", "a pentapod"},
    {"rosekins", "a rose engine"},
    {"rotatekins", "a machine whose linear axes turn"},
    {"millturn", "a machine that is a mill and a lathe in turn"},
    {"matrixkins", "a machine with corrected squareness"},
    {"userkins", "kinematics of your own"},
}};

class MachineReader {
public:
  MachineReader(const LinuxCncIni& ini, Diagnostics& diagnostics)
      : ini_(ini), hal_(halValues(ini)), diagnostics_(diagnostics) {}

  std::optional<LinuxCncMachine> read() {
    readUnits();
    if (!readKinematics() || !readLetters()) return std::nullopt;
    machine_.name = ini_.text("EMC", "MACHINE").value_or(ini_.path().stem().string());
    for (const char letter : allLetters)
      if (const std::size_t joint = joints_.find(letter); carries(letter)) readAxis(letter, joint);
    readChains();
    if (hasErrors(diagnostics_)) return std::nullopt;
    leaveOut();
    readOrientation();
    readToolChange();
    if (hasErrors(diagnostics_)) return std::nullopt;
    LinuxCncMachine result{std::move(machine_), ini_.files()};
    result.inputs.insert(result.inputs.end(), hal_.files.begin(), hal_.files.end());
    return result;
  }

private:
  void report(Severity severity, const IniEntry* entry, std::string message, std::string advice = {}) {
    SourcePlace place = entry != nullptr ? entry->place : SourcePlace{ini_.path().string(), 0, 0};
    diagnostics_.push_back({severity,
                            std::move(place),
                            std::move(message),
                            entry != nullptr ? entry->key + " = " + entry->value : std::string(),
                            std::move(advice),
                            {}});
  }
  void mistake(const IniEntry* entry, std::string message, std::string advice = {}) {
    report(Severity::Error, entry, std::move(message), std::move(advice));
  }
  void warn(const IniEntry* entry, std::string message, std::string advice = {}) {
    report(Severity::Warning, entry, std::move(message), std::move(advice));
  }

  static bool isRotary(char letter) { return letter >= 'A' && letter <= 'C'; }
  bool carries(char letter) const { return letters_.find(letter) != std::string::npos; }
  std::optional<std::size_t> indexOf(char letter) const { return machine_.axisIndex(std::string(1, letter)); }

  void readUnits() {
    mmPerUnit_ =
        unit("LINEAR_UNITS",
             {{"mm", 1}, {"metric", 1}, {"in", 25.4}, {"inch", 25.4}, {"imperial", 25.4}, {"cm", 10}, {"m", 1000}}, 1);
    constexpr double radian = 180 / std::numbers::pi;
    degreesPerUnit_ =
        unit("ANGULAR_UNITS",
             {{"deg", 1}, {"degree", 1}, {"grad", 0.9}, {"gon", 0.9}, {"rad", radian}, {"radian", radian}}, 1);
  }

  /// mm or degrees per unit of the configuration; a number says how many units are 1 mm or 1 degree.
  double unit(const char* key, const std::vector<std::pair<std::string_view, double>>& names, double otherwise) {
    const IniEntry* entry = ini_.find("TRAJ", key);
    if (entry == nullptr) return otherwise;
    const std::string word = entry->value.substr(0, entry->value.find_first_of(" \t"));
    for (const auto& [name, value] : names)
      if (plainWord(word) == plainWord(name)) return value;
    if (const auto number = ini_.number("TRAJ", key, diagnostics_); number && *number > 0) return 1 / *number;
    mistake(entry, fmt::format("the unit {} is not known", word));
    return otherwise;
  }

  bool readKinematics() {
    const IniEntry* entry = ini_.find("KINS", "KINEMATICS");
    if (entry == nullptr) {
      mistake(nullptr, "the configuration does not say what kinematics its machine has: [KINS]KINEMATICS is missing",
              "Name the .ini file that LinuxCNC is started with; this may be a part of one");
      return false;
    }
    std::istringstream words(entry->value);
    std::string name;
    words >> name;
    for (std::string word; words >> word && word.front() != '#';) {
      const std::size_t equals = word.find('=');
      if (equals != std::string::npos && plainWord(word.substr(0, equals)) == "COORDINATES")
        joints_ = plainWord(word.substr(equals + 1));
    }
    const auto known = std::ranges::find(knownKinematics, name, &Kinematics::name);
    if (known != knownKinematics.end()) {
      kinematics_ = *known;
      jointsSaid_ = !joints_.empty();
      if (joints_.empty()) joints_ = kinematics_.letters;
      kinsEntry_ = entry;
      return true;
    }
    const auto other = std::ranges::find(otherKinematics, name, &std::pair<std::string_view, std::string_view>::first);
    mistake(entry,
            other != otherKinematics.end()
                ? fmt::format("the kinematics {} are those of {}, which cannot be described by axes of table and head",
                              name, other->second)
                : fmt::format("the kinematics {} are not known", name),
            "Kinematics that are: trivkins, corexykins, xyzac-trt-kins, xyzbc-trt-kins, xyzab_tdr_kins, 5axiskins, "
            "maxkins. Another machine can be described in a machine file (docs/machine-files.md)");
    return false;
  }

  /// Which axes the machine has.
  bool readLetters() {
    const IniEntry* entry = ini_.find("TRAJ", "COORDINATES");
    letters_ = entry != nullptr ? plainWord(entry->value) : jointsSaid_ ? joints_ : std::string("XYZ");
    for (const char letter : letters_ + joints_) {
      if (allLetters.find(letter) != std::string_view::npos) continue;
      mistake(entry != nullptr ? entry : kinsEntry_, fmt::format("there is no axis {}", letter),
              "Axes are X, Y, Z, A, B, C, U, V and W");
      return false;
    }
    // LinuxCNC 2.8 and later count joints by the kinematics; letters without one do not exist.
    std::erase_if(letters_, [&](char letter) { return joints_.find(letter) == std::string::npos; });
    if (!carries('X') || !carries('Z')) {
      mistake(entry != nullptr ? entry : kinsEntry_,
              fmt::format("the machine has no axis {}", carries('X') ? 'Z' : 'X'),
              "Only mills and lathes can be simulated");
      return false;
    }
    if (const auto count = ini_.number("KINS", "JOINTS", diagnostics_);
        count && *count >= 1 && *count < static_cast<double>(joints_.size())) {
      const std::string there = joints_.substr(0, static_cast<std::size_t>(*count));
      for (const char letter : letters_) {
        if (there.find(letter) != std::string::npos) continue;
        mistake(ini_.find("KINS", "JOINTS"),
                fmt::format("axis {} is joint {} of these kinematics, but there are only {} joints", letter,
                            joints_.find(letter), *count),
                "Name the axes: KINEMATICS = trivkins coordinates=" + letters_);
        return false;
      }
    }
    return true;
  }

  enum class Stops { AtSmaller, AtLarger };

  /// The value of a key that both [AXIS_L] and [JOINT_N] may have: whichever LinuxCNC would stop at first.
  std::optional<double> limit(char letter, const char* key, Stops stops) {
    std::optional<double> result;
    const auto take = [&](const std::string& section) {
      const auto value = ini_.number(section, key, diagnostics_);
      if (value)
        result = !result ? *value : stops == Stops::AtSmaller ? std::min(*result, *value) : std::max(*result, *value);
    };
    // With other kinematics the limits of axes are those of the tool tip on the workpiece.
    if (kinematics_.identity) take(std::string("AXIS_") + letter);
    if (kinematics_.perJoint)
      for (std::size_t i = 0; i < joints_.size(); ++i)
        if (joints_[i] == letter) take(fmt::format("JOINT_{}", i));
    return result;
  }

  void readAxis(char letter, std::size_t joint) {
    Axis axis;
    axis.name = std::string(1, letter);
    axis.kind = isRotary(letter) ? AxisKind::Rotary : AxisKind::Linear;
    const std::string axisSection = std::string("AXIS_") + letter, jointSection = fmt::format("JOINT_{}", joint);
    if (!ini_.hasSection(axisSection) && !ini_.hasSection(jointSection)) {
      mistake(nullptr, fmt::format("axis {} has neither a section [{}] nor [{}]", letter, axisSection, jointSection),
              "These sections hold limits, speed and acceleration of the axis");
      return;
    }
    const double unit = isRotary(letter) ? degreesPerUnit_ : mmPerUnit_;
    const char* name = isRotary(letter) ? "degrees" : "mm";
    const auto low = limit(letter, "MIN_LIMIT", Stops::AtLarger), high = limit(letter, "MAX_LIMIT", Stops::AtSmaller);
    const auto wrapped = ini_.number(axisSection, "WRAPPED_ROTARY", diagnostics_);
    axis.modulo = isRotary(letter) && wrapped && *wrapped != 0;
    const double far = isRotary(letter) ? farthest : endless;
    axis.minimum = low ? std::clamp(*low * unit, -farthest, farthest) : -far;
    axis.maximum = high ? std::clamp(*high * unit, -farthest, farthest) : far;
    if ((!low || !high) && !axis.modulo && !isRotary(letter)) {
      warn(nullptr, fmt::format("axis {} has no {}: a travel to {:g} {} is assumed", letter,
                                low ? "MAX_LIMIT" : "MIN_LIMIT", low ? axis.maximum : axis.minimum, name));
    }
    if (!(axis.minimum < axis.maximum)) {
      mistake(ini_.find(jointSection, "MIN_LIMIT"),
              fmt::format("the travel of axis {} ends before it begins: {:g} to {:g} {}", letter, axis.minimum,
                          axis.maximum, name));
    }
    axis.rapid = pace(letter, "MAX_VELOCITY", unit) * 60;
    if (!isRotary(letter)) {
      const auto path = ini_.number("TRAJ", "MAX_LINEAR_VELOCITY", diagnostics_);
      if (path && *path > 0) axis.rapid = std::min(axis.rapid, *path * unit * 60);
    }
    axis.acceleration = pace(letter, "MAX_ACCELERATION", unit);
    home_[machine_.axes.size()] = ini_.number(jointSection, "HOME", diagnostics_).value_or(0) * unit;
    machine_.axes.push_back(std::move(axis));
  }

  double pace(char letter, const char* key, double unit) {
    const auto value = limit(letter, key, Stops::AtSmaller);
    if (value && *value > 0) return *value * unit;
    warn(nullptr, fmt::format("axis {} has no {}: LinuxCNC takes 1 unit", letter, key));
    return unit;
  }

  // ---- chains ----

  /// A length of the kinematics: [PROBEWRIGHT] of the .ini, else what the HAL files give to the pin.
  std::optional<double> length(std::string_view pin) {
    std::string key = plainWord(pin);
    std::ranges::replace(key, '-', '_');
    if (const auto said = ini_.number("PROBEWRIGHT", key, diagnostics_)) return *said * mmPerUnit_;
    const std::string name = fmt::format("{}.{}", kinematics_.name, pin);
    if (const auto found = hal_.pins.find(name); found != hal_.pins.end()) return found->second * mmPerUnit_;
    // A pin that nothing is connected to keeps its 0.
    if (std::ranges::find(hal_.netted, name) == hal_.netted.end()) return 0;
    return std::nullopt;
  }
  double lengthOr(std::string_view pin) {
    const auto value = length(pin);
    if (value) return *value;
    std::string key = plainWord(pin);
    std::ranges::replace(key, '-', '_');
    mistake(kinsEntry_,
            fmt::format("the length {}.{} is set by something that runs, so the files do not tell it", kinematics_.name,
                        pin),
            fmt::format("Write it into the .ini: [PROBEWRIGHT] {} = ...", key));
    return 0;
  }

  void add(std::vector<ChainElement>& chain, char letter, const Vector3& direction,
           const Vector3& point = Vector3::Zero()) {
    const auto axis = indexOf(letter);
    if (axis) chain.push_back({axis, direction, point});
  }

  void readChains() {
    for (const char letter : {'X', 'Y', 'Z'})
      add(machine_.spindleChain, letter, Vector3::Unit(letter - 'X'));
    const std::string_view name = kinematics_.name;
    const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
    auto& table = machine_.tableChain;
    auto& head = machine_.spindleChain;
    if (name == "xyzac-trt-kins" || name == "xyzbc-trt-kins") {
      const Vector3 point(lengthOr("x-rot-point"), lengthOr("y-rot-point"), lengthOr("z-rot-point"));
      if (name == "xyzac-trt-kins") {
        add(table, 'A', x, point + Vector3(0, lengthOr("y-offset"), lengthOr("z-offset")));
      } else {
        add(table, 'B', y, point + Vector3(lengthOr("x-offset"), 0, lengthOr("z-offset")));
      }
      add(table, 'C', z, point);
    } else if (name == "xyzab_tdr_kins") {
      const Vector3 point(lengthOr("x-rot-point"), lengthOr("y-rot-point"), lengthOr("z-rot-point"));
      add(table, 'B', -y, point);
      add(table, 'A', -x, point + Vector3(lengthOr("x-offset"), 0, lengthOr("z-offset")));
    } else if (name == "5axiskins") {
      add(head, 'C', z);
      add(head, 'B', -y, pivot());
      add(head, 'W', -z);
    } else if (name == "maxkins") {
      add(table, 'C', -z);
      add(head, 'B', -y, pivot());
      add(head, 'W', -z);
    }
    for (const IniEntry* entry : ini_.all("PROBEWRIGHT"))
      if (entry->key.starts_with("ROTARY_")) readRotary(*entry);
    for (const Axis& axis : machine_.axes) {
      const char letter = axis.name.front();
      if (!isRotary(letter) || moves(letter)) continue;
      if (!kinematics_.identity) continue;
      mistake(kinsEntry_,
              fmt::format("{} does not say where the axis of {} lies, nor whether it turns the table or the head",
                          kinematics_.name, letter),
              fmt::format("Write it into the .ini, direction and a point in machine coordinates of the spindle nose: "
                          "[PROBEWRIGHT] ROTARY_{} = TABLE {} 0 0 -300",
                          letter,
                          letter == 'A'   ? "1 0 0  0"
                          : letter == 'B' ? "0 1 0  0"
                                          : "0 0 1  0"));
    }
  }

  /// The point that a head swings about, above the nose. Pins of these modules begin with a length that is not 0.
  Vector3 pivot() {
    const std::string pin = fmt::format("{}.pivot-length", kinematics_.name);
    const bool said = ini_.find("PROBEWRIGHT", "PIVOT_LENGTH") != nullptr || hal_.pins.contains(pin);
    const bool netted = std::ranges::find(hal_.netted, pin) != hal_.netted.end();
    if (!said && !netted) {
      mistake(kinsEntry_, fmt::format("the files do not say how far the axis of B lies from the spindle nose: {}", pin),
              "Write it into the .ini: [PROBEWRIGHT] PIVOT_LENGTH = ...");
      return Vector3::Zero();
    }
    return {0, 0, lengthOr("pivot-length")};
  }

  bool moves(char letter) const {
    const auto axis = indexOf(letter);
    const auto is = [&](const ChainElement& element) { return element.axis == axis; };
    return std::ranges::any_of(machine_.tableChain, is) || std::ranges::any_of(machine_.spindleChain, is);
  }

  /// ROTARY_A = TABLE dx dy dz px py pz
  void readRotary(const IniEntry& entry) {
    const char letter = entry.key.size() == 8 ? entry.key[7] : ' ';
    const auto axis = indexOf(letter);
    if (!isRotary(letter) || !axis) {
      mistake(&entry, fmt::format("the machine has no rotary axis for {}", entry.key));
      return;
    }
    if (moves(letter)) {
      mistake(&entry, fmt::format("where the axis of {} lies is known already from {}", letter, kinematics_.name),
              "Remove this line");
      return;
    }
    std::istringstream words(entry.value);
    std::string part;
    std::array<double, 6> n{};
    words >> part;
    for (double& number : n)
      words >> number;
    const Vector3 direction(n[0], n[1], n[2]);
    part = plainWord(part);
    if (!words || (part != "TABLE" && part != "HEAD") || !(direction.norm() > 1e-9) || !(direction.norm() < farthest)) {
      mistake(&entry, fmt::format("{} is TABLE or HEAD, a direction and a point", entry.key),
              "For instance TABLE 1 0 0  0 0 -300: X direction, through X0 Y0 Z-300");
      return;
    }
    const Vector3 point = mmPerUnit_ * Vector3(n[3], n[4], n[5]);
    auto& chain = part == "TABLE" ? machine_.tableChain : machine_.spindleChain;
    chain.push_back({axis, direction.normalized(), point});
  }

  /// What the configuration says of itself, else whether something answers to an order to orient the spindle.
  void readOrientation() {
    if (const auto said = ini_.number("PROBEWRIGHT", "SPINDLE_ORIENTS", diagnostics_)) {
      machine_.spindleOrients = *said != 0;
      return;
    }
    machine_.spindleOrients = std::ranges::any_of(
        hal_.netted, [](const std::string& pin) { return pin.starts_with("spindle.") && pin.ends_with(".orient"); });
  }

  /// Axes that move nothing here are not axes of the machine.
  void leaveOut() {
    for (std::size_t i = machine_.axes.size(); i-- > 0;) {
      const char letter = machine_.axes[i].name.front();
      if (moves(letter)) continue;
      warn(kinsEntry_, fmt::format("axis {} is left out: {} does not say what it moves", letter, kinematics_.name));
      machine_.axes.erase(machine_.axes.begin() + static_cast<std::ptrdiff_t>(i));
      for (auto* chain : {&machine_.tableChain, &machine_.spindleChain})
        for (ChainElement& element : *chain)
          if (*element.axis > i) --*element.axis;
      for (std::size_t k = i; k + 1 < maximumAxes; ++k)
        home_[k] = home_[k + 1];
    }
  }

  /// Where tools are changed: where the configuration says, else at home.
  void readToolChange() {
    machine_.toolChange = home_;
    if (const IniEntry* entry = ini_.find("EMCIO", "TOOL_CHANGE_POSITION")) {
      std::istringstream words(entry->value);
      double value = 0;
      for (std::size_t i = 0; i < allLetters.size() && words >> value; ++i)
        if (const auto axis = indexOf(allLetters[i]))
          machine_.toolChange[*axis] = value * (isRotary(allLetters[i]) ? degreesPerUnit_ : mmPerUnit_);
    }
    for (std::size_t i = 0; i < machine_.axes.size(); ++i) {
      const Axis& axis = machine_.axes[i];
      if (!axis.modulo) machine_.toolChange[i] = std::clamp(machine_.toolChange[i], axis.minimum, axis.maximum);
    }
  }

  const LinuxCncIni& ini_;
  HalValues hal_;
  Diagnostics& diagnostics_;
  MachineDescription machine_;
  Kinematics kinematics_;
  const IniEntry* kinsEntry_ = nullptr;
  std::string joints_;   ///< a letter for each joint
  std::string letters_;  ///< of the axes
  bool jointsSaid_ = false;
  double mmPerUnit_ = 1, degreesPerUnit_ = 1;
  AxisPositions home_;
};

}  // namespace

std::optional<LinuxCncMachine> readLinuxCncMachine(const std::filesystem::path& path, Diagnostics& diagnostics) {
  Diagnostics own;
  std::optional<LinuxCncMachine> machine;
  if (const auto ini = LinuxCncIni::read(path, own)) machine = MachineReader(*ini, own).read();
  diagnostics.insert(diagnostics.end(), own.begin(), own.end());
  return machine;
}

}  // namespace probewright::machine
