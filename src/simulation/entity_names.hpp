#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/text.hpp"
#include "simulation/cad_transfer.hpp"
#include "simulation/step_text.hpp"

namespace probewright::simulation {

inline int numberIn(std::string_view text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// What OpenCASCADE says of an entity, in words that can be read.
inline std::string plainReason(const std::string& kernels) {
  static const std::array<std::pair<std::regex, const char*>, 9> kRules{{
      {std::regex("Unknown message invoked with the keyword .*"), "it cannot be read"},
      {std::regex("Set to empty string : "), ""},
      {std::regex("Parameter n0\\.([0-9]+) \\(([^()]*)\\)( :)? ?"), "parameter $1 ($2): "},
      {std::regex("Parameter Data : parameter %d \\(([^()]*)\\) is"), "its parameter $1 is"},
      {std::regex("Directory Entry : "), ""},
      {std::regex("[ (]*%[ds][)]*"), ""},
      {std::regex(" Process continues\\."), ""},
      {std::regex("Entity has illegal type"), "what it refers to is missing or of another type"},
      {std::regex("[ .]+$"), ""},
  }};
  std::string reason = kernels;
  for (const auto& [pattern, words] : kRules)
    reason = std::regex_replace(reason, pattern, words);
  return reason;
}

/// What the entities of a file are called, and where they stand.
class EntityNames {
public:
  EntityNames(CadFormat format, StepText text, std::string_view bytes) : format_(format), text_(std::move(text)) {
    if (format != CadFormat::Iges) return;
    // The directory has two lines an entity; column 73 names the section.
    std::uint64_t number = 1;
    for (std::size_t at = 0; at < bytes.size(); ++number) {
      const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
      const std::string_view line = bytes.substr(at, end - at);
      at = end + 1;
      if (line.size() <= 72) continue;
      if (line[72] == 'D') {
        if (firstDirectoryLine_ == 0) firstDirectoryLine_ = number;
        if ((number - firstDirectoryLine_) % 2 == 0) igesTypes_.insert(numberIn(trimmed(line.substr(0, 8))));
      } else if (line[72] == 'P' && line[64] != ' ' && overlongLine_ == 0) {
        overlongLine_ = number;
      }
    }
  }

  std::uint64_t lineOf(std::string_view label) const {
    if (label.size() < 2) return 0;
    const auto number = static_cast<std::uint64_t>(std::max(0, numberIn(label.substr(1))));
    if (label.front() == 'D') return number == 0 || firstDirectoryLine_ == 0 ? 0 : firstDirectoryLine_ + number - 1;
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

  /// True if nothing in the file can be a face of a part: drawings, wire frames, finite elements, empty assemblies.
  bool holdsNoFace() const {
    if (format_ == CadFormat::Iges) {
      return !igesTypes_.empty() && std::ranges::none_of(igesTypes_, [](int type) {
        constexpr std::array kSurfaces{108, 114, 118, 120, 122, 128, 140, 143, 144};
        return std::ranges::find(kSurfaces, type) != kSurfaces.end() || (type >= 150 && type < 200) || type == 430 ||
               (type >= 500 && type < 520);
      });
    }
    return std::ranges::none_of(text_.entities, [](const auto& entity) {
      const std::string_view type = entity.second.type;
      return type.ends_with("_FACE") || type == "FACE" || type.starts_with("FACE_") ||
             type.find("SHELL") != type.npos || type.find("BREP") != type.npos ||
             type.find("SURFACE_MODEL") != type.npos || type == "GEOMETRIC_SET";
    });
  }

  /// True if the file makes its bodies of other bodies, cut and joined.
  bool holdsConstructions() const {
    return std::ranges::any_of(text_.entities, [](const auto& entity) {
      return entity.second.type == "BOOLEAN_RESULT" || entity.second.type == "CSG_SOLID";
    });
  }

  /// The first line of an IGES file whose parameters go on where there is no place for them; 0: none.
  std::uint64_t overlongLine() const { return overlongLine_; }

  /// True if the file holds triangles in place of exact surfaces, as AP242 can.
  bool holdsOnlyTriangles() const {
    const auto any = [&](auto test) {
      return std::ranges::any_of(text_.entities, [&](const auto& entity) { return test(entity.second.type); });
    };
    const bool triangles = any([](std::string_view type) { return type.ends_with("TRIANGULATED_FACE"); });
    return triangles && !any([](std::string_view type) { return type == "ADVANCED_FACE" || type == "FACE_SURFACE"; });
  }

private:
  CadFormat format_;
  StepText text_;
  std::uint64_t firstDirectoryLine_ = 0;
  std::uint64_t overlongLine_ = 0;
  std::set<int> igesTypes_;
};

}  // namespace probewright::simulation
