#include "language/sinumerik/statement_kinds.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace probewright::language::sinumerik {

namespace {

template <class Kind, std::size_t count>
std::optional<Kind> kindNamed(const std::array<std::pair<std::string_view, Kind>, count>& kinds,
                              std::string_view name) {
  const auto found = std::ranges::find(kinds, name, &std::pair<std::string_view, Kind>::first);
  return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

using NamedModal = std::pair<std::string_view, ModalKind>;
constexpr std::array modals = {
    NamedModal{"F", ModalKind::Feed},
    NamedModal{"S", ModalKind::SpindleSpeed},
    NamedModal{"H", ModalKind::AuxiliaryFunction},
    NamedModal{"D", ModalKind::CuttingEdge},
    NamedModal{"DIAMON", ModalKind::DiameterOn},
    NamedModal{"DIAM90", ModalKind::DiameterIfAbsolute},
    NamedModal{"DIAMOF", ModalKind::DiameterOff},
    NamedModal{"DIAMCYCOF", ModalKind::DiameterOff},
    NamedModal{"TRAORI", ModalKind::TransformationOn},
    NamedModal{"TRAFOOF", ModalKind::TransformationOff},
    NamedModal{"ORIEULER", ModalKind::OrientationEuler},
    NamedModal{"ORIRPY", ModalKind::OrientationRpy},
    NamedModal{"ORIRPY2", ModalKind::OrientationRpyFromX},
    NamedModal{"TOROT", ModalKind::TurnFrameToTool},
    NamedModal{"TOROTZ", ModalKind::TurnFrameToTool},
    NamedModal{"TOFRAME", ModalKind::PutFrameOnTool},
    NamedModal{"TOFRAMEZ", ModalKind::PutFrameOnTool},
    NamedModal{"TOROTOF", ModalKind::FrameOfToolOff},
};

using NamedChange = std::pair<std::string_view, FrameChange>;
constexpr std::array changes = {
    NamedChange{"TRANS", FrameChange::Shift},       NamedChange{"ATRANS", FrameChange::Shift},
    NamedChange{"ROT", FrameChange::Turn},          NamedChange{"AROT", FrameChange::Turn},
    NamedChange{"ROTS", FrameChange::TurnInSpace},  NamedChange{"AROTS", FrameChange::TurnInSpace},
    NamedChange{"CROTS", FrameChange::TurnInSpace}, NamedChange{"SCALE", FrameChange::Scale},
    NamedChange{"ASCALE", FrameChange::Scale},      NamedChange{"MIRROR", FrameChange::Mirror},
    NamedChange{"AMIRROR", FrameChange::Mirror},
};

/// However many zeros are written before it.
std::optional<FrameChange> changeByG(int number) {
  switch (number) {
    case 58:
      return FrameChange::CoarseShift;
    case 59:
      return FrameChange::FineShift;
    case 110:
      return FrameChange::PoleFromLastPosition;
    case 111:
      return FrameChange::PoleFromZero;
    case 112:
      return FrameChange::PoleFromPole;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<int> gFunction(std::string_view name) {
  int number = 0;
  if (name.size() < 2 || name[0] != 'G') return std::nullopt;
  const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return number;
}

ModalKind modalKind(std::string_view name) {
  if (gFunction(name)) return ModalKind::GFunction;
  return kindNamed(modals, name).value_or(ModalKind::Other);
}

FrameChange frameChange(std::string_view name) {
  const std::optional<int> number = gFunction(name);
  const auto change = number ? changeByG(*number) : kindNamed(changes, name);
  if (!change) throw std::logic_error(std::string(name) + " changes no frame");
  return *change;
}

}  // namespace probewright::language::sinumerik
