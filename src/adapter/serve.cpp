#include "adapter/serve.hpp"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "adapter/protocol.hpp"

namespace probewright::adapter {
namespace {

/// The engine's orders, one after another. A thread listens all the time, because a stop comes while an order is under
/// way.
class Orders {
public:
  Orders(machine::Machine& machine, LineStream stream) : machine_(machine), stream_(std::move(stream)) {
    listener_ = std::jthread([this] { listen(); });
  }
  ~Orders() { stream_.hangUp(); }

  /// The next order, which is then under way; nothing once the engine has hung up.
  std::optional<Json> next() {
    std::unique_lock lock(mutex_);
    come_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
    if (closed_) return std::nullopt;
    Json order = std::move(waiting_.front());
    waiting_.pop_front();
    stop_ = {};
    machine_.stopOn(stop_.get_token());
    underWay_ = order.value("id", Json());
    return order;
  }

  void answer(Json json) {
    const std::lock_guard lock(mutex_);
    json["id"] = std::exchange(underWay_, Json());
    stream_.send(json.dump());
  }

private:
  void listen() {
    std::string line;
    while (true) {
      const LineStream::Got got = stream_.receive(line, std::chrono::milliseconds(500));
      const std::lock_guard lock(mutex_);
      if (got == LineStream::Got::Line) {
        try {
          Json order = parseLine(line);
          if (text(order, "do") != "stop") {
            waiting_.push_back(std::move(order));
            come_.notify_one();
          } else if (!underWay_.is_null() && order.value("order", Json()) == underWay_) {
            stop_.request_stop();
          }
          continue;
        } catch (const Breach&) {
        }
      } else if (got == LineStream::Got::Nothing) {
        if (!underWay_.is_null()) stream_.send(Json{{"alive", underWay_}}.dump());
        continue;
      }
      // Nobody is there any more: the axes must not go on.
      closed_ = true;
      stop_.request_stop();
      come_.notify_one();
      return;
    }
  }

  machine::Machine& machine_;
  LineStream stream_;
  std::mutex mutex_;
  std::condition_variable come_;
  std::deque<Json> waiting_;
  Json underWay_;  ///< the number of the order; null: none
  std::stop_source stop_;
  bool closed_ = false;
  std::jthread listener_;  ///< ends before what it uses does
};

Json ended(std::string_view end, std::string detail) {
  Json json = {{"end", end}};
  if (!detail.empty()) json["detail"] = std::move(detail);
  return json;
}

template <class Outcome>
Json ended(const Outcome& result) {
  return ended(word(result.end), result.detail);
}

Json hello(const machine::Machine& machine, const std::string& adapterName) {
  Json functions = Json::array();
  for (int number = 0; number < 1000; ++number) {
    if (machine.hasFunction(number)) functions.push_back(number);
  }
  return {{"protocol", protocolVersion},
          {"adapter", adapterName},
          {"machine", toJson(machine.description())},
          {"functions", std::move(functions)}};
}

Json path(machine::Machine& machine, const Json& order, std::size_t axes) {
  std::vector<machine::PathPiece> pieces;
  for (const Json& piece : member(order, "pieces"))
    pieces.push_back({positions(member(piece, "target"), axes), feed(piece)});
  const machine::PathResult result = machine.moveAlong(pieces);
  Json json = ended(result);
  json["reached"] = result.reached;
  return json;
}

Json measure(machine::Machine& machine, const Json& order, std::size_t axes) {
  const machine::MeasureResult result =
      machine.measure({positions(member(order, "target"), axes), feed(order), sensor(text(order, "sensor")),
                       touchWith(text(order, "part"))});
  Json json = ended(result);
  if (result.end == machine::MeasureEnd::Touched) json["latched"] = toJson(result.latched, axes);
  if (result.spindleAngle) json["spindleAngle"] = *result.spindleAngle;
  return json;
}

Json carryOut(machine::Machine& machine, const Json& order, const std::string& adapterName) {
  const std::size_t axes = machine.description().axes.size();
  const std::string what = text(order, "do");
  if (what == "hello") return hello(machine, adapterName);
  if (what == "position") return Json::object();
  if (what == "move") return ended(machine.move(positions(member(order, "target"), axes), feed(order)));
  if (what == "retract") return ended(machine.retract(positions(member(order, "target"), axes), feed(order)));
  if (what == "path") return path(machine, order, axes);
  if (what == "measure") return measure(machine, order, axes);
  if (what == "deflected") return {{"deflected", machine.deflected(sensor(text(order, "sensor")))}};
  if (what == "probeSerial") return {{"serial", machine.probeSerial()}};
  if (what == "turnSpindle")
    return ended(machine.turnSpindle(rotation(text(order, "rotation")), number(order, "speed")));
  if (what == "orientSpindle") return ended(machine.orientSpindle(number(order, "degrees")));
  if (what == "spindle") {
    const machine::SpindleState state = machine.spindle();
    return {{"rotation", word(state.rotation)}, {"speed", state.speed}, {"angle", state.angle}};
  }
  if (what == "function") return ended(machine.function(static_cast<int>(number(order, "number"))));
  if (what == "changeTool") {
    return ended(machine.changeTool({static_cast<int>(number(order, "number")), text(order, "name")}));
  }
  if (what == "dwell") return ended(word(machine.dwell(number(order, "seconds"))), {});
  if (what == "seconds") return {{"seconds", machine.seconds()}};
  return ended(word(machine::MoveEnd::Refused), "there is no order \"" + what + "\"");
}

}  // namespace

void serve(machine::Machine& machine, const std::string& adapterName, LineStream stream) {
  Orders orders(machine, std::move(stream));
  while (const auto order = orders.next()) {
    try {
      Json answer = carryOut(machine, *order, adapterName);
      answer["position"] = toJson(machine.position(), machine.description().axes.size());
      orders.answer(std::move(answer));
    } catch (const Breach& breach) {
      orders.answer(ended(word(machine::MoveEnd::Refused), breach.what()));
    }
  }
}

}  // namespace probewright::adapter
