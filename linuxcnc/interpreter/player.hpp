// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine_process.hpp"
#include "mill.hpp"

/// Plays the machine orders of an engine as canonical commands, in the rhythm in which LinuxCNC asks an interpreter for
/// blocks: read() takes in the next order, execute() carries it out.
///
/// Moves are answered as soon as they are queued, so that LinuxCNC can look ahead. Every other order first waits until
/// the axes stand, and is answered when it has ended.
class Player {
public:
  /// What LinuxCNC is to do next.
  enum class Next {
    GoOn,   ///< ask for the next block
    Wait,   ///< until the axes stand
    Ended,  ///< the program has run to its end
    Failed  ///< it has stopped with an alarm: see message()
  };
  /// Why LinuxCNC has stopped by itself.
  enum class Stop { ByOperator, EmergencyStop, SwitchedOff, Fault };

  /// `setTables` carries out blocks of G-code that set zero offsets and tools: why it cannot, or nothing.
  explicit Player(std::function<std::string(const Mill& mill, const EngineProcess::Json& tables)> setTables)
      : setTables_(std::move(setTables)) {}

  /// Starts the engine with the program; `line` above 1: from that line on. The configuration says which engine, with
  /// which beliefs, and where to leave its output: [PROBEWRIGHT] PROGRAM, CONTROL (or SETUP), OUT, ANSWERS.
  bool start(const std::string& iniFile, const std::string& program, int line);
  bool playing() const { return playing_; }

  Next read();
  Next execute();
  /// LinuxCNC has stopped: what is under way ends so, and the engine writes what it has measured. Nobody waits for it:
  /// attend() does the rest.
  void stop(Stop why);
  /// In every cycle of LinuxCNC: tells a waiting engine that we are alive, answers one that is coming to its end.
  /// The control's alarm, once, when a program that was stopped has written its results.
  std::optional<std::string> attend();
  const std::string& message() const { return message_; }
  /// The line of the program that the last order belongs to.
  int line() const { return line_; }

private:
  using Json = EngineProcess::Json;

  /// Seconds of a clock that never goes back.
  static double now();
  /// The answer to an order that needs no motion of its own; nothing: it does.
  std::optional<Json> atOnce(const Json& order);
  /// Once the axes stand: the answer if the order cannot begin.
  std::optional<Json> refusal(const Json& order);
  void perform(const Json& order);
  /// Whether what perform() has begun has come about; false too of an order that has been stopped.
  bool arrived(const Json& order) const;
  /// Once what perform() has begun has ended.
  Json outcome(const Json& order);
  struct Piece {
    Mill::Position target;
    std::optional<double> feed;  ///< per minute; nothing: rapid
    int line = 0;
  };
  std::vector<Piece> pieces(const Json& order, Json& answer) const;
  void queueNext();
  /// Takes in ways that have come while another is queued, so that the engine works out what follows meanwhile.
  void lookAhead();
  void answerAndQueue();
  /// The answer to an order after LinuxCNC has stopped.
  Json stopped(const Json& order);
  void answer(Json json);
  /// Takes in what the order tells beside what it orders.
  void note();
  Next finish();
  /// Opens the window that puts the question of `order_` to the operator.
  void askWithWindow();
  /// Once it has closed: what was answered.
  std::optional<Json> replied();

  enum class Stage {
    Idle,     ///< no order has come yet
    Motion,   ///< `order_` is a move
    Drain,    ///< `order_` waits for the axes to stand
    Perform,  ///< they do
    Pending   ///< it has been begun
  };
  std::function<std::string(const Mill& mill, const Json& tables)> setTables_;
  Mill mill_;
  std::optional<EngineProcess> engine_;
  std::optional<EngineProcess> window_;  ///< while the operator is asked
  std::string windowProgram_;            ///< empty: there is no screen to open it on
  bool playing_ = false;
  bool settled_ = false;  ///< the axes have stood since the program began: offsets and the probe are known
  bool queued_ = false;   ///< moves have been answered that may not have ended
  bool gone_ = false;     ///< the engine has died while LinuxCNC was busy
  std::optional<Stop> stopped_;
  bool signalled_ = false;  ///< with `stopped_`: the probe was deflected
  bool told_ = false;       ///< with `stopped_`: an order was answered so
  std::string detail_;      ///< with `stopped_`: what has happened
  Stage stage_ = Stage::Idle;
  Json order_;
  std::vector<Piece> way_;                ///< of the last move or path
  std::size_t queuedPieces_ = 0;          ///< how many of them LinuxCNC has
  std::deque<std::vector<Piece>> ahead_;  ///< ways after that one, which have been answered
  std::optional<Json> next_;              ///< an order after them, which has not
  std::vector<std::string> messages_;     ///< to be shown to the operator
  Mill::Position at_;                     ///< where the axes stand, or are going to
  Json spindle_ = {{"rotation", "none"}, {"speed", 0}, {"angle", 0}};
  double begun_ = 0, alive_ = 0;
  std::optional<double> ended_;    ///< when the engine closed its socket
  std::optional<double> lingers_;  ///< since when `order_` seems to have ended without having come about
  int line_ = 0;
  std::string message_;
};
