#pragma once

#include <functional>
#include <optional>

#include "control/channel.hpp"
#include "execution/names.hpp"
#include "geometry/primitives.hpp"
#include "language/block.hpp"
#include "language/klartext/heidenhain_program.hpp"

/// The contour that path functions describe: roundings and chamfers between its elements, and the path of the tool
/// centre beside it.
namespace probewright::execution::klartext {

/// The block that a piece of a contour comes from: alarms name it, however late the piece is carried out.
struct BlockPlace {
  const HeidenhainProgram* program = nullptr;
  BlockPosition position{};
};

/// On which side of the contour the tool centre runs, seen in the direction of motion.
enum class Side { Off = 0, Left = 1, Right = -1 };

/// One element of a contour, in the working plane (main and minor axis, mm) and along the tool axis.
struct Element {
  Vector2 from = Vector2::Zero(), to = Vector2::Zero();
  double heightFrom = 0, heightTo = 0;
  bool arc = false;
  Vector2 centre = Vector2::Zero();
  double sweep = 0;  ///< arcs: radians, counter-clockwise positive; may exceed a full turn
  Side side = Side::Off;
  control::Feed feed;
  BlockPlace block;
  /// Axes beside X, Y, Z that move along, by axis index.
  std::array<std::optional<double>, machine::maximumAxes> rotary;

  double radius() const { return (from - centre).norm(); }
  /// Directions of motion, unit length. The zero vector for a line without length.
  Vector2 startDirection() const;
  Vector2 endDirection() const;
};

/// A tangential arc that starts at `from` in `direction` and ends at `to`; a line if they are in line.
Element tangentialArc(const Vector2& from, const Vector2& direction, const Vector2& to);

/// APPR and DEP.
struct Approach {
  enum class Path { TangentialLine, PerpendicularLine, TangentialArc, ArcAndLine };
  Path path = Path::TangentialLine;
  Vector2 point = Vector2::Zero();  ///< APPR: the first contour point; DEP LCT: the end point
  double height = 0;                ///< at `point`
  double length = 0;                ///< LEN
  double radius = 0;                ///< R; negative: on the other side
  double angle = 0;                 ///< CCA, radians
  Side side = Side::Off;
  control::Feed feed;
  BlockPlace block;
};

/// Takes elements in their order and hands on what the tool centre does. Elements wait here as long as what follows
/// them decides where they end: before a rounding, and while radius compensation is on. Throws Alarm where the
/// geometry is impossible; alarms, also those of the moves, name the block of the element that was under way.
class Contour {
public:
  /// `run` moves along an element. `radius` is asked for the tool radius (mm) when an element with compensation comes.
  Contour(std::function<void(const Element&)> run, std::function<double()> radius)
      : run_(std::move(run)), radius_(std::move(radius)) {}

  /// Adds an element. `waits`: a rounding or a chamfer follows.
  void add(const Element& element, bool waits);
  /// The tool went straight in this direction (any length; zero: along the tool axis) without this contour.
  void passed(const Vector2& motion) {
    if (motion.squaredNorm() > 1e-18) direction_ = motion.normalized();
  }
  void round(double radius, std::optional<control::Feed> feed, const BlockPlace& block);
  void chamfer(double length, std::optional<control::Feed> feed, const BlockPlace& block);
  /// Begins a contour at `from`, where the tool stands; its direction comes with the next element.
  void approach(const Vector2& from, double heightFrom, const Approach& approach);
  /// Leaves the contour after the last element.
  void depart(const Approach& departure);

  /// Carries out everything that waits; compensation stays on.
  void flush();
  /// Forgets everything that waits.
  void discard();

  /// True while the programmed position is not where the tool stands.
  bool holds() const { return last_ || previous_ || compensated_ || approach_; }
  /// The programmed position, while holds().
  const Vector2& end() const { return end_; }
  double endHeight() const { return endHeight_; }
  /// The direction in which the last element ended; the zero vector if there is none.
  const Vector2& direction() const { return direction_; }

private:
  struct Corner {
    double size = 0;
    bool rounding = true;
    std::optional<control::Feed> feed;
    BlockPlace block;
  };
  struct Waiting {
    Element element;
    bool approachLine = false;  ///< the block that switches compensation on
  };

  template <class Work>
  void located(Work work);
  void addLocated(const Element& element, bool waits);
  void flushLocated();
  void departLocated(const Approach& departure);
  std::optional<Element> cut(Element& first, Element& second, const Corner& corner);
  void compensate(const Element& element);
  void join(const Element& next);
  void finish();
  void runOffset(const Element& element, const Vector2& end);
  void lineTo(const Vector2& to, double height, control::Feed feed);
  void arcTo(const Vector2& centre, double sweep, double height, control::Feed feed);
  void runApproach(const Element& next);

  std::function<void(const Element&)> run_;
  std::function<double()> radius_;
  std::optional<Element> last_;      ///< waits for a rounding
  std::optional<Corner> corner_;     ///< waits for the element after it
  std::optional<Waiting> previous_;  ///< waits for the corner with the next element
  std::optional<Approach> approach_;
  bool compensated_ = false;
  Vector2 position_ = Vector2::Zero();  ///< of the tool centre while compensated
  double height_ = 0;
  Vector2 end_ = Vector2::Zero();
  double endHeight_ = 0;
  Vector2 direction_ = Vector2::Zero();
  Side lastSide_ = Side::Off;
  BlockPlace current_;  ///< of what is under way
};

}  // namespace probewright::execution::klartext
