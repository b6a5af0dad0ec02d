#pragma once

#include <array>
#include <string>

#include "cycles/heidenhain/context.hpp"
#include "metrology/tolerance.hpp"

/// The nominal positions and diameters of cycles 1410, 1411 and 1420: numbers, or texts such as "?30", "10+0.02-0.01",
/// "8m7" and "10@10.0123". mm, active program coordinates (I-CS).
namespace probewright::cycles::heidenhain {

struct NominalValue {
  std::optional<double> nominal;            ///< absent in "?"
  std::optional<metrology::Limits> limits;  ///< absent: not monitored
  std::optional<double> actual;             ///< after "@": known, not to be probed
  bool semiAutomatic = false;               ///< "?": the operator moves the probe there
  /// What deviations count from: the middle of the tolerance, or the nominal value. Only with `nominal`.
  double middle() const { return limits ? limits->middle() : *nominal; }
};

/// The value of parameter Q`number`. Throws Alarm for texts that are none, values out of range, "?" together with "@".
NominalValue nominalValue(Context& context, int number);

struct NominalPosition {
  int first = 0;    ///< number of the parameter of the main axis: 1100, 1103 or 1106
  int ordinal = 1;  ///< of the point or object, from 1
  std::array<NominalValue, 3> axes;

  bool semiAutomatic() const { return axes[0].semiAutomatic || axes[1].semiAutomatic || axes[2].semiAutomatic; }
  /// All three actual positions are given.
  bool known() const { return axes[0].actual && axes[1].actual && axes[2].actual; }
  /// The nominal position; 0 along axes without one.
  PartPoint place() const;
};

/// The position `ordinal` (parameters Q1100 to Q1102, Q1103 to Q1105, Q1106 to Q1108). Throws Alarm if an axis of
/// `needed` has no nominal position, if no axis has one, or if only some axes have an actual position.
NominalPosition nominalPosition(Context& context, int ordinal, const std::array<bool, 3>& needed);

/// Throws Alarm if the position has no nominal value along `axis` (0, 1, 2), which is to be measured.
void requireNominal(const NominalPosition& position, std::size_t axis);

/// A position as it was measured, and as it ought to be.
struct MeasuredPosition {
  PartPoint actual;
  PartPoint nominal;  ///< middle of the tolerance or nominal; actual where the program names none
  PartPoint wanted;   ///< the same, but actual also along axes that a touch says nothing about
  PlaneWay deviation() const { return actual - wanted; }
};

/// The axis that a touch along `direction` (1, 2, 3, or negative) says something about.
std::array<bool, 3> axisOf(int direction);

/// `measuredAxes`: along which the touches say something about the place.
MeasuredPosition measuredPosition(const NominalPosition& nominal, const PartPoint& actual,
                                  const std::array<bool, 3>& measuredAxes);

/// The result parameters, the verdict and the log of a cycle of the family, gathered value by value.
class RotationFindings {
public:
  explicit RotationFindings(Context& context) : context_(context) {}

  /// Q950.. and Q980.. of the position. `direction`: signed axis of probing (1, 2, 3, -1...) for edges and planes:
  /// material left towards the probe is rework, beyond it scrap; 0: any position out of its limits is scrap.
  void add(const NominalPosition& nominal, const MeasuredPosition& measured, int direction);
  /// Q966 and Q996, or Q967 and Q997, of the diameter of object 1 or 2.
  void addDiameter(const NominalValue& nominal, double actual, int ordinal, Side side);
  void addAngle(int parameter, const std::string& label, double actual);
  /// Sets Q183, writes the log, and stops as Q309 says.
  void finish();

private:
  void note(const std::string& label, const NominalValue& value, double actual, double deviation, Verdict verdict);

  Context& context_;
  Verdict verdict_ = Verdict::None;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace probewright::cycles::heidenhain
