#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "adapter/connection.hpp"
#include "adapter/line_queue.hpp"
#include "adapter/protocol.hpp"
#include "base/diagnostic.hpp"
#include "machine/machine.hpp"
#include "machine/own_control.hpp"

namespace probewright::adapter {

/// How long an adapter may say nothing while it works.
struct Patience {
  std::chrono::milliseconds silence{10'000};
};

/// A machine that an adapter plays: another program at the other end of a socket. Every order is one line there and one
/// back (docs/machine-adapters.md).
///
/// When the connection is lost, or the adapter does not keep to the protocol, or says that the machine has failed, the
/// order is Refused and says so; what only tells then tells what was last known. An adapter whose connection is lost
/// stops the axes by itself.
class RemoteMachine final : public machine::Machine, public machine::OwnControl {
public:
  /// Greets the adapter and learns what machine it plays.
  static Result<std::unique_ptr<RemoteMachine>> greet(Connection connection, Patience patience = {});
  ~RemoteMachine() override;

  /// What the adapter calls itself: "LinuxCNC 2.9".
  const std::string& adapterName() const { return adapterName_; }
  /// Why the machine could not go on, if that has happened: an emergency stop, a lost connection.
  const std::optional<std::string>& failure() const { return failure_; }

  /// Whether the adapter moves nothing and feels nothing: it draws what it is told.
  bool draws() const { return draws_; }
  /// Whether the adapter puts questions to the operator; else whoever runs the program does.
  bool asks() const { return asks_; }
  /// Shows the text to the operator and waits: true if the program is to go on.
  bool ask(const std::string& text);

  /// Whether the adapter has the operator answer questions with a text.
  bool answers() const { return answers_; }
  struct Reply {
    std::string text;
    bool cancelled = false;  ///< the program is not to go on
  };
  /// Puts the question `name` to the operator; `wanted` says what an answer consists of. Nothing: there is none.
  std::optional<Reply> answer(const std::string& name, const std::string& wanted);

  /// Where a measuring move was signalled, and with which tool as the control believed it.
  struct Felt {
    machine::AxisPositions latched;
    Vector3 toolVector = Vector3::Zero();
    double toolRadius = 0;
  };
  const std::vector<Felt>& felt() const { return felt_; }

  /// The .ini file of the LinuxCNC that the adapter moves, if it tells one.
  const std::string& configuration() const { return configuration_; }
  /// The chains of a machine with the same axes, of an adapter that tells none. False if its axes are others.
  bool adoptChains(const machine::MachineDescription& machine);

  const machine::OwnTables* tables() const override { return tables_ ? &*tables_ : nullptr; }
  std::optional<std::string> keep(const machine::OwnTables& tables) override;
  void accompany(std::function<machine::OrderPlace()> place) override { place_ = std::move(place); }

  const machine::MachineDescription& description() const override { return description_; }
  void stopOn(std::stop_token stop) override { stop_ = std::move(stop); }
  machine::AxisPositions position() const override;
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override;
  machine::PathResult moveAlong(std::span<const machine::PathPiece> path) override;
  machine::MeasureResult measure(const machine::MeasureOrder& order) override;
  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override;
  bool deflected(machine::Sensor sensor) const override;
  std::string probeSerial() const override;
  machine::MoveResult turnSpindle(machine::Rotation rotation, double speed) override;
  machine::MoveResult orientSpindle(double degrees) override;
  machine::SpindleState spindle() const override;
  bool hasFunction(int number) const override { return functions_.contains(number); }
  machine::FunctionResult function(int number) override;
  machine::ToolChangeResult changeTool(const machine::ToolOrder& order) override;
  machine::WaitEnd dwell(double seconds) override;
  double seconds() const override;

private:
  struct Answer;
  RemoteMachine(Connection connection, Patience patience);

  Answer ask(Json order) const;
  /// What `read` makes of the answer; nothing, and a failure, if there is none or it is not as the protocol says.
  template <class Value>
  std::optional<Value> tells(Json order, const std::function<Value(const Json& answer)>& read) const;
  Answer lose(std::string why) const;
  Answer exchange(Json order) const;
  /// Why a move is not even sent.
  std::optional<machine::MoveResult> refusal(const machine::AxisPositions& target, machine::Feed feed) const;
  machine::MoveResult travel(const char* order, const machine::AxisPositions& target, machine::Feed feed);
  machine::MoveResult moved(Json order);
  machine::PathResult order(std::span<const machine::PathPiece> path);
  /// A line is kept until there are some, or an order of another kind comes. False: it has to be ordered by itself.
  bool keepLine(const machine::AxisPositions& target, machine::Feed feed);
  Json path(const std::vector<double>& numbers) const;
  /// Orders the lines that were kept.
  void sendLines(LineQueue::Next next) const;

  std::shared_ptr<void> peer_;  ///< ends after the stream
  mutable LineStream stream_;
  Patience patience_;
  std::string adapterName_, configuration_;
  machine::MachineDescription description_;
  std::set<int> functions_;
  bool asks_ = false, answers_ = false, draws_ = false, looksAhead_ = false, compact_ = false, tellsChains_ = false;
  std::optional<machine::OwnTables> tables_;
  std::function<machine::OrderPlace()> place_;
  mutable machine::OrderPlace now_;  ///< of the last order
  std::vector<Felt> felt_;
  mutable bool underWay_ = false;  ///< the last order was a line, and the probe was free when it began
  mutable LineQueue lines_;
  mutable std::vector<std::string> messages_;  ///< for the operator, with the next order
  std::stop_token stop_;
  int wake_ = -1;  ///< an event that ends a wait when a stop is asked for
  mutable std::uint64_t lastOrder_ = 0;
  mutable bool lost_ = false;
  mutable std::optional<std::string> failure_;
  mutable machine::AxisPositions at_;
  mutable std::chrono::steady_clock::time_point toldAt_;  ///< when `at_` was
  mutable machine::SpindleState spindle_;
  mutable double seconds_ = 0;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace probewright::adapter
