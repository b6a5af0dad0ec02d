#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/primitives.hpp"
#include "machine/description.hpp"

/// What a report draws, as plain data. All of it is given in one frame, the scene: the one in which the part stands
/// still (the frame of the machine's table), Z up, mm. Reports know nothing of where it comes from.
namespace probewright::reports {

using Vector3f = Eigen::Vector3f;

enum class MeshRole : std::uint8_t { Part, Fixture, Artefact };

/// A triangulated body in its own frame.
struct Mesh {
  std::string name;
  MeshRole role = MeshRole::Part;
  Pose sceneFromMesh = Pose::Identity();
  std::vector<Vector3f> positions;       ///< one per vertex
  std::vector<Vector3f> normals;         ///< unit, one per vertex; empty: flat shading
  std::vector<std::uint32_t> triangles;  ///< three indices each, counter-clockwise from outside
  std::vector<Vector3f> featureEdges;    ///< two points per segment
};

/// A jump is not drawn: the tool was changed or set down elsewhere.
enum class MoveKind : std::uint8_t { Rapid = 0, Feed = 1, Measure = 2, Jump = 3 };

/// The way of the ball's centre, or of the end of a cutter.
struct Path {
  std::vector<Vector3f> points;
  std::vector<MoveKind> kinds;               ///< kinds[i] is the move from points[i] to points[i + 1]
  std::vector<float> seconds;                ///< machine clock at each point; empty: the run cannot be replayed
  std::vector<Vector3f> toolAxes;            ///< unit, from the ball to the spindle at each point; empty: always +Z
  std::vector<machine::AxisPositions> axes;  ///< what they read at each point; empty: nobody knows
  /// Which of the scene's tools is in the spindle from a point on; -1: a touch probe, or none. Empty: always so.
  struct ToolFrom {
    std::uint32_t point = 0;
    std::int32_t tool = -1;
  };
  std::vector<ToolFrom> tools;
};

/// Where a touch of the journal really was.
struct SceneTouch {
  std::uint32_t cycle = 0;  ///< index into Journal::cycles
  std::uint32_t touch = 0;  ///< index into CycleRecord::touches
  Vector3f ballCentre = Vector3f::Zero();
  Vector3f surface = Vector3f::Zero();  ///< on the part; equal to ballCentre if there was no contact
  std::int32_t tool = -1;  ///< the scene's tool that touched, its end at ballCentre; -1: a touch probe's ball
  Vector3f toolAxis = Vector3f::UnitZ();  ///< unit, from the ball or the end to the spindle
};

/// Where the tool ran into something, or the ball was deflected while the axes only positioned.
struct SceneCollision {
  Vector3f at = Vector3f::Zero();  ///< on the surface
  std::string what;                ///< "stylus", "ball", "tool": the part of the tool that hit
  std::string solid;               ///< the name of what was hit
};

/// What a cycle saw with the camera of the machine. Pictures are PNG files; empty where there is none.
struct CameraShot {
  std::uint32_t cycle = 0;  ///< index into Journal::cycles
  std::string point;        ///< monitoring point: "PLATE.OS"
  int number = 0;           ///< of the image
  int references = 0;       ///< reference images of the point
  int errors = 0;           ///< places in which the image deviates
  std::string reference;    ///< what it is compared with: the average of the reference images
  std::string taken;
  std::string evaluated;  ///< taken, with monitoring areas and errors framed; empty where nothing is compared
};

struct MachineReplay;

struct Scene {
  std::vector<Mesh> meshes;
  Path path;
  /// Cutters: the end of each lies in its origin, its shank along +Z, as simulation::toolFrame() has it.
  std::vector<Mesh> tools;
  std::vector<SceneTouch> touches;
  std::vector<SceneCollision> collisions;
  std::vector<CameraShot> camera;
  double ballRadius = 0;  ///< of the probe, mm; 0: not drawn
  bool lathe = false;     ///< the main spindle turns the workpiece: drawn with Z to the right and X up
  std::optional<Pose>
      sceneFromWorkpiece;  ///< the workpiece coordinate system at the end of the run, as the control believes
  std::shared_ptr<const MachineReplay> machine;  ///< null: it has no bodies to be drawn
};

}  // namespace probewright::reports
