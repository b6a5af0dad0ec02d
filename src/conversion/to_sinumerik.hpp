#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "conversion/call.hpp"
#include "conversion/conversion.hpp"
#include "conversion/corner_room.hpp"
#include "conversion/flow_graph.hpp"
#include "conversion/lacking_rows.hpp"
#include "conversion/output.hpp"
#include "conversion/rotary_turns.hpp"
#include "conversion/sinumerik_formulas.hpp"
#include "conversion/sinumerik_tasks.hpp"

/// Writes a HEIDENHAIN program in the language of a SINUMERIK, block by block.
namespace probewright::conversion {

/// The call as text: each parameter at its place.
std::string callText(const Call& call);

class ToSinumerik {
public:
  ToSinumerik(language::klartext::HeidenhainProgram& program, const Job* job, const TouchProbe& probe);
  Conversion run();

private:
  // to_sinumerik.cpp: the program and its flow
  void survey();
  void surveyRows(const language::Block& block);
  /// A block of another program of the job.
  void surveyOther(const language::Block& block);
  void surveyCentre(const language::Block& block, const language::Move& move);
  void write(const language::Block& block);
  std::vector<std::string> head() const;
  void comment(const language::Block& block);
  void instruction(const language::Block& block, const language::Instruction& instruction);
  void toolCall(const language::Block& block, const language::ToolCall& call);
  void machineFunction(const language::Block& block, const language::MachineFunction& function);
  void command(const language::Block& block, const language::Command& command);
  /// Leaves out, with a note, what changes neither where the tool goes nor what is measured.
  bool leavesOut(const language::Block& block, const language::Command& command);
  /// $TC_DPx of what FN 17 and FN 18 know as number `number` of ID 50, in the tool's first edge.
  std::string toolDatum(const Quantity& number, const Quantity& tool) const;
  void blank(std::string_view text);

  // to_sinumerik_flow.cpp
  void surveyFlow();
  void jump(const language::Block& block, const language::Jump& jump);
  void mark(const language::Block& block, const language::LabelMark& mark);
  void callLabel(const language::Block& block, const language::CallLabel& call);
  void callProgram(const language::Block& block, const language::CallProgram& call);
  /// The G function of the unit of this program.
  std::string_view unitWord() const;
  /// Of a program of the job, by its name in capitals; nothing if it was not found.
  std::optional<language::klartext::Unit> unitOf(std::string_view name) const;
  /// Whether a main program of the other unit may call this one: on a HEIDENHAIN control results of cycles count in it.
  bool cyclesAnswerInOtherUnit() const;
  /// LBL 0 of a program that keeps its own stack of calls.
  void goBack();
  std::string labelName(std::string_view label);

  // to_sinumerik_frames.cpp
  struct Frame {
    bool known = true;  ///< the shift
    std::array<Quantity, 3> shift{};
    std::optional<Quantity> rotation = Quantity();
    bool isNone() const;
  };
  void transform(const language::Block& block, const language::Transform& transform);
  void writeFrame(const Frame& frame);
  /// What TOOL CALL has brought into the spindle.
  enum class Spindle : std::uint8_t { Empty, Tool, Unset };
  /// Empty where only the running program knows it.
  static std::optional<Spindle> calledBy(const language::Block& block, const language::ToolCall& call);
  struct Plane {
    bool isTilted = false;           ///< by PLANE SPATIAL, until PLANE RESET; so it is with angles of 0
    std::array<double, 3> angles{};  ///< SPA, SPB, SPC
    bool operator==(const Plane&) const = default;
  };
  /// What is in effect and stays so until a block changes it; empty where it depends on the way that led there.
  struct Modes {
    std::optional<char> toolAxis = 'Z';
    std::optional<Spindle> spindle;
    std::optional<std::array<double, 3>> shift = std::array<double, 3>{};  ///< X, Y, Z
    std::optional<double> rotation = 0;
    std::optional<Plane> plane = Plane();
    std::optional<language::RadiusCompensation> compensation = language::RadiusCompensation::Off;
    std::optional<int> row;
    std::set<int> selected;  ///< rows that cycle 247 has selected: the preset table has them
    bool operator==(const Modes&) const = default;
  };
  void surveyModes();
  /// Where the probe may stand beside its path, on one of the ways to a block at least.
  void surveyPlaces();
  static void follow(const language::Block& block, Modes& modes);
  static bool agree(Modes& with, const Modes& other);
  /// Takes over what all ways to this block agree on.
  void adopt(const language::Block& block);
  void requireAxis() const;

  // planes.cpp
  void plane(const language::Block& block, const language::Transform& transform);
  /// What is in effect after a PLANE block; empty if only the running program knows its angles.
  static std::optional<Plane> planeAfter(const language::Block& block, const language::Transform& transform);
  /// A way in the tilted plane, counted along the axes of the zero offset: main, minor and tool axis.
  std::array<Quantity, 3> untilted(const std::array<Quantity, 3>& way) const;

  // single_touches.cpp
  void singleTouch(const language::Block& block, const language::CycleCall& cycle, const Call& call);

  // rotary_axes.cpp
  /// The rotary axis about the tool axis.
  std::string tableAxis() const;
  void alignRotaryAxis(const language::Block& block, const Call& call);

  // tool_measuring.cpp
  void toolMeasurement(const language::Block& block, const Call& call);

  // hole_patterns.cpp
  /// Two variables of the converter's own: where a centre was found.
  using Centre = std::array<std::string, 2>;
  /// Returns where the running program finds the centre, in coordinates from before the correction.
  Place holePattern(const language::Block& block, const MeasuringTask& pattern, const std::string& heidenhainCycle);
  Centre holeByStrokes(int number, const Place& place, const Quantity& clearance);
  Centre spigotCentre(const language::Block& block, int number, const MeasuringTask& pair);
  void turnByPair(const MeasuringTask& pair, const std::vector<Centre>& centres);
  void judgePattern(const language::Block& block, const MeasuringTask& pattern, const Centre& centre,
                    const std::string& diameter);

  // to_sinumerik_moves.cpp
  void move(const language::Block& block, const language::Move& move);
  void setCentre(const language::Block& block, const language::Move& move);
  /// The cutting edge is in effect again, if there is a tool.
  void callEdgeAgain();
  void moveOnMachine(const language::Block& block, const language::Move& move);
  std::string axisWords(const language::Block& block, const language::Move& move);
  std::string centreWords() const;
  /// Loses words of a path block that a SINUMERIK does not have.
  void loseWords(const language::Block& block, const language::Move& move);
  /// In inches a minute where a HEIDENHAIN control counts in tenths of that.
  Quantity asFeed(const Quantity& programmed) const {
    return programmed * (program_.unit() == language::klartext::Unit::Inch ? 0.1 : 1);
  }
  Quantity feed(const language::Block& block, const language::Operand& operand) {
    return asFeed(quantity(block, operand));
  }
  std::string feedWord(const language::Block& block, const language::Move& move);

  // to_sinumerik_contour.cpp: radius compensation, roundings and chamfers
  static void followCompensation(const language::Instruction& instruction,
                                 std::optional<language::RadiusCompensation>& compensation);
  /// Lists where radius compensation begins or ends in another way than on a SINUMERIK.
  void listCompensation(const language::Block& block, const language::Instruction& instruction);
  /// Adds RND= or CHR= to the path block that the corner belongs to.
  void corner(const language::Block& block, const language::Move& move);
  std::string cornerWord(const language::Block& block, const language::Move& move, const Quantity& size);
  /// Where the path of a later block ends that begins here.
  PlanePoint endOf(const language::Block& block, const language::Move& move) const;
  /// The path block that comes next, if only a comment lies between; else nothing.
  struct NextPath {
    bool rapid = false, arc = false, hasFeed = false, compensates = false;
    PlanePoint to;  ///< where it ends
  };
  std::optional<NextPath> nextPath(const language::Block& block);
  /// The block names coordinates of the working plane.
  bool movesInPlane(const language::Block& block, const language::Move& move) const;
  /// Lists, after M136 and M137, a path whose feed was programmed before them.
  void listFeedOfOtherKind(const language::Block& block, const language::Move& move);
  void wherePolar(const language::Block& block, const language::Move& move, Place& target);

  // to_sinumerik_cycles.cpp
  void cycle(const language::Block& block, const language::CycleCall& call);
  /// Returns where the running program finds the feature, in coordinates from before the correction.
  Place task(const language::Block& block, const MeasuringTask& task, const std::string& heidenhainCycle);
  /// The point of Q382, Q383 counts from the origin that was in effect before `preset` has moved it.
  void countFromNewOrigin(const MeasuringTask& preset, const Place& found, MeasuringTask& touch);
  /// Lists a frame of the program that the cycle does not run under on its own control.
  void listForbiddenFrame(const language::Block& block, int cycle);
  /// Lists, once, that the SINUMERIK cycle does not look for the surface as far as the touch probe does.
  void requireReach(const language::Block& block, const MeasuringTask& task, const SinumerikPassage& passage);
  void approach(const Place& start, const Quantity& clearance);
  /// By the first size, where the cycle does not do it.
  void correctTool(const MeasuringTask& task, const SinumerikPassage& passage);
  /// Shifts the origin so that what lies at `now` gets the coordinates of the wish; `measured`: in the coordinates that
  /// are in effect.
  void shiftOrigin(const language::Block& block, const MeasuringTask& task, const Place& now,
                   SinumerikPassage::Rest from);
  void shiftToWish(const language::Block& block, const MeasuringTask& task, SinumerikPassage::Rest rest);
  /// Where the cycle of the passage leaves what it measures, counted as a HEIDENHAIN control does.
  static Results resultsOf(const MeasuringTask& task, const SinumerikPassage& passage);
  void copyResults(const language::Block& block, const std::string& heidenhainCycle, const MeasuringTask& task,
                   const SinumerikPassage& passage);
  void planeByTouches(const language::Block& block, const MeasuringTask& plane);
  void takeRotationOut(const MeasuringTask& task);
  /// The rotation of a zero offset about the tool axis; without `row` of the one in effect.
  void setRotation(const std::optional<Quantity>& row, const Quantity& angle);
  void basicRotation(const language::Block& block, const Call& call);
  /// Lists that the cycle corrects a row after another one has set row 0 (Q305 = 0): a TNC 640 goes on in row 0, an
  /// iTNC 530 in the row that was in effect.
  void listRowAfterZero(const language::Block& block, const Quantity& row);
  /// The row that cycle 247 selects in the block, if it stands there as a number.
  static std::optional<int> selectedRow(const language::Block& block);
  /// Lists, once a row, that the cycle writes a row which the preset table may lack and a later block selects: a
  /// control adds it as a copy of the preset in effect, a settable zero offset keeps its own values.
  void listLackingRow(const language::Block& block, const Quantity& row);
  /// Row 0, the preset that a cycle sets at once; here the last settable zero offset, a copy of the active one.
  void takeRowZero();
  /// What row 0 stands for in a call.
  enum class RowZero : std::uint8_t {
    Preset,    ///< the preset that a cycle sets at once, as takeRowZero() has it
    InEffect,  ///< the row in effect
  };
  /// The number of the zero offset for a row that only the running program knows; negative rows are the one in effect.
  Quantity runningRow(const Quantity& row, RowZero zero);
  /// Writes a component of a zero offset, "Z,RT", and selects it again if it is in effect; without `row` that of the
  /// one in effect. `value` makes the new one of the text of the present one.
  void setComponent(const std::optional<Quantity>& row, const std::string& component,
                    const std::function<std::string(const std::string&)>& value);
  /// Selects the zero offset that is in effect again, so that what was written to it acts.
  void selectAgain();
  void judge(const language::Block& block, const MeasuringTask& task, const SinumerikPassage& passage);
  /// The condition, if one of the values is not 0.
  static std::string onlyUnlessZero(const std::vector<Quantity>& values, const std::string& condition);
  /// Whether the deviation of a centre exceeds its tolerance; one of 0 is none.
  static std::string exceedsCentre(const std::string& deviation, const Quantity& tolerance);
  /// Sets Q180 to Q182 by conditions, and stops or tells, if that is asked for.
  void decide(const std::vector<std::string>& rework, const std::vector<std::string>& scrap, bool stops, bool tells);
  std::string parameter(int number);
  /// Results of the cycle that the program reads, but for the status.
  std::set<int> readResults(const std::string& heidenhainCycle) const;
  Call callOf(const language::Block& block, const language::CycleCall& call);
  void globalDefinition(const language::Block& block, const language::Command& command);

  /// "X", the axis of the plane's main (0), minor (1) or tool axis (2).
  std::string axis(std::size_t index) const;
  Quantity quantity(const language::Block& block, const language::Operand& operand) {
    return formulas_.quantity(block, operand);
  }
  std::optional<std::size_t> planeIndex(std::uint32_t address) const;
  void forgetPosition() { position_ = {}; }

  language::klartext::HeidenhainProgram& program_;
  Job job_;
  Output out_;
  SinumerikFormulas formulas_;
  FlowGraph graph_;
  double millimetre_ = 1;  ///< in the unit of the program
  TouchProbe probe_;
  Quantity ballRadius_ = sinumerikBallRadius;
  Conversion result_;

  // What the whole program tells.
  std::set<std::string> calledLabels_;  ///< as subprograms
  std::map<std::string, std::string, std::less<>> labelNames_;
  std::set<int> usedQ_;
  bool selectsRow0_ = false;  ///< a cycle of the job sets or selects row 0 of the preset table
  bool cyclesSetRow0_ = false;
  bool listedRow99_ = false;
  bool compensates_ = false;
  bool callsTools_ = false;
  bool othersFeedPerRevolution_ = false, othersCompensate_ = false;  ///< other programs of the job
  bool sharesText_ = false;                                          ///< it is listed that texts are not shared
  /// Subprograms that return early, or that jumps lead into or out of, are not sections: the program keeps a stack of
  /// its calls.
  bool keepsStack_ = false;
  std::map<std::uint64_t, std::size_t> returnsOf_;  ///< number of each call, by the block's offset
  std::map<std::uint64_t, std::size_t> countsOf_;   ///< count of each repetition, the same
  std::vector<std::string> callStack_;              ///< its definitions
  std::map<std::uint64_t, Modes> entries_;          ///< by the offset of blocks that several ways lead to
  std::map<std::uint64_t, bool> besides_;           ///< the same: besidePath_
  std::set<std::uint64_t> fromBeyondATurn_;         ///< offsets of positions of rotary axes

  // Where the text has come to.
  char toolAxis_ = 'Z';
  std::optional<Spindle> spindle_;
  std::array<std::optional<Quantity>, 3> position_;  ///< of the tip; as the SINUMERIK program drives
  std::array<std::optional<Quantity>, 2> centre_;
  std::optional<std::array<std::optional<double>, 2>> surveyedCentre_;
  bool oneCentre_ = true;    ///< every CC of the program names the same point: it is known after labels too
  bool besidePath_ = false;  ///< the probe stands where the original program did not leave it
  int arcDirection_ = 0;
  std::vector<std::string> openLabels_;
  std::map<int, Quantity> global_;  ///< GLOBAL DEF values by Q number
  Frame frame_;
  std::optional<Plane> plane_ = Plane();
  bool axisDoubtful_ = false;
  std::optional<int> activeRow_;
  std::set<int> selectedRows_;  ///< on every way to this block
  LackingRows lackingRows_;
  bool ended_ = false;
  bool listedReach_ = false;
  std::optional<std::array<double, 3>> blank_;  ///< X, Y, Z of BLK FORM 0.1
  std::string orientation_;                     ///< of the spindle by M19 and M20: what cycle 13 has said last
  std::size_t lastMove_ = 0;                    ///< line of the last motion, plus 1
  struct LastPath {
    language::BlockPosition next{};
    bool rapid = false, arc = false, inPlane = false, skippable = false;
    PlanePoint from;
  };
  LastPath lastPath_;  ///< of the block that `lastMove_` comes of
  CornerRoom room_;
  std::optional<language::RadiusCompensation> compensation_ = language::RadiusCompensation::Off;
  bool feedOfOtherKind_ = false;  ///< M136 or M137 came after the last F
};

}  // namespace probewright::conversion
