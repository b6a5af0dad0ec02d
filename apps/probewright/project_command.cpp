#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/toml_table.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "terminal.hpp"

/// Programs in the order in which a job needs them, each with the tables that the one before has left.
namespace probewright::app {

namespace {

namespace fs = std::filesystem;

struct Step {
  fs::path program, setup;
  bool tablesOfPrevious = false;
  std::string name;
};

struct Project {
  std::string name;
  std::vector<Step> steps;
};

Project parse(const toml::table& table, const fs::path& file, Diagnostics& mistakes) {
  TomlReader root(table, "", file.string(), mistakes);
  Project project;
  project.name = root.text("name").value_or(file.stem().string());
  root.require("run");
  const auto inFolder = [&](const std::string& path) {
    return fs::path(path).is_absolute() ? fs::path(path) : file.parent_path() / path;
  };
  for (TomlReader& entry : root.tables("run")) {
    Step step;
    const bool first = project.steps.empty();
    if (const auto program = entry.requiredText("program")) step.program = inFolder(*program);
    if (first) entry.require("setup");
    const auto setup = entry.text("setup");
    step.setup = setup ? inFolder(*setup) : first ? fs::path() : project.steps.back().setup;
    const auto tables = entry.choice("tables", {"setup", "previous"});
    if (first && tables == std::size_t{1})
      entry.report("tables", "the first run has no run before it", "leave `tables` out, or write \"setup\"");
    const bool sameSetup = !first && step.setup == project.steps.back().setup;
    step.tablesOfPrevious = tables ? *tables == 1 : sameSetup;
    step.name = entry.text("name").value_or(step.program.filename().string());
    entry.finish();
    project.steps.push_back(std::move(step));
  }
  root.finish();
  return project;
}

/// "2-inspect": what a run leaves lies in a folder of this name.
std::string folderOf(const Project& project, std::size_t index) {
  const std::size_t width = std::to_string(project.steps.size()).size();
  return fmt::format("{:0{}}-{}", index + 1, width, project.steps[index].program.stem().string());
}

std::string_view endOf(int exit) {
  constexpr std::array<std::string_view, 5> words = {"good", "out of tolerance", "input mistake", "stopped",
                                                     "internal error"};
  return exit >= 0 && exit < static_cast<int>(words.size()) ? words[static_cast<std::size_t>(exit)] : "unknown";
}

}  // namespace

int project(const ProjectArguments& arguments) {
  Diagnostics mistakes;
  std::optional<Project> project;
  if (auto text = readFile(arguments.file, largestText)) {
    if (const auto table = parseToml(*text, arguments.file.string(), mistakes))
      project = parse(*table, arguments.file, mistakes);
  } else {
    mistakes.push_back(text.error());
  }
  print(mistakes);
  if (!project || hasErrors(mistakes)) return 2;

  // Values of an earlier run of the project are not those of this one; what is not such a record is somebody's own.
  const fs::path record = arguments.out / "project.csv";
  if (const auto earlier = readFile(record)) {
    if (!exchange::isRecord(*earlier)) {
      print({fail({record.string()}, "this file is not of a project, and stays as it is",
                  "move it away, or give --out another folder")
                 .value()});
      return 2;
    }
    std::error_code unknown;
    fs::remove(record, unknown);
  }
  std::vector<fs::path> folders;
  for (std::size_t i = 0; i < project->steps.size(); ++i)
    folders.push_back(arguments.out / folderOf(*project, i));
  int worst = 0;
  std::string summary = fmt::format("{}\n", project->name);
  for (std::size_t i = 0; i < project->steps.size(); ++i) {
    const Step& step = project->steps[i];
    RunArguments one = arguments.run;
    one.program = step.program;
    one.setup = step.setup;
    one.out = folders[i];
    one.otherOutputs = folders;
    if (step.tablesOfPrevious) one.tables = folders[i - 1];
    one.append = record;
    if (!one.quiet) put(fmt::format("--- {} of {}: {}\n", i + 1, project->steps.size(), printable(step.name)), stdout);
    const int exit = run(one);
    if (!one.quiet) put("\n", stdout);
    worst = std::max(worst, exit);
    summary += fmt::format("  {:>2}  {:<32} {:<18} {}\n", i + 1, printable(step.name), endOf(exit),
                           printable((one.out / "report.html").string()));
    // What comes after would begin from tables that were never written, or from a wrong preset.
    if (exit >= 2) {
      for (std::size_t j = i + 1; j < project->steps.size(); ++j)
        summary += fmt::format("  {:>2}  {:<32} {}\n", j + 1, printable(project->steps[j].name), "not run");
      break;
    }
  }
  if (!arguments.run.quiet) {
    put(summary, stdout);
    put(fmt::format("All values: {}\n", printable(record.string())), stdout);
  }
  return worst;
}

}  // namespace probewright::app
