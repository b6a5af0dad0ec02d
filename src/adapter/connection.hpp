#pragma once

#include <memory>
#include <string>

#include "adapter/line_stream.hpp"
#include "base/diagnostic.hpp"

namespace probewright::adapter {

/// A way to an adapter, and who is at its end: what is destroyed after the stream has been closed, such as a program
/// that was started and is to be waited for. Null: that is not ours to end.
struct Connection {
  std::shared_ptr<void> peer;
  LineStream stream;
};

/// Opens the way to the adapter that `where` names:
/// - "fd:3": the open socket that whoever started this program has left;
/// - a path with a / at which a socket of the local machine is: connects to it;
/// - else a command, its words separated by blanks: starts the program with the socket as its standard input and
///   output. "linuxcnc" is the command `probewright-linuxcnc`. Programs are looked for in the folder of this program,
///   then in $PATH.
Result<Connection> connect(const std::string& where);

}  // namespace probewright::adapter
