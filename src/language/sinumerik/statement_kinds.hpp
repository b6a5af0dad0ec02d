#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "language/block.hpp"

/// Kinds of the statements whose blocks carry the word of the program: parsers write the word, hosts visit all kinds.
/// Those of commands are in commands.hpp.
namespace probewright::language::sinumerik {

/// What a modal word is: a G function, a word with a value, a function by name.
enum class ModalKind : std::uint8_t {
  GFunction,            ///< G and a number
  Feed,                 ///< F
  SpindleSpeed,         ///< S
  AuxiliaryFunction,    ///< H
  CuttingEdge,          ///< D
  DiameterOn,           ///< DIAMON
  DiameterIfAbsolute,   ///< DIAM90
  DiameterOff,          ///< DIAMOF, DIAMCYCOF
  TransformationOn,     ///< TRAORI
  TransformationOff,    ///< TRAFOOF
  OrientationEuler,     ///< ORIEULER: A2, B2, C2 are Euler angles
  OrientationRpy,       ///< ORIRPY: about Z first
  OrientationRpyFromX,  ///< ORIRPY2: about X first
  TurnFrameToTool,      ///< TOROT, TOROTZ
  PutFrameOnTool,       ///< TOFRAME, TOFRAMEZ
  FrameOfToolOff,       ///< TOROTOF
  Other,  ///< words that say nothing about where the tool goes, or are named because they do (keywords.hpp: Effect)
};

/// The kind of the modal word `name` (upper case).
ModalKind modalKind(std::string_view name);
inline ModalKind kindOf(const Block& block, const Modal& modal) { return modalKind(block.at(modal.name)); }

/// The number of a G function; nothing if the word is none.
std::optional<int> gFunction(std::string_view name);

/// What a change of the coordinates does to the frame of the program. TRANS and the like replace it, ATRANS and the
/// like are added to it.
enum class FrameChange : std::uint8_t {
  PoleFromLastPosition,  ///< G110
  PoleFromZero,          ///< G111
  PoleFromPole,          ///< G112
  CoarseShift,           ///< G58
  FineShift,             ///< G59
  Shift,                 ///< TRANS, ATRANS
  Turn,                  ///< ROT, AROT
  TurnInSpace,           ///< ROTS, AROTS, CROTS
  Scale,                 ///< SCALE, ASCALE
  Mirror,                ///< MIRROR, AMIRROR
};

/// The change that the word `name` (upper case) stands for.
FrameChange frameChange(std::string_view name);
inline FrameChange kindOf(const Block& block, const Transform& transform) {
  return frameChange(block.at(transform.name));
}

}  // namespace probewright::language::sinumerik
