#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "base/file.hpp"
#include "base/folder_swap.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/text.hpp"
#include "control/sinumerik/tool_carrier.hpp"
#include "execution/sinumerik/host.hpp"
#include "language/directory_library.hpp"
#include "language/sinumerik/program.hpp"
#include "session/own_control.hpp"
#include "session/run_parts.hpp"
#include "session/sinumerik/beliefs.hpp"
#include "session/sinumerik/family_parts.hpp"
#include "session/sinumerik/global_data.hpp"
#include "session/sinumerik/own_tables.hpp"
#include "session/source.hpp"
#include "session/standing_machine.hpp"
#include "session/trace_recorder.hpp"

namespace probewright::session::sinumerik {

namespace fs = std::filesystem;
namespace sin = control::sinumerik;
using execution::RunEnd;

namespace {

execution::InterpreterOptions interpreterOptionsOf(const RunOptions& options) {
  execution::InterpreterOptions interpreter = interpreterOptions(options);
  interpreter.programDepth = execution::sinumerik::SinumerikHost::programDepth;
  return interpreter;
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
    if (execution::sinumerik::definitionFileName(name).empty() || !entry->is_regular_file(error)) continue;
    if (Result<std::string> text = readFile(entry->path())) files[name] = std::move(*text);
  }
  return files;
}

/// Runs the program `name`, if there is one; see execution::sinumerik::HostOptions::callProgram.
bool callAside(language::ProgramLibrary& library, execution::Host& host, execution::InterpreterOptions options,
               std::string_view name, const language::Program* caller) {
  if (!library.exists(name, caller)) return false;
  const auto opened = library.open(name, caller);
  if (!opened) throw control::Alarm("14011", opened.error().message, opened.error().advice);
  const execution::RunResult result = execution::Interpreter(library, host, std::move(options)).run(*opened);
  if (result.end == RunEnd::Finished) return true;
  if (result.end == RunEnd::Cancelled) throw control::Cancelled();
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

/// The R parameters that have values, by name.
std::map<std::string, double, std::less<>> arithmeticParameters(const sin::DataStore& store) {
  std::map<std::string, double, std::less<>> values;
  for (const sin::DataKey& key : store.keys()) {
    if (key.name == "R") values.emplace(key.text(), store.number(key));
  }
  return values;
}

/// The machine with the rotary axes where the swivel data set has them that cycles correct.
machine::MachineDescription believedAtTheEnd(const sin::Control& control) {
  const auto carrier = sin::toolCarrier(control.data, std::max(1, control.carrier));
  if (!carrier) return control.told();
  auto described = sin::withCarrier(control.told(), *carrier);
  return described ? *std::move(described) : control.told();
}

/// Hirth couplings that the control has been told of, into the data set that describes its machine.
void enterHirthGrids(sin::Control& control, const control::Beliefs& beliefs) {
  const auto carrier = sin::toolCarrier(control.data, 1);
  if (!carrier) return;
  for (int which = 0; which < carrier->axes(); ++which) {
    const auto belief = beliefs.kinematics.find(carrier->axisName[static_cast<std::size_t>(which)]);
    const sin::DataKey grid = sin::carrierDatum(28 + which, 1);
    if (belief != beliefs.kinematics.end() && belief->second.hirthGrid > 0 && !control.data.isSet(grid))
      control.data.load(grid, belief->second.hirthGrid);
  }
}

/// "T2 PROBE D1".
std::string describedTool(const sin::ActiveTool& tool) {
  if (tool.number == 0) return {};
  std::string text = "T" + std::to_string(tool.number);
  if (!tool.name.empty()) text += " " + tool.name;
  return text + " D" + std::to_string(tool.edge);
}

/// The G function of a settable zero offset.
std::string zeroOffset(int settable) {
  constexpr int lastTwoDigits = 4;
  return "G" + std::to_string(settable == 0 ? 500 : settable <= lastTwoDigits ? 53 + settable : 500 + settable);
}

/// What each run of a program begins with: data, made of the beliefs when it begins for the first time, and where the
/// programs are that it calls.
struct FirstData {
  std::optional<SinumerikData> data;
  std::map<std::string, std::string> definitions;
  Diagnostics remarks;
  std::shared_ptr<language::DirectoryLibrary::Found> called = std::make_shared<language::DirectoryLibrary::Found>();
  ControlFamily family = sinumerikFamily();

  void make(const control::Beliefs& beliefs, const execution::sinumerik::GlobalUserData& globalData) {
    if (data) return;
    data = sinumerikData(beliefs, remarks, &globalData);
    definitions = definitionFiles(beliefs.tables);
  }
};

void run(const RunRequest& request, const execution::sinumerik::GlobalUserData& globalData, FolderReading reading,
         FirstData& first, machine::Machine& trueMachine, HostFiles& host, RunOutcome& outcome) {
  const RunOptions& options = request.options;
  const control::Beliefs& beliefs = request.beliefs;
  const std::shared_ptr<language::Program>& program = request.program;
  first.make(beliefs, globalData);
  SinumerikData data = *first.data;
  const std::map<std::string, std::string>& definitions = first.definitions;
  outcome.diagnostics.insert(outcome.diagnostics.end(), first.remarks.begin(), first.remarks.end());
  reading = {};
  execution::sinumerik::HostOptions hostOptions;
  hostOptions.globalData = globalData.variables(data.store, outcome.diagnostics);
  const std::set<std::string> dataNames = namesOf(data);
  refuseForeign(outcome.diagnostics, dataNames, options);
  if (hasErrors(outcome.diagnostics)) return;
  machine::OwnControl* own = machine::ownControlOf(trueMachine);
  if (own != nullptr && own->tables() == nullptr) own = nullptr;
  std::vector<std::string> notes;
  if (own != nullptr) notes = takeOver(data.store, *own->tables(), trueMachine.description());
  StandingMachine machine(trueMachine);
  sin::Control control(machine, data.store, control::believedMachine(trueMachine.description(), beliefs.kinematics));
  enterHirthGrids(control, beliefs);
  setPanel(control.panel, request, dataNames);
  control.journal.limit = options.recordLimit;
  control.programPath = request.path.string();
  control.wallClockStart = options.wallClock;
  for (const std::string& name : options.measuringLogs)
    control.output.logs.push_back(
        {name, fs::path(name).extension() == ".csv" ? sin::MeasuringLog::Form::Table : sin::MeasuringLog::Form::Text});
  control.activateSettable(activeZeroOffset(beliefs));
  for (const auto& tool : beliefs.tools) {
    if (tool.inSpindle) control.loadTool(tool.number);
  }
  control.applyFrames();
  for (const std::string& note : notes)
    control.panel.message(control::EventKind::Message, note, control.channel.seconds());

  control.dryRun = options.mode == ProgramMode::DryRun;
  control.programTest = options.mode == ProgramMode::ProgramTest;
  control.blockSearch = options.searchLine.has_value();
  const bool stands = control.programTest || control.blockSearch;
  if (stands) machine.hold();
  hostOptions.strict = options.strict;
  hostOptions.searchLine = options.searchLine.value_or(0);
  double counted = 0;  // mm of the path on which nothing moved
  hostOptions.searchEnds = [&] {
    if (control.programTest) return;
    counted = control.channel.pathLength();
    catchUp(machine, control.channel);
  };
  const auto noteCalled = [&](language::Program* opened, const fs::path& file) {
    if (opened != nullptr) useMacros(*opened, globalData);
    host.note(file);
  };
  const auto library = programLibrary(first.family, noteCalled, first.called);
  hostOptions.fileExists = [&](std::string_view name) { return library->exists(name, program.get()); };
  hostOptions.readFile = [&](std::string_view name) { return textBeside(host, *library, *program, name); };
  execution::sinumerik::SinumerikHost* running = nullptr;
  hostOptions.callProgram = [&](std::string_view name, const language::Program* caller) {
    return callAside(*library, *running, interpreterOptionsOf(options), name, caller);
  };
  execution::sinumerik::SinumerikHost sinumerikHost(control, hostOptions);
  running = &sinumerikHost;
  TraceRecorder trace(control.channel, [&](records::RunTrace::State& state) {
    state.tool = describedTool(control.tool);
    state.preset = zeroOffset(control.frames.settable);
    state.diameter = control.diameter;
  });
  execution::InterpreterOptions interpreterSettings = interpreterOptionsOf(options);
  recordBlocks(interpreterSettings, trace, options);
  execution::Interpreter interpreter(*library, sinumerikHost, interpreterSettings);
  {
    const Accompanied accompanied(trueMachine, control.channel, control.panel, control.journal, program->file());
    outcome.result = interpreter.run(program);
  }
  outcome.trace = trace.finish();
  if (own != nullptr) {
    giveBack(*own, differing(control.data, *own->tables(), trueMachine.description()), control.panel,
             control.channel.seconds());
  }
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

  if (options.files) {
    outcome.files = control.panel.files();
    std::erase_if(outcome.files, [](const auto& file) { return file.second.empty(); });  // what DELETE left
    addDataFiles(outcome, data, control.data);
    for (const auto& [name, text] : definitions)
      outcome.files[name] = text;
  }
  const Eigen::Affine3d workpiece = control.machineFromBase() * sin::transform(control.frames.settableFrame);
  outcome.machineFromWorkpiece = Pose(workpiece.matrix());
  outcome.ballRadius = control.tool.radius;
  outcome.info.inches = control.unit != 1;
  outcome.believedMachine = believedAtTheEnd(control);
  outcome.variable = [values = arithmeticParameters(control.data)](std::string_view name) {
    const auto found = values.find(name);
    return found == values.end() ? std::nan("") : found->second;
  };
  takeRecords(control, outcome, control.blockSearch || control.programTest ? control.channel.pathLength() : counted);
}

}  // namespace

RunOn prepareSinumerik(const RunRequest& request, Diagnostics& diagnostics) {
  // Until the control has its data: another run may be about to replace the tables.
  const auto reading = std::make_shared<FirstReading>(request);
  const auto first = std::make_shared<FirstData>();
  const auto globalData = std::make_shared<const execution::sinumerik::GlobalUserData>(
      globalUserData(request.path, request.beliefs.tables, diagnostics));
  const Diagnostics mistakes = checkSinumerik({.program = *request.program,
                                               .control = request.control,
                                               .path = request.path,
                                               .beliefs = &request.beliefs,
                                               .skipLevels = request.options.skipLevels,
                                               .foresees = false},
                                              *globalData);
  diagnostics.insert(diagnostics.end(), mistakes.begin(), mistakes.end());
  return [request, reading, globalData, first](machine::Machine& machine, HostFiles& host, RunOutcome& outcome) {
    run(request, *globalData, reading->take(request), *first, machine, host, outcome);
  };
}

}  // namespace probewright::session::sinumerik
