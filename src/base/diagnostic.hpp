#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <vector>

/// What the program tells a user about something the user wrote: a program, a table, a setup, a command line.
namespace probewright {

/// A place in a text. Lines and columns count from 1; 0 means "not known". Columns count bytes.
struct SourcePlace {
  std::string file;
  std::uint64_t line = 0;
  std::uint32_t column = 0;
};

enum class Severity { Note, Warning, Error };

/// One message: where, what stands there, what is wrong and what to do about it.
struct Diagnostic {
  Severity severity = Severity::Error;
  SourcePlace place;
  std::string message;  ///< one sentence without a full stop: what is wrong or was expected
  std::string excerpt;  ///< the offending text as it is in the file; may be empty
  std::string advice;   ///< the way out; may be empty
  std::string code;     ///< the control's own alarm number or error name where there is one
};

/// A value, or the one reason why there is none. Functions that can report several mistakes fill a Diagnostics instead.
template <class T>
using Result = tl::expected<T, Diagnostic>;

using Diagnostics = std::vector<Diagnostic>;

/// An error at `place`, for `return fail(...)` out of a function that returns a Result.
tl::unexpected<Diagnostic> fail(SourcePlace place, std::string message, std::string advice = {});
tl::unexpected<Diagnostic> fail(std::string message, std::string advice = {});

/// True if any of the diagnostics is an error.
bool hasErrors(const Diagnostics& diagnostics);

/// `file:line:column: error: code: message`, then the excerpt and the advice on lines of their own, as compilers print
/// it.
std::string format(const Diagnostic& diagnostic);

}  // namespace probewright
