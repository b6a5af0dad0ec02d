#include "adapter/remote_machine.hpp"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "adapter/latched.hpp"

namespace probewright::adapter {

using machine::AxisPositions;
using machine::Feed;
using machine::FunctionEnd;
using machine::MeasureEnd;
using machine::MoveEnd;
using machine::ToolChangeEnd;

namespace {

constexpr const char* stopped = "a stop was asked for";

/// Axes that the operator jogs between two orders are asked for anew after this time.
constexpr std::chrono::milliseconds freshFor{50};

bool possible(Feed feed) { return feed.rapid || (feed.perMinute > 0 && std::isfinite(feed.perMinute)); }

}  // namespace

/// What came back to an order: the adapter's line, or why there is none.
struct RemoteMachine::Answer {
  Json json;
  std::optional<std::string> failure;
};

RemoteMachine::RemoteMachine(Connection connection, Patience patience)
    : peer_(std::move(connection.peer)),
      stream_(std::move(connection.stream)),
      patience_(patience),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

RemoteMachine::~RemoteMachine() {
  if (wake_ >= 0) close(wake_);
}

Result<std::unique_ptr<RemoteMachine>> RemoteMachine::greet(Connection connection, Patience patience) {
  std::unique_ptr<RemoteMachine> machine(new RemoteMachine(std::move(connection), patience));
  const Answer answer = machine->exchange({{"do", "hello"}, {"protocol", protocolVersion}});
  if (answer.failure) {
    return fail(fmt::format("the machine adapter does not answer: {}", *answer.failure),
                "start the machine's control first; see docs/machine-adapters.md");
  }
  try {
    if (answer.json.contains("end") && text(answer.json, "end") == failed)
      return fail("the machine is not ready: " + optionalText(answer.json, "detail"), "see what it lacks, try again");
    if (number(answer.json, "protocol") != protocolVersion) {
      return fail(fmt::format("the machine adapter speaks version {} of the protocol, this program version {}",
                              number(answer.json, "protocol"), protocolVersion),
                  "install the adapter that belongs to this version of Probewright");
    }
    machine->adapterName_ = text(answer.json, "adapter");
    machine->configuration_ = optionalText(answer.json, "configuration");
    machine->description_ = adapter::description(member(answer.json, "machine"));
    if (answer.json.contains("functions")) {
      for (const Json& function : answer.json.at("functions")) {
        if (!function.is_number_integer()) throw Breach("\"functions\" is not a list of whole numbers");
        machine->functions_.insert(function.get<int>());
      }
    }
    const auto says = [&](const char* name) {
      if (!answer.json.contains(name)) return false;
      if (!answer.json.at(name).is_boolean()) throw Breach(fmt::format("\"{}\" is neither true nor false", name));
      return answer.json.at(name).get<bool>();
    };
    machine->asks_ = says("asks");
    machine->answers_ = says("answers");
    machine->draws_ = says("draws");
    machine->looksAhead_ = says("looksAhead");
    machine->compact_ = says("compact");
    const double joins = answer.json.contains("joins") ? number(answer.json, "joins") : 0;
    machine->lines_ = LineQueue(machine->description_, joins);
    const Json& told = member(answer.json, "machine");
    machine->tellsChains_ = told.contains("tableChain") || told.contains("spindleChain");
    if (answer.json.contains("tables"))
      machine->tables_ = ownTables(answer.json.at("tables"), machine->description_.axes.size());
    machine->at_ = positions(member(answer.json, "position"), machine->description_.axes.size());
    machine->toldAt_ = std::chrono::steady_clock::now();
  } catch (const Breach& breach) {
    return fail(fmt::format("the machine adapter does not keep to the protocol: {}", breach.what()),
                "see docs/machine-adapters.md");
  }
  return machine;
}

RemoteMachine::Answer RemoteMachine::lose(std::string why) const {
  lost_ = true;
  stream_.hangUp();
  failure_ = why;
  return {{}, std::move(why)};
}

RemoteMachine::Answer RemoteMachine::exchange(Json order) const {
  using Clock = std::chrono::steady_clock;
  sendLines(LineQueue::Next::AnotherOrder);
  underWay_ = false;
  if (lost_) return {{}, failure_};
  const std::uint64_t id = ++lastOrder_;
  order["id"] = id;
  if (place_) {
    now_ = place_();
    if (now_.line) order["line"] = *now_.line;
    std::ranges::move(now_.messages, std::back_inserter(messages_));
    if (!messages_.empty()) order["messages"] = std::exchange(messages_, {});
  }
  bool listens = !stop_.stop_requested();
  std::uint64_t rung = 0;
  while (read(wake_, &rung, sizeof rung) > 0) {
  }
  const std::stop_callback onStop(stop_, [this] {
    const std::uint64_t one = 1;
    static_cast<void>(write(wake_, &one, sizeof one) > 0);
  });
  const std::string gone = "the connection to the machine adapter is lost";
  if (!stream_.send(order.dump())) return lose(gone);
  Clock::time_point heard = Clock::now();
  // What may be ordered after a stop (to tell, to stop the spindle) is not stopped by it.
  std::string line;
  while (true) {
    const auto silent = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - heard);
    switch (stream_.receive(line, std::max(patience_.silence - silent, std::chrono::milliseconds(0)),
                            listens ? wake_ : -1)) {
      case LineStream::Got::Line:
        break;
      case LineStream::Got::Woken:
        listens = false;
        if (!stream_.send(Json{{"do", "stop"}, {"order", id}}.dump())) return lose(gone);
        continue;
      case LineStream::Got::Nothing:
        return lose(fmt::format("the machine adapter has said nothing for {} s",
                                std::chrono::duration<double>(patience_.silence).count()));
      case LineStream::Got::Closed:
        return lose(gone);
    }
    heard = Clock::now();
    try {
      Json answer = parseLine(line);
      if (answer.contains("alive")) continue;
      if (member(answer, "id") != Json(id)) throw Breach("it answers an order that was not given");
      if (answer.contains("position") && !description_.axes.empty()) {
        at_ = positions(answer.at("position"), description_.axes.size());
        toldAt_ = heard;
      } else if (order.contains("target") || order.contains("pieces") || order.contains("lines")) {
        toldAt_ = {};
      }
      return {std::move(answer), {}};
    } catch (const Breach& breach) {
      return lose(fmt::format("the machine adapter does not keep to the protocol: {}", breach.what()));
    }
  }
}

/// The answer; an end that says that the machine has failed becomes a failure.
RemoteMachine::Answer RemoteMachine::ask(Json order) const {
  Answer answer = exchange(std::move(order));
  if (answer.failure) return answer;
  try {
    if (answer.json.contains("end") && text(answer.json, "end") == failed) {
      failure_ = optionalText(answer.json, "detail");
      return {{}, failure_};
    }
  } catch (const Breach& breach) {
    return lose(fmt::format("the machine adapter does not keep to the protocol: {}", breach.what()));
  }
  return answer;
}

template <class Value>
std::optional<Value> RemoteMachine::tells(Json order, const std::function<Value(const Json& answer)>& read) const {
  const Answer answer = ask(std::move(order));
  if (answer.failure) return std::nullopt;
  try {
    return read(answer.json);
  } catch (const Breach& breach) {
    lose(fmt::format("the machine adapter does not keep to the protocol: {}", breach.what()));
    return std::nullopt;
  }
}

bool RemoteMachine::ask(const std::string& what) {
  if (stop_.stop_requested()) return false;
  return tells<bool>({{"do", "ask"}, {"text", what}},
                     [](const Json& answer) {
                       const std::string end = text(answer, "end");
                       if (end != "continued" && end != "cancelled")
                         throw Breach("an operator neither continues nor stops");
                       return end == "continued";
                     })
      .value_or(false);
}

std::optional<RemoteMachine::Reply> RemoteMachine::answer(const std::string& name, const std::string& wanted) {
  if (stop_.stop_requested()) return Reply{{}, true};
  const std::function<std::optional<Reply>(const Json&)> read = [](const Json& answer) -> std::optional<Reply> {
    const std::string end = adapter::text(answer, "end");
    if (end == "answered") return Reply{adapter::text(answer, "text"), false};
    if (end == "cancelled") return Reply{{}, true};
    if (end != "unanswered") throw Breach("a question is neither answered nor left unanswered");
    return std::nullopt;
  };
  auto reply = tells<std::optional<Reply>>({{"do", "answer"}, {"name", name}, {"wanted", wanted}}, read);
  return reply ? *std::move(reply) : Reply{{}, true};
}

std::optional<std::string> RemoteMachine::keep(const machine::OwnTables& tables) {
  const std::function<std::optional<std::string>(const Json&)> read =
      [](const Json& answer) -> std::optional<std::string> {
    const std::string end = text(answer, "end");
    if (end == "kept") return std::nullopt;
    if (end != "refused" && end != "cancelled") throw Breach("tables are neither kept nor refused");
    return optionalText(answer, "detail");
  };
  auto result =
      tells<std::optional<std::string>>({{"do", "tables"}, {"tables", toJson(tables, description_.axes.size())}}, read);
  return result ? *std::move(result) : failure_;
}

bool RemoteMachine::adoptChains(const machine::MachineDescription& machine) {
  if (tellsChains_) return true;
  const auto alike = [](const machine::Axis& a, const machine::Axis& b) {
    return a.name == b.name && a.kind == b.kind;
  };
  if (!std::ranges::equal(description_.axes, machine.axes, alike)) return false;
  description_.tableChain = machine.tableChain;
  description_.spindleChain = machine.spindleChain;
  return true;
}

// ---- axes ----

AxisPositions RemoteMachine::position() const {
  if (!lost_ && std::chrono::steady_clock::now() - toldAt_ > freshFor) exchange({{"do", "position"}});
  return at_;
}

std::optional<machine::MoveResult> RemoteMachine::refusal(const AxisPositions& target, Feed feed) const {
  if (stop_.stop_requested()) return machine::MoveResult{MoveEnd::Cancelled, stopped};
  if (!possible(feed)) return machine::MoveResult{MoveEnd::Refused, "the feed is not above 0"};
  for (const double value : target.values) {
    if (!std::isfinite(value)) return machine::MoveResult{MoveEnd::Refused, "the target is not a number"};
  }
  return std::nullopt;
}

machine::MoveResult RemoteMachine::moved(Json order) {
  auto result = tells<machine::MoveResult>(std::move(order), [](const Json& answer) {
    return machine::MoveResult{moveEnd(text(answer, "end")), optionalText(answer, "detail")};
  });
  return result ? *std::move(result) : machine::MoveResult{MoveEnd::Refused, *failure_};
}

machine::MoveResult RemoteMachine::travel(const char* what, const AxisPositions& target, Feed feed) {
  if (auto refused = refusal(target, feed)) return *std::move(refused);
  Json order = {{"do", what}, {"target", toJson(target, description_.axes.size())}};
  addFeed(order, feed);
  return moved(std::move(order));
}

bool RemoteMachine::keepLine(const AxisPositions& target, Feed feed) {
  if (!looksAhead_ || !underWay_ || lost_) return false;
  // What the adapter would refuse has to be refused now.
  for (std::size_t i = 0; i < description_.axes.size(); ++i)
    if (!(target[i] >= description_.axes[i].minimum && target[i] <= description_.axes[i].maximum)) return false;
  if (place_) {
    now_ = place_();
    std::ranges::move(now_.messages, std::back_inserter(messages_));
  }
  toldAt_ = std::chrono::steady_clock::now();
  lines_.add(now_.line.value_or(0), feed.rapid ? 0 : feed.perMinute, at_, target, toldAt_);
  at_ = target;
  if (lines_.isDue(toldAt_)) {
    sendLines(LineQueue::Next::MoreLines);
    underWay_ = !lost_ && !failure_;
  }
  return true;
}

/// The kept lines as an order.
Json RemoteMachine::path(const std::vector<double>& numbers) const {
  if (compact_) return {{"do", "path"}, {"lines", numbers}};
  Json pieces = Json::array();
  const std::size_t axes = description_.axes.size();
  for (auto at = numbers.begin(); at != numbers.end(); at += static_cast<std::ptrdiff_t>(axes + 2)) {
    Json piece = {{"target", std::vector<double>(at + 2, at + 2 + static_cast<std::ptrdiff_t>(axes))}};
    addFeed(piece, at[1] > 0 ? Feed::at(at[1]) : Feed::rapidTraverse());
    if (at[0] > 0) piece["line"] = static_cast<std::uint64_t>(at[0]);
    pieces.push_back(std::move(piece));
  }
  return {{"do", "path"}, {"pieces", std::move(pieces)}};
}

void RemoteMachine::sendLines(LineQueue::Next next) const {
  if (lines_.empty()) return;
  const Answer answer = exchange(path(lines_.take(next)));
  if (answer.failure) return;
  // They count as travelled. Whatever stops the adapter stops the next order as well; if there is none, this is known.
  try {
    if (text(answer.json, "end") != word(MoveEnd::Reached)) failure_ = optionalText(answer.json, "detail");
  } catch (const Breach& breach) {
    lose(fmt::format("the machine adapter does not keep to the protocol: {}", breach.what()));
  }
}

machine::MoveResult RemoteMachine::move(const AxisPositions& target, Feed feed) {
  if (auto refused = refusal(target, feed)) return *std::move(refused);
  if (keepLine(target, feed)) return {};
  machine::MoveResult result = travel("move", target, feed);
  underWay_ = result.end == MoveEnd::Reached;
  return result;
}

machine::MoveResult RemoteMachine::retract(const AxisPositions& target, Feed feed) {
  return travel("retract", target, feed);
}

machine::PathResult RemoteMachine::moveAlong(std::span<const machine::PathPiece> path) {
  for (const machine::PathPiece& piece : path) {
    if (auto refused = refusal(piece.target, piece.feed)) return {refused->end, 0, std::move(refused->detail)};
  }
  std::size_t reached = 0;
  while (true) {
    while (reached < path.size() && keepLine(path[reached].target, path[reached].feed))
      ++reached;
    if (reached == path.size()) return {MoveEnd::Reached, reached, {}};
    // To an adapter that looks ahead a piece that may not begin is sent alone; others are kept like lines.
    const auto pieces = path.subspan(reached, looksAhead_ ? 1 : path.size() - reached);
    machine::PathResult result = order(pieces);
    result.reached += reached;
    if (result.end != MoveEnd::Reached || result.reached < reached + pieces.size()) return result;
    reached = result.reached;
  }
}

machine::PathResult RemoteMachine::order(std::span<const machine::PathPiece> path) {
  Json pieces = Json::array();
  for (const machine::PathPiece& each : path) {
    Json piece = {{"target", toJson(each.target, description_.axes.size())}};
    addFeed(piece, each.feed);
    pieces.push_back(std::move(piece));
  }
  const std::function<machine::PathResult(const Json&)> read = [&](const Json& answer) {
    const Json& reached = member(answer, "reached");
    if (!reached.is_number_unsigned() || reached.get<std::size_t>() > path.size())
      throw Breach("\"reached\" is not a number of pieces of the path");
    return machine::PathResult{moveEnd(text(answer, "end")), reached.get<std::size_t>(),
                               optionalText(answer, "detail")};
  };
  auto result = tells({{"do", "path"}, {"pieces", std::move(pieces)}}, read);
  if (!result) return {MoveEnd::Refused, 0, *failure_};
  underWay_ = result->end == MoveEnd::Reached;
  return *std::move(result);
}

machine::MeasureResult RemoteMachine::measure(const machine::MeasureOrder& order) {
  if (auto refused = refusal(order.target, order.feed))
    return {refused->end == MoveEnd::Cancelled ? MeasureEnd::Cancelled : MeasureEnd::Refused, at_,
            std::move(refused->detail)};
  const AxisPositions start = position();
  Json json = {{"do", "measure"},
               {"target", toJson(order.target, description_.axes.size())},
               {"sensor", word(order.sensor)},
               {"part", word(order.part)}};
  addFeed(json, order.feed);
  const std::function<machine::MeasureResult(const Json&)> read = [&](const Json& answer) {
    machine::MeasureResult result{measureEnd(text(answer, "end")), at_, optionalText(answer, "detail")};
    if (result.end == MeasureEnd::Touched) {
      result.latched = positions(member(answer, "latched"), description_.axes.size());
      if (auto why = offTheMeasuringMove(description_, start, order.target, result.latched))
        throw Breach(*std::move(why));
    }
    if (answer.contains("spindleAngle")) result.spindleAngle = number(answer, "spindleAngle");
    return result;
  };
  auto result = tells(std::move(json), read);
  if (!result) return {MeasureEnd::Refused, at_, *failure_};
  // A signal that comes after a stop was asked for counts for nothing.
  if (stop_.stop_requested()) return {MeasureEnd::Cancelled, at_, stopped};
  if (result->end == MeasureEnd::Touched) felt_.push_back({result->latched, now_.toolVector, now_.toolRadius});
  return *std::move(result);
}

// ---- sensors ----

bool RemoteMachine::deflected(machine::Sensor sensor) const {
  return tells<bool>({{"do", "deflected"}, {"sensor", word(sensor)}},
                     [](const Json& answer) {
                       const Json& value = member(answer, "deflected");
                       if (!value.is_boolean()) throw Breach("\"deflected\" is neither true nor false");
                       return value.get<bool>();
                     })
      .value_or(false);
}

std::string RemoteMachine::probeSerial() const {
  return tells<std::string>({{"do", "probeSerial"}}, [](const Json& answer) { return optionalText(answer, "serial"); })
      .value_or("");
}

// ---- spindle, functions, tools ----

machine::MoveResult RemoteMachine::turnSpindle(machine::Rotation rotation, double speed) {
  const bool stands = rotation == machine::Rotation::None;
  if (!stands && stop_.stop_requested()) return {MoveEnd::Cancelled, stopped};
  if (!stands && !(speed >= 0 && std::isfinite(speed)))
    return {MoveEnd::Refused, fmt::format("a spindle speed of {} is not possible", speed)};
  return moved({{"do", "turnSpindle"}, {"rotation", word(rotation)}, {"speed", stands ? 0 : speed}});
}

machine::MoveResult RemoteMachine::orientSpindle(double degrees) {
  if (stop_.stop_requested()) return {MoveEnd::Cancelled, stopped};
  if (!std::isfinite(degrees)) return {MoveEnd::Refused, "the target angle of the spindle is not a number"};
  return moved({{"do", "orientSpindle"}, {"degrees", degrees}});
}

machine::SpindleState RemoteMachine::spindle() const {
  if (const auto state = tells<machine::SpindleState>({{"do", "spindle"}}, [](const Json& answer) {
        return machine::SpindleState{rotation(text(answer, "rotation")), number(answer, "speed"),
                                     number(answer, "angle")};
      })) {
    spindle_ = *state;
  }
  return spindle_;
}

machine::FunctionResult RemoteMachine::function(int number) {
  if (!hasFunction(number)) return {FunctionEnd::Unknown, {}};
  if (stop_.stop_requested()) return {FunctionEnd::Cancelled, stopped};
  auto result = tells<machine::FunctionResult>({{"do", "function"}, {"number", number}}, [](const Json& answer) {
    return machine::FunctionResult{functionEnd(text(answer, "end")), optionalText(answer, "detail")};
  });
  return result ? *std::move(result) : machine::FunctionResult{FunctionEnd::Refused, *failure_};
}

machine::ToolChangeResult RemoteMachine::changeTool(const machine::ToolOrder& order) {
  if (stop_.stop_requested()) return {ToolChangeEnd::Cancelled, stopped};
  auto result = tells<machine::ToolChangeResult>(
      {{"do", "changeTool"}, {"number", order.number}, {"name", order.name}}, [](const Json& answer) {
        return machine::ToolChangeResult{toolChangeEnd(text(answer, "end")), optionalText(answer, "detail")};
      });
  return result ? *std::move(result) : machine::ToolChangeResult{ToolChangeEnd::Refused, *failure_};
}

// ---- clock ----

machine::WaitEnd RemoteMachine::dwell(double seconds) {
  if (stop_.stop_requested()) return machine::WaitEnd::Cancelled;
  if (!(seconds > 0) || !std::isfinite(seconds)) return machine::WaitEnd::Over;
  // Of a failure the next order tells, and whoever runs the program asks for it at the end.
  return tells<machine::WaitEnd>({{"do", "dwell"}, {"seconds", seconds}},
                                 [](const Json& answer) { return waitEnd(text(answer, "end")); })
      .value_or(machine::WaitEnd::Over);
}

double RemoteMachine::seconds() const {
  // Asked between two lines: their machine is busy with earlier ones.
  if (looksAhead_) return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  if (const auto told =
          tells<double>({{"do", "seconds"}}, [](const Json& answer) { return number(answer, "seconds"); }))
    seconds_ = std::max(seconds_, *told);
  return seconds_;
}

}  // namespace probewright::adapter
