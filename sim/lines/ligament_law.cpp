#include "sim/lines/ligament_law.hpp"

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
  const double e = length / slack_length - 1;
  if (e <= 0) return {};
  if (e <= 2 * toe_strain)
    return {stiffness * e * e / (4 * toe_strain), stiffness * e / (2 * toe_strain) / slack_length};
  return {stiffness * (e - toe_strain), stiffness / slack_length};
}

double blankevoort_ligament_energy(double length, double slack_length, double stiffness,
                                   double toe_strain) {
  const double e = length / slack_length - 1;
  if (e <= 0) return 0;
  const double toe_end = 2 * toe_strain;
  if (e <= toe_end) return stiffness * slack_length * e * e * e / (12 * toe_strain);
  const double toe_energy = toe_end * toe_end * toe_end / (12 * toe_strain);
  const double beyond = e - toe_end;
  return stiffness * slack_length * (toe_energy + beyond * (toe_strain + 0.5 * beyond));
}

Damper ligament_damper(const ValueSlope& elastic, double rate, double damping) {
  if (!(rate > 0)) return {};
  const double force = damping * rate;
  if (force < elastic.value) return {force, 0, damping};
  return {elastic.value, elastic.slope, 0};
}

}  // namespace articular::sim
