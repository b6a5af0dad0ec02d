#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/beliefs.hpp"
#include "control/control_kind.hpp"
#include "control/journal.hpp"
#include "control/working_plane.hpp"
#include "records/truth.hpp"
#include "session/run.hpp"
#include "simulation/truth.hpp"
#include "truth/expected_corner.hpp"
#include "truth/expected_feature.hpp"
#include "truth/expected_walls.hpp"
#include "truth/touched_points.hpp"

/// What has to be known of a control family to compare its runs with the truth: what its calls say of the features that
/// they are to find, and what the entries of its tables mean. A family without an entry has runs of which less is told.
namespace probewright::truth {

/// A number of a preset or zero offset: a coordinate of the origin along a machine axis, or an angle about one.
struct FrameNumber {
  records::EntryKind kind = records::EntryKind::Preset;
  std::string name;   ///< of the frame
  std::string label;  ///< of the number
  int axis = 0;       ///< X, Y, Z
  bool angle = false;
};

struct FamilyTruth {
  std::string_view family;  ///< as session::ControlFamily names it

  /// What the call of a cycle looks for; nothing for cycles that look for something else. SINUMERIK cycles begin in the
  /// middle of the feature: `start` is where, in workpiece coordinates.
  std::optional<ExpectedRound> (*round)(const control::CycleRecord& cycle, const control::WorkingPlane& plane,
                                        const Vector3& start) = nullptr;
  std::optional<ExpectedWalls> (*walls)(const control::CycleRecord& cycle, const control::WorkingPlane& plane,
                                        const Vector3& start) = nullptr;
  /// `height`: of the start, along the tool.
  std::optional<PlaneCorner> (*corner)(const control::CycleRecord& cycle, double height) = nullptr;
  /// `way`: of the measuring move; the cycle may be null.
  Reach (*reach)(const control::CycleRecord* cycle, double way, control::ControlKind control) = nullptr;

  /// What a place of a table is, if it is a number of a preset or zero offset.
  std::optional<FrameNumber> (*frameNumber)(const std::string& table, const std::string& entry) = nullptr;
  /// The mm in a unit of length of that table, as the run left it; null: tables are in mm.
  double (*unitOf)(const session::RunOutcome& outcome, const std::string& table) = nullptr;
  bool (*isOfTools)(std::string_view table) = nullptr;
  /// As toolEntries().
  std::vector<records::EntryTruth> (*tools)(const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                                            const control::Beliefs& calibrated,
                                            const simulation::Truth& truth) = nullptr;
  bool (*isOfKinematics)(std::string_view table) = nullptr;
  /// As tableEntries(); null: there is nothing else.
  std::vector<records::EntryTruth> (*tables)(const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                                             const std::vector<TouchedCycle>& touched, const simulation::Truth& truth,
                                             const simulation::PathRecord& path) = nullptr;
};

extern const FamilyTruth heidenhainTruth, sinumerikTruth;

/// Null for families that have no entry.
const FamilyTruth* familyTruth(control::ControlKind control);

std::vector<records::EntryTruth> heidenhainToolEntries(const session::RunOutcome& outcome,
                                                       const control::Beliefs& beliefs,
                                                       const control::Beliefs& calibrated,
                                                       const simulation::Truth& truth);
std::vector<records::EntryTruth> heidenhainTableEntries(const session::RunOutcome& outcome,
                                                        const control::Beliefs& beliefs,
                                                        const std::vector<TouchedCycle>& touched,
                                                        const simulation::Truth& truth,
                                                        const simulation::PathRecord& path);
std::vector<records::EntryTruth> sinumerikToolEntries(const session::RunOutcome& outcome,
                                                      const control::Beliefs& beliefs,
                                                      const control::Beliefs& calibrated,
                                                      const simulation::Truth& truth);

}  // namespace probewright::truth
