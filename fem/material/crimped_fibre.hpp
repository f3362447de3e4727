#pragma once

#include "fem/material/force_velocity.hpp"

namespace articular::fem {

/// Collagen that is crimped at rest: it pulls only when it is stretched, softly up to twice its toe
/// strain e_l, then in a line [Blankevoort 1991]:
///
///   0 for e < 0,  k e²/(4 e_l) up to 2 e_l,  k (e − e_l) beyond,   e = l/l0 − 1.
///
/// [Blankevoort 1991] Blankevoort, Huiskes. Ligament-bone interaction in a three-dimensional model
///                    of the knee. J. Biomech. Eng. 113:263.
struct CrimpedFibre {
  double stiffness = 0;      // k, of the straight fibre, per unit strain: [N] or [Pa]
  double toe_strain = 0.03;  // e_l, > 0

  ValueSlope tension(double strain) const;  // its unit is that of the stiffness
  double energy(double strain) const;       // by the length, or the volume, at rest
};

}  // namespace articular::fem
