#pragma once

#include <string>
#include <string_view>

#include "control/sinumerik/data_store.hpp"

/// A tool that turns while it is measured appears a little too large or too small to a tool touch probe; SD 54690 to
/// SD 54710 take that out.
namespace probewright::cycles::sinumerik {

enum class TurningDimension { Length, Radius };

/// What SD 54691 $SNS_MEA_T_PROBE_OFFSET asks for.
enum class RotationOffset {
  None = 0,
  OfTheMaker = 1,  ///< tables within the control for the probe of SD 54690, which nobody has published
  OfTheUser = 2,   ///< SD 54695 to 54700 for the radius, SD 54705 to 54710 for the length
};
RotationOffset rotationOffsetOf(const control::sinumerik::DataStore& data);

/// Why a value of SD 54691 adds nothing though it asks for something; empty for 0 and 2. What to do about it.
std::string rotationOffsetComplaint(double value);
inline constexpr std::string_view rotationOffsetAdvice = "Enter tables in SD 54695 to 54710 and set SD 54691 = 2.";

/// mm, to be added to what was measured with a tool of `radius` mm at `speed` per minute; 0 if the table is empty.
///
/// The first row of a table, [1] to [4], has tool radii (mm), the first column of its other five rows peripheral speeds
/// (m/min), where they cross is the value (mm). Radii and speeds that are 0 are not there. Between them the value is
/// linear, beyond them that of the border.
double rotationOffset(const control::sinumerik::DataStore& data, TurningDimension dimension, double radius,
                      double speed);

}  // namespace probewright::cycles::sinumerik
