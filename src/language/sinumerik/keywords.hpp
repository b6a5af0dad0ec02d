#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "language/block.hpp"

/// The reserved words of the language and what kind of statement each begins.
namespace probewright::language::sinumerik {

enum class Keyword : std::uint8_t {
  None,  ///< not reserved: a variable, a label, a program
  If,
  Else,
  EndIf,
  Case,
  For,
  EndFor,
  While,
  EndWhile,
  Loop,
  EndLoop,
  Repeat,
  RepeatBlock,
  Until,
  Goto,  ///< all five forms
  Define,
  IsoCall,   ///< a program of the ISO dialect is called
  Declare,   ///< DEF
  Redefine,  ///< REDEF
  Procedure,
  External,
  Call,
  PathCall,
  ModalCall,
  ExternalCall,
  Return,
  Transform,  ///< TRANS, AROT, ...
  Motion,     ///< CIP, CT: motions that are named, not numbered
  Suppress,   ///< SUPA
  Modal,      ///< a G function with a name: DIAMON, CUT2D, ...; may have arguments: TRAORI(1)
  MoveWord,   ///< CR=, AP=, ...
  Setting,    ///< an address that is assigned to, with an index perhaps: LIMS=, POS[X]=, SPOS=
  Axial,      ///< FINEA[X], FINEA=X: how an axis ends its block
  Measure,    ///< MEAS, MEAW
  Statement,  ///< NAME or NAME(arguments): MSG, SETAL, STOPRE, FGROUP, ...
  SynchronizedAction,
  Reserved,  ///< TO, OF, DEFAULT, AND, ...: never begins a statement
};

/// The kind of `name` (upper case).
Keyword keywordOf(std::string_view name);

/// What Probewright does with a word.
enum class Effect : std::uint8_t {
  CarriedOut,
  Harmless,       ///< it says nothing about where the tool goes: dynamics, display, coordination with other channels
  NotCarriedOut,  ///< it would change where the tool is, or what a program reads: it is named
  Straight,       ///< the way there is another, the end is right: it is named
  AsNorm,         ///< KONT: named
};

/// All reserved words, sorted.
struct KeywordEntry {
  std::string_view name;
  Keyword keyword;
  Effect effect = Effect::CarriedOut;
};
std::span<const KeywordEntry> keywords();
/// The entry of `name` (upper case), or null.
const KeywordEntry* keywordEntry(std::string_view name);

/// A function that expressions know.
struct FunctionEntry {
  std::string_view name;
  language::Function function;
  int fewestArguments;
  int mostArguments;
};
/// The function called `name` (upper case), or null.
const FunctionEntry* functionOf(std::string_view name);
std::span<const FunctionEntry> functions();

/// The types of DEF and of parameters.
enum class Type : std::uint8_t { Int, Real, Bool, Char, String, Axis, Frame };
/// Characters that a STRING can hold.
constexpr int longestString = 400;
/// True and sets `type` if `name` (upper case) names a type.
bool typeOf(std::string_view name, Type& type);
std::string_view typeName(Type type);

/// DAC, DIC, RAC, RIC: values of the transverse axis that are diameters or radii by themselves.
constexpr bool isDimensionFunction(std::string_view name) {
  return name == "DAC" || name == "DIC" || name == "RAC" || name == "RIC";
}

/// True if the control knows G`number`.
bool isGFunction(int number);

/// The name among `candidates` that differs from `name` by at most two typing mistakes; empty if there is none.
std::string_view closestName(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace probewright::language::sinumerik
