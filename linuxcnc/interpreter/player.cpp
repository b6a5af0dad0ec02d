// SPDX-License-Identifier: GPL-2.0-or-later
#include "player.hpp"

#include <time.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "canon.hh"

double Player::now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

bool Player::start(const std::string& iniFile, const std::string& program, int line) {
  namespace fs = std::filesystem;
  // What the program before has measured is written first: its tables may be those of this one.
  for (const double end = now() + 20; engine_ && now() < end; usleep(2000))
    attend();
  stopped_.reset();
  ended_.reset();
  signalled_ = told_ = gone_ = false;
  lingers_.reset();
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
  const std::string out = inFolder(key("OUT").empty() ? "probewright-out" : key("OUT"));
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
  if (Mill::moves()) {
    words.insert(words.end(), {"--on-stop", "ask"});
  } else {
    words.emplace_back("--preview");
  }
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
    // For up to a servo cycle after a motion is handed over LinuxCNC's status is that of the motion before, and its
    // planner takes this one for ended.
    constexpr double unexpected = 1;
    if (!arrived(order_) && Mill::notReady().empty()) {
      if (!lingers_) lingers_ = now();
      if (now() - *lingers_ < unexpected) return Next::Wait;
    }
    lingers_.reset();
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
      Mill::show(messages_.front());
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
