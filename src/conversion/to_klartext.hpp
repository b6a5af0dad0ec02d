#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "conversion/call.hpp"
#include "conversion/klartext_formulas.hpp"
#include "conversion/output.hpp"

/// Writes a SINUMERIK program in Klartext, block by block.
namespace probewright::conversion {

class ToKlartext {
public:
  /// `globalData`: global user data with their values; null if none are known.
  ToKlartext(sinumerik::SinumerikProgram& program, const GlobalData* globalData, control::ControlKind control);
  Conversion run();

private:
  // to_klartext.cpp: the program, tools, frames
  void survey();
  void write(const language::Block& block);
  void statements(const language::Block& block);
  void instruction(const language::Block& block, const language::Instruction& instruction);
  void toolCall(const language::Block& block, const language::ToolCall& call);
  void changeTool();
  void modal(const language::Block& block, const language::Modal& modal);
  void machineFunction(const language::Block& block, const language::MachineFunction& function);
  void transform(const language::Block& block, const language::Transform& transform);
  void command(const language::Block& block, const language::Command& command);
  void blank(const language::Block& block, const language::Command& command);
  std::string numbered() const;

  // to_klartext_variables.cpp
  void assign(const language::Block& block, const language::Assign& assign);
  /// A component of $P_UIFR: a translation or the rotation about the tool axis.
  void assignFrameComponent(const language::Block& block, const language::Assign& assign);
  void define(const language::Block& block, const language::Command& command);

  // to_klartext_flow.cpp
  void structured(const language::Block& block, const language::Structured& structured);
  void carryOver(const language::Block& block, const language::Structured& structured);
  void jump(const language::Block& block, const language::Jump& jump);
  void repeat(const language::Block& block, const language::RepeatSection& section);
  void call(const language::Block& block, const language::CallProgram& call);
  /// Jumps to the label if the condition is `wanted`.
  void jumpIf(const language::Block& block, const language::Operand& condition, bool wanted, const std::string& label);
  void goTo(const std::string& label);
  std::string comparable(const language::Block& block, const language::Operand& operand);
  void label(const std::string& name);

  // planes.cpp
  void swivel(const language::Block& block, const language::CallProgram& call);

  // single_touches.cpp
  void measuringBlock(const language::Block& block, const language::Command& command);

  // to_klartext_moves.cpp
  void move(const language::Block& block, const language::Move& move);
  void arc(const language::Block& block, const language::Move& move, bool clockwise);
  std::string coordinate(const language::Block& block, const language::Word& word);

  // to_klartext_cycles.cpp
  void cycle(const language::Block& block, const language::CallProgram& call);
  /// CYCLE150: whether the cycles that follow write a log.
  void measuringLog(const language::Block& block, const Call& call);
  Place here();
  /// Writes the touch probe cycle that carries out the task; its number.
  std::string writeTask(const MeasuringTask& task);
  /// A corner that is measured only, which no touch probe cycle does: four times cycle 427.
  Results cornerByTouches(const MeasuringTask& corner);
  void copyResults(const language::Block& block, const Results& left, const MeasuringTask& task);
  /// Corrects the tool by FN 17, if that depends on conditions or on both sides of a rectangle.
  void correctTool(const MeasuringTask& task, const Results& results);
  /// To where the SINUMERIK cycle leaves the probe.
  void goBack(const MeasuringTask& task, std::array<std::optional<Quantity>, 3> end);

  std::string axis(std::size_t index) const;
  std::optional<std::size_t> planeIndex(std::uint32_t address) const;
  Quantity quantity(const language::Block& block, const language::Operand& operand) {
    return formulas_.quantity(block, operand);
  }
  /// Writes the line behind what its values need.
  void line(std::string text);
  void forgetPosition() { position_ = {}; }

  sinumerik::SinumerikProgram& program_;
  control::ControlKind control_;
  Output out_;
  KlartextFormulas formulas_;
  Quantity ballRadius_ = klartextBallRadius;
  Conversion result_;

  // What the whole program tells.
  std::set<std::string> targets_;           ///< labels that jumps and repetitions name
  std::set<std::string> sections_;          ///< labels that end a repeated section
  std::set<int> usedResults_;               ///< n of _OVR[n]
  std::vector<std::set<int>> wantedAfter_;  ///< those read behind the n-th measuring cycle; 0: before any
  bool changesTool_ = false;                ///< by M6
  double millimetre_ = 1;                   ///< in the unit of the program

  // Where the text has come to.
  char toolAxis_ = 'Z';
  std::array<std::optional<Quantity>, 3> position_;  ///< of the tip: main, minor, tool axis
  language::MoveKind motion_ = language::MoveKind::Rapid;
  bool incremental_ = false;
  std::string compensation_ = "R0";
  std::string pendingTool_, tool_;  ///< to be changed to, in the spindle
  std::array<std::optional<Quantity>, 3> shift_;
  bool rotated_ = false;
  std::optional<int> activeRow_;
  bool hasRowZero_ = false;      ///< the last zero offset is a copy of another
  bool rowZeroIsDue_ = false;    ///< so it was, but no cycle has done it yet
  bool copiesToRow0_ = false;    ///< the active zero offset was copied to the last one
  bool besideMeasured_ = false;  ///< a measuring block has left the probe elsewhere than the original one
  bool unturned_ = false;        ///< the zero offset has lost its rotation, as for cycle 400
  std::size_t cycleNumber_ = 0;
  MeasuringTask::Log log_ = MeasuringTask::Log::None;  ///< as CYCLE150 has said

  struct Open {
    language::Structure kind;
    std::string begin, end, other;
    std::string counter;
    bool hasElse = false;
    bool lost = false;  ///< it could not be carried over, but what closes it is still to come
  };
  std::vector<Open> open_;
  std::set<std::string> changedGlobals_;
  int nextLabel_ = 1;
};

}  // namespace probewright::conversion
