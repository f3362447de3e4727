#include "fem/material/viscosity.hpp"

namespace articular::fem {

KelvinVoigt stiffness_damping(double beta, double shear_modulus, double bulk_modulus) {
  checked_not_negative(beta, "stiffness damping", "s");
  return {beta * shear_modulus, beta * bulk_modulus};
}

void add_mass_damping(double alpha, const Eigen::VectorXd& lumped_mass, const Positions& v,
                      Positions& f) {
  f += alpha * v * lumped_mass.asDiagonal();
}

}  // namespace articular::fem
