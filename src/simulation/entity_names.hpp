#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <utility>

#include "simulation/cad_transfer.hpp"
#include "simulation/step_text.hpp"

namespace probewright::simulation {

inline int numberIn(std::string_view text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// What the entities of a file are called, and where they stand.
class EntityNames {
public:
  EntityNames(CadFormat format, StepText text, std::string_view bytes) : text_(std::move(text)) {
    if (format != CadFormat::Iges) return;
    // The directory has two lines an entity; column 73 names the section.
    for (std::size_t at = 0; at < bytes.size(); ++firstDirectoryLine_) {
      if (at + 72 < bytes.size() && bytes[at + 72] == 'D') break;
      at = std::min(bytes.find('\n', at), bytes.size() - 1) + 1;
    }
  }

  std::uint64_t lineOf(std::string_view label) const {
    if (label.size() < 2) return 0;
    const auto number = static_cast<std::uint64_t>(std::max(0, numberIn(label.substr(1))));
    if (label.front() == 'D') return number == 0 ? 0 : firstDirectoryLine_ + number - 1;
    const auto found = text_.entities.find(number);
    return found == text_.entities.end() ? 0 : found->second.line;
  }

  /// "#123 ADVANCED_FACE"; "the directory entry D123".
  std::string nameOf(std::string_view label) const {
    if (label.starts_with('D')) return fmt::format("the directory entry {}", label);
    const auto found = text_.entities.find(static_cast<std::uint64_t>(std::max(0, numberIn(label.substr(1)))));
    if (found == text_.entities.end() || found->second.type.empty()) return std::string(label);
    return fmt::format("{} {}", label, found->second.type);
  }

  /// What the text itself shows to be wrong: an entity and why; the label is empty if there is nothing.
  std::pair<std::string, std::string> wrongInText() const {
    if (const std::uint64_t circular = circularEntity(text_); circular != 0)
      return {fmt::format("#{}", circular), "it refers to itself, directly or through others"};
    if (text_.dangling != 0)
      return {fmt::format("#{}", text_.dangling), fmt::format("it refers to #{}, which is not there", text_.missing)};
    return {};
  }

  /// True if the file holds triangles in place of exact surfaces, as AP242 can.
  bool holdsOnlyTriangles() const {
    const auto any = [&](auto test) {
      return std::ranges::any_of(text_.entities, [&](const auto& entity) { return test(entity.second.type); });
    };
    const bool triangles = any([](std::string_view type) { return type.ends_with("TRIANGULATED_FACE"); });
    return triangles && !any([](std::string_view type) { return type == "ADVANCED_FACE" || type == "FACE_SURFACE"; });
  }

private:
  StepText text_;
  std::uint64_t firstDirectoryLine_ = 1;
};

}  // namespace probewright::simulation
