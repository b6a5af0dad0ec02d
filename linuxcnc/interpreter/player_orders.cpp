// SPDX-License-Identifier: GPL-2.0-or-later
// The player's orders, one after another: which are known at once, which cannot begin, how they are carried out, and
// how they have ended.
#include <algorithm>
#include <cmath>
#include <string>

#include "canon.hh"
#include "player.hpp"

namespace {

bool near(const Mill::Position& a, const Mill::Position& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > 1e-4) return false;
  return true;
}

}  // namespace

std::optional<Player::Json> Player::atOnce(const Json& order) {
  const std::string what = order.value("do", "");
  if (what == "hello") {
    std::string why;
    Json hello = mill_.hello(why);
    if (!why.empty()) return Json{{"end", "failed"}, {"detail", why}};
    hello["answers"] = !windowProgram_.empty();
    return hello;
  }
  if (what == "position") return Json::object();
  if (what == "spindle") return spindle_;
  if (what == "seconds") return Json{{"seconds", now() - begun_}};
  if (what == "probeSerial") return Json{{"serial", ""}};
  if (what == "function" && std::ranges::count(Mill::functions(), order.value("number", 0)) == 0)
    return Json{{"end", "unknown"}};
  for (const char* known : {"move", "path", "retract", "measure", "deflected", "turnSpindle", "orientSpindle",
                            "function", "changeTool", "dwell", "ask", "answer", "tables"})
    if (what == known) return std::nullopt;
  return Json{{"end", "refused"}, {"detail", "LinuxCNC does not know the order " + what}};
}

std::optional<Player::Json> Player::refusal(const Json& order) {
  const std::string what = order.value("do", "");
  if (what == "deflected") return Json{{"deflected", Mill::deflected()}};
  if (what == "tables") {
    const std::string why = Mill::moves() ? setTables_(mill_, order.at("tables")) : "";
    return why.empty() ? Json{{"end", "kept"}} : Json{{"end", "refused"}, {"detail", why}};
  }
  if ((what == "move" || what == "path") && Mill::deflected())
    return Json{{"end", "probeSignal"}, {"reached", 0}, {"detail", "the probe is deflected before the motion begins"}};
  if (what == "retract" || what == "measure") {
    if (const std::string limit = mill_.limit(order.at("target").get<Mill::Position>()); !limit.empty())
      return Json{{"end", "axisLimit"}, {"detail", limit}};
  }
  if (what == "measure" && Mill::moves()) {
    if (Mill::toolInSpindle() == 0) return Json{{"end", "notReady"}, {"detail", "LinuxCNC has no tool in the spindle"}};
    if (Mill::deflected())
      return Json{{"end", "deflectedAtStart"}, {"detail", "the probe is deflected before the measuring move begins"}};
  }
  if (what == "orientSpindle" && mill_.key("PROBEWRIGHT", "SPINDLE_ORIENTS") != "1")
    return Json{{"end", "refused"}, {"detail", "the spindle of this LinuxCNC machine is not set up to be oriented"}};
  if (what == "changeTool" && Mill::moves()) {
    const int number = order.value("number", 0);
    if (Mill::toolInSpindle() == number) return Json{{"end", "changed"}};
    if (number != 0 && !Mill::hasTool(number))
      return Json{{"end", "missing"}, {"detail", "LinuxCNC's tool table has no tool " + std::to_string(number)}};
    if (Mill::deflected())
      return Json{{"end", "probeSignal"}, {"detail", "the probe is deflected before the tool change"}};
  }
  return std::nullopt;
}

void Player::perform(const Json& order) {
  const std::string what = order.at("do").get<std::string>();
  if (what == "retract") {
    Json answered;
    way_ = pieces(order, answered);
    for (queuedPieces_ = 0; queuedPieces_ < way_.size();)
      queueNext();
  } else if (what == "measure") {
    auto target = order.at("target").get<Mill::Position>();
    if (!Mill::moves()) {
      // Nobody feels anything in a preview: the touch is drawn in the middle of the way.
      for (std::size_t i = 0; i < target.size(); ++i)
        target[i] = (target[i] + at_[i]) / 2;
      at_ = target;
    }
    mill_.feed(order.at("feed").get<double>());
    mill_.probe(target);
  } else if (what == "turnSpindle") {
    const std::string rotation = order.value("rotation", "none");
    spindle_["rotation"] = rotation;
    spindle_["speed"] = rotation == "none" ? Json(0) : order.at("speed");
    if (rotation == "none") {
      STOP_SPINDLE_TURNING(0);
    } else {
      SET_SPINDLE_SPEED(0, order.at("speed").get<double>());
      rotation == "clockwise" ? START_SPINDLE_CLOCKWISE(0) : START_SPINDLE_COUNTERCLOCKWISE(0);
    }
  } else if (what == "orientSpindle") {
    spindle_ = {{"rotation", "none"}, {"speed", 0}, {"angle", order.at("degrees")}};
    ORIENT_SPINDLE(0, std::fmod(std::fmod(order.at("degrees").get<double>(), 360) + 360, 360), 0);
    WAIT_SPINDLE_ORIENT_COMPLETE(0, 30);
  } else if (what == "function") {
    Mill::function(order.at("number").get<int>());
  } else if (what == "changeTool") {
    SELECT_TOOL(order.at("number").get<int>());
    START_CHANGE();
    CHANGE_TOOL(order.at("number").get<int>());
  } else if (what == "dwell") {
    DWELL(order.at("seconds").get<double>());
  } else if (what == "ask") {
    Mill::show(order.value("text", ""));
    PROGRAM_STOP();
  } else if (what == "answer") {
    askWithWindow();
  }
}

void Player::askWithWindow() {
  std::string why;
  window_.emplace();
  if (windowProgram_.empty() ||
      !window_->start({windowProgram_, order_.value("name", ""), order_.value("wanted", "")}, why)) {
    window_.reset();
    answer({{"end", "unanswered"}, {"detail", why}});
  }
}

std::optional<Player::Json> Player::replied() {
  Json reply;
  const EngineProcess::Got got = window_->receive(reply, 0);
  if (got == EngineProcess::Got::Nothing) return std::nullopt;
  // A window that cannot be opened has a reason, which is not the operator's.
  if (got == EngineProcess::Got::Ended) {
    const int code = window_->exitCode(1000);
    reply = code == 0 ? Json{{"end", "cancelled"}} : Json{{"end", "unanswered"}, {"detail", window_->messages()}};
  }
  window_.reset();
  return reply;
}

bool Player::arrived(const Json& order) const {
  const std::string what = order.at("do").get<std::string>();
  if (!Mill::moves() || (what != "retract" && what != "measure")) return true;
  return near(at_, order.at("target").get<Mill::Position>()) || (what == "measure" && Mill::tripped());
}

Player::Json Player::outcome(const Json& order) {
  const std::string what = order.at("do").get<std::string>();
  if (what == "retract") {
    const bool there = !Mill::moves() || near(at_, order.at("target").get<Mill::Position>());
    return there ? Json{{"end", "reached"}} : Json{{"end", "cancelled"}, {"detail", "stopped at LinuxCNC"}};
  }
  if (what == "measure") {
    if (!Mill::moves()) return {{"end", "touched"}, {"latched", at_}};
    if (Mill::tripped()) return {{"end", "touched"}, {"latched", mill_.probed()}};
    if (near(at_, order.at("target").get<Mill::Position>())) return {{"end", "noContact"}};
    return {{"end", "cancelled"}, {"detail", "stopped at LinuxCNC"}};
  }
  if (what == "changeTool") {
    const int number = order.at("number").get<int>();
    if (!Mill::moves() || Mill::toolInSpindle() == number) return {{"end", "changed"}};
    return {{"end", "refused"}, {"detail", "LinuxCNC has not changed the tool"}};
  }
  if (what == "function") return {{"end", "carriedOut"}};
  if (what == "dwell") return {{"end", "over"}};
  if (what == "ask") return {{"end", "continued"}};
  return {{"end", "reached"}};
}

/// Of a stop the next order is told, however it came: moves are answered before they have ended.
Player::Json Player::stopped(const Json& order) {
  const std::string what = order.value("do", "");
  const bool first = !told_;
  if (what == "tables") {
    const std::string why = setTables_(mill_, order.at("tables"));
    return why.empty() ? Json{{"end", "kept"}} : Json{{"end", "refused"}, {"detail", why}};
  }
  if (auto known = atOnce(order)) return *std::move(known);
  told_ = true;
  const bool stands = (what == "turnSpindle" && order.value("rotation", "") == "none") || what == "function";
  if (!first && stands) return {{"end", what == "function" ? "carriedOut" : "reached"}};
  if (!first && what == "deflected") return {{"deflected", Mill::deflected()}};
  Json json = {{"end", "failed"}, {"reached", 0}, {"detail", detail_}};
  if (*stopped_ == Stop::ByOperator && what != "deflected") {
    json["end"] = "cancelled";
  } else if (signalled_) {
    if (what == "move" || what == "path" || what == "retract" || what == "changeTool") json["end"] = "probeSignal";
    if (what == "measure") json["end"] = "deflectedAtStart";
  }
  if (what == "deflected") json["deflected"] = Mill::deflected();
  return json;
}
