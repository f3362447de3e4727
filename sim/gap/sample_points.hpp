#pragma once

#include <span>

#include "sim/gap/contact_patch.hpp"

namespace articular::sim {

/// Seven points of a triangle that integrate polynomials up to the fifth degree [Cowper 1973].
///
/// [Cowper 1973] Cowper. Gaussian quadrature formulas for triangles. Int J Numer Methods Eng 7:405.
std::span<const SamplePoint> triangle_samples();

}  // namespace articular::sim
