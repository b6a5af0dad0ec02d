#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "simulation/contact_search.hpp"
#include "simulation/machine_body.hpp"
#include "simulation/truth.hpp"

/// What the bodies of a machine run into: each other, the tool, and what lies on the table.
namespace probewright::simulation {

/// A body of the machine has met something, or the tool has met a body.
struct BodyHit {
  double fraction = 0;                ///< of the way of the motion
  bool byTool = false;                ///< the tool has met the body
  std::optional<std::size_t> shaft;   ///< of the tool: counts in ToolShape::shafts; nothing for a ball
  std::string body;                   ///< the name of the body
  std::string other;                  ///< of what it has met, if that is not the tool
  Vector3 point = Vector3::Zero();    ///< table frame, mm
  Vector3 normal = Vector3::UnitZ();  ///< unit, away from what was met, as far as it is known; table frame
};

/// Watches bodies on straight moves in axis space.
///
/// Pairs. Everything on one link is rigid. Bodies of links that an axis joins touch by design and are not tested
/// against each other; parts, fixtures and gauges are tested against all bodies but those of the table, the tool
/// against all but those of the head.
///
/// Method. The tool meets a body as it meets a part, see firstTouch(). Two bodies are triangles: their distance is
/// computed where they stand, and they go on as far as that allows whatever way they take (conservative advancement),
/// but by at least 0.02 mm. A contact is found to 0.002 mm of the triangles, one that lasts less than 0.02 mm of the
/// way may be missed. Axes are where they truly are but for their deviations by position and by heat.
class BodyGuard {
public:
  explicit BodyGuard(const Truth& truth);
  ~BodyGuard();
  BodyGuard(const BodyGuard&) = delete;
  BodyGuard& operator=(const BodyGuard&) = delete;

  enum class Touching { Counts, MayBePulledOff };
  /// The first hit on the way up to the fraction `end`. `touching`: what of things that touch at the start of it and do
  /// not come apart. Throws SearchStopped.
  std::optional<BodyHit> firstHit(const Motion& motion, double end, const ToolShape& tool, Touching touching,
                                  const std::stop_token& stop);
  /// How far the axes have gone on the way asked for last: what is known of the distances stays known.
  void arrived(double fraction);
  /// The axes have moved otherwise: nothing is known.
  void forget();

  /// What touches where the axes stand: bodies and things on the table, then the tool.
  std::optional<BodyHit> standing(const machine::AxisPositions& slides, double seconds);
  std::optional<BodyHit> standing(const machine::AxisPositions& slides, double seconds, const ToolShape& tool);

private:
  struct Thing;
  struct Pair;
  struct View;

  void addThing(std::shared_ptr<const Solid> solid, const machine::Link& link, const Pose& linkFromSolid,
                std::string name, bool ofMachine, bool isBody);
  void addPairs();
  void addViews();
  std::unique_ptr<TrueKinematics> kinematicsBetween(const machine::Link& first, const machine::Link& second) const;
  double gap(Pair& pair, const Pose& firstFromSecond, double enough, Vector3* point, Vector3* normal);
  std::optional<BodyHit> approach(Pair& pair, const Motion& motion, double end, Touching touching,
                                  const std::stop_token& stop);
  BodyHit hitOf(const Pair& pair, const Motion& motion, double fraction, const Vector3& point,
                const Vector3& normal) const;
  BodyHit hitOf(const View& view, const Touch& touch, const Pose& tableFromLink) const;
  Motion seen(const Motion& motion, const TrueKinematics& kinematics) const;
  Pose tableFromLink(const machine::Link& link, const machine::AxisPositions& slides) const;

  machine::MachineDescription machine_;
  MachineErrors errors_;  ///< those of single axes that do not depend on their positions
  std::vector<std::unique_ptr<Thing>> things_;
  std::vector<std::unique_ptr<Pair>> pairs_;
  std::vector<std::unique_ptr<View>> views_;
};

}  // namespace probewright::simulation
