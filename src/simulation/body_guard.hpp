#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "simulation/body_scene.hpp"

/// What the bodies of a machine run into: each other, the tool, and what lies on the table.
namespace probewright::simulation {

struct BodyMesh;

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
/// The tool meets a body as it meets a part, see firstTouch(). Two bodies are triangles: their distance is
/// computed where they stand, and they go on as far as that allows whatever way they take (conservative advancement),
/// but by at least 0.02 mm. A contact is found to 0.002 mm of the triangles, one that lasts less than 0.02 mm of the
/// way may be missed.
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
  struct Pair;
  struct View;

  const BodyMesh& meshOf(const BodyThing& thing);
  double gap(const BodyPair& pair, const Pose& firstFromSecond, double enough, Vector3* point, Vector3* normal);
  std::optional<BodyHit> approach(Pair& pair, const Motion& motion, double end, Touching touching,
                                  const std::stop_token& stop);
  BodyHit hitOf(const BodyPair& pair, const Motion& motion, double fraction, const Vector3& point,
                const Vector3& normal) const;
  BodyHit hitOf(const BodyView& view, const Touch& touch, const Pose& tableFromLink) const;
  Pose tableFromLink(const machine::Link& link, const machine::AxisPositions& slides) const;

  BodyScene scene_;
  std::vector<std::shared_ptr<const BodyMesh>> meshes_;  ///< of its things; made when they are needed
  std::vector<Pair> pairs_;                              ///< what is known of the pairs of the scene
  std::vector<View> views_;                              ///< and of its views
};

}  // namespace probewright::simulation
