#pragma once

#include "cycles/heidenhain/nominal_position.hpp"

/// How the probe travels in cycles 1410, 1411 and 1420: Q1125, Q260, Q320 and the semi-automatic mode.
namespace probewright::cycles::heidenhain {

class ObjectProbing {
public:
  /// Pre-positions at FMAX of the probe table, with Q1125 = 2 at 2000 mm/min. `called`: what questions to the operator
  /// call what is probed, "point" or "object".
  ObjectProbing(Context& context, std::string_view called);

  probing::HeidenhainProber& prober() { return prober_; }

  /// Touches the point of an edge or plane whose position is not known beforehand. All such points of a call belong to
  /// one object, which is entered and left as Q1125 says. Of a position with "?" the operator says where the touch
  /// begins, and may choose another direction. `direction`: 1, 2, 3 along main, minor, tool axis, or negative, as in
  /// Q372.
  EvaluatedTouch touch(const NominalPosition& nominal, int& direction);
  /// The ball centres on a circle at `count` angles `step` apart. With "?" the operator brings the ball to the middle
  /// of the object at the measuring height (hole) or centred above it by the set-up clearance (stud).
  std::vector<EvaluatedTouch> touchCircle(const NominalPosition& nominal, const Vector2& diameterAndStart, double step,
                                          int count, Side side);
  /// The object is done, others follow.
  void leaveObject();
  /// The last one is. After "?" the operator has retracted already.
  void leaveLastObject();

private:
  enum class Point { FirstOfObject, Further };
  void enter(const BallCentre& ballCentre, Point point);
  void askOperator(const std::string& what, const std::string& task, int* direction = nullptr);
  /// Where the operator retracts to by hand, if he says so.
  void retractByOperator(const std::string& what);
  /// Where the operator wants the tip of the probe to go, and the probing direction if he chooses one, otherwise 0.
  struct Way {
    std::vector<PlanePlace> tips;
    int direction = 0;
  };
  /// What the operator may say.
  enum class Asked { Way, WayAndDirection };
  /// "main minor tool; main minor tool" in the unit of the program, as the position display shows it. After the last
  /// waypoint a direction may follow, where it can be chosen: "10 20 -5 Y-". Without waypoints the probe stays where it
  /// is. Nothing if the text is something else.
  std::optional<Way> wayOf(const std::string& text, Asked asked) const;
  std::optional<std::string> answer(const std::string& what, Asked asked);
  void moveAlong(const std::string& what, const std::string& waypoints, int* direction = nullptr);
  /// "Y-" as Q372 counts, 0 if it is none; and the other way round.
  int directionFrom(const std::string& word) const;
  std::string nameOf(int direction) const;
  std::string question(int ordinal) const;

  Context& context_;
  std::string_view called_;
  probing::HeidenhainProber prober_;
  int mode_ = 0;
  double clearance_ = 0, extra_ = 0;
  bool entered_ = false, byHand_ = false;
};

}  // namespace probewright::cycles::heidenhain
