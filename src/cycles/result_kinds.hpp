#pragma once

#include "control/result_kind.hpp"

/// The words in which the catalogue says what results are: `actual(of::diameter).main()`.
namespace probewright::cycles {

/// Characteristics by name: of one coordinate, dimension or angle. Angles count about the axis.
namespace of {

using control::Along;
using control::Characteristic;
using control::Quantity;

inline constexpr Characteristic centre1{Quantity::Centre, Along::First}, centre2{Quantity::Centre, Along::Second},
    centre3{Quantity::Centre, Along::Third};
inline constexpr Characteristic centreX{Quantity::Centre, Along::X}, centreY{Quantity::Centre, Along::Y},
    centreZ{Quantity::Centre, Along::Z};
inline constexpr Characteristic corner1{Quantity::Corner, Along::First}, corner2{Quantity::Corner, Along::Second};
inline constexpr Characteristic position1{Quantity::Coordinate, Along::First},
    position2{Quantity::Coordinate, Along::Second}, position3{Quantity::Coordinate, Along::Third};
inline constexpr Characteristic positionX{Quantity::Coordinate, Along::X}, positionY{Quantity::Coordinate, Along::Y},
    positionZ{Quantity::Coordinate, Along::Z}, position4{Quantity::Angle, Along::A},
    position5{Quantity::Angle, Along::B};
inline constexpr Characteristic coordinate{Quantity::Coordinate, Along::Measuring},
    alongNormal{Quantity::Coordinate, Along::Normal};
inline constexpr Characteristic diameter{Quantity::Diameter}, radius{Quantity::Radius}, width{Quantity::Width};
inline constexpr Characteristic length1{Quantity::Length, Along::First}, length2{Quantity::Length, Along::Second},
    length3{Quantity::Length, Along::Third};
inline constexpr Characteristic angle{Quantity::Angle, Along::Third}, angle1{Quantity::Angle, Along::First},
    angle2{Quantity::Angle, Along::Second}, tableAngle{Quantity::Angle, Along::Table};
inline constexpr Characteristic angleX{Quantity::Angle, Along::X}, angleY{Quantity::Angle, Along::Y},
    angleZ{Quantity::Angle, Along::Z};
inline constexpr Characteristic projectionA{Quantity::Projection, Along::A},
    projectionB{Quantity::Projection, Along::B};
inline constexpr Characteristic eccentricity1{Quantity::Eccentricity, Along::First},
    eccentricity2{Quantity::Eccentricity, Along::Second};
inline constexpr Characteristic distance{Quantity::Distance}, distance1{Quantity::Distance, Along::First},
    distance2{Quantity::Distance, Along::Second};
inline constexpr Characteristic name{Quantity::Name};

}  // namespace of

namespace result {

using control::Characteristic;
using control::ResultKind;
using control::Role;

constexpr ResultKind actual(const Characteristic& what) { return {Role::Actual, what}; }
constexpr ResultKind set(const Characteristic& what) { return {Role::Set, what}; }
constexpr ResultKind difference(const Characteristic& what) { return {Role::Difference, what}; }
constexpr ResultKind lowerLimit(const Characteristic& what) { return {Role::LowerLimit, what}; }
constexpr ResultKind upperLimit(const Characteristic& what) { return {Role::UpperLimit, what}; }
constexpr ResultKind excess(const Characteristic& what) { return {Role::Excess, what}; }
constexpr ResultKind correction(const Characteristic& what) { return {Role::Correction, what}; }
constexpr ResultKind statistic(const Characteristic& what) { return {Role::Statistic, what}; }
constexpr ResultKind touched(const Characteristic& what) { return {Role::Touch, what}; }
constexpr ResultKind setting(const Characteristic& what = {}) { return {Role::Setting, what}; }
inline constexpr ResultKind status{Role::Status, {}};

}  // namespace result

}  // namespace probewright::cycles
