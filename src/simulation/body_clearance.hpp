#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/body_scene.hpp"

namespace probewright::simulation {

struct BodyMesh;

/// Whether bodies of the machine keep a distance from each other, from what lies on the table and from the tool. Safe
/// to query from many threads at once.
class BodyClearance {
public:
  /// All pairs of the scene; or what carries the tool against what carries the part, and against what lies on the
  /// table: gaps of slides and covers that a machine is built with do not count there.
  enum class Pairs { All, SpindleAgainstTable };
  explicit BodyClearance(const Truth& truth, Pairs pairs = Pairs::All);
  BodyClearance(const BodyClearance&) = delete;
  BodyClearance& operator=(const BodyClearance&) = delete;

  struct Margins {
    double bodies = 0;  ///< mm, between two bodies of the machine
    double solids = 0;  ///< mm, between a body and something on the table
  };
  struct Near {
    std::string body;   ///< of the machine
    std::string other;  ///< what it is near to; empty: the tool
    std::string text() const;
  };
  /// What may come nearer than the margins somewhere on the motion; nothing if all keep away. `tool` must touch no
  /// body; it is to be as thick as it is with its margin. Never misses what comes nearer; what comes no nearer than the
  /// margin and 0.05 mm is not named. With Pairs::SpindleAgainstTable things that the motion does not move against each
  /// other are left out.
  std::optional<Near> nearer(const Motion& motion, const Margins& margins, const ToolShape& tool) const;

private:
  double gap(const BodyPair& pair, const Pose& firstFromSecond, double enough, double margin) const;

  BodyScene scene_;
  Pairs which_;
  std::vector<const BodyPair*> pairs_;                   ///< those of the scene that count
  std::vector<std::shared_ptr<const BodyMesh>> meshes_;  ///< of the things of the scene
};

}  // namespace probewright::simulation
