#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/protocol.hpp"
#include "language/klartext/lexer.hpp"

namespace probewright::execution::klartext {

using control::Alarm;

namespace {

/// Files that the run itself leaves, whatever their case.
bool isOwnFile(std::string_view name) {
  static constexpr std::array<std::string_view, 8> own = {"TOOL.T",      "TCHPROBE.TP", "PRESET.PR",    "TOOLTURN.TRN",
                                                          "AXSHIFT.TAB", "REPORT.HTML", "RESULTS.JSON", "QR.TXT"};
  return std::ranges::any_of(own, [&](std::string_view each) { return std::ranges::equal(each, name, {}, {}, upper); });
}

}  // namespace

void Protocol::send(std::string_view text) {
  const std::size_t open = text.find('"');
  const std::size_t close = text.rfind('"');
  if (open == std::string_view::npos || close == open) {
    run_.message(fmt::format("FN38 {}", text));
    return;
  }
  std::string mask(text.substr(open, close + 1 - open));
  for (const char c : text.substr(close + 1))
    mask += c == '/' ? ',' : c;
  const ProtocolResult sent = formatProtocol(
      mask, [&](std::string_view name) { return parameters_.readNamed(name); },
      static_cast<std::int64_t>(run_.machineSeconds()), run_.levels.back().file, control_.panel.language);
  run_.message(fmt::format("FN 38: {}", trimmed(sent.text, lineBlanks)));
}

/// :'QS1' or :'QL3' in a path, also with a colon after it, stands for the value of the parameter.
void Protocol::insertParameters(std::string& text) const {
  for (std::size_t at = text.find(":'Q"); at != std::string::npos; at = text.find(":'Q", at)) {
    const std::size_t end = text.find('\'', at + 2);
    if (end == std::string::npos) {
      throw Alarm("FN 16: file missing", fmt::format("the quotation mark after {} is missing", text.substr(at, 20)),
                  "write the parameter as :'QS1'");
    }
    const Value value = parameters_.readNamed(std::string_view(text).substr(at + 2, end - at - 2));
    const std::string inserted = isText(value) ? std::get<std::string>(value) : formatShortest(std::get<double>(value));
    const std::size_t behind = end + 1 < text.size() && text[end + 1] == ':' ? end + 2 : end + 1;
    text.replace(at, behind - at, inserted);
    at += inserted.size();
  }
}

void Protocol::write(const Command& command, Evaluation& evaluation) {
  std::string text(evaluation.at(command.text));
  insertParameters(text);
  std::erase(text, '"');
  const auto trimmedPart = [&](std::size_t from, std::size_t to) {
    return std::string(trimmed(std::string_view(text).substr(from, to - from), lineBlanks));
  };
  const std::size_t first = text.find('/');
  if (first == std::string::npos) {
    throw Alarm("FN 16: file missing", "FN 16 needs a mask file and a target, separated by /",
                "write FN 16: F-PRINT MASK.A / LOG.TXT");
  }
  // Either path may hold slashes itself: the mask is the shortest beginning that names a file.
  std::size_t slash = first;
  Result<std::string> bytes = run_.readHostFile(trimmedPart(0, first));
  for (std::size_t next = first; !bytes && (next = text.find('/', next + 1)) != std::string::npos;) {
    if (Result<std::string> longer = run_.readHostFile(trimmedPart(0, next))) {
      bytes = std::move(longer);
      slash = next;
    }
  }
  if (!bytes) {
    std::string mask = trimmedPart(0, first);
    if (mask.empty()) mask = trimmedPart(0, text.rfind('/'));
    throw Alarm("FN 16: file missing", fmt::format("the mask file {}: {}", excerptOf(mask), bytes.error().message),
                "put it beside the program, or check how its name is written");
  }
  const std::string target = trimmedPart(slash + 1, text.size());

  const auto read = [&](std::string_view name) { return parameters_.readNamed(name); };
  const ProtocolResult result = formatProtocol(*bytes, read, static_cast<std::int64_t>(run_.machineSeconds()),
                                               run_.levels.back().file, control_.panel.language);
  const std::string device = upperCase(target);
  if (device == "SCLR:") return;  // closes the window of an earlier message
  if (device.starts_with("SCREEN:")) {
    if (!result.text.empty()) run_.message(std::string(trimmed(result.text, lineBlanks)));
    return;
  }
  writeFile(fileOf(target), result);
}

/// The target of FN 16 as a name in the folder of the run.
std::string Protocol::fileOf(const std::string& target) const {
  constexpr std::size_t longestName = 248;  // bytes; file systems take 255
  const std::string name = fileNameOf(target);
  const auto refuseName = [&](std::string reason) {
    throw Alarm("FN 16: file wrong", std::move(reason), "write another name after the / of FN 16");
  };
  if (name.empty()) {
    throw Alarm("FN 16: file missing", "FN 16 has no name of a file after its /",
                "write FN 16: F-PRINT MASK.A / LOG.TXT");
  }
  if (name == "." || name == "..") refuseName(fmt::format("{} is a folder, not a file", name));
  if (name.size() > longestName) {
    refuseName(fmt::format("The name {}... has {} bytes; a name has at most {}", name.substr(0, 40), name.size(),
                           longestName));
  }
  const bool table = std::ranges::any_of(
      control_.tables.datums, [&](const auto& each) { return std::ranges::equal(each.first, name, {}, upper, upper); });
  if (isOwnFile(name) || table) refuseName(fmt::format("The run writes {} itself", name));
  if (run_.options.isInput && run_.options.isInput(name)) refuseName(fmt::format("{} is read by this run", name));
  return name;
}

/// A file that stands open goes on; one that was closed, or comes from an earlier program, begins anew unless the mask
/// says otherwise.
void Protocol::writeFile(const std::string& name, const ProtocolResult& result) {
  bool& open = open_[name];
  const auto written = control_.panel.files().find(name);
  const std::size_t size = written == control_.panel.files().end() ? 0 : written->second.size();
  const bool full = result.mostBytes > 0 && size + result.text.size() > result.mostBytes;
  const bool goesOn =
      result.going == ProtocolResult::Going::Append || (open && result.going == ProtocolResult::Going::AsOpen);
  if (full) {
    run_.message(fmt::format("FN 16: {} has reached the size that M_APPEND_MAX allows", name));
  } else if (goesOn) {
    control_.panel.appendToFile(name, result.text);
  } else {
    control_.panel.file(name, result.text);
  }
  open = !result.close;
}

void Protocol::print(std::string_view text) {
  if (control_.isTNC640()) {
    run_.message(fmt::format("FN 15: {}", text));
    return;
  }
  const auto numberText = [](double number) {
    std::string written = formatSigned(number, 4);
    written.erase(written.find_last_not_of('0') + 1);
    if (written.ends_with('.')) written.pop_back();
    std::ranges::replace(written, '.', ',');
    return written;
  };
  std::string line;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    std::string_view item = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    item = trimmed(item, blanksAndReturn);
    if (item.empty()) continue;
    const auto number = parseDecimal(item.starts_with('+') ? item.substr(1) : item);
    if (!number && upper(item.front()) != 'Q' && !item.starts_with("+Q")) {
      throw Alarm("FN 15: value wrong", fmt::format("{} is neither a number nor a Q parameter", excerptOf(item)),
                  "write FN 15: PRINT Q5/Q6");
    }
    const Value value = number ? Value(*number) : parameters_.readNamed(item);
    line.append(line.empty() ? "" : "  ");
    line += isText(value) ? std::get<std::string>(value) : numberText(std::get<double>(value));
  }
  control_.panel.appendToFile("%FN15RUN.A", line + "\n");
}

}  // namespace probewright::execution::klartext
