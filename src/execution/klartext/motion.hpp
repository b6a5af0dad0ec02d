#pragma once

#include <optional>

#include "execution/klartext/contour.hpp"
#include "execution/klartext/tool_guidance.hpp"
#include "execution/klartext/tools.hpp"

namespace probewright::execution::klartext {

/// What M functions say about the path.
struct PathModes {
  bool feedPerRevolution = false;  ///< M136
  bool shortestPath = false;       ///< M126
  bool untiltedPositions = false;  ///< M130, in this block
  bool ignoreProbe = false;        ///< M141, in this block
};

/// Throws Alarm for a feed slower than any control takes: it would never arrive.
control::Feed checkedFeed(double millimetresPerMinute);

/// Path functions: straight lines, arcs, corners, approach and departure, polar coordinates, positions of the machine.
/// Program coordinates and feeds are in the unit of the program.
class Motion {
public:
  Motion(RunContext& run, ToolGuidance& guidance, Tools& tools);

  void carryOut(const Move& move, Evaluation& evaluation);

  /// Carries out all motion that waits; radius compensation stays.
  void flush() { contour_.flush(); }
  /// Forgets all motion that waits.
  void discard() { contour_.discard(); }
  /// Ends all motion that waits; compensation ends too.
  /// True while the tool does not stand where the program does: radius compensation, a rounding or chamfer to come.
  bool holdsContour() const { return contour_.holds(); }
  void settle();

  /// Away from the workpiece along the tool axis, by a distance or to the limit of travel.
  void retract(std::optional<double> distance, control::Feed feed);
  /// The end point that axis words X, Y, Z give.
  ProgramPlace pointOf(WordRange words, Evaluation& evaluation, const ProgramPlace& from) const;
  /// True if the block moves an axis; a feed or a radius compensation alone does not.
  static bool travels(const Move& move, Evaluation& evaluation);

  PathModes modes;
  /// mm/min, or with M136 mm per revolution; 0: none programmed yet.
  double feed() const { return feed_; }
  /// The feed of TOOL CALL counts until a path block or another TOOL CALL names one.
  void takeFeedOfTool() { feed_ = control_.tool.feed; }

private:
  void straight(const Move& move, Evaluation& evaluation);
  void arc(const Move& move, Evaluation& evaluation);
  void corner(const Move& move, Evaluation& evaluation);
  void approachOrDepart(const Move& move, Evaluation& evaluation);
  void setCentre(const Move& move, Evaluation& evaluation);
  void moveInMachineCoordinates(const Move& move, Evaluation& evaluation);
  void runElement(const Element& element, const control::WorkingPlane& plane);
  void addElement(Element element, const Move& move, Evaluation& evaluation);
  ProgramPlace programmedPosition() const;
  control::Feed feedOf(const Move& move, Evaluation& evaluation);
  control::Feed feedFor(double programmed) const;
  Vector2 polarEnd(const Move& move, const Vector2& start, const Vector2& pole, Evaluation& evaluation) const;
  void refuseMixture(const Move& move, const control::WorkingPlane& plane, Evaluation& evaluation) const;
  void nameOtherAxes(const Move& move, Evaluation& evaluation);
  void namePathWords(const Move& move, Evaluation& evaluation);
  ProgramPlace untiltedTarget(const Move& move, Evaluation& evaluation, const ProgramPlace& from) const;
  void straightTo(const ProgramPlace& to, control::Feed feed);
  BlockPlace placeOf(Evaluation& evaluation) const;
  bool cornerFollows(Evaluation& evaluation) const;
  Side sideOf(const Move& move);

  RunContext& run_;
  control::heidenhain::Control& control_;
  ToolGuidance& guidance_;
  Tools& tools_;
  Contour contour_;
  double feed_ = 0;
  Side side_ = Side::Off;
  ProgramPlace pole_;
  bool poleSet_ = false;
  std::optional<control::WorkingPlane> polePlane_;  ///< of CC, if it is not that of the tool axis
  int arcDirection_ = 0;
};

}  // namespace probewright::execution::klartext
