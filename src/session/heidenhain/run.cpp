#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/folder_swap.hpp"
#include "base/number_text.hpp"
#include "execution/din_iso/host.hpp"
#include "execution/klartext/host.hpp"
#include "language/encoding.hpp"
#include "session/heidenhain/beliefs.hpp"
#include "session/heidenhain/family_parts.hpp"
#include "session/heidenhain/kinematic_files.hpp"
#include "session/heidenhain/monitoring_files.hpp"
#include "session/heidenhain/own_tables.hpp"
#include "session/heidenhain/remanent_parameters.hpp"
#include "session/own_control.hpp"
#include "session/run_parts.hpp"
#include "session/source.hpp"
#include "session/standing_machine.hpp"
#include "session/trace_recorder.hpp"

namespace probewright::session::heidenhain {

namespace fs = std::filesystem;
namespace hh = control::heidenhain;
using control::ControlKind;
using execution::RunEnd;

namespace {

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
  names.merge(kinematicFileNames());
  for (const auto& [name, table] : tables.datums)
    names.insert(name);
  for (const auto& [name, table] : tables.deflections)
    names.insert(name);
  for (const auto* table : {&tables.turningTools, &tables.axisShifts}) {
    if (*table) names.insert((*table)->table().name());
  }
  return names;
}

/// What the control has of the machine's camera; null if the machine has none, or the control no use for it.
std::shared_ptr<hh::CameraMonitoring> cameraMonitoringOf(machine::Machine& machine, const RunRequest& request,
                                                         Diagnostics& diagnostics) {
  machine::Camera* camera = machine::cameraOf(machine);
  if (camera == nullptr || request.control != ControlKind::TNC640) return nullptr;
  return std::make_shared<hh::CameraMonitoring>(
      hh::CameraMonitoring{camera, readMonitoringFiles(request.beliefs.tables, diagnostics)});
}

/// "5 PROBE".
std::string describedTool(const hh::ActiveTool& tool) {
  const std::string number = tool.row.empty() ? std::to_string(tool.number) : tool.row;
  return tool.name.empty() ? number : number + " " + tool.name;
}

/// What each run of a program begins with: tables, made of the beliefs when it begins for the first time, and where the
/// programs are that it calls.
struct FirstTables {
  std::optional<hh::Tables> tables;
  Diagnostics remarks;
  std::shared_ptr<language::DirectoryLibrary::Found> called = std::make_shared<language::DirectoryLibrary::Found>();
  ControlFamily family = heidenhainFamily();

  const hh::Tables& of(const RunRequest& request) {
    if (!tables) tables = heidenhainTables(request.beliefs, request.control, remarks);
    return *tables;
  }
};

/// The tables as they are at the end, and the logs.
std::map<std::string, std::string> filesOf(const hh::Control& control, const hh::CameraMonitoring* cameraMonitoring,
                                           control::DialogLanguage language) {
  std::map<std::string, std::string> files = control.panel.files();
  encodeLogs(files, textFileEncoding(control.kind(), language));
  files["TOOL.T"] = control.tables.tools.table().bytes();
  files["TCHPROBE.TP"] = control.tables.probes.table().bytes();
  files["PRESET.PR"] = control.tables.presets.table().bytes();
  for (const auto& [name, table] : control.tables.datums)
    files[name] = table.table().bytes();
  for (const auto& [name, table] : control.tables.deflections)
    files[name] = table.table().bytes();
  writeKinematics(control, files);
  if (std::string remanent = remanentParametersText(control.q); !remanent.empty())
    files[remanentFile] = std::move(remanent);
  if (cameraMonitoring != nullptr) {
    for (const auto& point : cameraMonitoring->points)
      files.merge(monitoringFiles(point));
  }
  // Tables that few machines have come out if there is anything in them.
  for (const auto* table : {&control.tables.turningTools, &control.tables.axisShifts}) {
    if (*table && !(*table)->table().keys().empty()) files[(*table)->table().name()] = (*table)->table().bytes();
  }
  return files;
}

/// The axis of the machine along the tool.
std::optional<std::size_t> toolAxisOf(const hh::Control& control) {
  return control.channel.description().axisIndex(std::string(1, "XYZ"[control.coordinates.plane.tool]));
}

void run(const RunRequest& request, FolderReading reading, FirstTables& first, machine::Machine& trueMachine,
         HostFiles& host, RunOutcome& outcome) {
  const RunOptions& options = request.options;
  const control::Beliefs& beliefs = request.beliefs;
  hh::Tables tables = first.of(request);
  outcome.diagnostics.insert(outcome.diagnostics.end(), first.remarks.begin(), first.remarks.end());
  const hh::MachineParameters parameters = machineParameters(beliefs, request.control, outcome.diagnostics);
  std::set<std::string> tableNames = namesOf(tables);
  const auto cameraMonitoring = cameraMonitoringOf(trueMachine, request, outcome.diagnostics);
  if (cameraMonitoring) {
    for (const auto& point : cameraMonitoring->points)
      for (const auto& [name, bytes] : monitoringFiles(point))
        tableNames.insert(name);
  }
  refuseForeign(outcome.diagnostics, tableNames, options);
  if (hasErrors(outcome.diagnostics)) return;
  machine::OwnControl* own = machine::ownControlOf(trueMachine);
  if (own != nullptr && own->tables() == nullptr) own = nullptr;
  std::vector<std::string> notes;
  if (own != nullptr) notes = takeOver(tables, *own->tables(), trueMachine.description());
  // Only a start in the middle lets the axes stand.
  std::optional<StandingMachine> standing;
  if (options.searchLine) standing.emplace(trueMachine);
  machine::Machine& machine = standing ? *standing : trueMachine;
  hh::Control control(request.control, machine, std::move(tables), parameters);
  setPanel(control.panel, request, tableNames);
  control.journal.limit = options.recordLimit;
  control.programPath = request.path.string();
  control.cameraMonitoring = cameraMonitoring;
  control.startSeconds = control.channel.seconds();
  control.wallClockStart = options.wallClock;
  readKinematics(control, beliefs, outcome.diagnostics);
  if (hasErrors(outcome.diagnostics)) return;
  control.activatePreset(activePresetRow(beliefs));
  const auto probe = std::ranges::find(beliefs.tools, "probe", &control::BelievedTool::kind);
  if (probe != beliefs.tools.end()) control.handProbe = {probe->number, probe->name};
  for (const auto& tool : beliefs.tools) {
    if (tool.inSpindle) control.callTool(std::to_string(tool.number), 'Z', 0, 0, 0);
  }
  control.applyCoordinates();

  for (const std::string& note : notes)
    control.panel.message(control::EventKind::Message, note, control.startSeconds);

  readRemanentParameters(beliefs.tables, control.q, outcome.diagnostics);
  reading = {};
  if (hasErrors(outcome.diagnostics)) return;
  execution::klartext::HostOptions hostOptions;
  hostOptions.strict = options.strict;
  hostOptions.readFile = [&host](const std::string& name) { return host.read(name); };
  hostOptions.isInput = [&host](const std::string& name) { return host.isInput(name); };
  double counted = 0;  // mm of the path on which nothing moved
  if (standing) {
    standing->hold();
    hostOptions.startLine = std::max<std::uint64_t>(*options.searchLine, 1);
    hostOptions.scanEnds = [&] {
      counted = control.channel.pathLength();
      catchUp(*standing, control.channel, toolAxisOf(control));
      control.meetProbe();
    };
  }
  execution::klartext::KlartextHost klartext(control, hostOptions);
  execution::din_iso::DinIsoHost isoHost(klartext);
  const auto library = programLibrary(
      first.family, [&](language::Program*, const fs::path& opened) { host.note(opened); }, first.called);
  TraceRecorder trace(control.channel, [&](records::RunTrace::State& state) {
    if (control.tool.called) state.tool = describedTool(control.tool);
    state.preset = std::to_string(control.coordinates.preset.row);
  });
  execution::InterpreterOptions interpreterSettings = interpreterOptions(options);
  recordBlocks(interpreterSettings, trace, options);
  execution::Interpreter interpreter(*library, isoHost, interpreterSettings);
  {
    const Accompanied accompanied(trueMachine, control.channel, control.panel, control.journal,
                                  request.program->file());
    outcome.result = interpreter.run(request.program);
  }
  outcome.trace = trace.finish();
  if (own != nullptr) {
    giveBack(*own, differing(control.tables, *own->tables(), trueMachine.description()), control.panel,
             control.channel.seconds());
  }
  if (klartext.scans() && outcome.result.end == RunEnd::Finished) {
    outcome.result.end = RunEnd::Alarm;
    outcome.result.diagnostics.push_back({Severity::Error,
                                          {request.program->file(), *options.searchLine, 0},
                                          "the start block was not found: the program ended before this line",
                                          {},
                                          "name a line that the program reaches",
                                          "Start block not found"});
  }

  if (options.files) outcome.files = filesOf(control, cameraMonitoring.get(), options.language);
  outcome.machineFromWorkpiece = control.coordinates.machineFromPreset();
  outcome.ballRadius = control.tool.radius;
  outcome.believedMachine = control.channel.description();
  outcome.variable = [q = control.q](std::string_view name) {
    const auto number = name.starts_with('Q') ? parseInteger(name.substr(1)) : std::nullopt;
    return number && hh::QParameters::exists(*number) ? q.q(static_cast<int>(*number)) : std::nan("");
  };
  outcome.info.inches = control.mainUnit != 1;
  takeRecords(control, outcome, klartext.scans() ? control.channel.pathLength() : counted);
}

}  // namespace

RunOn prepareHeidenhain(const RunRequest& request, Diagnostics& diagnostics) {
  // Until the control has its data: another run may be about to replace the tables.
  const auto reading = std::make_shared<FirstReading>(request);
  const auto first = std::make_shared<FirstTables>();
  const Diagnostics mistakes = checkHeidenhain({.program = *request.program,
                                                .control = request.control,
                                                .path = request.path,
                                                .beliefs = &request.beliefs,
                                                .skipLevels = request.options.skipLevels,
                                                .foresees = false});
  diagnostics.insert(diagnostics.end(), mistakes.begin(), mistakes.end());
  return [request, reading, first](machine::Machine& machine, HostFiles& host, RunOutcome& outcome) {
    run(request, reading->take(request), *first, machine, host, outcome);
  };
}

}  // namespace probewright::session::heidenhain
