#include "sim/build/active_stress_doubt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace articular::sim {
namespace {

// Of the shear modulus. Measured on a bar of Blemker's muscle, when its fibres did not feel the
// volume, held at both ends, in time: the force is right at 3.3 times, 3 % too small at 5 to 6, a
// quarter to a half at 7 and more.
constexpr double kMostTension = 4;

/// The largest active tension of an element at the start that a pressure has to balance [Pa]: T of
/// T (a aᵀ − I/3), and none of T a aᵀ, which has a trace.
double active_tension(const Tissue& tissue, double activation) {
  const Eigen::MatrixXd stress = tissue.elements.cauchy_stress(tissue.X, activation) -
                                 tissue.elements.cauchy_stress(tissue.X, 0);
  double most = 0;
  for (const auto& s : stress.colwise()) {
    const double size = s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm();
    const double trace = s.head<3>().sum();
    if (trace * trace < 0.25 * size) most = std::max(most, size);
  }
  return std::sqrt(1.5 * most);
}

}  // namespace

std::optional<std::string> active_stress_doubt(const Tissue& tissue, const std::string& body,
                                               const Muscle& muscle) {
  if (tissue.elements.smoothed() == nullptr || muscle.excitation.value.empty()) return std::nullopt;
  const double activation =
      *std::max_element(muscle.excitation.value.begin(), muscle.excitation.value.end());
  const double tension = active_tension(tissue, activation);
  if (!(tension > kMostTension * tissue.shear_modulus)) return std::nullopt;
  return fmt::format(
      "the fibres of `{}` pull with up to {:.3g} kPa, {:.2g} times its shear modulus of {:.3g} "
      "kPa: "
      "smoothed elements may fold then, and pull with too little force; expected a shear modulus "
      "of "
      "{:.3g} kPa or more (c10), or element = \"plain\"",
      body, 1e-3 * tension, tension / tissue.shear_modulus, 1e-3 * tissue.shear_modulus,
      1e-3 * tension / kMostTension);
}

}  // namespace articular::sim
