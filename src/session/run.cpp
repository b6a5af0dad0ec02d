#include "session/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/file.hpp"
#include "base/folder_swap.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/text.hpp"
#include "execution/din_iso/host.hpp"
#include "execution/klartext/host.hpp"
#include "execution/sinumerik/host.hpp"
#include "language/directory_library.hpp"
#include "language/encoding.hpp"
#include "language/sinumerik/program.hpp"
#include "records/results.hpp"
#include "session/beliefs.hpp"
#include "session/check.hpp"
#include "session/global_data.hpp"
#include "session/host_files.hpp"
#include "session/remanent_parameters.hpp"
#include "session/source.hpp"
#include "session/standing_machine.hpp"
#include "simulation/cad_solid.hpp"
#include "simulation/mesh_solid.hpp"

namespace probewright::session {

namespace fs = std::filesystem;
namespace hh = control::heidenhain;
namespace sin = control::sinumerik;
using control::ControlKind;
using language::RunEnd;
using records::ExitState;

namespace {

language::InterpreterOptions interpreterOptions(const RunOptions& options, ControlKind kind) {
  language::InterpreterOptions interpreter;
  interpreter.stepLimit = options.stepLimit;
  interpreter.stop = options.stop;
  interpreter.skipLevels = options.skipLevels;
  interpreter.breakpoints = options.breakpoints;
  interpreter.onProgress = options.progress;
  if (!control::isHeidenhain(kind)) interpreter.programDepth = sinumerik::SinumerikHost::programDepth;
  return interpreter;
}

/// Sets what the panel shows, asks and stops at. The panel must not outlive `options` and `setup`.
void setPanel(control::OperatorPanel& panel, const simulation::Setup& setup, const RunOptions& options) {
  panel.onStop = options.onStop;
  panel.ask = options.ask;
  panel.answer = [&](const control::Question& question) -> std::optional<std::string> {
    for (const auto* known : {&options.answers, &setup.answers}) {
      if (const auto found = known->find(question.name); found != known->end()) return found->second;
    }
    return options.answer ? options.answer(question) : std::nullopt;
  };
  panel.language = options.language;
  panel.showAllResults = options.showAllResults;
}

/// What the control writes text files in: the TNC 640 in UTF-8, the iTNC 530 in the 8-bit character set of its
/// language.
language::Encoding textFileEncoding(ControlKind kind, control::DialogLanguage language) {
  if (kind != ControlKind::iTNC530) return language::Encoding::Utf8;
  return language == control::DialogLanguage::Russian ? language::Encoding::Windows1251
                                                      : language::Encoding::Windows1252;
}

void encodeLogs(std::map<std::string, std::string>& files, language::Encoding encoding) {
  for (auto& [name, text] : files) {
    if (name.starts_with("TCHPR") && name.ends_with(".TXT")) text = language::fromUtf8(text, encoding);
  }
}

/// The tables that every run of a HEIDENHAIN control leaves.
std::set<std::string> namesOf(const hh::Tables& tables) {
  std::set<std::string> names = {"TOOL.T", "TCHPROBE.TP", "PRESET.PR", "QR.TXT"};
  for (const auto& [name, table] : tables.datums)
    names.insert(name);
  for (const auto& [name, table] : tables.deflections)
    names.insert(name);
  for (const auto* table : {&tables.turningTools, &tables.axisShifts}) {
    if (*table) names.insert((*table)->table().name());
  }
  return names;
}

/// A run must be able to leave its tables: better said before it begins than at its end.
void refuseForeign(RunOutcome& outcome, const std::set<std::string>& tables, const RunOptions& options) {
  if (!options.whyNoFile) return;
  for (const std::string& name : tables) {
    if (auto why = options.whyNoFile(name)) outcome.diagnostics.push_back(std::move(*why));
  }
}

/// What names a program cannot give to its files: those that every run leaves, and whatever the caller refuses.
std::function<std::optional<Diagnostic>(const std::string&)> fileRule(std::set<std::string> tables,
                                                                      const RunOptions& options) {
  return [tables = std::move(tables), &options](const std::string& name) -> std::optional<Diagnostic> {
    const std::string upper = sin::upperCase(name);
    if (tables.contains(upper) || upper == "RESULTS.JSON" || upper == "REPORT.HTML" ||
        upper.starts_with(".PROBEWRIGHT")) {
      return Diagnostic{Severity::Error,        {}, "it is one of the files that every run leaves", {},
                        "give it another name", {}};
    }
    return options.whyNoFile ? options.whyNoFile(name) : std::nullopt;
  };
}

void runHeidenhain(RunOutcome& outcome, const std::shared_ptr<language::Program>& program, const fs::path& path,
                   const simulation::Setup& setup, HostFiles& host, const RunOptions& options, FolderReading reading) {
  hh::Tables tables = heidenhainTables(setup, outcome.control, outcome.diagnostics);
  const hh::MachineParameters parameters = machineParameters(setup, outcome.control, outcome.diagnostics);
  const std::set<std::string> tableNames = namesOf(tables);
  refuseForeign(outcome, tableNames, options);
  if (hasErrors(outcome.diagnostics)) return;
  hh::Control control(outcome.control, *outcome.machine, std::move(tables), parameters);
  setPanel(control.panel, setup, options);
  control.panel.whyNoFile = fileRule(tableNames, options);
  control.journal.limit = options.recordLimit;
  control.programPath = path.string();
  control.startSeconds = control.channel.seconds();
  control.wallClockStart = options.wallClock;
  control.activatePreset(activePresetRow(setup));
  const auto probe = std::ranges::find(setup.tools, "probe", &simulation::BelievedTool::kind);
  if (probe != setup.tools.end()) control.handProbe = {probe->number, probe->name};
  for (const auto& tool : setup.tools) {
    if (tool.inSpindle) control.callTool(std::to_string(tool.number), 'Z', 0, 0, 0);
  }
  control.applyCoordinates();

  readRemanentParameters(setup.tables, control.q, outcome.diagnostics);
  reading = {};
  if (hasErrors(outcome.diagnostics)) return;
  language::klartext::HostOptions hostOptions;
  hostOptions.strict = options.strict;
  hostOptions.readFile = [&host](const std::string& name) { return host.read(name); };
  hostOptions.isInput = [&host](const std::string& name) { return host.isInput(name); };
  language::klartext::KlartextHost klartext(control, hostOptions);
  language::din_iso::DinIsoHost isoHost(klartext);
  const auto library = programLibrary(outcome.control, {}, nullptr, [&](const fs::path& opened) { host.note(opened); });
  language::Interpreter interpreter(*library, isoHost, interpreterOptions(options, outcome.control));
  outcome.result = interpreter.run(program);

  outcome.files = control.panel.files();
  encodeLogs(outcome.files, textFileEncoding(outcome.control, options.language));
  outcome.files["TOOL.T"] = control.tables.tools.table().bytes();
  outcome.files["TCHPROBE.TP"] = control.tables.probes.table().bytes();
  outcome.files["PRESET.PR"] = control.tables.presets.table().bytes();
  for (const auto& [name, table] : control.tables.datums)
    outcome.files[name] = table.table().bytes();
  for (const auto& [name, table] : control.tables.deflections)
    outcome.files[name] = table.table().bytes();
  if (std::string remanent = remanentParametersText(control.q); !remanent.empty())
    outcome.files[remanentFile] = std::move(remanent);
  // Tables that few machines have come out if there is anything in them.
  for (const auto* table : {&control.tables.turningTools, &control.tables.axisShifts}) {
    if (*table && !(*table)->table().keys().empty())
      outcome.files[(*table)->table().name()] = (*table)->table().bytes();
  }
  outcome.machineFromWorkpiece = control.coordinates.machineFromPreset();
  outcome.ballRadius = control.tool.radius;
  outcome.qParameters = control.q;
  outcome.info.inches = control.mainUnit != 1;
  outcome.info.totalPathLength = control.channel.pathLength();
  outcome.info.totalSeconds = control.channel.seconds();
  outcome.journal = std::move(control.journal);
}

/// The SINUMERIK control's data as initialization texts: the files that were read, or one for tools, frames and the
/// rest. Global user data that no file mentions go into the first *.GUD, or into one of their own.
void addDataFiles(RunOutcome& outcome, const SinumerikData& data, const sin::DataStore& store) {
  const auto keep = [&](const std::string& name, Result<std::string> text) {
    if (text) {
      outcome.files[name] = std::move(*text);
    } else {
      outcome.diagnostics.push_back(text.error());
    }
  };
  const auto written = [&](const char* name, const sin::InitText::Accepts& accepts) {
    sin::DataStore nothing;
    Diagnostics none;
    keep(name, sin::InitText::parse("M17\n", name, nothing, none).updated(store, accepts));
  };
  const auto isUserData = [](const sin::DataKey& key) { return !key.name.starts_with('$') && key.name != "R"; };
  std::set<sin::DataKey> inFiles;
  for (const SinumerikData::File& file : data.files)
    inFiles.merge(file.text.keys());
  const auto mentioned = [&](const sin::DataKey& key) { return inFiles.contains(key); };
  const std::vector<sin::DataKey> keys = store.keys();
  const bool newUserData =
      std::ranges::any_of(keys, [&](const sin::DataKey& key) { return isUserData(key) && !mentioned(key); });
  const auto holdsUserData = [](const SinumerikData::File& file) {
    return sin::upperCase(file.name).ends_with(".GUD");
  };
  const auto userFile = std::ranges::find_if(data.files, holdsUserData);
  const auto otherFile = std::ranges::find_if_not(data.files, holdsUserData);
  for (auto file = data.files.begin(); file != data.files.end(); ++file) {
    keep(file->name, file->text.updated(store, [&](const sin::DataKey& key) {
      return !mentioned(key) && file == (isUserData(key) ? userFile : otherFile);
    }));
  }
  if (newUserData && userFile == data.files.end())
    written("USER.GUD", [&](const sin::DataKey& key) { return isUserData(key) && !mentioned(key); });
  if (otherFile != data.files.end()) return;
  const auto isTool = [](const sin::DataKey& key) { return key.name.starts_with("$TC_"); };
  const auto isFrame = [](const sin::DataKey& key) { return sin::isFrameName(key.name); };
  written("TOOLS.TOA", [&](const sin::DataKey& key) { return isTool(key) && !mentioned(key); });
  written("FRAMES.UFR", [&](const sin::DataKey& key) { return isFrame(key) && !mentioned(key); });
  written("DATA.INI", [&](const sin::DataKey& key) {
    return !isTool(key) && !isFrame(key) && !isUserData(key) && !mentioned(key);
  });
}

/// The definition files of the folder of tables, as they are, so that what the run leaves can be the tables of the
/// next.
std::map<std::string, std::string> definitionFiles(const fs::path& tables) {
  std::map<std::string, std::string> files;
  if (tables.empty()) return files;
  std::error_code error;
  for (fs::directory_iterator entry(tables, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (sinumerik::definitionFileName(name).empty() || !entry->is_regular_file(error)) continue;
    if (Result<std::string> text = readFile(entry->path())) files[name] = std::move(*text);
  }
  return files;
}

/// After a block search the machine catches up: tool, spindle, M functions, then straight to where the program stands.
void goOnMoving(StandingMachine& machine, sin::Control& control) {
  const machine::AxisPositions target = machine.position();
  const StandingOrders orders = machine.orders();
  machine.release();
  if (orders.tool) control.channel.changeTool(*orders.tool);
  if (orders.angle) machine.orientSpindle(*orders.angle);
  if (orders.rotation) control.channel.turnSpindle(orders.rotation->rotation, orders.rotation->speed);
  for (const int number : orders.functions)
    control.channel.function(number);
  control.channel.moveAxes(target, machine::Feed::rapidTraverse());
}

/// Runs the program `name`, if there is one; see sinumerik::HostOptions::callProgram.
bool callAside(language::ProgramLibrary& library, language::Host& host, language::InterpreterOptions options,
               std::string_view name, const language::Program* caller) {
  if (!library.exists(name, caller)) return false;
  const auto opened = library.open(name, caller);
  if (!opened) throw control::Alarm("14011", opened.error().message, opened.error().advice);
  const language::RunResult result = language::Interpreter(library, host, std::move(options)).run(*opened);
  if (result.end == RunEnd::Finished) return true;
  if (result.end == RunEnd::Cancelled || result.end == RunEnd::Halted) throw control::Cancelled();
  const Diagnostic& why = result.diagnostics.front();
  control::Alarm alarm(why.code, why.message, why.advice);
  alarm.setPlace({why.place.file, why.place.line, 0});
  throw alarm;
}

/// The text of the file or program that `program` means by `name`.
std::optional<std::string> textBeside(HostFiles& host, language::ProgramLibrary& library,
                                      const language::Program& program, std::string_view name) {
  const std::string plain(name.substr(name.find_last_of("/\\") + 1));
  fs::path file = host.folder() / plain;
  std::error_code error;
  if (plain.empty() || !fs::is_regular_file(file, error)) {
    const auto* folder = dynamic_cast<language::DirectoryLibrary*>(&library);
    const auto found = folder == nullptr ? std::nullopt : folder->find(name, &program);
    if (!found) return std::nullopt;
    file = *found;
  }
  Result<std::string> text = host.readAt(file);
  return text ? std::optional(std::move(*text)) : std::nullopt;
}

/// The initialization texts that a run of a SINUMERIK control leaves.
std::set<std::string> namesOf(const SinumerikData& data) {
  std::set<std::string> names = {"TOOLS.TOA", "FRAMES.UFR", "DATA.INI", "USER.GUD"};
  for (const SinumerikData::File& file : data.files)
    names.insert(file.name);
  return names;
}

void runSinumerik(RunOutcome& outcome, const std::shared_ptr<language::Program>& program, const fs::path& path,
                  const simulation::Setup& setup, const sinumerik::GlobalUserData& globalData, HostFiles& host,
                  const RunOptions& options, FolderReading reading) {
  SinumerikData data = sinumerikData(setup, outcome.diagnostics, &globalData);
  const std::map<std::string, std::string> definitions = definitionFiles(setup.tables);
  reading = {};
  sinumerik::HostOptions hostOptions;
  hostOptions.globalData = globalData.variables(data.store, outcome.diagnostics);
  const std::set<std::string> dataNames = namesOf(data);
  refuseForeign(outcome, dataNames, options);
  if (hasErrors(outcome.diagnostics)) return;
  StandingMachine machine(*outcome.machine);
  sin::Control control(machine, data.store);
  setPanel(control.panel, setup, options);
  control.panel.whyNoFile = fileRule(dataNames, options);
  control.journal.limit = options.recordLimit;
  control.programPath = path.string();
  control.wallClockStart = options.wallClock;
  for (const std::string& name : options.measuringLogs)
    control.output.logs.push_back(
        {name, fs::path(name).extension() == ".csv" ? sin::MeasuringLog::Form::Table : sin::MeasuringLog::Form::Text});
  control.activateSettable(activeZeroOffset(setup));
  for (const auto& tool : setup.tools) {
    if (tool.inSpindle) control.loadTool(tool.number);
  }
  control.applyFrames();

  control.dryRun = options.mode == ProgramMode::DryRun;
  control.programTest = options.mode == ProgramMode::ProgramTest;
  control.blockSearch = options.searchLine.has_value();
  const bool stands = control.programTest || control.blockSearch;
  if (stands) machine.hold();
  hostOptions.strict = options.strict;
  hostOptions.searchLine = options.searchLine.value_or(0);
  hostOptions.searchEnds = [&] {
    if (!control.programTest) goOnMoving(machine, control);
  };
  const auto library =
      programLibrary(outcome.control, {}, &globalData, [&](const fs::path& opened) { host.note(opened); });
  hostOptions.fileExists = [&](std::string_view name) { return library->exists(name, program.get()); };
  hostOptions.readFile = [&](std::string_view name) { return textBeside(host, *library, *program, name); };
  sinumerik::SinumerikHost* running = nullptr;
  hostOptions.callProgram = [&](std::string_view name, const language::Program* caller) {
    return callAside(*library, *running, interpreterOptions(options, outcome.control), name, caller);
  };
  sinumerik::SinumerikHost sinumerikHost(control, hostOptions);
  running = &sinumerikHost;
  language::Interpreter interpreter(*library, sinumerikHost, interpreterOptions(options, outcome.control));
  outcome.result = interpreter.run(program);
  if (control.blockSearch && outcome.result.end == RunEnd::Finished) {
    outcome.result.end = RunEnd::Alarm;
    outcome.result.diagnostics.push_back(
        {Severity::Error,
         {program->file(), *options.searchLine, 0},
         "the block search did not find its target: the program ended before this line",
         {},
         "name a line that the program reaches",
         "15370"});
  }

  outcome.files = control.panel.files();
  std::erase_if(outcome.files, [](const auto& file) { return file.second.empty(); });  // what DELETE left
  addDataFiles(outcome, data, control.data);
  for (const auto& [name, text] : definitions)
    outcome.files[name] = text;
  const Eigen::Affine3d workpiece = control.machineFromBase() * sin::transform(control.frames.settableFrame);
  outcome.machineFromWorkpiece = Pose(workpiece.matrix());
  outcome.ballRadius = control.tool.radius;
  outcome.info.totalPathLength = control.channel.pathLength();
  outcome.info.totalSeconds = control.channel.seconds();
  outcome.journal = std::move(control.journal);
}

/// Notes how the run ended, in the words of an exit code, and puts what stopped it among the events.
void conclude(RunOutcome& outcome) {
  if (hasErrors(outcome.diagnostics)) {
    outcome.info.exit = ExitState::InputMistake;
    outcome.info.exitText = outcome.diagnostics.front().message;
    return;
  }
  if (outcome.result.end != RunEnd::Finished && !outcome.result.diagnostics.empty()) {
    const Diagnostic& why = outcome.result.diagnostics.front();
    outcome.info.exitText = why.code.empty() ? why.message : why.code + ": " + why.message;
    if (outcome.result.end == RunEnd::Alarm) {
      outcome.journal.events.push_back(
          {control::EventKind::Alarm, why.place, why.code, why.message, outcome.info.totalSeconds});
    }
  }
  switch (outcome.result.end) {
    case RunEnd::Finished: {
      const control::Verdict worst = records::worstVerdict(outcome.journal);
      const bool out = worst == control::Verdict::Rework || worst == control::Verdict::Scrap;
      outcome.info.exit = out ? ExitState::OutOfTolerance : ExitState::Good;
      break;
    }
    case RunEnd::BrokenProgram:
      outcome.info.exit = ExitState::InputMistake;
      break;
    case RunEnd::Alarm:
    case RunEnd::Cancelled:
    case RunEnd::StepLimit:
    case RunEnd::RecordLimit:
    case RunEnd::Halted:
      outcome.info.exit = ExitState::Stopped;
      break;
  }
}

/// What a part lacks: the probe may enter where a triangle or a face is missing.
void warnOfParts(RunOutcome& outcome, const simulation::Setup& setup) {
  for (const simulation::PlacedSolid& placed : outcome.machine->truth().solids) {
    if (const auto* cad = dynamic_cast<const simulation::CadSolid*>(placed.solid.get())) {
      outcome.diagnostics.insert(outcome.diagnostics.end(), cad->remarks().begin(), cad->remarks().end());
      continue;
    }
    const auto* mesh = dynamic_cast<const simulation::MeshSolid*>(placed.solid.get());
    if (mesh == nullptr || mesh->isClosed()) continue;
    outcome.diagnostics.push_back(
        {Severity::Warning,
         {setup.file, 0, 0},
         fmt::format("the surface of \"{}\" is not closed: triangles are missing", placed.name),
         {},
         "the probe meets only the triangles there are; export the part again as one solid body",
         {}});
  }
}

RunOutcome run(const std::shared_ptr<language::Program>& program, const fs::path& path, ControlKind kind,
               const simulation::Setup& setup, const RunOptions& options) {
  RunOutcome outcome;
  outcome.control = kind;
  outcome.info.language = nameOf(languageFor(kind, path, {}));
  outcome.info.control = name(kind);
  outcome.info.setupPath = setup.file;
  outcome.info.seed = setup.truth.seed;
  for (std::size_t level = 0; level < options.skipLevels.size(); ++level)
    if (options.skipLevels[level]) outcome.info.skipLevels.push_back(static_cast<int>(level));
  for (const auto& solid : setup.solids) {
    if (solid.role != simulation::SolidRole::Part) continue;
    outcome.info.partName = solid.name;
    outcome.info.partPath = solid.source.file.string();
  }
  if (control::isHeidenhain(kind) && (options.mode != ProgramMode::Normal || options.searchLine)) {
    outcome.diagnostics.push_back({Severity::Error,
                                   {path.string(), 0, 0},
                                   "dry run, program test and block search are modes of SINUMERIK controls",
                                   {},
                                   "leave them out for this program",
                                   {}});
    conclude(outcome);
    return outcome;
  }
  // Until the control has its data: another run may be about to replace the tables.
  FolderReading reading = FolderReading::of(setup.tables, options.stop);
  const sinumerik::GlobalUserData globalData = control::isHeidenhain(kind)
                                                   ? sinumerik::GlobalUserData()
                                                   : globalUserData(path, setup.tables, outcome.diagnostics);
  useMacros(*program, globalData);
  const Diagnostics mistakes =
      checkProgram(*program, kind, namesOfData(setup, kind), &globalData, options.skipLevels, false);
  outcome.diagnostics.insert(outcome.diagnostics.end(), mistakes.begin(), mistakes.end());
  if (hasErrors(outcome.diagnostics)) {
    conclude(outcome);
    return outcome;
  }
  simulation::ImportOptions import = options.import;
  import.stop = options.stop;
  Result<std::unique_ptr<simulation::VirtualMachine>> machine = simulation::buildMachine(setup, import);
  if (!machine) {
    outcome.diagnostics.push_back(machine.error());
    conclude(outcome);
    return outcome;
  }
  outcome.machine = std::move(*machine);
  warnOfParts(outcome, setup);
  outcome.machine->recordPath(options.recordPath);
  outcome.machine->stopOn(options.stop);
  outcome.info.machine = outcome.machine->description().name;
  outcome.info.axes = outcome.machine->description().axes;
  HostFiles host(path, setup);
  try {
    if (control::isHeidenhain(kind)) {
      runHeidenhain(outcome, program, path, setup, host, options, std::move(reading));
    } else {
      runSinumerik(outcome, program, path, setup, globalData, host, options, std::move(reading));
    }
  } catch (const control::Alarm& alarm) {
    // Before the first block: an active preset or a tool in the spindle that the tables do not have.
    outcome.diagnostics.push_back(
        {Severity::Error, {setup.file, 0, 0}, alarm.text(), {}, alarm.advice(), alarm.code()});
  }
  outcome.inputs.insert(outcome.inputs.end(), host.used().begin(), host.used().end());
  conclude(outcome);
  return outcome;
}

RunOutcome refused(Diagnostic why) {
  RunOutcome outcome;
  outcome.diagnostics.push_back(std::move(why));
  conclude(outcome);
  return outcome;
}

}  // namespace

RunOutcome runProgram(const fs::path& path, const simulation::Setup& setup, const RunOptions& options) {
  Result<std::string> text = readFile(path);
  if (!text) return refused(text.error());
  const Result<ControlKind> kind = controlFor(path, *text, options.control, setup.control);
  if (!kind) return refused(kind.error());
  Result<std::shared_ptr<language::Program>> program = openProgram(path, *text, languageFor(*kind, path, *text));
  if (!program) return refused(program.error());
  RunOutcome outcome = run(*program, path, *kind, setup, options);
  if (const auto note = otherLanguage(path, *text); note && hasErrors(outcome.diagnostics))
    outcome.diagnostics.push_back(*note);
  outcome.info.programs.push_back({path.string(), std::move(*text)});
  return outcome;
}

RunOutcome runText(const std::string& name, std::string text, const simulation::Setup& setup,
                   const RunOptions& options) {
  const Result<ControlKind> kind = controlFor(name, text, options.control, setup.control);
  if (!kind) return refused(kind.error());
  const std::shared_ptr<language::Program> program = programOf(name, text, languageFor(*kind, name, text));
  RunOutcome outcome = run(program, name, *kind, setup, options);
  outcome.info.programs.push_back({name, std::move(text)});
  return outcome;
}

}  // namespace probewright::session
