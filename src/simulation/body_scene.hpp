#pragma once

#include <memory>
#include <string>
#include <vector>

#include "machine/links.hpp"
#include "simulation/contact_search.hpp"
#include "simulation/truth.hpp"

/// What the bodies of a machine may run into: each other, the tool, and what lies on the table.
///
/// Everything on one link is rigid. Bodies of links that an axis joins touch by design and make no pair; parts,
/// fixtures and gauges make one with all bodies but those of the table, the tool meets all but those of the head. Axes
/// are where they truly are but for their deviations by position and by heat.
namespace probewright::simulation {

/// A body, or a solid on the table.
struct BodyThing {
  std::size_t index = 0;  ///< in the scene
  std::shared_ptr<const Solid> solid;
  machine::Link link;
  Pose linkFromSolid;
  std::string name;
  bool ofMachine = false;  ///< the machine's own: it may touch its neighbours
  bool isBody = false;
  Bounds bounds;                     ///< solid's frame
  Vector3 centre = Vector3::Zero();  ///< of a ball about it, link frame
  double radius = 0;
};

/// How far two boxes are apart at least: the second one within the smallest box about it that is parallel to the first.
double boxDistance(const Bounds& first, const Pose& firstFromSecond, const Bounds& second);
/// How far the solids of two things are apart at least, by balls and boxes about them; the pose leads between their
/// frames.
double apartByBounds(const BodyThing& first, const Pose& firstFromSecond, const BodyThing& second);

/// Two things that must not meet; the second is a body.
struct BodyPair {
  const BodyThing* first = nullptr;
  const BodyThing* second = nullptr;
  std::shared_ptr<const TrueKinematics> kinematics;  ///< "table" and "spindle" of it are the two links
  machine::Between between;
};

/// The bodies of one link as the tool sees them.
struct BodyView {
  machine::Link link;
  std::shared_ptr<const TrueKinematics> kinematics;
  std::vector<PlacedSolid> solids;
  std::unique_ptr<Surroundings> surroundings;
};

class BodyScene {
public:
  explicit BodyScene(const Truth& truth);

  const machine::MachineDescription& machine() const { return machine_; }
  const std::vector<BodyThing>& things() const { return things_; }
  const std::vector<BodyPair>& pairs() const { return pairs_; }
  const std::vector<BodyView>& views() const { return views_; }

  /// How far points of two things may travel against each other on the motion, mm: of the balls about them, each made
  /// larger by `more`.
  double longestWay(const BodyPair& pair, const Motion& motion, double more = 0) const;

  /// The motion as a pair or a view of the scene sees it.
  static Motion seen(const Motion& motion, const TrueKinematics& kinematics);

private:
  /// Bodies of the machine; what it has on its table, such as tool touch probes; parts and fixtures.
  enum class Kind { Body, OfMachine, Other };
  void addThing(std::shared_ptr<const Solid> solid, const machine::Link& link, const Pose& linkFromSolid,
                std::string name, Kind kind);
  void addPairs();
  void addViews();
  std::shared_ptr<const TrueKinematics> kinematicsBetween(const machine::Link& first,
                                                          const machine::Link& second) const;

  machine::MachineDescription machine_;
  MachineErrors errors_;  ///< those of single axes that do not depend on their positions
  std::vector<BodyThing> things_;
  std::vector<BodyPair> pairs_;
  std::vector<BodyView> views_;
};

}  // namespace probewright::simulation
