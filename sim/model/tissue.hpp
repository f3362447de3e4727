#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// Edge of the cube that six of its mean tetrahedra fill [m].
double element_size(const Tissue& tissue);

/// λ + 2μ at small strain [Pa].
double constrained_modulus(const Tissue& tissue);
double constrained_modulus(double young_modulus, double poisson_ratio);

}  // namespace articular::sim
