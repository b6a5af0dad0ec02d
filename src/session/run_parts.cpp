#include "session/run_parts.hpp"

#include "base/text.hpp"
#include "control/alarm.hpp"
#include "session/trace_recorder.hpp"

namespace probewright::session {

namespace {

/// What names a program cannot give to its files.
std::function<std::optional<Diagnostic>(const std::string&)> fileRule(std::set<std::string> tables,
                                                                      const RunOptions& options) {
  return [tables = std::move(tables), &options](const std::string& name) -> std::optional<Diagnostic> {
    const std::string upper = upperCase(name);
    if (tables.contains(upper) || upper == "RESULTS.JSON" || upper == "REPORT.HTML" ||
        upper.starts_with(".PROBEWRIGHT")) {
      return Diagnostic{Severity::Error,        {}, "it is one of the files that every run leaves", {},
                        "give it another name", {}};
    }
    return options.whyNoFile ? options.whyNoFile(name) : std::nullopt;
  };
}

}  // namespace

execution::InterpreterOptions interpreterOptions(const RunOptions& options) {
  execution::InterpreterOptions interpreter;
  interpreter.stepLimit = options.stepLimit;
  interpreter.stop = options.stop;
  interpreter.skipLevels = options.skipLevels;
  interpreter.onProgress = options.progress;
  return interpreter;
}

void recordBlocks(execution::InterpreterOptions& interpreter, TraceRecorder& trace, const RunOptions& options) {
  if (!options.trace) return;
  interpreter.onBlock = [&trace](const language::Program& program, const language::Block& block) {
    trace.begin(program, block);
  };
}

void setPanel(control::OperatorPanel& panel, const RunRequest& request, std::set<std::string> tables) {
  const control::Beliefs& beliefs = request.beliefs;
  const RunOptions& options = request.options;
  panel.onStop = options.onStop;
  // Whoever is asked may answer with Ctrl-C.
  const auto orStopped = [&options](auto answer) {
    if (options.stop.stop_requested()) throw control::Cancelled();
    return answer;
  };
  if (options.ask) panel.ask = [&options, orStopped](const std::string& text) { return orStopped(options.ask(text)); };
  panel.answer = [&, orStopped](const control::Question& question) -> std::optional<std::string> {
    for (const auto* known : {&options.answers, &beliefs.answers}) {
      if (const auto found = known->find(question.name); found != known->end()) return found->second;
    }
    return options.answer ? orStopped(options.answer(question)) : std::nullopt;
  };
  panel.language = options.language;
  panel.showAllResults = options.showAllResults;
  panel.whyNoFile = fileRule(std::move(tables), options);
}

void refuseForeign(Diagnostics& diagnostics, const std::set<std::string>& tables, const RunOptions& options) {
  if (!options.whyNoFile) return;
  for (const std::string& name : tables) {
    if (auto why = options.whyNoFile(name)) diagnostics.push_back(std::move(*why));
  }
}

}  // namespace probewright::session
