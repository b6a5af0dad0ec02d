#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "control/dialog_language.hpp"
#include "control/journal.hpp"

/// What stands between a running program and the person at the machine.
namespace probewright::control {

/// What happens when a program waits for NC start.
enum class OnStop { Continue, Abort, Ask };

/// What a cycle wants to know from the operator.
struct Question {
  std::string name;                                    ///< as a list of answers has it: "1410 point 1"
  std::string wanted;                                  ///< what an answer consists of
  std::function<bool(const std::string&)> understood;  ///< whether a text is such an answer
};

/// Messages, stops and files that a program and its cycles leave for the operator.
class OperatorPanel {
public:
  explicit OperatorPanel(Journal& journal) : journal_(journal) {}

  OnStop onStop = OnStop::Continue;
  DialogLanguage language = DialogLanguage::English;
  /// Results are shown even where the program and the control's settings don't ask for it.
  bool showAllResults = false;
  /// Asked at a stop when onStop is Ask: shows the text, returns true to go on.
  std::function<bool(const std::string& text)> ask;
  /// Asked where a semi-automatic cycle is to probe: nothing means that there is no answer.
  std::function<std::optional<std::string>(const Question& question)> answer;

  /// Where the program stands now; kept up to date by the interpreter's host.
  SourcePlace place;

  void message(EventKind kind, std::string text, double seconds, std::string code = {}) {
    journal_.event({kind, place, std::move(code), std::move(text), seconds});
  }

  /// The program waits here. Throws Cancelled if it is not to go on.
  void stop(const std::string& text, double seconds);

  /// Why the run cannot leave a file of this name: the reason, and the way out; nothing if it can.
  std::function<std::optional<Diagnostic>(const std::string& name)> whyNoFile;

  /// A text file that the control writes beside the program. `name` has no folder. Files are gathered here and written
  /// by whoever runs the program. An Alarm if no file can have that name.
  void file(const std::string& name, std::string text);
  void appendToFile(const std::string& name, const std::string& text);
  const std::map<std::string, std::string>& files() const { return files_; }

private:
  std::string& fileCalled(const std::string& name);

  Journal& journal_;
  std::map<std::string, std::string> files_;
};

}  // namespace probewright::control
