#include "cycles/heidenhain/call_rules.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "metrology/tolerance.hpp"

namespace probewright::cycles::heidenhain {
namespace {

class Rules {
public:
  Rules(const CycleDefinition& cycle, ControlKind kind, const KnownValue& known)
      : cycle_(cycle), kind_(kind), known_(known) {}

  std::vector<CallMistake> all() {
    transfer();
    alignment();
    control();
    for (const std::uint32_t first : {1100U, 1103U, 1106U})
      actualPosition(first);
    limits();
    return std::move(mistakes_);
  }

private:
  bool has(std::uint32_t address) const { return cycle_.parameter(address) != nullptr; }

  std::optional<double> number(std::uint32_t address) const {
    if (!has(address)) return std::nullopt;
    const std::optional<Argument> value = known_(address);
    return value && !value->isText ? std::optional(value->number) : std::nullopt;
  }

  void add(std::uint32_t parameter, std::string message, std::string advice, Severity severity = Severity::Error) {
    mistakes_.push_back({parameter, severity, std::move(message), std::move(advice)});
  }

  /// Row 0 is the preset set at once; for a row the control must know which table is meant.
  void transfer() {
    const auto row = number(305), target = number(303);
    if (!row || *row == 0 || target != -1) return;
    add(303, fmt::format("Q303 = -1 does not say where row {} is: the cycle is refused", *row),
        "set Q303 to 0 (datum table) or 1 (preset table)");
  }

  void alignment() {
    const auto aligns = number(1126), takesOver = number(1121);
    if (!aligns || *aligns == 0 || takesOver != 0) return;
    add(1126, "Q1126 aligns rotary axes, but Q1121 takes over no rotation", "set Q1121, or Q1126 = 0");
  }

  void control() {
    if (kind_ != ControlKind::iTNC530) return;
    if (cycle_.number == 460 && number(423).value_or(4) > 4) {
      add(423, "Q423 takes four or three touches on the iTNC 530", "enter 4 or 3");
    }
    if (cycle_.number == 403 && number(312) == 0) {
      add(312, "the iTNC 530 does not find the rotary axis itself (Q312 = 0)",
          "name the axis: Q312 = 4 (A), 5 (B) or 6 (C)");
    }
  }

  /// Q1100 to Q1102 and so on: an actual position (@) is in all three axes or in none.
  void actualPosition(std::uint32_t first) {
    int given = 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto value = has(first + i) ? known_(first + i) : std::nullopt;
      if (!value) return;
      if (!value->isText) continue;
      const auto text = metrology::parseDimension(value->text);
      if (!text) return;
      given += text->actual || !text->actualParameter.empty() ? 1 : 0;
    }
    if (given == 0 || given == 3) return;
    add(first, fmt::format("Q{} to Q{} have an actual position (@) in {} of three axes", first, first + 2, given),
        "give it in all three axes or in none");
  }

  void limits() {
    // 427 takes exchanged limits for those of a recess.
    if (cycle_.number == 427) return;
    static constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 5> pairs = {
        {{275, 276}, {277, 278}, {284, 285}, {286, 287}, {288, 289}}};
    for (const auto& [largest, smallest] : pairs) {
      const auto most = number(largest), least = number(smallest);
      if (!most || !least || *most == 0 || *least <= *most) continue;
      add(largest,
          fmt::format("Q{} ({}) is less than Q{} ({}): no part can meet these limits", largest, *most, smallest,
                      *least),
          "exchange them", Severity::Warning);
    }
  }

  const CycleDefinition& cycle_;
  ControlKind kind_;
  const KnownValue& known_;
  std::vector<CallMistake> mistakes_;
};

}  // namespace

std::vector<CallMistake> callMistakes(const CycleDefinition& cycle, ControlKind kind, const KnownValue& known) {
  return Rules(cycle, kind, known).all();
}

ForbiddenTransformations forbiddenTransformations(int cycle) {
  if (cycle == 444 || (cycle >= 1400 && cycle <= 1499)) return {.other = true};
  if (cycle < 400 || cycle > 499 || cycle == 441) return {};
  const bool presets = cycle >= 408 && cycle <= 419;
  return {.shift = true, .rotation = !presets, .other = true};
}

std::string transformationsText(const ForbiddenTransformations& forbidden) {
  if (!forbidden.shift) return "mirror image or scaling is active (cycle 8, 11 or 26)";
  if (!forbidden.rotation) return "datum shift, mirror image or scaling is active (cycle 7, 8, 11 or 26)";
  return "datum shift, mirror image, rotation or scaling is active (cycle 7, 8, 10, 11 or 26)";
}

}  // namespace probewright::cycles::heidenhain
