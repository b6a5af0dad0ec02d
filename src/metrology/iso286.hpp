#pragma once

#include <string_view>

#include "base/diagnostic.hpp"
#include "metrology/tolerance.hpp"

/// ISO code system for tolerances on linear sizes (ISO 286-1:2010), sizes up to 500 mm. mm.
namespace probewright::metrology {

/// The tolerance of a class: letters and grade, capitals for holes, small letters for shafts ("H7", "js6", "ZC10").
/// Deviations a, b, c, cd, d, e, ef, f, fg, g, h, js, j, k, m, n, p, r, s, t, u, v, x, y, z, za, zb, zc and the holes'
/// likewise; cd, ef and fg up to 50 mm. Exactly the values of the standard's tables; js is half the grade, not rounded
/// to whole micrometres. Fails where the standard defines no such class, and names what is wrong with it: no size of 0
/// mm or less or above 500 mm; a, b from 1 mm up; j5 to j7 (j8 to 3 mm) and J6 to J8; K above IT8 only to 3 mm; hole
/// classes K to ZC from IT3 up.
Result<Tolerance> isoTolerance(double nominal, std::string_view toleranceClass);

/// Width of the standard tolerance grade IT1 to IT18, and -1 for IT01, 0 for IT0. Grades 14 and above from 1 mm up.
Result<double> standardTolerance(double nominal, int grade);

}  // namespace probewright::metrology
