#pragma once

#include <vector>

#include "sim/contact/pressed_triangles.hpp"

/// The area on which at least a given pressure acts, as a pressure film shows it.
///
/// Where contact ends, pressure ends at zero, and on a thin layer even its slope does: so the whole
/// area that touches hangs on pressures that no film shows and no mesh resolves. The line where the
/// pressure has a given value does not.
namespace articular::sim {

/// Area of what of the triangles has a pressure of at least that [m²].
/// @param threshold  [Pa], > 0
double area_above(const std::vector<PressedTriangle>& triangles, double threshold);

}  // namespace articular::sim
