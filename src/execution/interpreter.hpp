#pragma once

#include <bitset>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/alarm.hpp"
#include "execution/block_cache.hpp"
#include "execution/evaluation.hpp"
#include "execution/host.hpp"
#include "execution/names.hpp"
#include "language/program.hpp"

namespace probewright::execution {

struct InterpreterOptions {
  /// The run ends after so many blocks, which catches endless loops; what Host::takeWork tells of them counts,
  /// too. 0: never.
  std::uint64_t stepLimit = 50'000'000;
  /// Programs that may be open above each other, the main program included. HEIDENHAIN 20, SINUMERIK 16.
  int programDepth = 20;
  /// CALL LBL and REPEAT that may be under way in one program.
  int sectionDepth = 20;
  /// Asked to stop, the run ends before the next block; steps of the host that take long check it themselves and
  /// throws control::Cancelled.
  std::stop_token stop;
  /// Levels of "/" that are skipped; the plain "/" has level 0.
  std::bitset<10> skipLevels;
  /// Told every 4096 blocks how many have been carried out.
  std::function<void(std::uint64_t blocks)> onProgress;
  /// Told of each block that is about to be carried out.
  std::function<void(const Program& program, const Block& block)> onBlock;
};

enum class RunEnd {
  Finished,
  Alarm,          ///< the control would have stopped with an alarm
  BrokenProgram,  ///< a block that cannot be read
  Cancelled,
  StepLimit,
  RecordLimit,  ///< control::RecordFull: what the program leaves has become too much
};

struct RunResult {
  RunEnd end = RunEnd::Finished;
  /// Why the run ended, at the block where it happened, and for every call that was under way a note with its place.
  /// Empty if the program finished.
  Diagnostics diagnostics;
  std::uint64_t blocks = 0;  ///< carried out or skipped
};

/// Carries out programs, block by block.
///
/// A block is parsed when its turn comes and forgotten again; only blocks that are reached a second time are kept, a
/// bounded number of them. So memory stays flat over programs of any length and loops are not parsed again and again.
///
/// The instructions of a block are carried out in their order; whatever is not flow goes to the host. Flow:
/// - LBL, CALL LBL, LBL 0 (LabelMark, CallLabel): LBL 0 ends the subprogram that was called last, and means nothing if
///   none was. CALL LBL with REP jumps back so many times and then goes on; each such block counts for itself, a
///   subprogram's counts begin anew with every call, and a count of 0 or less jumps never. A part that is left by a
///   jump goes on counting when its CALL LBL is reached again.
/// - REPEAT, REPEATB (RepeatSection): the section is looked for backwards, then forwards. Without an end label it ends
///   with the block of the label ENDLABEL. If REPEAT is before the section's end, the section ends with
///   REPEAT. A jump out of the section ends its repetition.
/// - END PGM, M2, M30, M17, RET and the end of the file end the program, in a called one they return to the caller.
///   RET with a target (Return) goes on there instead of at the call: the label is looked for in the program that is
///   gone on with, first from the call to the end, then from the beginning; passes of the call that are still to come
///   are dropped. Without a target, but with a number of levels, only the passes of the programs between are dropped.
/// - MCALL (CallProgram::modal): the arguments are computed once, there; the call follows each block that the host says
///   drives it, before M0, M1, M17 and M30 of that block, but not inside of the program that is called this way.
/// - FOR counts up in steps of one and compares with its limit, which is computed anew each time; the variable keeps
///   the first value above the limit.
class Interpreter {
public:
  Interpreter(ProgramLibrary& library, Host& host, InterpreterOptions options = {});

  /// Runs `main` from its beginning. Alarms and everything else that ends a run come back as the result; Host::leave is
  /// called for every level that was entered. Exceptions that are not alarms pass through.
  RunResult run(std::shared_ptr<Program> main);

private:
  /// A program that was opened in this run.
  struct Loaded {
    std::shared_ptr<Program> program;
    std::uint64_t frontier = 0;  ///< blocks before this offset were reached before
    std::uint32_t id = 0;
  };

  struct Call {
    const Program* caller;
    std::string name;
    Loaded* called;  ///< null: no program has this name
  };

  /// A part program repeat that is under way.
  struct RepeatCount {
    std::uint64_t offset;
    double remaining;
  };

  /// MCALL as it was programmed, its arguments computed.
  struct ModalCall {
    Block block;
    int level = 0;  ///< of the called program while it is under way; 0: it is not
  };

  static constexpr std::uint64_t noSection = std::numeric_limits<std::uint64_t>::max();

  enum class FrameKind : std::uint8_t { Program, Label, Section };

  /// Where to go on after a program, a subprogram or a section.
  struct Frame {
    FrameKind kind = FrameKind::Program;
    Loaded* caller = nullptr;  ///< null: the main program
    BlockPosition call{};      ///< the block with the call
    BlockPosition next{};      ///< the one after it
    std::uint32_t instruction = 0;
    bool more = false;               ///< the block has instructions after the call
    double remaining = 0;            ///< passes that are still to come
    BlockPosition first{};           ///< Section
    std::uint64_t last = noSection;  ///< Section, or Program of which a section was called: offset of its last block
    std::size_t repeats = 0;         ///< counts in force below this frame
    int sections = 0;                ///< Program: labels and sections under way in the caller
  };

  enum class Flow { Next, Moved, Finished };
  struct Dispatch;

  void clear();
  RunResult runLoop();
  Flow carryOut(const Block& block, std::uint32_t first);
  void leaveAll();

  Flow jump(const Jump& jump, Evaluation& evaluation);
  Flow mark(const LabelMark& mark);
  Flow callLabel(const CallLabel& call, Evaluation& evaluation);
  Flow repeatPart(const CallLabel& call, Evaluation& evaluation);
  Flow repeatSection(const RepeatSection& repeat, Evaluation& evaluation);
  Flow callProgram(const CallProgram& call, const Instruction& instruction, Evaluation& evaluation);
  Flow followRequest(Evaluation& evaluation);
  void setModalCall(const CallProgram& call, Evaluation& evaluation);
  Flow callModally();
  Flow structured(const Structured& statement, Evaluation& evaluation);
  Flow endFor();
  Flow leaveProgram();
  Flow returnFrom(const Return& order, Evaluation& evaluation);
  Frame popProgram();
  bool isSkipped(const Block& block) const;
  [[nodiscard]] bool limitReached() const;

  ParsedBlock* fetch();
  ParsedBlock& fetchAside(BlockPosition position);
  bool parse(BlockPosition position, ParsedBlock& parsed);
  void advance(std::uint64_t offset, BlockPosition next);
  void nextPass();
  void goTo(BlockPosition position);
  void resume(const Frame& frame);
  void enter(Loaded& program, const CallProgram& call, Evaluation& caller, double remaining);
  std::pair<BlockPosition, std::uint64_t> sectionOf(Program& program, const CallProgram& call,
                                                    Evaluation& caller) const;
  void push(Frame frame);
  Frame pop();
  void watchSection();

  BlockPosition label(TextRef literal, const Operand& computed, JumpDirection direction, Evaluation& evaluation);
  BlockPosition sectionStart(const RepeatSection& repeat, Evaluation& evaluation);
  std::uint64_t sectionEnd(const RepeatSection& repeat, BlockPosition first, Evaluation& evaluation);
  BlockPosition counterpart();
  BlockPosition behindCounterpart();
  Loaded* load(std::shared_ptr<Program> program);
  /// The program of that name; null if there is none and that is fine.
  enum class Missing { Refused, Fine };
  Loaded* called(std::string_view name, Missing missing);
  [[noreturn]] void refuse(Refusal refusal, std::string text, std::string advice = {}) const;
  Diagnostic here(Severity severity, std::string message, std::string advice = {}, std::string code = {}) const;
  void relocate(Diagnostic& diagnostic, const control::AlarmPlace& place) const;
  Diagnostics explain(Diagnostic cause) const;

  ProgramLibrary& library_;
  Host& host_;
  InterpreterOptions options_;

  std::vector<std::unique_ptr<Loaded>> programs_;
  std::vector<Call> calls_;
  std::vector<Frame> frames_;
  std::vector<RepeatCount> repeats_;
  BlockCache cache_;
  ParsedBlock streamed_;
  Diagnostics mistakes_;

  Loaded* current_ = nullptr;
  ParsedBlock* block_ = nullptr;   ///< the one that is carried out
  BlockPosition position_;         ///< of the block to carry out next
  std::uint32_t resumeAt_ = 0;     ///< and the instruction to begin with
  std::uint32_t instruction_ = 0;  ///< the one that is carried out
  std::uint64_t sectionLast_ = 0;  ///< offset of the last block of the innermost section
  int sections_ = 0;               ///< labels and sections under way in the current program
  int levels_ = 0;                 ///< programs under way
  std::unique_ptr<ModalCall> modal_;
  std::uint64_t blocks_ = 0;
  std::uint64_t work_ = 0;  ///< Host::takeWork so far
};

}  // namespace probewright::execution
