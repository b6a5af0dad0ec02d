// SPDX-License-Identifier: GPL-2.0-or-later
// The player's lines on their way: from an order of the engine into LinuxCNC's queue, and those that come after them.
#include <utility>

#include "player.hpp"

/// A move, or the pieces of a path, up to the first one beyond the travel.
std::vector<Player::Piece> Player::pieces(const Json& order, Json& answer) const {
  const bool path = order.contains("pieces");
  std::vector<Piece> pieces;
  answer = {{"end", "reached"}};
  /// False if the piece leads out of the travel.
  const auto add = [&](Piece piece) {
    if (const std::string limit = mill_.limit(piece.target); !limit.empty()) {
      answer = {{"end", "axisLimit"}, {"detail", limit}};
      return false;
    }
    pieces.push_back(std::move(piece));
    return true;
  };
  if (order.contains("lines")) {
    const auto& numbers = order.at("lines").get_ref<const Json::array_t&>();
    const std::size_t axes = at_.size();
    pieces.reserve(numbers.size() / (axes + 2));
    for (auto at = numbers.begin(); numbers.end() - at >= static_cast<std::ptrdiff_t>(axes + 2); at += axes + 2) {
      const double line = at->get<double>(), feed = at[1].get<double>();
      Piece piece{Mill::Position(axes), feed > 0 ? feed : std::optional<double>(), line > 0 ? int(line) : line_};
      for (std::size_t i = 0; i < axes; ++i)
        piece.target[i] = at[static_cast<std::ptrdiff_t>(i) + 2].get<double>();
      if (!add(std::move(piece))) break;
    }
    answer["reached"] = pieces.size();
    return pieces;
  }
  for (const Json& json : path ? order.at("pieces") : Json::array({order})) {
    if (!add({json.at("target").get<Mill::Position>(),
              json.value("rapid", false) ? std::optional<double>() : json.at("feed").get<double>(),
              json.value("line", order.value("line", line_))}))
      break;
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
