#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/sinumerik/data_store.hpp"
#include "control/working_plane.hpp"

/// Tool data of SINUMERIK controls: cutting edges $TC_DP1..25[t,d], additive and setup offsets $TC_SCP.., $TC_ECP..,
/// names $TC_TP2[t]. Lengths in mm, angles in degrees.
namespace probewright::control::sinumerik {

/// One cutting edge.
struct ToolEdge {
  int type = 0;                           ///< DP1: 1xx mill, 2xx drill, 5xx turning, 580 and 710..714 probes
  int position = 0;                       ///< DP2: cutting edge position of turning tools
  std::array<double, 3> length = {};      ///< DP3..DP5
  double radius = 0;                      ///< DP6
  double cornerRadius = 0;                ///< DP7
  double correctionAngle = 0;             ///< DP10, of probes
  std::array<double, 3> lengthWear = {};  ///< DP12..DP14
  double radiusWear = 0;                  ///< DP15
  std::array<double, 3> adapter = {};     ///< DP21..DP23
  double identifier = 0;                  ///< DP25: switching directions of probes in bits 16..21
  std::array<double, 3> additive = {};    ///< SCP lengths of the DL number asked for
  std::array<double, 3> setup = {};       ///< ECP lengths of the DL number asked for
  double radiusAdditive = 0, radiusSetup = 0;
  /// 2 where the data count length 1 of a turning tool, which acts in the transverse axis, as a diameter: MD 20360
  /// $MC_TOOL_PARAMETER_DEF_MASK, bit 0 for wear, bit 1 for geometry.
  std::array<double, 3> wearScale = {1, 1, 1}, lengthScale = {1, 1, 1};

  bool isTurning() const { return type >= 500 && type < 600; }
  /// Length 1..3 as the control adds them up: geometry, wear, adapter, additive and setup offset.
  std::array<double, 3> totalLength() const;
  double totalRadius() const { return radius + radiusWear + radiusAdditive + radiusSetup; }
};

/// Edge `edge` of tool `tool` with the offsets of `dl` (0: none, 1..6), or nothing if no data of it exist. Whoever
/// wants to know what a control makes of tool data asks here, not the data: MD 20360 and adapters count.
std::optional<ToolEdge> toolEdge(const DataStore& store, int tool, int edge, int dl = 0);

/// DL of the last additive offset of an edge.
constexpr int lastOffsetNumber = 6;

/// "$TC_SCP13" for the additive offset of length 1 (parameter 3) with DL = 1; parameters 3..11, DL 1..6.
std::string additiveOffsetName(int dl, int parameter);
std::string setupOffsetName(int dl, int parameter);

/// True for the names of tool data that add up to lengths and radius of an edge: $TC_DP3..6, 12..15 and 21..23, the
/// additive and setup offsets $TC_SCP.., $TC_ECP...
bool isToolSize(std::string_view name);
/// The DL number of "$TC_SCP13" to "$TC_SCP21", "$TC_ECP23" to "$TC_ECP31": 1, 2; nothing for other names.
std::optional<int> offsetNumber(std::string_view name);

/// Tools with data, in order, and their edges.
std::vector<int> toolNumbers(const DataStore& store);
std::vector<int> toolEdges(const DataStore& store, int tool);

/// The tool called `name` in $TC_TP2, capitals or not; nothing if there is none.
std::optional<int> toolNamed(const DataStore& store, std::string_view name);
std::string toolName(const DataStore& store, int tool);

/// Whose lengths get their axes as those of turning tools do.
enum class LengthType : std::uint8_t {
  ByToolType,  ///< those of turning tools
  AsTurning,   ///< those of all tools: $SC_TOOL_LENGTH_TYPE = 2
};

/// The geometry axes (0, 1, 2 for X, Y, Z) in which length 1, 2, 3 act. Mills, drills and probes: length 1 in the third
/// axis of the plane, 2 in the second, 3 in the first. Turning tools: length 1 in the second axis, 2 in the first, 3 in
/// the third.
std::array<int, 3> lengthAxes(WorkingPlane plane, const ToolEdge& edge, LengthType type = LengthType::ByToolType);

/// The plane by which the lengths of tools get their axes: the active one (17, 18, 19), unless SD 42940
/// $SC_TOOL_LENGTH_CONST names one for good.
WorkingPlane planeOfLengths(const DataStore& store, int activePlane);

/// From the tool tip to the tool reference point in X, Y, Z.
Vector3 toolVector(WorkingPlane plane, const ToolEdge& edge, LengthType type = LengthType::ByToolType);

}  // namespace probewright::control::sinumerik
