#include <fmt/format.h>

#include "cycles/sinumerik/lathe_measurement.hpp"

/// How CYCLE982 measures mills and drills: tools that are round about their
/// axis.
namespace probewright::cycles::sinumerik {

namespace {

/// How a mill or drill is led: `along` is the axis that it lies along, `across`
/// that of its radius.
struct Rotated {
  int along = 0, across = 1;
  double pointing = -1;  ///< where its tip points along its axis
  double radius = 0;
  double edge = 0;   ///< from its axis to where its face is touched
  double front = 0;  ///< of the tip: the measuring path in front of the near face
  double depth = 0;  ///< of the tip while its side touches
};

Rotated rotatedOf(Context& context, const LatheVariant& variant, const LatheTool& tool,
                  const LatheToolTouches& touches) {
  Rotated rotated;
  rotated.along = tool.axis().value_or(variant.radial ? 1 : 0);
  rotated.across = 1 - rotated.along;
  rotated.radius = tool.radius();
  // Where the lowest point of a corner is; a drill touches with its point.
  rotated.edge = tool.kind() == LatheToolKind::Mill ? tool.radius() - tool.cornerRadius() : 0;
  const double tip = touches.at()[rotated.along];
  if (tip > touches.trigger(rotated.along, -1)) {
    rotated.pointing = -1;
  } else if (tip < touches.trigger(rotated.along, 1)) {
    rotated.pointing = 1;
  } else {
    rotated.pointing = -tool.holder(rotated.along);
    if (rotated.pointing == 0)
      context.alarm(61332, "the cycle cannot tell from which side the tool reaches the contact");
  }
  rotated.front = touches.trigger(rotated.along, rotated.pointing) - rotated.pointing * touches.path();
  rotated.depth = touches.middle(rotated.along) + rotated.pointing * context.real("S_ID");
  return rotated;
}

/// Leads a mill or drill round the contact.
class RotatedTouches {
public:
  RotatedTouches(LatheToolTouches& touches, const Rotated& rotated) : touches_(touches), rotated_(rotated) {}

  /// In front of the contact, `side` of its middle, the tip touches the near
  /// face: how far the length along the tool is wrong.
  double face(double side) {
    touches_.go(rotated_.across, touches_.middle(rotated_.across) + side * rotated_.edge);
    return touchAlong(rotated_.pointing);
  }
  /// Along the tool, from where it is.
  double touchAlong(double direction) {
    return touches_.touch(rotated_.along, direction) - touches_.trigger(rotated_.along, direction);
  }
  double sideStart(double direction) const {
    return touches_.trigger(rotated_.across, direction) - direction * (rotated_.radius + touches_.path());
  }
  /// In front of the side that is touched in `direction`, at the height where
  /// the tool is.
  void toSide(double direction) {
    const Vector2 from = touches_.at();
    const double beyond =
        rotated_.pointing * (from[rotated_.along] - touches_.trigger(rotated_.along, rotated_.pointing));
    if (beyond > 0) {
      // The tool reaches from its tip past the contact.
      Vector2 body = from;
      body[rotated_.along] = touches_.middle(rotated_.along);
      touches_.requireWay(rotated_.across, body, sideStart(direction), rotated_.radius);
    }
    touches_.go(rotated_.across, sideStart(direction));
  }
  /// The tool's axis at the signal, from the trigger point.
  double side(double direction) {
    touches_.go(rotated_.along, rotated_.depth);
    return touches_.touch(rotated_.across, direction) - touches_.trigger(rotated_.across, direction);
  }
  void toFront() { touches_.go(rotated_.along, rotated_.front); }
  void along(double place) { touches_.go(rotated_.along, place); }
  void across(double place) { touches_.go(rotated_.across, place); }

  /// Both sides, the one that is touched in `direction` first; between them the
  /// tool passes the contact at `clear`.
  void bothSides(double direction, double clear, LatheFindings& findings) {
    toSide(direction);
    const double first = side(direction);
    along(clear);
    across(sideStart(-direction));
    const double second = side(-direction);
    const double minus = direction < 0 ? first : second, plus = direction < 0 ? second : first;
    findings.radius = (minus - plus) / 2 - rotated_.radius;
    findings.tip[static_cast<std::size_t>(rotated_.across)] = (minus + plus) / 2;
  }

private:
  LatheToolTouches& touches_;
  const Rotated& rotated_;
};

void requireRadius(Context& context, const Rotated& rotated) {
  if (!(rotated.radius > 0)) context.alarm(61351, "the radius $TC_DP6 of a tool that is touched at its side");
}

}  // namespace

/// S_MD, or where the middle of the contact lies.
double directionOf(Context& context, const LatheToolTouches& touches, int axis) {
  switch (context.integer("S_MD")) {
    case 0:
      return touches.towardsMiddle(axis);
    case 1:
      return 1;
    case 2:
      return -1;
    default:
      context.alarm(61326, fmt::format("S_MD = {}: 0, 1 and 2 are possible", context.integer("S_MD")));
  }
}

LatheFindings measureRotatedToolAlongAxis(Context& context, const LatheVariant& variant, const LatheTool& tool,
                                          LatheToolTouches& touches) {
  const Rotated rotated = rotatedOf(context, variant, tool, touches);
  RotatedTouches rounds(touches, rotated);
  LatheFindings findings;
  const int axis = tool.axis().value_or(context.measuringAxis(2));
  const double direction = directionOf(context, touches, axis);
  auto& ofAxis = findings.tip[static_cast<std::size_t>(axis)];
  if (axis == rotated.along) {
    if (variant.quantities != LatheQuantities::Length)
      context.alarm(61325, "the radius is measured along the other axis of the plane");
    if (!variant.incremental) {
      if (direction != rotated.pointing) context.alarm(61326, "the tip of the tool does not point that way");
      const Vector2 start = touches.at();
      rounds.toFront();
      const double side = start[rotated.across] < touches.middle(rotated.across) ? -1 : 1;
      ofAxis = rounds.face(side);
    } else {
      ofAxis = rounds.touchAlong(direction);
    }
    return findings;
  }
  requireRadius(context, rotated);
  if (variant.incremental) {
    ofAxis = touches.touch(axis, direction) - touches.trigger(axis, direction) + direction * rotated.radius;
    return findings;
  }
  if (variant.quantities == LatheQuantities::Length) {
    rounds.toSide(direction);
    ofAxis = rounds.side(direction) + direction * rotated.radius;
    return findings;
  }
  rounds.bothSides(direction, rotated.front, findings);
  if (variant.quantities == LatheQuantities::Radius) ofAxis.reset();
  return findings;
}

LatheFindings measureMillCompletely(Context& context, const LatheVariant& variant, const LatheTool& tool,
                                    LatheToolTouches& touches) {
  const Rotated rotated = rotatedOf(context, variant, tool, touches);
  RotatedTouches rounds(touches, rotated);
  LatheFindings findings;
  const Vector2 start = touches.at();
  const double side = context.digit("_DMODE", 4) == 0 ? 1 : -1;
  auto& length = findings.tip[static_cast<std::size_t>(rotated.along)];
  const auto home = [&](double clear) {
    rounds.along(clear);
    rounds.across(start[rotated.across]);
    rounds.along(start[rotated.along]);
  };
  if (variant.quantities == LatheQuantities::RearSide) {
    // Behind the contact, the shank beside it. The width of the disc is not
    // known: it passes where the cycle started.
    requireRadius(context, rotated);
    const double clear = start[rotated.along];
    const double behind = touches.trigger(rotated.along, -rotated.pointing) + rotated.pointing * touches.path();
    const auto rear = [&](double beside) {
      rounds.along(behind);
      rounds.across(touches.middle(rotated.across) + beside * rotated.edge);
      const double found = rounds.touchAlong(-rotated.pointing);
      rounds.across(rounds.sideStart(-beside));
      return found;
    };
    rounds.toSide(-side);
    if (rotated.along == 0) {
      const double first = rear(side);
      rounds.bothSides(-side, clear, findings);
      length = (first + rear(-side)) / 2;
    } else {
      rounds.bothSides(-side, clear, findings);
      const double first = rear(-side);
      rounds.along(clear);
      rounds.across(rounds.sideStart(-side));
      length = (first + rear(side)) / 2;
    }
    home(clear);
    return findings;
  }
  rounds.toFront();
  const bool lengthsOnly = !(rotated.radius > 0);
  const auto faces = [&] { length = lengthsOnly ? rounds.face(0) : (rounds.face(side) + rounds.face(-side)) / 2; };
  const auto sides = [&] {
    if (!lengthsOnly) return rounds.bothSides(-side, rotated.front, findings);
    rounds.toSide(-side);
    findings.tip[static_cast<std::size_t>(rotated.across)] = rounds.side(-side);
  };
  if (rotated.along == 0) {
    faces();
    sides();
  } else {
    sides();
    rounds.toFront();
    faces();
  }
  home(rotated.front);
  return findings;
}

}  // namespace probewright::cycles::sinumerik
