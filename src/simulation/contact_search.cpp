#include "simulation/contact_search.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/clear_way.hpp"

namespace probewright::simulation {

using machine::AxisPositions;

namespace {

/// Shafts sweep with a fixed direction; where they turn on the way, pieces are cut until they turn less than this.
constexpr double shaftPrecision = 0.005;  // mm

bool sweptBoxMisses(const Bounds& bounds, const Vector3& from, const Vector3& to, const Vector3& axis, double radius) {
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double low = std::min(from[i], to[i]) + std::min(axis[i], 0.0) - radius;
    const double high = std::max(from[i], to[i]) + std::max(axis[i], 0.0) + radius;
    if (low > bounds.maximum[i] || high < bounds.minimum[i]) return true;
  }
  return false;
}

/// A shaft with all its surface moved out by `growth`.
Shaft grown(Shaft shaft, double growth) {
  shaft.radius += growth;
  if (growth == 0 || shaft.ends == Ends::Round) return shaft;
  const Vector3 out = growth * shaft.axis.normalized();
  shaft.start -= out;
  shaft.axis += 2 * out;
  return shaft;
}

/// The first contact of a shaft whose start moves straight, in the solid's frame.
std::optional<BallContact> shaftContact(const Solid& solid, const Shaft& shaft, const Vector3& from, const Vector3& to,
                                        const Vector3& axis) {
  return shaft.ends == Ends::Flat ? solid.firstCylinderContact(from, to, axis, shaft.radius)
                                  : solid.firstCapsuleContact(from, to, axis, shaft.radius);
}

/// A stretch of the motion that is taken as straight on the table.
struct Piece {
  double begin, end;
  Pose atBegin, atEnd;
};

class Search {
public:
  Search(const Motion& motion, const ToolShape& shape, const Surroundings& surroundings, const SearchOptions& options)
      : motion_(motion), shape_(shape), surroundings_(surroundings), options_(options) {}

  std::optional<Touch> between(double begin, double end) const {
    std::vector<double> cuts = backlashCuts(begin, end);
    Pose atBegin = motion_.tableFromSpindleAt(begin);
    double from = begin;
    for (const double to : cuts) {
      const AxisPositions first = motion_.slidesAt(from), last = motion_.slidesAt(to);
      if (motion_.kinematics.isStraight(first, last)) {
        const Pose atEnd = motion_.tableFromSpindleAt(to);
        if (auto touch = sweep({from, to, atBegin, atEnd}, 0, 0)) return touch;
        atBegin = atEnd;
      } else {
        const int pieces = motion_.kinematics.piecesFor(first, last);
        for (int i = 1; i <= pieces; ++i) {
          const double pieceBegin = from + (to - from) * (i - 1) / pieces;
          const double pieceEnd = i == pieces ? to : from + (to - from) * i / pieces;
          const Pose atEnd = motion_.tableFromSpindleAt(pieceEnd);
          if (auto touch = bent({pieceBegin, pieceEnd, atBegin, atEnd}, 0)) return touch;
          atBegin = atEnd;
        }
      }
      from = to;
    }
    return std::nullopt;
  }

  /// No touch of the tool, with its radii grown, on a motion that is straight.
  bool isClear(double margin) const {
    return !sweep({0, 1, motion_.tableFromSpindleAt(0), motion_.tableFromSpindleAt(1)}, margin, margin);
  }

private:
  /// The ends of the stretches in which each slide either rests in its backlash or follows.
  std::vector<double> backlashCuts(double begin, double end) const {
    std::vector<double> cuts;
    for (std::size_t i = 0; i < motion_.kinematics.axisCount(); ++i) {
      const double backlash = motion_.kinematics.backlash(i);
      const double travel = motion_.to[i] - motion_.from[i];
      if (backlash == 0 || travel == 0) continue;
      const double gripsAt = motion_.slidesAtStart[i] - (travel < 0 ? backlash : 0);
      const double fraction = (gripsAt - motion_.from[i]) / travel;
      if (fraction > begin && fraction < end) cuts.push_back(fraction);
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.push_back(end);
    return cuts;
  }

  /// Searches a stretch that may bend: halves it until its chord is true to the precision, but leaves it at once if
  /// even a tool swollen by the bend would pass.
  std::optional<Touch> bent(const Piece& piece, int depth) const {
    if (options_.stop != nullptr && options_.stop->stop_requested()) throw SearchStopped{piece.begin};
    const double middle = 0.5 * (piece.begin + piece.end);
    const Pose atMiddle = motion_.tableFromSpindleAt(middle);
    const auto bend = [&](const Vector3& p) {
      return (atMiddle * p - 0.5 * (piece.atBegin * p + piece.atEnd * p)).norm();
    };
    double ballBend = 0, shaftBend = 0;
    for (const Ball& ball : shape_.balls)
      ballBend = std::max(ballBend, bend(ball.centre));
    for (const Shaft& shaft : shape_.shafts) {
      const double turn = ((piece.atEnd.linear() - piece.atBegin.linear()) * shaft.axis).norm();
      shaftBend = std::max({shaftBend, bend(shaft.start), bend(shaft.start + shaft.axis), turn});
    }
    constexpr int deepest = 40;
    constexpr double safety = 2;  // the bend of a smooth path is largest near the middle, where it was taken
    const bool fine = ballBend <= options_.precision && shaftBend <= shaftPrecision;
    if (fine || depth >= deepest) return sweep(piece, 0, 0);
    // A tool swollen much is near nearly everything, and where it would touch matters to nobody: boxes will do.
    constexpr double much = 1;  // mm
    const double growBall = safety * ballBend, growShafts = safety * shaftBend;
    const bool swollen = std::max(growBall, growShafts) > much;
    if (swollen ? missesAllBoxes(piece, growBall, growShafts) : !sweep(piece, growBall, growShafts))
      return std::nullopt;
    if (auto touch = bent({piece.begin, middle, piece.atBegin, atMiddle}, depth + 1)) return touch;
    return bent({middle, piece.end, atMiddle, piece.atEnd}, depth + 1);
  }

  /// True if the tool, with its radii grown, comes into the box of no solid along the chord of the piece.
  bool missesAllBoxes(const Piece& piece, double growBall, double growShafts) const {
    return std::ranges::all_of(surroundings_.items(), [&](const Surroundings::Item& item) {
      const Pose atBegin = item.solidFromTable * piece.atBegin, atEnd = item.solidFromTable * piece.atEnd;
      const bool balls = options_.ignoreBall || std::ranges::all_of(shape_.balls, [&](const Ball& ball) {
                           return sweptBoxMisses(item.bounds, atBegin * ball.centre, atEnd * ball.centre,
                                                 Vector3::Zero(), ball.radius + growBall);
                         });
      return balls &&
             (options_.ignoreShafts || std::ranges::all_of(shape_.shafts, [&](const Shaft& given) {
                const Shaft shaft = grown(given, growShafts);
                const Vector3 axis = 0.5 * (atBegin.linear() * shaft.axis + atEnd.linear() * shaft.axis);
                return sweptBoxMisses(item.bounds, atBegin * shaft.start, atEnd * shaft.start, axis, shaft.radius);
              }));
    });
  }

  /// The first touch of the tool, with its radii grown, along the chord of the piece.
  std::optional<Touch> sweep(const Piece& piece, double growBall, double growShafts) const {
    std::optional<Touch> first;
    double reach = 1;  // the part of the piece that is still in question
    const auto take = [&](const BallContact& contact, std::size_t solid, std::optional<std::size_t> shaft,
                          std::size_t ball) {
      const double local = reach * contact.fraction;
      if (first && local >= reach) return;
      const Surroundings::Item& item = surroundings_.items()[solid];
      first = Touch{piece.begin + (piece.end - piece.begin) * local,
                    solid,
                    shaft,
                    ball,
                    item.tableFromSolid * contact.ballCentre,
                    item.tableFromSolid * contact.touchPoint,
                    item.tableFromSolid.linear() * contact.normal};
      reach = local;
    };
    const auto& items = surroundings_.items();
    for (std::size_t which = 0; which < shape_.balls.size() && !options_.ignoreBall; ++which) {
      const Ball& ball = shape_.balls[which];
      const Vector3 from = piece.atBegin * ball.centre, to = piece.atEnd * ball.centre;
      const double radius = ball.radius + growBall;
      for (std::size_t i = 0; i < items.size(); ++i) {
        const Vector3 a = items[i].solidFromTable * from, b = items[i].solidFromTable * (from + (to - from) * reach);
        if (sweptBoxMisses(items[i].bounds, a, b, Vector3::Zero(), radius)) continue;
        if (const auto contact = items[i].solid->firstContact(a, b, radius)) take(*contact, i, std::nullopt, which);
      }
    }
    if (options_.ignoreShafts) return first;
    for (std::size_t c = 0; c < shape_.shafts.size(); ++c) {
      const Shaft shaft = grown(shape_.shafts[c], growShafts);
      const Vector3 from = piece.atBegin * shaft.start, to = piece.atEnd * shaft.start;
      const Vector3 axis = 0.5 * (piece.atBegin.linear() * shaft.axis + piece.atEnd.linear() * shaft.axis);
      for (std::size_t i = 0; i < items.size(); ++i) {
        const Vector3 a = items[i].solidFromTable * from, b = items[i].solidFromTable * (from + (to - from) * reach);
        const Vector3 turned = items[i].solidFromTable.linear() * axis;
        if (sweptBoxMisses(items[i].bounds, a, b, turned, shaft.radius)) continue;
        if (const auto contact = shaftContact(*items[i].solid, shaft, a, b, turned)) take(*contact, i, c, 0);
      }
    }
    return first;
  }

  const Motion& motion_;
  const ToolShape& shape_;
  const Surroundings& surroundings_;
  const SearchOptions& options_;
};

}  // namespace

AxisPositions Motion::readingAt(double fraction) const {
  if (fraction == 1) return to;
  AxisPositions reading = from;
  for (std::size_t i = 0; i < kinematics.axisCount(); ++i)
    reading[i] += (to[i] - from[i]) * fraction;
  return reading;
}

AxisPositions Motion::slidesAt(double fraction) const {
  AxisPositions slides = readingAt(fraction);
  for (std::size_t i = 0; i < kinematics.axisCount(); ++i) {
    slides[i] = kinematics.follow(i, slidesAtStart[i], slides[i]);
  }
  return slides;
}

Pose Motion::tableFromSpindleAt(double fraction) const {
  return kinematics.tableFromSpindle(slidesAt(fraction), startSeconds + profile.secondsAt(fraction * profile.length()));
}

Surroundings::Surroundings(const std::vector<PlacedSolid>& solids) {
  for (const PlacedSolid& placed : solids) {
    items_.push_back(
        {placed.solid.get(), placed.tableFromSolid.inverse(), placed.tableFromSolid, placed.solid->reach()});
  }
}

Surroundings::Surroundings(const std::vector<PlacedSolid>& solids, bool (*wanted)(const PlacedSolid&))
    : Surroundings(solids) {
  for (std::size_t i = 0; i < solids.size(); ++i)
    if (!wanted(solids[i])) items_[i].bounds = Bounds{};
}

std::optional<Touch> firstTouch(const Motion& motion, double begin, double end, const ToolShape& shape,
                                const Surroundings& surroundings, const SearchOptions& options) {
  return Search(motion, shape, surroundings, options).between(begin, end);
}

bool isClear(const Motion& straight, double margin, const ToolShape& shape, const Surroundings& surroundings) {
  return Search(straight, shape, surroundings, {}).isClear(margin);
}

std::optional<Touch> ballOverlap(const Pose& tableFromSpindle, const ToolShape& shape,
                                 const Surroundings& surroundings) {
  for (std::size_t b = 0; b < shape.balls.size(); ++b) {
    const double radius = shape.balls[b].radius;
    const Vector3 centre = tableFromSpindle * shape.balls[b].centre;
    for (std::size_t i = 0; i < surroundings.items().size(); ++i) {
      const Surroundings::Item& item = surroundings.items()[i];
      const Vector3 p = item.solidFromTable * centre;
      if (sweptBoxMisses(item.bounds, p, p, Vector3::Zero(), radius)) continue;
      if (const auto contact = item.solid->firstContact(p, p, radius)) {
        return Touch{0,
                     i,
                     std::nullopt,
                     b,
                     centre,
                     item.tableFromSolid * contact->touchPoint,
                     item.tableFromSolid.linear() * contact->normal};
      }
    }
  }
  return std::nullopt;
}

std::optional<Touch> shaftOverlap(const Pose& tableFromSpindle, const ToolShape& shape,
                                  const Surroundings& surroundings) {
  for (std::size_t c = 0; c < shape.shafts.size(); ++c) {
    const Shaft& shaft = shape.shafts[c];
    for (std::size_t i = 0; i < surroundings.items().size(); ++i) {
      const Surroundings::Item& item = surroundings.items()[i];
      const Vector3 p = item.solidFromTable * (tableFromSpindle * shaft.start);
      const Vector3 axis = item.solidFromTable.linear() * (tableFromSpindle.linear() * shaft.axis);
      if (sweptBoxMisses(item.bounds, p, p, axis, shaft.radius)) continue;
      if (const auto contact = shaftContact(*item.solid, shaft, p, p, axis)) {
        return Touch{0,
                     i,
                     c,
                     0,
                     Vector3::Zero(),
                     item.tableFromSolid * contact->touchPoint,
                     item.tableFromSolid.linear() * contact->normal};
      }
    }
  }
  return std::nullopt;
}

}  // namespace probewright::simulation
