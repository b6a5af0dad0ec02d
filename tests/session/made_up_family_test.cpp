#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "control/channel.hpp"
#include "cycles/result_kinds.hpp"
#include "execution/evaluation.hpp"
#include "machine/machine_file.hpp"
#include "session/check.hpp"
#include "session/run_parts.hpp"
#include "session/source.hpp"
#include "support/scripted_machine.hpp"

/// A third family of controls, made up: one control, a language with one word and one cycle, one table. It stands here
/// to show what a newcomer has to write, and to see that nobody asks which family it is.
namespace probewright::session {
namespace {

using control::ControlKind;
using language::Block;
using language::BlockPosition;
using testing::HasSubstr;
using testing_support::ScriptedMachine;

// ---- a newcomer adds an enumerator to each of these ----

constexpr auto pocket1 = static_cast<ControlKind>(3);
constexpr auto pocketLanguage = static_cast<ProgramLanguage>(3);

// ---- the language: text to instructions ----
//
//   GO X10 Z5     at rapid traverse
//   TOUCH X40     the cycle: from here towards X40, until the probe signals

class PocketProgram : public language::Program {
public:
  PocketProgram(std::string name, std::string text) : file_(std::move(name)) {
    std::istringstream lines(std::move(text));
    for (std::string line; std::getline(lines, line);)
      lines_.push_back(line);
  }
  const std::string& file() const override { return file_; }
  const std::string& name() const override { return file_; }
  BlockPosition begin() const override { return {}; }

  bool parse(BlockPosition position, Block& block, Diagnostics& diagnostics) override {
    block.clear();
    if (position.line > lines_.size()) return false;
    const std::string& line = lines_[position.line - 1];
    block.position = position;
    block.next = {position.offset + line.size() + 1, position.line + 1};
    block.source = block.add(line);
    std::istringstream words(line);
    std::string statement, word;
    if (!(words >> statement)) return true;
    language::WordRange range;
    while (words >> word) {
      const auto value = parseDecimal(std::string_view(word).substr(1));
      if (std::string_view("XYZ").find(word[0]) == std::string_view::npos || !value)
        return mistake(position, line, fmt::format("{} is not an axis with its position", word), diagnostics);
      block.words.push_back({.address = static_cast<std::uint32_t>(word[0]), .value = language::Operand::of(*value)});
      ++range.count;
    }
    if (statement == "GO") {
      block.instructions.emplace_back(language::Move{.kind = language::MoveKind::Rapid, .words = range});
    } else if (statement == "TOUCH") {
      block.instructions.emplace_back(language::CycleCall{.name = block.add("TOUCH"), .parameters = range});
    } else {
      return mistake(position, line, fmt::format("there is no statement {}", statement), diagnostics);
    }
    return true;
  }
  std::optional<BlockPosition> findLabel(std::string_view, BlockPosition, language::JumpDirection) override {
    return std::nullopt;
  }
  std::optional<BlockPosition> counterpart(BlockPosition) override { return std::nullopt; }

private:
  bool mistake(BlockPosition at, const std::string& line, std::string message, Diagnostics& diagnostics) const {
    diagnostics.push_back(
        {Severity::Error, {file_, at.line, 1}, std::move(message), line, "write GO or TOUCH with X, Y, Z", {}});
    return true;
  }
  std::string file_;
  std::vector<std::string> lines_;
};

// ---- the control: what it knows, and its cycle ----

struct PocketControl {
  explicit PocketControl(machine::Machine& machine) : channel(machine, journal) {}
  control::Journal journal;
  control::Channel channel;
  control::OperatorPanel panel{journal};
  double ballRadius = 0;
  double lastWall = 0;  ///< the control's only variable, in its only table
};

constexpr std::array<cycles::ResultDefinition, 1> touchResults = {{
    {"WALL", "wall", cycles::result::actual(cycles::of::coordinate).main()},
}};
const cycles::CycleDefinition touchDefinition = {.number = 1,
                                                 .name = "TOUCH",
                                                 .title = "TOUCH WALL",
                                                 .family = cycles::CycleFamily::Inspection,
                                                 .summary = "Measures where a wall is.",
                                                 .results = touchResults,
                                                 .controls = control::ControlSet::of(pocket1)};

void cycleTouch(PocketControl& control, const ProgramPlace& target) {
  const ProgramWay way = (target - control.channel.position()).normalized();
  control::CycleRecord opened;
  opened.name = touchDefinition.name;
  opened.title = touchDefinition.title;
  opened.place = control.panel.place;
  control.journal.begin(std::move(opened));
  const auto result = control.channel.measureTo(target, machine::Feed::at(300), machine::Sensor::TouchProbe);
  if (result.end != machine::MeasureEnd::Touched) throw control::Alarm("P1", "no wall", "measure further");
  const auto surface = partAt(control.channel.touchFrom(result).tip, control.ballRadius * way);
  control.lastWall = surface.vector().dot(way.vector().cwiseAbs());
  control::ResultRecord record;
  record.name = "WALL";
  record.value = control.lastWall;
  describe(record, touchResults[0]);
  control.journal.open()->results.push_back(record);
  control.journal.write({"POCKET.TAB", "WALL", "0", formatShortest(control.lastWall)});
  control.journal.cycleOpen = false;
}

// ---- what the control does with instructions ----

class PocketHost : public execution::Host {
public:
  explicit PocketHost(PocketControl& control) : control_(control) {}
  language::Value read(const language::VariableRef&, execution::Evaluation&) override { return {}; }
  void write(const language::VariableRef&, const language::Value&, execution::Evaluation&) override {}
  bool isDefined(const language::VariableRef&, execution::Evaluation&) override { return false; }
  language::Value call(std::string_view, std::span<const language::Value>) override { return {}; }
  bool beginBlock(const language::Program& program, const Block& block) override {
    control_.panel.place = {program.file(), block.position.line, 1};
    return true;
  }
  void enter(const language::Program&, const language::CallProgram*, execution::Evaluation*) override {}
  void leave(const language::Program&) override {}

  void execute(const language::Instruction& instruction, execution::Evaluation& evaluation) override {
    if (const auto* move = std::get_if<language::Move>(&instruction))
      control_.channel.moveTo(target(move->words, evaluation), machine::Feed::rapidTraverse());
    if (const auto* cycle = std::get_if<language::CycleCall>(&instruction))
      cycleTouch(control_, target(cycle->parameters, evaluation));
  }

private:
  ProgramPlace target(language::WordRange words, execution::Evaluation& evaluation) {
    ProgramPlace point = control_.channel.position();
    for (const language::Word& word : evaluation.words(words))
      point[static_cast<Eigen::Index>(word.address - 'X')] = evaluation.number(word.value);
    return point;
  }
  PocketControl& control_;
};

// ---- check, beliefs, run: the entry ----

Diagnostics checkPocket(const CheckRequest& request) {
  Diagnostics found;
  Block block;
  for (BlockPosition at = request.program.begin(); request.program.parse(at, block, found); at = block.next) {
  }
  return found;
}

ControlFamily pocketFamily();

void runPocket(const RunRequest& request, machine::Machine& machine, RunOutcome& outcome) {
  PocketControl control(machine);
  setPanel(control.panel, request, {"POCKET.TAB"});
  for (const control::BelievedTool& tool : request.beliefs.tools) {
    control.ballRadius = tool.radius;
    control.channel.toolVector = {0, 0, tool.length};
  }
  PocketHost host(control);
  const ControlFamily family = pocketFamily();
  const auto library = programLibrary(family);
  outcome.result = execution::Interpreter(*library, host, interpreterOptions(request.options)).run(request.program);
  outcome.files = control.panel.files();
  outcome.files["POCKET.TAB"] = fmt::format("WALL {}\n", formatShortest(control.lastWall));
  takeRecords(control, outcome);
}

RunOn preparePocket(const RunRequest& request, Diagnostics& diagnostics) {
  const Diagnostics mistakes = checkPocket({.program = *request.program});
  diagnostics.insert(diagnostics.end(), mistakes.begin(), mistakes.end());
  return
      [request](machine::Machine& machine, HostFiles&, RunOutcome& outcome) { runPocket(request, machine, outcome); };
}

ControlFamily pocketFamily() {
  ControlFamily family;
  family.name = "POCKET";
  family.controls = {{.kind = pocket1, .name = "Pocket1", .alsoCalled = {"Pocket2"}, .alsoUnderstood = {"pkt"}}};
  family.languages = {
      {.language = pocketLanguage,
       .name = "Pocket",
       .whose = "a POCKET",
       .endings = {".PKT"},
       .archiveEndings = {},
       .looksLike = [](const std::string& head) { return head.starts_with("GO ") || head.starts_with("TOUCH "); },
       .open = [](const std::filesystem::path& path) -> Result<std::shared_ptr<language::Program>> {
         return fail(SourcePlace{path.string(), 0, 0}, "a pocket has no files");
       },
       .fromText = [](std::string name, std::string text) -> std::shared_ptr<language::Program> {
         return std::make_shared<PocketProgram>(std::move(name), std::move(text));
       }}};
  family.calledEndings = {".PKT"};
  family.dialogLanguages = {control::DialogLanguage::English};
  family.cycles = [](ControlKind) { return std::vector<const cycles::CycleDefinition*>{&touchDefinition}; };
  family.cycleTemplate = [](const cycles::CycleDefinition& cycle, ControlKind, control::DialogLanguage) {
    return fmt::format("{} X0\n", cycle.name);
  };
  family.check = checkPocket;
  family.prepare = preparePocket;
  return family;
}

// ---- the families with the newcomer ----

const ControlFamilies& threeFamilies() {
  static const ControlFamilies families = [] {
    std::vector<ControlFamily> all(knownFamilies().all().begin(), knownFamilies().all().end());
    all.push_back(pocketFamily());
    return ControlFamilies(std::move(all));
  }();
  return families;
}

RunOptions options() {
  RunOptions chosen;
  chosen.families = &threeFamilies();
  return chosen;
}

control::Beliefs probeOfTwoMillimetres() {
  control::Beliefs beliefs;
  control::BelievedTool tool;
  tool.number = 1;
  tool.kind = "probe";
  tool.length = 100;
  tool.radius = 2;
  beliefs.tools.push_back(tool);
  return beliefs;
}

ScriptedMachine machineWithProbe() {
  ScriptedMachine machine(*machine::readMachine("mill3"));
  machine.changeTool({1, {}});
  return machine;
}

const std::string program = "GO X0 Y0 Z-400\nTOUCH X40\n";

TEST(MadeUpFamily, MeasuresAndLeavesItsTable) {
  ScriptedMachine machine = machineWithProbe();
  machine.signals = {ScriptedMachine::Signal{0, 25.5}};
  const control::Beliefs beliefs = probeOfTwoMillimetres();
  const RunOutcome outcome = runText("WALL.PKT", program, beliefs, machine, options());
  ASSERT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  EXPECT_EQ(outcome.info.control, "Pocket1");
  EXPECT_EQ(outcome.info.language, "Pocket");
  ASSERT_EQ(outcome.journal.cycles.size(), 1u);
  EXPECT_NEAR(outcome.journal.cycles[0].results.at(0).value, 27.5, 1e-9) << "the signal, and the ball radius";
  EXPECT_EQ(outcome.files.at("POCKET.TAB"), "WALL 27.5\n");
}

TEST(MadeUpFamily, EndsWithItsOwnAlarm) {
  ScriptedMachine machine = machineWithProbe();
  const control::Beliefs beliefs = probeOfTwoMillimetres();
  const RunOutcome outcome = runText("WALL.PKT", program, beliefs, machine, options());
  EXPECT_EQ(outcome.info.exit, records::ExitState::Stopped);
  EXPECT_EQ(outcome.info.exitText, "P1: no wall");
}

TEST(MadeUpFamily, IsCheckedBeforeAnythingMoves) {
  ScriptedMachine machine = machineWithProbe();
  const control::Beliefs beliefs = probeOfTwoMillimetres();
  const RunOutcome outcome = runText("WALL.PKT", "GO X0\nSCRATCH X4\n", beliefs, machine, options());
  EXPECT_EQ(outcome.info.exit, records::ExitState::InputMistake);
  EXPECT_EQ(outcome.info.exitText, "there is no statement SCRATCH");
  EXPECT_TRUE(machine.lines.empty());
  PocketProgram broken("WALL.PKT", "GO X0\nSCRATCH X4\n");
  EXPECT_EQ(checkProgram(broken, pocket1, threeFamilies()).size(), 1u);
}

TEST(MadeUpFamily, IsKnownByItsFilesItsTextAndItsNames) {
  const ControlFamilies& families = threeFamilies();
  EXPECT_EQ(languageOf("WALL.PKT", "", families), pocketLanguage);
  EXPECT_EQ(languageOf("WALL.TXT", program, families), pocketLanguage);
  EXPECT_EQ(*controlFor("WALL.PKT", program, {}, {}, families), pocket1);
  EXPECT_FALSE(controlFor("WALL.PKT", program, ControlKind::TNC640, {}, families));
  EXPECT_FALSE(controlFor("PART.H", "BEGIN PGM A MM\n", pocket1, {}, families));
  EXPECT_EQ(families.controlNamed("POCKET-1"), pocket1);
  EXPECT_EQ(families.controlNamed("pocket 2"), pocket1);
  EXPECT_EQ(families.controlNamed("pkt"), pocket1);
  EXPECT_EQ(families.controlNamed("828 D"), ControlKind::Sinumerik840Dsl);
  EXPECT_EQ(families.controlNamed("FANUC"), std::nullopt);
  EXPECT_THAT(families.controlNames(),
              testing::ElementsAre("TNC640", "iTNC530", "840Dsl", "828D", "Pocket1", "Pocket2"));
  EXPECT_EQ(families.of(pocket1).cycles(pocket1).at(0)->name, "TOUCH");
}

TEST(MadeUpFamily, IsNamedWhereUsersChoose) {
  const auto wrong = controlFor("WALL.PKT", program, {}, ControlKind::TNC640, threeFamilies());
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message, "this is a Pocket program, but the setup's control is TNC640");
  EXPECT_EQ(wrong.error().advice, "name a setup whose [control] type is Pocket1 or Pocket2, or has none");
  const auto foreign = controlFor("A.NGC", "G21\nG38.2 X10\n", {}, {}, threeFamilies());
  ASSERT_FALSE(foreign);
  EXPECT_THAT(foreign.error().advice, HasSubstr("HEIDENHAIN (.H, .I), SINUMERIK (.MPF, .SPF) and POCKET (.PKT)"));
  const auto nobody = controlFor("A.TXT", "hello\n", {}, {}, threeFamilies());
  ASSERT_FALSE(nobody);
  EXPECT_EQ(nobody.error().advice, "name it with --control TNC640, iTNC530, 840Dsl or Pocket1");
  EXPECT_EQ(endingsOf(threeFamilies()), ".H, .I, .MPF or .PKT");
  EXPECT_EQ(endingsWithLanguages(threeFamilies()),
            ".H for Klartext, .I for DIN/ISO, .MPF for a SINUMERIK or .PKT for a POCKET");
  const ControlFamily& pocket = threeFamilies().of(pocket1);
  EXPECT_EQ(pocket.cycleTemplate(touchDefinition, pocket1, control::DialogLanguage::English), "TOUCH X0\n");
}

TEST(MadeUpFamily, RefusesModesAndLanguagesThatItDoesNotHave) {
  ScriptedMachine machine = machineWithProbe();
  const control::Beliefs beliefs = probeOfTwoMillimetres();
  RunOptions chosen = options();
  chosen.mode = ProgramMode::DryRun;
  EXPECT_EQ(runText("WALL.PKT", program, beliefs, machine, chosen).info.exit, records::ExitState::InputMistake);
  chosen = options();
  chosen.language = control::DialogLanguage::Polish;
  EXPECT_EQ(runText("WALL.PKT", program, beliefs, machine, chosen).info.exitText,
            "POCKET controls have no dialog language pl");
  EXPECT_TRUE(machine.lines.empty());
}

/// The other two are what they are without it.
TEST(MadeUpFamily, LeavesTheOthersAlone) {
  struct Sample {
    const char *file, *text;
    ControlKind control;
  };
  for (const Sample& sample : {Sample{"A.TXT", "BEGIN PGM A MM\n", ControlKind::TNC640},
                               {"A.I", "%A G71 *\n", ControlKind::TNC640},
                               {"A.TXT", "N10 G54 G90\nN20 CYCLE977(1,2)\n", ControlKind::Sinumerik840Dsl}}) {
    EXPECT_EQ(*controlFor(sample.file, sample.text, {}, {}), sample.control) << sample.file;
    EXPECT_EQ(*controlFor(sample.file, sample.text, {}, {}, threeFamilies()), sample.control) << sample.file;
  }
}

}  // namespace
}  // namespace probewright::session
