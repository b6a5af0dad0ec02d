#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace probewright::control {

/// The controls that programs are written for; session/control_family.hpp says of which family they are. SINUMERIK 828D
/// runs the same measuring cycles as the 840D sl.
enum class ControlKind : std::uint8_t { TNC640, iTNC530, Sinumerik840Dsl };

inline constexpr std::array allControlKinds = {ControlKind::TNC640, ControlKind::iTNC530, ControlKind::Sinumerik840Dsl};

/// "TNC640", "iTNC530", "840Dsl".
constexpr std::string_view name(ControlKind kind) {
  switch (kind) {
    case ControlKind::TNC640:
      return "TNC640";
    case ControlKind::iTNC530:
      return "iTNC530";
    case ControlKind::Sinumerik840Dsl:
      break;
  }
  return "840Dsl";
}

/// A set of controls.
struct ControlSet {
  std::uint8_t bits = 0;
  constexpr bool contains(ControlKind kind) const { return (bits >> static_cast<unsigned>(kind) & 1U) != 0; }
  static constexpr ControlSet of(ControlKind kind) {
    return {static_cast<std::uint8_t>(1U << static_cast<unsigned>(kind))};
  }
  constexpr ControlSet operator|(ControlSet other) const { return {static_cast<std::uint8_t>(bits | other.bits)}; }
};

inline constexpr ControlSet onTNC640 = ControlSet::of(ControlKind::TNC640);
inline constexpr ControlSet onITNC530 = ControlSet::of(ControlKind::iTNC530);
inline constexpr ControlSet onBothTNC = onTNC640 | onITNC530;
inline constexpr ControlSet onSinumerik = ControlSet::of(ControlKind::Sinumerik840Dsl);

}  // namespace probewright::control
