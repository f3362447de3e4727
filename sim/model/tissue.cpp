#include "sim/model/tissue.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace articular::sim {

double element_size(const Tissue& tissue) {
  const std::vector<double>& volume = tissue.elements.rest_volume();
  const double sum = std::accumulate(volume.begin(), volume.end(), 0.0);
  return std::cbrt(6 * sum / static_cast<double>(volume.size()));
}

bool is_tied(const Tissue& tissue) {
  return std::any_of(tissue.nodes.begin(), tissue.nodes.end(),
                     [](const NodeRef& node) { return node.rigid >= 0; });
}

double constrained_modulus(const Tissue& tissue) {
  return tissue.bulk_modulus + 4 * tissue.shear_modulus / 3;
}

double punch_modulus(const Tissue& tissue) {
  const double kappa = tissue.bulk_modulus, mu = tissue.shear_modulus;
  return 8 * mu * (3 * kappa + mu) / (3 * kappa + 4 * mu);
}

double constrained_modulus(double E, double nu) { return E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)); }

}  // namespace articular::sim
