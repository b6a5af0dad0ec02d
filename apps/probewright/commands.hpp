#pragma once

#include <bitset>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "check_formats.hpp"
#include "control/control_kind.hpp"
#include "control/operator_panel.hpp"
#include "exchange/formats.hpp"
#include "records/job.hpp"

/// The subcommands of probewright. Each prints what there is to say and returns the exit code: 0 fine, 1 measured and
/// out of tolerance, 2 a mistake in the input, 3 an alarm or a stop while running, 4 internal.
namespace probewright::app {

struct RunArguments {
  std::filesystem::path program;
  std::filesystem::path setup;
  std::string
      machine;  ///< the adapter of a real machine, see adapter::connect; empty: the virtual machine of the setup
  std::filesystem::path machineFile;  ///< instead of the setup's machine; empty: none
  std::filesystem::path out = "probewright-out";
  std::vector<std::filesystem::path> otherOutputs;  ///< of the runs that belong to this one; see setup::readSetupOn
  bool preview = false;                             ///< leaves no files
  std::optional<control::ControlKind> control;
  bool strict = false;
  control::OnStop onStop = control::OnStop::Continue;
  std::filesystem::path answers;  ///< empty: no file
  std::uint64_t stepLimit = 50'000'000;
  std::bitset<10> skipLevels;
  std::uint64_t recordLimit = 96;     ///< MB
  std::optional<std::uint64_t> seed;  ///< instead of the setup's
  bool dryRun = false, programTest = false;
  std::optional<std::uint64_t> searchLine;
  std::string language = "en";  ///< of the report, and of the control's logs where it has it
  bool screens = false;
  std::string cache;                             ///< folder for imported parts; "off": none; empty: the user's
  std::vector<std::string> measuringLogs;        ///< of a SINUMERIK control; .csv: as a table
  std::vector<const exchange::Format*> exports;  ///< files for other programs, beside results.json
  std::filesystem::path append;                  ///< record of many runs; empty: none
  std::filesystem::path tables;                  ///< instead of the setup's folder of tables; empty: that of the setup
  bool blind = false;                            ///< says nothing of what only the virtual machine knows
  records::Job job;                              ///< fields that go before the setup's
  bool pdf = false;                              ///< the report as pages, too
  bool clearance = false;                        ///< tells how near the tool came to things
  bool uncertainty = false;                      ///< each result gets its uncertainty, to first order
  bool quiet = false;
};
int run(const RunArguments& arguments);

struct ProjectArguments {
  std::filesystem::path file;
  std::filesystem::path out = "probewright-out";  ///< a folder in it for each run
  RunArguments run;                               ///< what holds for all of them
};
/// The worst exit code of the runs.
int project(const ProjectArguments& arguments);

struct CheckArguments {
  std::vector<std::filesystem::path> programs;
  std::filesystem::path setup;  ///< empty: none
  std::optional<control::ControlKind> control;
  std::bitset<10> skipLevels;
  CheckFormat format = CheckFormat::Text;
  bool watch = false;  ///< once more after each change of a file, until Ctrl-C
};
int check(const CheckArguments& arguments);

struct CompareArguments {
  std::filesystem::path first, second;  ///< folders of runs, or their results.json
  double tolerance = 1e-4;              ///< mm, degrees
  bool all = false;                     ///< also what is alike
  bool asJson = false;
};
/// 0: alike; 1: they differ.
int compare(const CompareArguments& arguments);

struct CyclesArguments {
  std::string name;  ///< of a cycle, or words to look for; empty: all
  std::optional<control::ControlKind> control;
  bool asJson = false;
  bool asTemplate = false;      ///< a call to paste
  std::string language = "en";  ///< of titles and of the texts in the call
};
int cycles(const CyclesArguments& arguments);

struct CameraArguments {
  std::filesystem::path folder;  ///< of tables
  std::string point;             ///< empty: all are listed
  std::string keys;              ///< soft keys; empty: its images are listed
};
int camera(const CameraArguments& arguments);

struct ConvertArguments {
  std::filesystem::path input;
  std::filesystem::path output;                 ///< its ending names the language
  std::optional<control::ControlKind> control;  ///< to write for
  std::filesystem::path setup;  ///< whose tables have definition files and values of global user data; empty: none
  bool force = false;           ///< an existing `output` is overwritten
  double setUp = 2, dist = 10;  ///< SET_UP and DIST of the touch probe table, mm
  std::string toolCycles;       ///< "old": 30 to 33, "new": 480 to 483, empty: as written
};
/// Here 1 means that something could not be carried over; it stands as a comment in the output.
int convert(const ConvertArguments& arguments);

struct MachineArguments {
  std::string machine;  ///< a ready-made one, or a machine file
  std::filesystem::path out = "machine.html";
  bool force = false;  ///< a file of that name is overwritten, whatever it is
};
int machine(const MachineArguments& arguments);

struct StudyArguments {
  std::filesystem::path program;
  std::filesystem::path setup;
  std::filesystem::path study;
  std::filesystem::path out = "probewright-study";
  std::optional<control::ControlKind> control;
  std::optional<std::uint64_t> trials;  ///< instead of what the study says
  std::optional<std::uint64_t> repeat;  ///< type-1 study
  int threads = 0;                      ///< 0: all cores
  bool resume = false;
  std::filesystem::path keep;  ///< all values of all trials, as HDF5; empty: nowhere
  std::string cache;           ///< as of RunArguments
  bool quiet = false;
};
/// Here 3 means that it was interrupted, or that no trial came to the end of the program.
int study(const StudyArguments& arguments);

struct SurviveArguments {
  std::filesystem::path program;
  std::filesystem::path setup;
  std::vector<std::string> tolerances;  ///< as survival::parseTolerance reads them
  std::filesystem::path out = "probewright-survive";
  std::optional<control::ControlKind> control;
  std::uint64_t samples = 1000, boxes = 1000, checks = 0, seed = 1;
  int threads = 0;    ///< 0: all cores
  std::string cache;  ///< as of RunArguments
  bool quiet = false;
};
/// Here 1 means that not the whole box is proven, 3 that it was interrupted or that the program fails as the setup is
/// written.
int survive(const SurviveArguments& arguments);

struct FeelArguments {
  std::filesystem::path setup;
  std::filesystem::path machineFile;          ///< instead of the setup's machine; empty: none
  std::string segment = "/probewright-feel";  ///< of shared memory
  std::string cache;                          ///< as of RunArguments
  bool quiet = false;
};
/// Answers LinuxCNC's HAL component probewright_feel until that leaves.
int feel(const FeelArguments& arguments);

}  // namespace probewright::app
