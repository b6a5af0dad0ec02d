#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "conversion/call.hpp"
#include "conversion/job.hpp"
#include "execution/sinumerik/user_variables.hpp"
#include "language/klartext/heidenhain_program.hpp"
#include "language/sinumerik/program.hpp"

/// Programs of one vendor in the language of the other. What is measured, corrected and driven is kept;
/// docs/conversion.md says which cycle becomes which, and what differs.
namespace probewright::conversion {

/// A program written in another language.
struct Conversion {
  std::string text;
  /// Blocks that cannot be read. With any of them `text` is not a program.
  Diagnostics mistakes;
  /// What the other language cannot say; it stands as a comment in `text`. And blocks that mean what the translation
  /// says only under a condition that the message names.
  Diagnostics notCarriedOver;
  /// Between Klartext and DIN/ISO: for each line of `text` the block that it comes from.
  std::vector<language::BlockPosition> origins;
};

/// `job`: of the program; null if nothing is known of others. `probe`: of the HEIDENHAIN control.
Conversion toSinumerik(language::klartext::HeidenhainProgram& program, const Job* job = nullptr,
                       const TouchProbe& probe = {});

/// Global user data of a SINUMERIK with their values, by name in capitals.
using GlobalData = execution::sinumerik::UserVariables::Scope;
/// `globalData`: what the program may use without defining it; null if nothing is known of its control. `control`: the
/// HEIDENHAIN control to write for.
Conversion toKlartext(language::sinumerik::SinumerikProgram& program, const GlobalData* globalData = nullptr,
                      control::ControlKind control = control::ControlKind::TNC640, const Job* job = nullptr,
                      const TouchProbe& probe = {});

}  // namespace probewright::conversion
