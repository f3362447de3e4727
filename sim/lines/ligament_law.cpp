#include "sim/lines/ligament_law.hpp"

#include "fem/material/crimped_fibre.hpp"

namespace articular::sim {

ValueSlope linear_ligament(double length, double slack_length, double stiffness) {
  if (length <= slack_length) return {};
  return {stiffness * (length - slack_length), stiffness};
}

double linear_ligament_energy(double length, double slack_length, double stiffness) {
  const double stretch = length - slack_length;
  return stretch > 0 ? 0.5 * stiffness * stretch * stretch : 0;
}

ValueSlope blankevoort_ligament(double length, double slack_length, double stiffness,
                                double toe_strain) {
  const ValueSlope tension =
      fem::CrimpedFibre{stiffness, toe_strain}.tension(length / slack_length - 1);
  return {tension.value, tension.slope / slack_length};
}

double blankevoort_ligament_energy(double length, double slack_length, double stiffness,
                                   double toe_strain) {
  return slack_length * fem::CrimpedFibre{stiffness, toe_strain}.energy(length / slack_length - 1);
}

Damper ligament_damper(const ValueSlope& elastic, double rate, double damping) {
  if (!(rate > 0)) return {};
  const double force = damping * rate;
  if (force < elastic.value) return {force, 0, damping};
  return {elastic.value, elastic.slope, 0};
}

}  // namespace articular::sim
