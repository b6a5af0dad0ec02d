// SPDX-License-Identifier: GPL-2.0-or-later
#include "player.hpp"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "canon.hh"

namespace {

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

bool near(const Mill::Position& a, const Mill::Position& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > 1e-4) return false;
  return true;
}

/// Shows a text on LinuxCNC's screen; a long one as several messages, as LinuxCNC keeps the beginning of each only.
void show(const std::string& text) {
  constexpr std::size_t longest = 240;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.size();
    if (end - at > longest) {
      end = text.rfind('\n', at + longest);
      if (end == std::string::npos || end <= at) end = text.rfind(' ', at + longest);
      if (end == std::string::npos || end <= at)
        // Not within a character of UTF-8.
        for (end = at + longest; (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U;)
          --end;
    }
    std::string part = text.substr(at, end - at);
    MESSAGE(part.data());
    at = end < text.size() && (text[end] == '\n' || text[end] == ' ') ? end + 1 : end;
  }
}

}  // namespace

bool Player::start(const std::string& iniFile, const std::string& program, int line) {
  namespace fs = std::filesystem;
  // What the program before has measured is written first: its tables may be those of this one.
  for (const double end = now() + 20; engine_ && now() < end; usleep(2000))
    attend();
  stopped_.reset();
  ended_.reset();
  signalled_ = told_ = gone_ = false;
  messages_.clear();
  way_.clear();
  queuedPieces_ = 0;
  ahead_.clear();
  next_.reset();
  window_.reset();
  mill_.load(iniFile);
  const auto key = [&](const char* name) { return mill_.key("PROBEWRIGHT", name); };
  const fs::path folder = fs::path(iniFile).parent_path();
  const auto inFolder = [&](const std::string& name) { return (folder / name).string(); };
  const std::string beliefs = key("CONTROL").empty() ? key("SETUP") : key("CONTROL");
  if (beliefs.empty()) {
    message_ = "the configuration does not say what the control knows: [PROBEWRIGHT]CONTROL names no setup";
    return false;
  }
  // A preview leaves nothing behind.
  const std::string out =
      Mill::moves() ? inFolder(key("OUT").empty() ? "probewright-out" : key("OUT"))
                    : (fs::temp_directory_path() / ("probewright-preview-" + std::to_string(getuid()))).string();
  const char* named = std::getenv("PROBEWRIGHT");
  const std::string otherwise = named != nullptr ? named : "probewright";
  std::vector<std::string> words = {key("PROGRAM").empty() ? otherwise : key("PROGRAM"),
                                    "run",
                                    program,
                                    "--setup",
                                    inFolder(beliefs),
                                    "--machine",
                                    "fd:3",
                                    "--quiet",
                                    "--out",
                                    out};
  if (Mill::moves()) words.insert(words.end(), {"--on-stop", "ask"});
  const char* screen = std::getenv("DISPLAY");
  const bool windows = Mill::moves() && screen != nullptr && *screen != '\0' && key("DIALOGS") != "0";
  windowProgram_ = windows ? fs::path(words.front()).replace_filename("probewright-dialog").string() : "";
  if (!key("ANSWERS").empty()) words.insert(words.end(), {"--answers", inFolder(key("ANSWERS"))});
  if (line > 1) words.insert(words.end(), {"--search", std::to_string(line)});
  engine_.emplace();
  if (!engine_->start(words, message_)) {
    engine_.reset();
    return false;
  }
  playing_ = true;
  queued_ = true;  // whatever LinuxCNC has done before
  settled_ = false;
  stage_ = Stage::Idle;
  begun_ = alive_ = now();
  line_ = 0;
  mill_.atLine(0);
  mill_.begin();
  at_ = mill_.position();
  return true;
}

void Player::answer(Json json) {
  json["position"] = at_;
  engine_->answer(order_, std::move(json));
  stage_ = Stage::Idle;
}

void Player::note() {
  alive_ = now();
  line_ = order_.value("line", line_);
  mill_.atLine(line_);
  if (!order_.contains("messages")) return;
  for (std::string& text : order_.at("messages").get<std::vector<std::string>>())
    messages_.push_back(std::move(text));
}

Player::Next Player::finish() {
  if (!ended_) ended_ = now();
  const int code = engine_->exitCode(50);
  // It writes what it has measured, which takes its time on a busy computer.
  if (code < 0 && now() - *ended_ < 60) return Next::Wait;
  playing_ = false;
  mill_.end();
  message_ = engine_->messages();
  if (code < 0 || code > 3) {
    // It did not end as a program does: nobody knows what the axes are to do.
    Mill::stopAxes();
    message_ = "probewright has ended unexpectedly\n" + message_;
  }
  engine_.reset();
  // What is drawn ends where the control would stop with an alarm.
  const bool ended = code == 0 || code == 1 || (code == 3 && !Mill::moves());
  return ended ? Next::Ended : Next::Failed;
}

Player::Next Player::read() {
  // What a dead engine had ordered is not begun.
  if (gone_) return finish();
  if (queuedPieces_ >= way_.size() && !ahead_.empty()) {
    way_ = std::move(ahead_.front());
    ahead_.pop_front();
    queuedPieces_ = 0;
  }
  if (queuedPieces_ < way_.size()) {
    constexpr std::size_t often = 64;
    if (queuedPieces_ % often == 0) lookAhead();
    line_ = way_[queuedPieces_].line;
    return Next::GoOn;
  }
  if (stage_ == Stage::Pending && window_) {
    auto reply = replied();
    if (!reply) {
      usleep(10'000);
      return Next::Wait;
    }
    answer(*std::move(reply));
  } else if (stage_ == Stage::Pending) {
    mill_.synchronize();
    if (Mill::moves()) at_ = mill_.position();
    answer(outcome(order_));
  } else if (stage_ == Stage::Drain) {
    mill_.synchronize();
    if (!settled_) mill_.learnOffsets();
    settled_ = true;
    queued_ = false;
    if (Mill::moves()) at_ = mill_.position();
    stage_ = Stage::Perform;
  }
  while (true) {
    if (stage_ == Stage::Perform) {
      auto refused = refusal(order_);
      if (!refused) return Next::GoOn;
      answer(*std::move(refused));
    }
    // LinuxCNC's planner does nothing else meanwhile, so it is not kept waiting long.
    const bool waits = next_.has_value();
    if (waits) order_ = *std::exchange(next_, std::nullopt);
    switch (waits ? EngineProcess::Got::Order : engine_->receive(order_, Mill::moves() ? 50 : 10'000)) {
      case EngineProcess::Got::Ended:
        return finish();
      case EngineProcess::Got::Nothing:
        Mill::flush();
        return Next::Wait;
      case EngineProcess::Got::Order:
        break;
    }
    note();
    for (; !messages_.empty(); messages_.erase(messages_.begin()))
      show(messages_.front());
    if (auto known = atOnce(order_)) {
      answer(*std::move(known));
      continue;
    }
    const std::string what = order_.value("do", "");
    stage_ = queued_ && Mill::moves() ? Stage::Drain : Stage::Perform;
    // A move behind others is queued; the first one must know whether the probe is free.
    if ((what == "move" || what == "path") && queued_ && settled_) stage_ = Stage::Motion;
    if (stage_ != Stage::Perform) return Next::GoOn;
  }
}

Player::Next Player::execute() {
  if (queuedPieces_ < way_.size()) {
    queueNext();
    return Next::GoOn;
  }
  switch (stage_) {
    case Stage::Idle:
    case Stage::Pending:
      return Next::GoOn;
    case Stage::Drain:
      Mill::flush();
      return Next::Wait;
    case Stage::Motion:
      answerAndQueue();
      return Next::GoOn;
    case Stage::Perform:
      break;
  }
  const std::string what = order_.value("do", "");
  if (what == "move" || what == "path") {
    answerAndQueue();
    return Next::GoOn;
  }
  perform(order_);
  if (stage_ == Stage::Idle) return Next::GoOn;
  Mill::flush();
  stage_ = Stage::Pending;
  return Mill::moves() ? Next::Wait : Next::GoOn;
}

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

/// A move, or the pieces of a path, up to the first one beyond the travel.
std::vector<Player::Piece> Player::pieces(const Json& order, Json& answer) const {
  const bool path = order.contains("pieces");
  std::vector<Piece> pieces;
  answer = {{"end", "reached"}};
  if (order.contains("lines")) {
    const auto& numbers = order.at("lines").get_ref<const Json::array_t&>();
    const std::size_t axes = at_.size();
    pieces.reserve(numbers.size() / (axes + 2));
    for (auto at = numbers.begin(); numbers.end() - at >= static_cast<std::ptrdiff_t>(axes + 2); at += axes + 2) {
      const double line = at->get<double>(), feed = at[1].get<double>();
      Piece piece{Mill::Position(axes), feed > 0 ? feed : std::optional<double>(), line > 0 ? int(line) : line_};
      for (std::size_t i = 0; i < axes; ++i)
        piece.target[i] = at[static_cast<std::ptrdiff_t>(i) + 2].get<double>();
      if (const std::string limit = mill_.limit(piece.target); !limit.empty()) {
        answer = {{"end", "axisLimit"}, {"detail", limit}};
        break;
      }
      pieces.push_back(std::move(piece));
    }
    answer["reached"] = pieces.size();
    return pieces;
  }
  for (const Json& json : path ? order.at("pieces") : Json::array({order})) {
    Piece piece{json.at("target").get<Mill::Position>(),
                json.value("rapid", false) ? std::optional<double>() : json.at("feed").get<double>(),
                json.value("line", order.value("line", line_))};
    if (const std::string limit = mill_.limit(piece.target); !limit.empty()) {
      answer = {{"end", "axisLimit"}, {"detail", limit}};
      break;
    }
    pieces.push_back(std::move(piece));
  }
  answer["reached"] = pieces.size();
  return pieces;
}

void Player::queueNext() {
  const Piece& piece = way_[queuedPieces_++];
  line_ = piece.line;
  mill_.atLine(line_);
  if (piece.feed) {
    mill_.feed(*piece.feed);
    mill_.straight(piece.target);
  } else {
    mill_.traverse(piece.target);
  }
  at_ = way_.back().target;
  queued_ = true;
}

void Player::lookAhead() {
  constexpr std::size_t far = 4;
  while (Mill::moves() && settled_ && stage_ == Stage::Idle && !next_ && ahead_.size() < far) {
    Json order;
    switch (engine_->receive(order, 0)) {
      case EngineProcess::Got::Nothing:
        return;
      case EngineProcess::Got::Ended:
        // Of an end as it should be the rest of the way is travelled.
        gone_ = engine_->exitCode(0) > 3;
        if (gone_) Mill::stopAxes();
        return;
      case EngineProcess::Got::Order:
        break;
    }
    const std::string what = order.value("do", "");
    Json json;
    if ((what == "move" || what == "path") && !order.contains("messages")) {
      std::vector<Piece> way = pieces(order, json);
      if (!way.empty() && json.at("end") == "reached") {
        json["position"] = way.back().target;
        ahead_.push_back(std::move(way));
        engine_->answer(order, std::move(json));
        continue;
      }
    }
    next_ = std::move(order);
    alive_ = now();
  }
}

/// Takes in a way. The engine works out what comes next while it is queued, a piece for each block that LinuxCNC asks
/// for: LinuxCNC reads a number of blocks before it attends to anything else.
void Player::answerAndQueue() {
  Json json;
  way_ = pieces(order_, json);
  queuedPieces_ = 0;
  if (!way_.empty()) at_ = way_.back().target;
  answer(std::move(json));
  if (!way_.empty()) queueNext();
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
    show(order.value("text", ""));
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

void Player::stop(Stop why) {
  if (!playing_) return;
  playing_ = false;
  window_.reset();
  way_.clear();
  queuedPieces_ = 0;
  ahead_.clear();
  stopped_ = why;
  signalled_ = why == Stop::Fault && Mill::deflected();
  const std::string off = Mill::notReady();
  if (why == Stop::EmergencyStop) {
    detail_ = "LinuxCNC is in emergency stop";
  } else if (why != Stop::ByOperator && !off.empty()) {
    detail_ = off;
  } else if (why == Stop::SwitchedOff) {
    detail_ = "LinuxCNC's machine is switched off";
  } else if (signalled_) {
    detail_ = "the probe has signalled on the way";
  } else {
    detail_ = why == Stop::ByOperator ? "stopped at LinuxCNC" : "LinuxCNC has stopped the motion: see its message";
  }
  // A touch counts, even if the axes had no time to come to rest.
  at_ = mill_.position();
  if (next_) {
    order_ = *std::exchange(next_, std::nullopt);
    stage_ = Stage::Drain;
  }
  if (stage_ != Stage::Idle) answer(stopped(order_));
  mill_.end();
  attend();
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

std::optional<std::string> Player::attend() {
  if (!engine_) return std::nullopt;
  if (playing_) {
    if ((stage_ != Stage::Idle || next_) && now() - alive_ > 1) {
      alive_ = now();
      engine_->alive(next_ ? *next_ : order_);
    }
    // LinuxCNC asks for no block while it waits for the axes.
    Json none;
    if ((stage_ != Stage::Idle || next_) && !gone_ && engine_->receive(none, 0) == EngineProcess::Got::Ended) {
      gone_ = true;
      Mill::stopAxes();
    }
    return std::nullopt;
  }
  for (EngineProcess::Got got = engine_->receive(order_, 0); got != EngineProcess::Got::Nothing;
       got = engine_->receive(order_, 0)) {
    if (got == EngineProcess::Got::Order) {
      answer(stopped(order_));
      continue;
    }
    const int code = engine_->exitCode(0);
    if (code < 0) break;
    const bool alarm = *stopped_ != Stop::ByOperator && code > 1;
    std::string text = alarm ? engine_->messages() : "";
    engine_.reset();
    if (alarm) return text;
    break;
  }
  return std::nullopt;
}
