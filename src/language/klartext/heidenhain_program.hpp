#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "language/program.hpp"

namespace probewright::language::klartext {

enum class Unit { Millimetre, Inch };

/// What a block is in the frame of its program.
enum class FramePart {
  Nothing,    ///< empty, a comment, a structure item
  Statement,  ///< anything between beginning and end
  Begin,      ///< BEGIN PGM, %NAME G71
  End,        ///< END PGM, N99999999 %NAME G71
};

/// How a language writes what messages about a whole program name.
struct FrameWords {
  std::string_view begin;       ///< "BEGIN PGM"
  std::string_view beginBlock;  ///< "BEGIN PGM NAME MM"
  std::string_view end;
  std::string_view endBlock;
  std::string_view label;  ///< "LBL "
};

/// What a block must not have because of the blocks before it.
struct ModalMistake {
  Word word;
  std::string message, advice;
};

/// A program of a HEIDENHAIN control, in Klartext or DIN/ISO: what the host and the check have to know of it.
class HeidenhainProgram : public Program {
public:
  /// The unit of the program's head; millimetres where there is none.
  virtual Unit unit() const = 0;
  /// True if the block at `position`, or the first after comments there, rounds or chamfers the corner before it.
  virtual bool cornerFollows(BlockPosition position) const = 0;
  /// A block of this program.
  virtual FramePart framePart(const Block& block) const = 0;
  virtual const FrameWords& frameWords() const = 0;
  /// The mistake in a block under the modal functions of those before it, where these are known without a run: after a
  /// label or a call they are not. To be asked for every block in the order of the program, from the first on.
  virtual std::optional<ModalMistake> modalMistake(const Block&) { return std::nullopt; }
};

}  // namespace probewright::language::klartext
