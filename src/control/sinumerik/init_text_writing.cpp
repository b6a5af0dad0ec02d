#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "control/sinumerik/init_text.hpp"
#include "control/sinumerik/text.hpp"

/// The text with new values: what did not change stays as it was, to the byte.
namespace probewright::control::sinumerik {

std::set<DataKey> InitText::keys() const {
  std::set<DataKey> keys;
  for (const Assignment& assignment : assignments_)
    for (const auto& [key, value] : assignment.values)
      keys.insert(key);
  return keys;
}

std::string InitText::bytes() const {
  std::string bytes;
  for (const std::string& line : lines_)
    bytes += line;
  return bytes;
}

Result<std::string> InitText::updated(const DataStore& store, const Accepts& accepts) const {
  // The last assignment of a datum is the one that counts.
  std::map<DataKey, std::size_t> owner;
  for (std::size_t i = 0; i < assignments_.size(); ++i) {
    for (const auto& [key, value] : assignments_[i].values)
      owner[key] = i;
  }
  for (const DataKey& key : store.keys()) {
    const auto value = store.get(key);
    const std::string* text = value ? std::get_if<std::string>(&*value) : nullptr;
    const bool unprintable = text && std::any_of(text->begin(), text->end(), [](char c) {
                               return c == '"' || static_cast<unsigned char>(c) < 0x20;
                             });
    if (unprintable) {
      return fail(
          fmt::format("the text of {} cannot be written: it holds a quotation mark or a control character", key.text()),
          "use plain text");
    }
  }

  std::vector<std::string> lines = lines_;
  for (std::size_t i = assignments_.size(); i-- > 0;) {
    const Assignment& assignment = assignments_[i];
    auto values = assignment.values;
    bool changed = false;
    for (auto& [key, value] : values) {
      if (owner.at(key) != i) continue;
      const auto now = store.get(key);
      if (!now || *now == value) continue;
      value = *now;
      changed = true;
    }
    if (!changed) continue;
    std::string text;
    if (assignment.form == Form::FrameChain) {
      Frame frame;
      for (const auto& [key, value] : values) {
        const double number = std::holds_alternative<bool>(value)     ? (std::get<bool>(value) ? 1.0 : 0.0)
                              : std::holds_alternative<double>(value) ? std::get<double>(value)
                                                                      : 0.0;
        frame.set(key.indices[key.indices.size() - 2], *framePartOf(key.indices.back()), number);
      }
      text = frameExpression(frame);
    } else {
      for (const auto& [key, value] : values) {
        if (!text.empty()) text += ',';
        text += valueText(value);
      }
      if (assignment.form == Form::List) text = fmt::format("SET({})", text);
    }
    lines[assignment.line].replace(assignment.begin, assignment.end - assignment.begin, text);
  }

  std::vector<DataKey> added = store.keys();
  std::erase_if(added, [&](const DataKey& key) { return owner.contains(key) || (accepts && !accepts(key)); });
  const bool windows = !lines.empty() && lines.front().ends_with("\r\n");
  const std::string_view lineEnd = windows ? "\r\n" : "\n";
  // A byte order mark stays before everything, new data included.
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  std::string bytes;
  if (!lines.empty() && lines.front().starts_with(mark)) {
    bytes = mark;
    lines.front().erase(0, mark.size());
  }
  const std::size_t head = bytes.size();
  for (std::size_t line = 0; line <= lines.size(); ++line) {
    if (line == insertLine_ && !added.empty()) {
      if (bytes.size() > head && bytes.back() != '\n') bytes += lineEnd;
      if (!newSection_.empty()) bytes.append(newSection_).append(lineEnd);
      for (const DataKey& key : added)
        bytes += fmt::format("{}={}{}", key.text(), valueText(*store.get(key)), lineEnd);
    }
    if (line < lines.size()) bytes += lines[line];
  }
  return bytes;
}

}  // namespace probewright::control::sinumerik
