#include "fem/material/crimped_fibre.hpp"

namespace articular::fem {

ValueSlope CrimpedFibre::tension(double strain) const {
  if (strain <= 0) return {};
  if (strain <= 2 * toe_strain)
    return {stiffness * strain * strain / (4 * toe_strain), stiffness * strain / (2 * toe_strain)};
  return {stiffness * (strain - toe_strain), stiffness};
}

double CrimpedFibre::energy(double strain) const {
  if (strain <= 0) return 0;
  const double toe_end = 2 * toe_strain;
  if (strain <= toe_end) return stiffness * strain * strain * strain / (12 * toe_strain);
  const double toe_energy = toe_end * toe_end * toe_end / (12 * toe_strain);
  const double beyond = strain - toe_end;
  return stiffness * (toe_energy + beyond * (toe_strain + 0.5 * beyond));
}

}  // namespace articular::fem
