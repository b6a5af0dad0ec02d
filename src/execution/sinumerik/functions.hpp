#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "control/sinumerik/frame.hpp"
#include "execution/names.hpp"
#include "language/value.hpp"

/// The control's own functions: texts, axes, frames.
namespace probewright::execution::sinumerik {

/// A number as the control puts it into texts: at most ten digits and ten decimal places, no exponent, no zeros at the
/// end.
std::string numberText(double value);

/// The number of an option, a function or a program: rounded, and within int whatever was computed.
int wholeNumber(double value);

/// What functions ask the control.
struct FunctionQuestions {
  std::function<bool(std::string_view name)> isVariable;  ///< ISVAR: a name, perhaps with indices
  std::function<bool(std::string_view name)> isAxis;      ///< a channel axis of that name
  std::function<bool(std::string_view path)> isFile;
  std::function<int(std::string_view name)> toolNumber;  ///< GETT; -1: no such tool
  double frameUnit = 1;                                  ///< mm in one unit of CTRANS and CFINE along geometry axes
};

/// Computes function `name` (upper case). Throws Alarm where the control raises one; std::nullopt if there is no such
/// function.
std::optional<Value> callFunction(std::string_view name, std::span<const Value> arguments,
                                  const FunctionQuestions& questions);

/// SPRINT: %d whole number, %f or %m.nF decimal, %e exponential, %g either, %s text, %x hexadecimal, %b bits, %c
/// character, %% percent. Throws Alarm 14020 if arguments are missing or do not fit.
std::string formatText(std::string_view format, std::span<const Value> arguments);

/// Frames travel through expressions as the text that writes them: "CTRANS(X,10):CROT(Z,30)".
Value frameValue(const control::sinumerik::Frame& frame);
/// Throws Alarm 12150 if `value` is not a frame.
control::sinumerik::Frame frameOf(const Value& value);

}  // namespace probewright::execution::sinumerik
