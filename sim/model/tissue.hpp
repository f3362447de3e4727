#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// Edge of the cube that six of its mean tetrahedra fill [m].
double element_size(const Tissue& tissue);

/// Whether a node moves with a rigid or a fixed body.
bool is_tied(const Tissue& tissue);

/// λ + 2μ at small strain [Pa].
double constrained_modulus(const Tissue& tissue);
double constrained_modulus(double young_modulus, double poisson_ratio);

/// 2E/(1 − ν²) at small strain [Pa]: the stiffness of a half space under a flat punch, by the
/// punch's radius [Johnson 1985, ch. 3.8]. It stays finite where ν goes to 0.5: what is under a
/// spot of the surface gives way to its sides, as it can't where all of the surface is pressed.
///
/// [Johnson 1985] Johnson. Contact Mechanics. Cambridge University Press.
double punch_modulus(const Tissue& tissue);

}  // namespace articular::sim
