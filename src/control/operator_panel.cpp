#include "control/operator_panel.hpp"

#include "control/alarm.hpp"

namespace probewright::control {

void OperatorPanel::stop(const std::string& text, double seconds) {
  message(EventKind::Stop, text, seconds);
  if (onStop == OnStop::Continue) return;
  if (onStop == OnStop::Ask && ask && ask(text)) return;
  throw Cancelled();
}

std::string& OperatorPanel::fileCalled(const std::string& name) {
  constexpr std::size_t longestName = 248;  // bytes; leaves room within the 255 of file systems
  if (const auto known = files_.find(name); known != files_.end()) return known->second;
  const auto refuse = [&](const std::string& why, const std::string& advice) -> std::string& {
    throw Alarm({}, "The file \"" + name.substr(0, 80) + "\" cannot be written: " + why, advice);
  };
  if (name.empty() || name == "." || name == ".." || name.find_first_of(std::string_view("/\\\0", 3)) != name.npos)
    return refuse("this is not the name of a file", "give it another name");
  if (name.size() > longestName) return refuse("its name has more than 248 bytes", "give it a shorter name");
  if (whyNoFile) {
    if (const std::optional<Diagnostic> why = whyNoFile(name)) return refuse(why->message, why->advice);
  }
  // A file takes room in folder and disk, and time to write, however short it is.
  constexpr std::uint64_t leastBytes = 16384;
  journal_.charge(leastBytes);
  return files_[name];
}

void OperatorPanel::file(const std::string& name, std::string text) {
  std::string& known = fileCalled(name);
  if (text.size() > known.size()) journal_.charge(text.size() - known.size());
  known = std::move(text);
}

void OperatorPanel::appendToFile(const std::string& name, const std::string& text) {
  std::string& known = fileCalled(name);
  journal_.charge(text.size());
  known += text;
}

}  // namespace probewright::control
