#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "control/sinumerik/control.hpp"
#include "execution/host.hpp"
#include "execution/names.hpp"
#include "execution/sinumerik/motion.hpp"
#include "execution/sinumerik/system_variables.hpp"
#include "execution/sinumerik/user_variables.hpp"
#include "language/sinumerik/block_parser.hpp"
#include "language/sinumerik/statement_kinds.hpp"

namespace probewright::execution::sinumerik {

struct HostOptions {
  /// Cycles that are read but not carried out end the run with an alarm instead of being noted as skipped.
  bool strict = false;
  /// ISFILE: whether a program or file of that name exists.
  std::function<bool(std::string_view path)> fileExists = {};
  /// READ: the text of a file beside the program; nothing if there is none of that name.
  std::function<std::optional<std::string>(std::string_view path)> readFile = {};
  /// While Control::blockSearch: the line of the main program that is searched for. In front of it the search ends, and
  /// `searchEnds` brings the machine to where the program stands.
  std::uint64_t searchLine = 0;
  std::function<void()> searchEnds = {};
  /// Runs a program that the control calls by itself, if `caller` finds one of that name; false if not. Throws what the
  /// program ends with.
  std::function<bool(std::string_view name, const language::Program* caller)> callProgram = {};
  /// Global user data with their values at the start. What programs change of them goes into the control's data when
  /// the last one ends.
  UserVariables::Scope globalData = {};
};

/// Carries out the instructions of SINUMERIK programs on a control: its variables, motions, tools, frames and cycles.
/// Throws control::Alarm with the control's numbers.
class SinumerikHost : public Host {
public:
  explicit SinumerikHost(Control& control, HostOptions options = {});
  ~SinumerikHost() override;
  SinumerikHost(const SinumerikHost&) = delete;
  SinumerikHost& operator=(const SinumerikHost&) = delete;

  Value read(const language::VariableRef& variable, Evaluation& evaluation) override;
  void write(const language::VariableRef& variable, const Value& value, Evaluation& evaluation) override;
  bool isDefined(const language::VariableRef& variable, Evaluation& evaluation) override;
  Value call(std::string_view name, std::span<const Value> arguments) override;
  void execute(const language::Instruction& instruction, Evaluation& evaluation) override;
  bool drivesModalCall(const language::Block& block) const override;
  void modalCall(bool inEffect) override { control_.modalCall = inEffect; }
  bool beginBlock(const language::Program& program, const language::Block& block) override;
  std::string code(Refusal refusal) const override;
  std::string numberText(double value) const override;
  std::optional<std::string> shownText(const language::VariableRef& variable, Evaluation& evaluation) override;
  Value valueFor(const language::VariableRef& variable, const language::Operand& operand,
                 Evaluation& evaluation) override;
  std::uint64_t takeWork() override { return std::exchange(work_, 0) + std::exchange(state_.pieces, 0); }
  double relativeEquality() const override { return 1e-12; }
  void enter(const language::Program& program, const language::CallProgram* call, Evaluation* caller) override;
  void leave(const language::Program& program) override;

  /// Options of an interpreter that runs SINUMERIK programs: 16 program levels and so on are the control's.
  static constexpr int programDepth = 16;

  const MotionState& motionState() const { return state_; }
  UserVariables& variables() { return variables_; }

private:
  // host_variables.cpp
  struct ResolvedVariable {
    language::VariableSpace space = language::VariableSpace::User;
    std::string name;
    std::vector<Value> indices;
  };
  ResolvedVariable resolve(const language::VariableRef& variable, Evaluation& evaluation) const;
  Value read(const ResolvedVariable& variable);
  void write(const ResolvedVariable& variable, const Value& value);
  double& rParameter(double number);
  std::optional<Value> readGlobal(std::string_view name, std::span<const Value> indices);
  bool writeGlobal(std::string_view name, std::span<const Value> indices, const Value& value);
  void declare(const language::Command& command, Evaluation& evaluation);
  void fill(const language::Command& command, Evaluation& evaluation);
  bool isVariableNamed(std::string_view text);
  void storeParameters();
  void storeGlobalData();

  // host_instructions.cpp
  void carryOut(const language::Assign& assign, Evaluation& evaluation);
  void carryOut(const language::Move& move, Evaluation& evaluation);
  void carryOut(const language::ToolCall& call, Evaluation& evaluation);
  void carryOut(const language::Modal& modal, Evaluation& evaluation);
  void carryOut(const language::MachineFunction& function, Evaluation& evaluation);
  void carryOut(const language::Transform& transform, Evaluation& evaluation);
  void carryOut(const language::Command& command, Evaluation& evaluation);
  void carryOut(const language::CallProgram& call, Evaluation& evaluation);
  void carryOut(const language::Stop& stop, Evaluation& evaluation);
  /// SINUMERIK programs call cycles as programs.
  void carryOut(const language::CycleCall&, Evaluation&) {}

  void chooseMotion(std::string_view name);
  void carryOutG(int number);
  void carryOutGroup(int group, int number);
  void setSpeed(std::span<const language::Word> words, Evaluation& evaluation);
  void selectEdge(int number);
  void requireAxisOfFrame(language::sinumerik::FrameChange change, const control::sinumerik::AxisValue& axis) const;
  std::optional<Vector3> poleOrigin(language::sinumerik::FrameChange change) const;
  void leaveLevel();
  void changeTool();
  bool handToMachine(int number);
  void turnSpindle();
  void takeSpeedOfBlock(Evaluation& evaluation);
  void followSpeed();
  void turnTool(int spindle, int function);
  void orientSpindle(int spindle, double degrees, WordMode mode);
  void setToolSpeed(int spindle, double speed);
  void selectMasterSpindle(const language::Command& command, Evaluation& evaluation);
  void alignFrameWithTool(bool withOrigin);
  void raiseAlarm(const language::Command& command, Evaluation& evaluation);
  void dwell(const language::Command& command, Evaluation& evaluation);
  void executeText(const language::Command& command, Evaluation& evaluation);
  void callFromText(const language::CallProgram& call, Evaluation& evaluation);
  bool callAside(std::string_view name);
  void skip(std::string_view what, std::string_view how = "is not carried out");
  void leaveOut(const language::Command& command, Evaluation& evaluation);
  void findTool(const language::Command& command, Evaluation& evaluation);
  void circleThroughPoints(const language::Command& command, Evaluation& evaluation);
  void runCircle(language::WordRange arguments, Evaluation& evaluation);
  void runCycle(std::string_view name, language::WordRange arguments, Evaluation& evaluation);
  void runSwivel(language::WordRange arguments, Evaluation& evaluation);
  /// When the machine builder's program CUST_MEACYC is called.
  enum class Occasion { BeforeMeasuring, AfterMeasuring, SpindlePositioned };
  /// What it is told.
  struct MeasuringNotice {
    int cycle = 0;
    Occasion occasion = Occasion::BeforeMeasuring;
  };
  void callMachineBuilder(int cycle, Occasion occasion);

  // host_files.cpp
  const std::string* writtenFile(const std::string& name) const;
  std::optional<std::string> fileText(const std::string& file) const;
  bool isFile(const std::string& path) const;
  void setVariable(const language::Operand& target, const Value& value, Evaluation& evaluation);
  void writeFile(const language::Command& command, Evaluation& evaluation);
  void readFile(const language::Command& command, Evaluation& evaluation);
  void deleteFile(const language::Command& command, Evaluation& evaluation);

  /// What SAVE keeps over a subprogram.
  struct SavedState {
    MotionState motion;
    int plane = 17;
    double unit = 1;
    bool diameter = false;
    int settable = 0;
    control::sinumerik::Frame programmed;
  };
  void restore(const SavedState& saved);
  /// One program level.
  struct Level {
    const language::Program* program = nullptr;
    SourcePlace call;                                                  ///< the block of the caller
    std::vector<std::pair<std::string, ResolvedVariable>> references;  ///< VAR parameters and where they come from
    std::optional<SavedState> saved;
  };

  Control& control_;
  HostOptions options_;
  MotionState state_;
  PathMotion motion_;
  SystemVariables system_;
  UserVariables variables_;
  std::vector<Level> levels_;
  std::vector<double> r_;
  std::vector<bool> rChanged_;
  const language::Program* lastProgram_ = nullptr;
  const language::Block* block_ = nullptr;
  int preparedTool_ = -1;
  double toolSpeed_ = 0;  ///< S of the spindle that drives tools, rev/min
  std::optional<int> edgeAfterChange_;
  std::optional<MeasuringNotice> notice_;  ///< while the call of CUST_MEACYC is being made
  bool builderTellsOccasions_ = false;     ///< the last CUST_MEACYC has a parameter for the occasion
  bool recording_ = false;                 ///< motions make a table of a contour or a curve: the axes stand
  mutable std::uint64_t work_ = 0;         ///< elements of arrays that were filled or copied, files that were looked up
  std::set<std::string, std::less<>> skipped_;
  std::set<std::string> deletedFiles_;  ///< what DELETE took from the files that lay there
};

}  // namespace probewright::execution::sinumerik
