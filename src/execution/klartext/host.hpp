#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "control/heidenhain/control.hpp"
#include "control/heidenhain/text_table.hpp"
#include "execution/evaluation.hpp"
#include "execution/host.hpp"
#include "execution/klartext/contour.hpp"
#include "language/klartext/heidenhain_program.hpp"

namespace probewright::language::klartext {

struct HostOptions {
  /// Cycles that are not simulated are refused instead of skipped.
  bool strict = false;
  /// The bytes of a file that a program names: masks of FN 16, datum tables. Without it no such file is found.
  std::function<Result<std::string>(const std::string& name)> readFile;
  /// True if the run reads a file of this name where it would write it: FN 16 must not write over it.
  std::function<bool(const std::string& name)> isInput;
};

/// What a mask of FN 16 makes of a file.
struct ProtocolResult {
  enum class Going { AsOpen, Append, Truncate };
  std::string text;
  bool close = false;
  Going going = Going::AsOpen;
  std::size_t mostBytes = 0;  ///< of the file, M_APPEND_MAX; 0: any
};

/// Carries out Klartext on a HEIDENHAIN control. Program coordinates and feeds are in the unit of the program.
class KlartextHost : public Host {
public:
  explicit KlartextHost(control::heidenhain::Control& control, HostOptions options = {});

  Value read(const VariableRef& variable, Evaluation& evaluation) override;
  void write(const VariableRef& variable, const Value& value, Evaluation& evaluation) override;
  bool isDefined(const VariableRef& variable, Evaluation& evaluation) override;
  Value call(std::string_view name, std::span<const Value> arguments) override;
  void execute(const Instruction& instruction, Evaluation& evaluation) override;
  std::string requestedProgram() override { return std::exchange(requestedProgram_, {}); }
  bool beginBlock(const Program& program, const Block& block) override;
  std::string code(Refusal refusal) const override;
  void enter(const Program& program, const CallProgram* call, Evaluation* caller) override;
  void leave(const Program& program) override;

private:
  /// Cycle 12 under way through the points of a pattern.
  struct PatternRun {
    std::vector<Vector3> points;  ///< mm
    std::size_t next = 0;
    Vector3 shift = Vector3::Zero();  ///< the datum shift without them
    std::string program;
  };
  struct Level {
    const HeidenhainProgram* program = nullptr;
    std::string file;
    double outerUnit = 1;
    std::vector<std::optional<double>> local;  ///< QL
    std::optional<PatternRun> pattern;
  };

  // host_moves.cpp
  void move(const Move& move, Evaluation& evaluation);
  void straight(const Move& move, Evaluation& evaluation);
  void arc(const Move& move, Evaluation& evaluation);
  void corner(const Move& move, Evaluation& evaluation);
  void approachOrDepart(const Move& move, Evaluation& evaluation);
  void setCentre(const Move& move, Evaluation& evaluation);
  void moveInMachineCoordinates(const Move& move, Evaluation& evaluation);
  void runElement(const Element& element, const control::WorkingPlane& plane);
  void addElement(Element element, const Move& move, Evaluation& evaluation);
  Vector3 programmedPosition() const;
  Vector3 pointOf(const Move& move, Evaluation& evaluation, const Vector3& from) const;
  std::size_t axisOf(char letter) const;
  control::Feed feedOf(const Move& move, Evaluation& evaluation);
  static control::Feed checkedFeed(double millimetresPerMinute);
  control::Feed feedFor(double programmed) const;
  void namePathWords(const Move& move, Evaluation& evaluation);
  Vector3 untiltedTarget(const Move& move, Evaluation& evaluation, const Vector3& from) const;
  void straightTo(const Vector3& to, control::Feed feed);
  BlockPlace placeOf(Evaluation& evaluation) const;
  /// Of the tool in the spindle, at least 1.
  double teeth() const;
  Side sideOf(const Move& move);
  bool travels(const Move& move, Evaluation& evaluation) const;
  double length(const Operand& operand, Evaluation& evaluation) const;
  const Word* find(WordRange range, std::string_view address, Evaluation& evaluation) const;
  void warnOfEarlyEnd(const Block& block);
  /// Ends all motion that waits; compensation ends too.
  void settle();

  // host_machine_functions.cpp
  void setUndefined(const VariableRef& variable);
  void machineFunction(const MachineFunction& function, Evaluation& evaluation);
  void nameMachineFunction(int number);
  bool handToMachine(int number);
  void coolant(int number);
  void standDown();
  void retractAlongTool(const MachineFunction& function, Evaluation& evaluation);
  void takeTurns(const MachineFunction& function, Evaluation& evaluation);
  void deleteBasicRotation();
  void retract(std::optional<double> distance, control::Feed feed);
  void setHoldTip(bool hold);

  // host_tcpm.cpp
  void guideTool(const Modal& modal, Evaluation& evaluation);
  void placeControlledPoint();
  using RotaryTarget = std::array<std::optional<double>, machine::maximumAxes>;
  void turnToSpaceAngles(WordRange words, RotaryTarget& rotary, Evaluation& evaluation);
  void turnToVector(WordRange words, RotaryTarget& rotary, Evaluation& evaluation);
  void turnTo(const Vector3& direction, RotaryTarget& rotary) const;
  void moveTurning(const control::Target& target, control::Feed feed);

  // host_tools.cpp
  void callTool(const ToolCall& call, Evaluation& evaluation);
  void defineTool(const Command& command, Evaluation& evaluation);
  void publishTool();

  // host_transforms.cpp
  void transform(const Transform& transform, Evaluation& evaluation);
  void shiftDatum(WordRange words, Evaluation& evaluation);
  void shiftAxis(char letter, double value, bool incremental);
  void shiftDatumByTable(double row);
  void selectDatumTable(const std::string& name);
  void activatePreset(int row, bool keepTransformations);
  int presetRowOf(const Word& word, Evaluation& evaluation) const;
  void correctPreset(control::heidenhain::ActivePreset& preset, control::heidenhain::Control::PresetChange& change,
                     WordRange words, Evaluation& evaluation);
  void presetCommand(std::string_view name, const Command& command, Evaluation& evaluation);

  // host_planes.cpp
  void plane(std::string_view name, WordRange words, Evaluation& evaluation);
  Matrix3 machineFromWorkpiece() const;
  void tiltByCycle19(WordRange words, Evaluation& evaluation);
  void tilt(const std::optional<Matrix3>& tilt, WordRange words, Evaluation& evaluation);
  void keepWantedSide(std::vector<machine::AxisPositions>& solutions, const Vector3& toolAxis, WordRange words,
                      Evaluation& evaluation) const;
  void placeFreeAxis(const Matrix3& machineFromPlane, const Vector3& toolAxis, bool onlyTurned,
                     machine::AxisPositions& target, WordRange words, Evaluation& evaluation) const;
  void positionRotaryAxes(const machine::AxisPositions& target, WordRange words, Evaluation& evaluation);
  void publishRotaryAxes(const machine::AxisPositions& target);

  // host_cycles.cpp
  void cycle(const CycleCall& call, Evaluation& evaluation);
  void measure(const CycleCall& call, Evaluation& evaluation);
  void defineCycle(int number);
  void callCycle(const Command& command, Evaluation& evaluation);
  void moveToCallPosition(const Command& command, Evaluation& evaluation);
  void callMachiningCycle();
  void skip(int number);

  // host_commands.cpp
  void command(const Command& command, Evaluation& evaluation);
  void circleThroughPoints(const Command& command, Evaluation& evaluation);
  void setPresetInAxis(const Command& command, Evaluation& evaluation);
  void message(std::string text);
  void warn(std::string text);
  /// Names what is not carried out, once in a run; refuses it under --strict.
  void leaveOut(const std::string& what);
  void functionBlock(std::string_view text, Evaluation& evaluation);
  void dwell(double seconds);
  void print(std::string_view text, Evaluation& evaluation);

  // host_system_data.cpp: FN 18
  void systemRead(const Command& command, Evaluation& evaluation);
  std::optional<double> systemData(int id, int number, double index, Evaluation& evaluation);
  std::optional<double> programData(int number, int index) const;
  std::optional<double> parameterData(int number, int index, Evaluation& evaluation);
  std::optional<double> stateData(int number) const;
  std::optional<double> touchData(int number, int index) const;
  std::optional<double> tableData(int id, int number, int index) const;
  std::optional<double> probingState(int number, int index) const;
  std::optional<double> coordinateData(int id, int number, int index) const;
  double spindleState() const;

  // host_tool_data.cpp: tools and touch probes of FN 18, and FN 17
  std::string toolRowOf(double index) const;
  std::optional<double> toolData(int number, const std::string& row) const;
  std::optional<double> toolCallData(int number) const;
  std::optional<double> toolCompensation(int number, double index) const;
  std::optional<double> probeData(int number, int index) const;
  void systemWrite(const Command& command, Evaluation& evaluation);

  // host_patterns.cpp
  void definePattern(std::string_view text, Evaluation& evaluation);
  void selectPattern(const std::string& path);
  void callAtPattern();
  void nextPatternPoint();

  // host_protocol.cpp: FN 16
  void protocol(const Command& command, Evaluation& evaluation);
  Value readNamed(std::string_view name, Evaluation& evaluation);
  double numberNamed(std::string_view name, Evaluation& evaluation);
  void send(std::string_view text, Evaluation& evaluation);
  void insertParameters(std::string& text, Evaluation& evaluation);
  std::string protocolFile(const std::string& target) const;
  void writeProtocol(const std::string& name, const ProtocolResult& result);

  // host_tables.cpp: FN 26, 27, 28, and files that programs name
  void openTable(std::string_view path);
  void writeTable(const Command& command, Evaluation& evaluation);
  void readTable(const Command& command, Evaluation& evaluation);
  void tableData(const Command& command, Evaluation& evaluation);
  void writeTableNumber(bool tool, const std::string& row, const std::string& column, double value);
  /// The bytes of a file of the control: at its path, or by its name alone.
  Result<std::string> readHostFile(std::string_view path) const;

  // host_system_text.cpp
  Value systemText(int id, int number, int index) const;
  Value configuration(const std::string& object, const std::string& attribute, int index) const;
  double machineSeconds() const;

  control::heidenhain::Control& control_;
  HostOptions options_;
  std::vector<Level> levels_;
  Contour contour_;
  double feed_ = 0;                 ///< mm/min, or with M136 mm per revolution; 0: none programmed yet
  bool feedPerRevolution_ = false;  ///< M136
  bool untiltedPositions_ = false;  ///< M130, in this block
  bool ignoreProbe_ = false;        ///< M141, in this block
  std::set<std::string> leftOut_;   ///< named already
  Side side_ = Side::Off;
  Vector3 pole_ = Vector3::Zero();
  bool poleSet_ = false;
  std::optional<control::WorkingPlane> polePlane_;  ///< of CC, if it is not that of the tool axis
  int arcDirection_ = 0;
  bool shortestPath_ = false;  ///< M126
  /// FUNCTION TCPM: the point of the tool that the program names, and the one about which rotary axes turn the tool.
  enum class ReferencePoint { TipTip, TipCentre, CentreCentre };
  ReferencePoint referencePoint_ = ReferencePoint::TipTip;
  bool spaceAngles_ = false;              ///< AXIS SPAT: A, B, C are space angles of the tool
  Vector3 toolAngles_ = Vector3::Zero();  ///< as last programmed with AXIS SPAT
  bool spindleHasRun_ = false;
  double preparedTool_ = 0;  ///< of TOOL DEF
  std::optional<int> lastProbeCycle_;
  bool clockwise_ = true;
  std::string selectedProgram_;
  std::optional<int> machiningCycle_;
  std::string cycleProgram_;      ///< of cycle 12
  std::string requestedProgram_;  ///< to be called after this instruction
  bool cycleAtEachMove_ = false;  ///< M89
  std::vector<Vector3> pattern_;  ///< of PATTERN DEF or SEL PATTERN, mm
  std::map<std::string, bool> protocolOpen_;
  std::optional<control::heidenhain::TextTable> table_;  ///< opened with FN 26
};

/// The name of a file without the folders of the control: "TNC:\\LOG\\R.TXT" -> "R.TXT".
std::string fileNameOf(std::string_view path);

/// The keyword of a mask for a language of the control: "L_ENGLISH".
std::string_view languageWord(control::DialogLanguage language);

/// Formats a FN 16 mask line by line; see host_protocol.cpp. `read` gives the value of "Q5" or "QS3".
ProtocolResult formatProtocol(std::string_view mask, const std::function<Value(std::string_view)>& read,
                              std::int64_t secondsSince1970, std::string_view callPath,
                              control::DialogLanguage language);

}  // namespace probewright::language::klartext
