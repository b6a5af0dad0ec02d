#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"

/// What a simulated run knows and its control does not: true values beside the measured ones, what table entries are
/// worth, why an alarm came, how near the machine came to things. Written after the run, by whoever knows the truth;
/// read by results files, summary and report. Lengths in mm, angles in degrees.
namespace probewright::records {

/// How a true value was found.
enum class TruthBasis : std::uint8_t {
  Face,    ///< from the exact surfaces of the faces that were touched
  Points,  ///< fitted through the true points of contact, on free-form faces and on triangles
};

/// The true value of a result, in its unit and coordinate system.
struct TrueValue {
  double value = 0;
  TruthBasis basis = TruthBasis::Face;
  std::string shape;  ///< of the face: "plane", "cylinder", "cone", "sphere", "torus"; empty: free form
};

/// Where a touch really was.
struct TrueTouch {
  Vector3 surface = Vector3::Zero();  ///< point of contact, workpiece coordinates
  double error = 0;                   ///< measured less true point, along the outward normal of the surface
  std::string solid;                  ///< its name
  std::string shape;                  ///< as of TrueValue
};

struct CycleTruth {
  std::vector<std::optional<TrueValue>> results;  ///< of each result, in order
  std::vector<std::optional<TrueTouch>> touches;  ///< of each touch, in order
};

/// One number of an entry.
struct EntryValue {
  std::string name;  ///< "X", "SPC", "L"
  std::string unit;  ///< "mm", "deg"
  double value = 0, truth = 0;
};

enum class EntryKind : std::uint8_t { Preset, ZeroOffset, Tool, Probe, Kinematics };

/// What was written into a table, as it is at the end of the run, against what is true.
struct EntryTruth {
  EntryKind kind = EntryKind::Preset;
  std::string name;                  ///< "preset 1", "G54", "tool 5", "axis C"
  std::optional<std::size_t> cycle;  ///< that wrote it last: its place in Journal::cycles
  std::vector<EntryValue> values;
  std::optional<double> distance;  ///< from the truth, mm
  std::optional<double> angle;     ///< degrees
};

/// A shape to be drawn: where something was expected, or is. Table frame.
struct Ghost {
  std::string shape;                 ///< "point", "circle", "plane", "outline"
  Vector3 at = Vector3::Zero();      ///< the point, the centre, the corner
  Vector3 normal = Vector3::Zero();  ///< outward; of a circle its axis; unit, or zero where there is none
  double diameter = 0;               ///< of a circle
  std::vector<Vector3> outline;      ///< corners of a line; one that closes ends where it begins
};

/// Why a motion was interrupted, as far as the truth tells.
struct Diagnosis {
  std::optional<std::size_t> cycle;  ///< that ran: its place in Journal::cycles
  double seconds = 0;                ///< machine clock
  std::vector<std::string> texts;    ///< one sentence each
  std::optional<Ghost> expected, found;
};

/// A stretch of time and the least distance of the tool from everything else in it.
struct ClearanceSpan {
  double from = 0, to = 0;           ///< machine clock, s
  double distance = 0;               ///< mm
  bool orMore = false;               ///< it is at least this
  std::string part;                  ///< of the tool: "stylus", "body", "tool"
  std::string solid;                 ///< what it was near to
  std::optional<std::size_t> cycle;  ///< that ran
  std::optional<SourcePlace> place;  ///< of the block, where the run was traced
};

struct Clearance {
  double limit = 0;  ///< below it a warning is given; 0: there is none
  std::vector<ClearanceSpan> spans;
};

/// How near an axis came to an end of its travel.
struct TravelMargin {
  std::string axis;
  std::string unit;
  double margin = 0;                                ///< from the nearer end
  double position = 0;                              ///< where it stood then
  double seconds = 0;                               ///< machine clock
  std::optional<SourcePlace> place = std::nullopt;  ///< of the block, where the run was traced
};

struct Truth {
  std::vector<CycleTruth> cycles;  ///< of each cycle, in order
  std::vector<EntryTruth> entries;
  std::vector<Diagnosis> diagnoses;
  std::optional<Clearance> clearance;
  std::vector<TravelMargin> travel;    ///< of each axis with end stops the least one
  std::vector<TravelMargin> nearEnds;  ///< of each block the axes that came nearer to an end than the clearance's limit
};

/// "face", "points"; "preset", "zero offset", "tool", "probe", "kinematics": the names in results.json.
std::string_view nameOf(TruthBasis basis);
std::string_view nameOf(EntryKind kind);

}  // namespace probewright::records
