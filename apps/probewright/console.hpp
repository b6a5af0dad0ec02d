#pragma once

#include <string>
#include <string_view>

#include "base/diagnostic.hpp"
#include "language/encoding.hpp"

/// What goes to the terminal. Programs may hold anything: nothing of it may steer the terminal.
namespace probewright::app {

/// The text in UTF-8 and without control characters but the line feed: each is shown as `\xNN`, a tab as a space.
/// Bytes that are not UTF-8 are read in `encoding`.
std::string printable(std::string_view text, language::Encoding encoding = language::Encoding::Windows1252);

/// Writes messages to standard error, each as `format` gives it.
void print(const Diagnostics& diagnostics, language::Encoding encoding = language::Encoding::Windows1252);

/// Writes to standard output what it still holds back. False, with a message on standard error, if anything that was
/// to be written there did not arrive: the disk is full, the reader has gone.
bool outputArrived();

}  // namespace probewright::app
