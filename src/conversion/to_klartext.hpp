#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "conversion/call.hpp"
#include "conversion/conversion.hpp"
#include "conversion/corner_room.hpp"
#include "conversion/flow_graph.hpp"
#include "conversion/klartext_formulas.hpp"
#include "conversion/lacking_rows.hpp"
#include "conversion/output.hpp"
#include "conversion/rotary_turns.hpp"
#include "conversion/rounded_values.hpp"

/// Writes a SINUMERIK program in Klartext, block by block.
namespace probewright::conversion {

class ToKlartext {
public:
  /// `globalData`: global user data with their values; null if none are known.
  ToKlartext(language::sinumerik::SinumerikProgram& program, const GlobalData* globalData, control::ControlKind control,
             const Job* job, const TouchProbe& probe);
  Conversion run();

private:
  // to_klartext.cpp: the program, tools, frames
  void survey();
  /// What other programs of the job may leave in effect, too.
  void surveyJob(const language::Block& block, const language::Instruction& instruction);
  enum class SelectedUnit { None, Millimetre, Inch };
  static SelectedUnit unitOf(const language::Block& block, const language::Instruction& instruction);
  struct Units {
    bool metric = false, inch = false;
    void add(SelectedUnit unit) {
      metric = metric || unit == SelectedUnit::Millimetre;
      inch = inch || unit == SelectedUnit::Inch;
    }
  };
  void write(const language::Block& block);
  void statements(const language::Block& block);
  void instruction(const language::Block& block, const language::Instruction& instruction);
  void toolCall(const language::Block& block, const language::ToolCall& call);
  void changeTool();
  /// False of T0, which leaves the spindle empty.
  static bool isTool(const language::Block& block, const language::ToolCall& call);
  void modal(const language::Block& block, const language::Modal& modal);
  /// True if the word or cycle says how a path is travelled or shown, not where it leads: it is left out. A note says
  /// so, once a word, where Klartext has words of its own for that.
  bool leavesOut(const language::Block& block, std::string_view name);
  void machineFunction(const language::Block& block, const language::MachineFunction& function);
  void command(const language::Block& block, const language::Command& command);
  /// SPOS. `words`: the angle, then the number of the spindle if it stands there.
  void orientSpindle(const language::Block& block, std::span<const language::Word> words);
  void blank(const language::Block& block, const language::Command& command);
  std::string numbered() const;

  // to_klartext_modes.cpp
  /// What is in effect and stays so until a block changes it; empty where it depends on the way that led there.
  struct Modes {
    std::optional<char> toolAxis = 'Z';
    std::optional<bool> incremental = false;
    std::optional<language::MoveKind> motion = language::MoveKind::Rapid;
    std::optional<std::string> compensation = "R0";
    std::optional<std::array<double, 3>> shift = std::array<double, 3>{};  ///< X, Y, Z
    std::optional<double> rotation = 0;
    std::optional<int> row;
    std::set<int> selected;  ///< zero offsets that were selected: the preset table has their rows
    std::optional<MeasuringTask::Log> log = MeasuringTask::Log::None;
    std::optional<bool> withoutLength = false;  ///< D0 is in effect
    std::optional<bool> tilted = false;         ///< a plane of CYCLE800 is in effect
    std::optional<bool> hasTool = false;        ///< a tool other than 0 is in the spindle, or comes next
    bool operator==(const Modes&) const = default;
  };
  /// Follows all ways through the program; where several meet, `entries_` has what all of them agree on.
  void surveyModes();
  /// Where the probe may stand elsewhere than the original program left it, on one of the ways to a block at least.
  struct Beside {
    std::array<bool, 3> cycle{};  ///< X, Y, Z: by a measuring cycle
    bool measured = false;        ///< by a measuring block
    bool operator==(const Beside&) const = default;
  };
  void surveyPlaces();
  void listPositionsRead(const language::Block& block);
  bool isNeutral(const language::Block& block) const;
  /// `next`: the blocks that may follow each block; `measures`: the block is a measuring cycle; `read`: n of the
  /// _OVR[n] that a block names.
  void surveyResults(const std::vector<std::vector<std::size_t>>& next, const std::vector<bool>& measures,
                     const std::map<std::size_t, std::set<int>>& read);
  static std::optional<MeasuringTask::Log> logOf(const language::Block& block, const language::CallProgram& call);
  static bool logs(const language::Block& block);
  void follow(const language::Block& block, Modes& modes) const;
  void followTransform(const language::Block& block, const language::Transform& transform, Modes& modes) const;
  static bool agree(Modes& with, const Modes& other);
  /// Takes over what all ways to this block agree on.
  void adopt(const language::Block& block);
  /// Lists, once a block, that it relies on something that depends on the way.
  void rely(const language::Block& block, bool doubtful, const char* on);

  // to_klartext_frames.cpp
  void transform(const language::Block& block, const language::Transform& transform);
  /// The settable zero offset that the block selects.
  static std::optional<int> selectedOffset(const language::Block& block);
  /// What a HEIDENHAIN control does of a row that it lacks where the SINUMERIK writes into the zero offset.
  enum class Lacking { CopiesPresetInEffect, Stops };
  /// Lists, once a row, that the block writes a zero offset whose row the preset table may lack and which a block then
  /// selects.
  void listLackingRow(const language::Block& block, const Quantity& row, Lacking lacking);
  void writeShift(const std::array<Quantity, 3>& shift);
  void writeRotation(const Quantity& angle);
  Quantity frozen(const Quantity& quantity, const std::string& name);
  /// Lets the program read the shift where only it knows it.
  void readFrame();
  /// Touch probe cycles permit neither shift nor rotation: refuses a rotation that only the running program knows.
  void requireFrame();
  /// Takes shift and rotation back.
  void cancelFrame();
  /// Sets them again.
  void restoreFrame();
  bool isShifted() const;
  /// Neither shift nor rotation, for certain.
  bool frameIsNone() const;
  /// Takes shift and rotation back and counts the task without them. False if there are none.
  bool leaveFrame(MeasuringTask& task);
  /// Sets them again; results count in them. `task`: as it was before.
  void comeBackToFrame(const MeasuringTask& task, Results& results);

  // to_klartext_variables.cpp
  void assign(const language::Block& block, const language::Assign& assign);
  /// A component of $P_UIFR: a translation or the rotation about the tool axis.
  /// The tool that an index of $TC_DP.. names may be the one in the spindle.
  bool mayBeInSpindle(const language::Block& block, const language::Operand& tool);
  /// What a block has written: it acts when a zero offset is selected, or an edge.
  enum class Acts : std::uint8_t { ZeroOffset, ToolDatum };
  /// True if that is done below the block before anything moves or reads where the tool is, or nothing does.
  bool actsBeforeItMoves(const language::Block& block, Acts what);
  void assignFrameComponent(const language::Block& block, const language::Assign& assign);
  void define(const language::Block& block, const language::Command& command);

  // to_klartext_flow.cpp
  void structured(const language::Block& block, const language::Structured& structured);
  void carryOver(const language::Block& block, const language::Structured& structured);
  void jump(const language::Block& block, const language::Jump& jump);
  void repeat(const language::Block& block, const language::RepeatSection& section);
  void call(const language::Block& block, const language::CallProgram& call);
  bool selectsUnitNext(const language::Block& block);

  // to_klartext_arguments.cpp
  /// The PROC line of a program of the job; null if it has none, or was not found.
  const language::sinumerik::BlockParser::Header* headerOf(std::string_view name) const;
  void callWithArguments(const language::Block& block, const language::CallProgram& call,
                         const language::sinumerik::BlockParser::Header& header);
  /// What the PROC line does: the parameters of this program take what the caller has handed over.
  void takeArguments();

  void returnEarly();
  /// Jumps to the label if the condition holds, or if it does not.
  enum class When { Holds, Fails };
  void jumpWhen(When when, const language::Block& block, const language::Operand& condition, const std::string& label);
  void goTo(const std::string& label);
  std::string comparable(const language::Block& block, const language::Operand& operand);
  void label(const std::string& name);
  void surveyFlow();
  /// A name for a label that the program does not have yet.
  std::string unusedLabel(std::string_view name);
  std::string labelAt(const language::BlockPosition& position) const;
  /// `times` rounds through what `body` writes.
  enum class Rounds { Written, Counted };  ///< a few may be written one by one, or all are counted
  void repeated(const Quantity& times, Rounds rounds, const std::function<void()>& body);
  /// Where the section of a repetition goes back to.
  std::string backFrom(std::size_t repetition);
  /// What ends the sections whose last block is this one.
  void endSections(const language::Block& block);

  // tool_measuring.cpp
  void toolMeasurement(const language::Block& block, const Call& call);

  // planes.cpp
  void swivel(const language::Block& block, const language::CallProgram& call);
  /// Lists another swivel data set (_TC) than the first one that the program names.
  void listOtherDataSet(const language::Block& block, const language::CallProgram& call);
  /// CYCLE800() and _TC = "0": the frames of the program and the rotary axes stay.
  static bool deselectsPlane(const language::Block& block, const language::CallProgram& call);
  /// Angles other than 0, or that only the running program knows: PLANE SPATIAL, not PLANE RESET.
  static bool tiltsPlane(const language::Block& block, const language::CallProgram& call);

  // single_touches.cpp
  void measuringBlock(const language::Block& block, const language::Command& command);

  // to_klartext_moves.cpp
  void move(const language::Block& block, const language::Move& move);
  void arc(const language::Block& block, const language::Move& move, bool clockwise);
  /// RND and CHR, at the end of the path in this block, which begins at `from`.
  void corner(const language::Block& block, std::span<const language::Word> words, const PlanePoint& from);
  /// Lists a corner that is larger than one of the two lines that it joins, and tells one that may be.
  void listTooLarge(const language::Block& block, Corner corner, const Quantity& size, const PlanePoint& from,
                    const PlanePoint& to);
  struct NextPath {
    std::optional<language::MoveKind> kind;     ///< nothing: as the active G function says
    bool hasFeed = false, compensates = false;  ///< F, or G40 to G42, stand before it or in its block
    PlanePoint to;                              ///< where it ends
  };
  /// Lists a block that a contour with radius compensation does not go on through as on a HEIDENHAIN control.
  void listCompensation(const language::Block& block);
  /// Lists, after G94 and G95, a path whose feed was programmed before them.
  void listFeedOfOtherKind(const language::Block& block, const language::Move& move);
  /// Lists a path in which radius compensation begins, ends or goes on in another way than on a HEIDENHAIN control.
  void listCompensatedPath(const language::Block& block, std::span<const language::Word> words);
  /// The next path, unless a label, a jump or a call comes before it in the text of the program.
  std::optional<NextPath> nextPath(const language::Block& block);
  /// D1 and the like stand in the block.
  bool callsEdge(const language::Block& block);
  std::string coordinate(const language::Block& block, const language::Word& word);
  /// A feed as Klartext counts it: in an INCH program in tenths of an inch a minute.
  Quantity feed(const language::Block& block, const language::Operand& operand) {
    return quantity(block, operand) * (millimetre_ == 1 ? 1 : 10);
  }
  std::string feedWord(const language::Block& block, const language::Operand& operand) {
    return " F" + formulas_.unsignedValue(feed(block, operand));
  }

  // to_klartext_cycles.cpp
  void cycle(const language::Block& block, const language::CallProgram& call);
  /// CYCLE150: whether the cycles that follow write a log.
  void measuringLog(const language::Block& block, const Call& call);
  Place here();
  /// Lists it if the probe does not look for the surface as far as the SINUMERIK cycle does; tells it, once, if it
  /// finds more.
  void requireReach(const language::Block& block, const MeasuringTask& task);
  /// Lists a plane of CYCLE800 with which the control refuses the touch probe cycle.
  void listTiltedPlane(const language::Block& block, int cycle);
  /// Writes the touch probe cycle that carries out the task; its number.
  std::string writeTask(const MeasuringTask& task);
  /// A corner that is measured only, which no touch probe cycle does: four times cycle 427.
  Results cornerByTouches(const MeasuringTask& corner);
  /// What the touch probe cycle has measured, as the SINUMERIK cycle counts it; `left`: where it leaves its results.
  std::optional<Quantity> measured(const MeasuringTask& task, const Results& left, Meaning meaning) const;
  /// n of the _OVR[n] that the program may read before another cycle measures.
  std::set<int> wantedAfter(const language::Block& block) const;
  void copyResults(const language::Block& block, const Results& left, const MeasuringTask& task);
  /// Corrects the tool by FN 17, if that depends on conditions or on both sides of a rectangle.
  void correctTool(const MeasuringTask& task, const Results& results);

  // to_klartext_safe_area.cpp
  /// S_TSA: what may deviate how far before the program stops.
  struct SafeArea {
    struct Watched {
      Meaning meaning;
      Quantity set;  ///< what counts is the difference from it
    };
    std::vector<Watched> watched;
    Quantity limit;
    Quantity turn;  ///< of the directions that deviations of a centre count along
  };
  /// A preset before a cycle that may correct it.
  struct PresetBefore {
    std::optional<Quantity> row;        ///< empty: none is corrected, or it cannot be restored
    std::array<std::string, 7> values;  ///< parameters, by the index of FN 18 ID507
  };
  std::optional<SafeArea> safeArea(const Call& call, const MeasuringTask& task) const;
  void rememberPreset(const language::Block& block, const MeasuringTask& task);
  /// Stops the program if a deviation is too large, with the preset as it was.
  void monitor(const language::Block& block, const SafeArea& safe, const MeasuringTask& task, const Results& results);
  /// The deviation of a centre along directions turned by `angle`.
  std::optional<Quantity> alongTurned(const MeasuringTask& task, const Results& results, Meaning meaning,
                                      const Quantity& angle) const;
  void restorePreset(const MeasuringTask& task);
  /// True if what the safe area watches would show only in how the preset changes, and `task` corrects a preset that
  /// may not be in effect: that one changes by more than the feature deviates.
  bool deviatesInActivePresetOnly(const SafeArea& safe, const MeasuringTask& task) const;
  /// A deviation that shows only in how the preset has changed.
  std::optional<Quantity> deviationOfPreset(const MeasuringTask& task, Meaning meaning);

  /// To where the SINUMERIK cycle leaves the probe.
  void goBack(const MeasuringTask& task, std::array<std::optional<Quantity>, 3> end);

  std::string axis(std::size_t index) const;
  std::optional<std::size_t> planeIndex(std::uint32_t address) const;
  Quantity quantity(const language::Block& block, const language::Operand& operand) {
    return formulas_.quantity(block, operand);
  }
  /// Writes the line after what its values need.
  void line(std::string text);
  /// The same for a block of several lines: nothing stands between them.
  void writeWhole(std::vector<std::string> lines);
  void forgetPosition() { position_ = {}; }

  language::sinumerik::SinumerikProgram& program_;
  control::ControlKind control_;
  Job job_;
  Output out_;
  KlartextFormulas formulas_;
  Quantity ballRadius_ = klartextBallRadius;
  Conversion result_;

  // What the whole program tells.
  std::optional<bool> withoutLength_ = false;  ///< D0 is in effect; empty: that depends on the way
  std::optional<bool> hasTool_ = false;  ///< a tool is in the spindle, or comes next; empty: that depends on the way
  bool movesBeforeUnit_ = false;         ///< something moves before the block that selects inches
  FlowGraph graph_;
  std::optional<RoundedValues> rounded_;
  std::map<std::uint64_t, std::string> labels_;  ///< by the block's offset, where jumps and repetitions lead to
  std::set<std::string> usedLabels_;
  std::map<std::string, int> nextNumberOfLabel_;                   ///< of a name that others have already
  std::map<std::uint64_t, std::vector<std::size_t>> sectionEnds_;  ///< by the offset of the last block: repetitions
  /// Sections that overlap are not subprograms: each repetition notes in a parameter that its section is under way.
  bool sectionsByNumber_ = false;
  std::map<std::size_t, std::string> backLabels_;
  std::set<int> usedResults_;                           ///< n of _OVR[n]
  std::map<std::uint64_t, std::set<int>> wantedAfter_;  ///< by the offset of each measuring cycle
  bool changesTool_ = false;                            ///< by M6
  std::string endLabel_;                                ///< where early returns jump to; empty: there are none
  std::vector<std::string> givenBack_;                  ///< blocks that end the program: arguments by reference
  double millimetre_ = 1;                               ///< in the unit of the program
  bool selectsMetric_ = false;                          ///< the last block that selects a unit selects millimetres
  Units units_;                                         ///< that the program selects
  std::map<std::string, Units> unitsOf_;                ///< that others of the job select, by their name in capitals
  bool unitDoubtful_ = false;                           ///< and not listed yet
  bool answersInOtherUnit_ = false;                     ///< touch probe cycles, to a program that is called
  TouchProbe probe_;

  std::map<std::uint64_t, Modes> entries_;  ///< by the offset of blocks that several ways lead to
  bool measuresAsCycles_ = false;  ///< measuring blocks stand for cycles 3 and 4, with what leads the probe back
  std::map<std::uint64_t, Beside> besides_;  ///< the same
  std::set<std::uint64_t> fromBeyondATurn_;  ///< offsets of positions of rotary axes
  std::array<bool, 3> shiftsEver_{};         ///< X, Y, Z
  bool feedsPerRevolution_ = false;          ///< G95 stands in the program or in another one of the job
  bool orientsSpindle_ = false;              ///< the same of SPOS

  // Where the text has come to.
  struct Frame {
    bool known = true;  ///< the shift
    std::array<Quantity, 3> shift{};
    std::optional<Quantity> rotation = Quantity();
  };
  Frame frame_;
  std::optional<bool> tilted_ = false;  ///< a plane of CYCLE800 is in effect
  bool incrementalDoubtful_ = false, motionDoubtful_ = false, compensationDoubtful_ = false, axisDoubtful_ = false,
       logDoubtful_ = false;
  PresetBefore before_;
  bool relied_ = false;  ///< listed for this block
  char toolAxis_ = 'Z';
  std::array<std::optional<Quantity>, 3> position_;  ///< of the tip: main, minor, tool axis
  language::MoveKind motion_ = language::MoveKind::Rapid;
  bool incremental_ = false;
  std::string compensation_ = "R0";
  std::string travelled_ = "R0";   ///< radius compensation of the last path
  bool travelledAtRapid_ = false;  ///< the last path was at rapid traverse
  bool perRevolution_ = false;     ///< G95 is in effect
  bool feedOfOtherKind_ = false;   ///< G94 or G95 came after the last F
  CornerRoom room_;
  std::string pendingTool_, tool_;  ///< to be changed to, in the spindle
  bool measuredWithTool_ = false;   ///< a cycle has measured with the tool in the spindle
  std::optional<int> activeRow_;
  std::set<int> selectedRows_;  ///< on every way to this block
  LackingRows lackingRows_;
  bool hasRowZero_ = false;    ///< the last zero offset is a copy of another
  bool rowZeroIsDue_ = false;  ///< so it was, but no cycle has done it yet
  bool copiesToRow0_ = false;  ///< the active zero offset was copied to the last one
  /// A cycle has left the probe elsewhere than the original one: along the main, minor and tool axis.
  std::array<bool, 3> beside_{};
  bool besideMeasured_ = false;  ///< a measuring block has left the probe elsewhere than the original one
  bool unturned_ = false;        ///< the zero offset has lost its rotation, as for cycle 400
  MeasuringTask::Log log_ = MeasuringTask::Log::None;  ///< as CYCLE150 has said

  struct Open {
    language::Structure kind;
    std::string begin = {}, end = {}, other = {};
    std::string counter = {};
    bool hasElse = false;
    bool lost = false;  ///< it could not be carried over, but what closes it is still to come
  };
  std::vector<Open> open_;
  std::set<std::string> changedGlobals_;
  std::set<std::uint8_t> skipLevels_;  ///< listed
  std::string swivelDataSet_;          ///< in capitals; empty: none is named yet
  double listedReach_ = 0;             ///< the longest that is listed
};

}  // namespace probewright::conversion
