#include "session/job.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/text.hpp"
#include "cycles/catalogue.hpp"

namespace probewright::session {

namespace fs = std::filesystem;
using language::Block;
using language::BlockPosition;
using language::VariableSpace;

namespace {

constexpr std::uintmax_t longestProgram = 4 << 20;  ///< bytes; longer ones are machining
constexpr int mostPrograms = 500;

/// The name without folders and ending, in capitals.
std::string plainName(std::string_view path) {
  if (const std::size_t slash = path.find_last_of("/\\:"); slash != std::string_view::npos)
    path.remove_prefix(slash + 1);
  return upperCase(path.substr(0, path.rfind('.')));
}

struct Found {
  std::set<std::string> calls;
  std::set<int> parameters, texts, results;
  std::shared_ptr<language::Program> program;
};

Found lookInto(language::Program& program) {
  Found found;
  Block block;
  Diagnostics ignored;
  for (BlockPosition at = program.begin(); program.parse(at, block, ignored); at = block.next) {
    for (const language::VariableRef& variable : block.variables) {
      if (!variable.index[0].isLiteral()) continue;
      const int number = static_cast<int>(variable.index[0].number);
      if (variable.space == VariableSpace::Q) found.parameters.insert(number);
      if (variable.space == VariableSpace::QS) found.texts.insert(number);
      if (variable.space == VariableSpace::User && block.at(variable.name) == "_OVR") found.results.insert(number);
    }
    for (const language::Instruction& instruction : block.instructions) {
      const auto* call = std::get_if<language::CallProgram>(&instruction);
      if (call == nullptr || call->name.length == 0 || cycles::sinumerikCycle(block.at(call->name)) != nullptr)
        continue;
      found.calls.insert(plainName(block.at(call->name)));
    }
  }
  return found;
}

/// What the program in that file shares with others; nothing if it cannot be read.
std::optional<Found> lookInto(const fs::path& path, ProgramLanguage language) {
  const Result<std::string> text = readFile(path);
  if (!text) return std::nullopt;
  const auto program = openProgram(path, *text, language);
  if (!program) return std::nullopt;
  Found found = lookInto(**program);
  found.program = *program;
  return found;
}

}  // namespace

conversion::Job jobOf(const fs::path& path, ProgramLanguage language) {
  const std::string own = plainName(path.filename().string());
  const ControlFamily& family = knownFamilies().of(language);
  std::map<std::string, Found> programs;
  if (auto found = lookInto(path, language)) programs.emplace(own, std::move(*found));
  std::error_code none;
  int opened = 0;
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  for (fs::directory_iterator each(folder, none), end; !none && each != end && opened < mostPrograms;
       each.increment(none)) {
    const auto other = languageOf(each->path(), {});
    const std::string name = plainName(each->path().filename().string());
    if (!other || &knownFamilies().of(*other) != &family || programs.contains(name)) continue;
    if (!each->is_regular_file(none) || each->file_size(none) > longestProgram) continue;
    ++opened;
    if (auto found = lookInto(each->path(), *other)) programs.emplace(name, std::move(*found));
  }
  // Those that calls lead to or come from, step by step.
  conversion::Job job;
  std::set<std::string> reached = {own};
  for (bool more = true; more;) {
    more = false;
    for (const auto& [name, found] : programs) {
      for (const std::string& called : found.calls) {
        if (!programs.contains(called) || reached.contains(name) == reached.contains(called)) continue;
        reached.insert({name, called});
        more = true;
      }
    }
  }
  job.shares = !programs[own].calls.empty() || reached.size() > 1;
  for (const std::string& name : reached) {
    const Found& found = programs[name];
    job.called = job.called || (name != own && found.calls.contains(own));
    job.parameters.insert(found.parameters.begin(), found.parameters.end());
    job.results.insert(found.results.begin(), found.results.end());
    if (name == own) continue;
    job.programs.insert(name);
    job.others.push_back(found.program);
    job.texts.insert(found.texts.begin(), found.texts.end());
  }
  return job;
}

}  // namespace probewright::session
