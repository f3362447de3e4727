#include "fem/sparse/nodal_pressure.hpp"

#include <algorithm>
#include <stdexcept>

namespace articular::fem {
namespace {

/// The upper half of the pattern of all pairs of pressures in one element.
SymmetricMatrix pattern_of(const Tetrahedra& of_corner, int size) {
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(size));
  for (const auto& pressures : of_corner.colwise()) {
    for (const int j : pressures) {
      for (const int i : pressures) {
        if (i <= j) rows[j].push_back(i);
      }
    }
  }
  SymmetricMatrix A;
  for (std::vector<int>& column : rows) {
    std::sort(column.begin(), column.end());
    A.row.insert(A.row.end(), column.begin(), std::unique(column.begin(), column.end()));
    A.end_column();
  }
  A.value.assign(A.row.size(), 0.0);
  return A;
}

}  // namespace

NodalPressure::NodalPressure(int num_nodes, const Tetrahedra& tets, std::span<const double> volume,
                             std::span<const int> material, std::span<const PressureModuli> moduli,
                             double tau)
    : of_corner_(4, tets.cols()) {
  for (int m = 0; m < static_cast<int>(moduli.size()); ++m) {
    std::vector<int> pressure_of(static_cast<std::size_t>(num_nodes), -1);
    for (Eigen::Index e = 0; e < tets.cols(); ++e) {
      if (material[e] != m) continue;
      for (const int a : tets.col(e)) pressure_of[a] = 0;
    }
    for (int a = 0; a < num_nodes; ++a) {
      if (pressure_of[a] < 0) continue;
      pressure_of[a] = size();
      node_.push_back(a);
      material_.push_back(m);
    }
    for (Eigen::Index e = 0; e < tets.cols(); ++e) {
      if (material[e] != m) continue;
      for (int a = 0; a < 4; ++a) of_corner_(a, e) = pressure_of[tets(a, e)];
    }
  }

  A_ = pattern_of(of_corner_, size());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const auto [kappa, mu] = moduli[material[e]];
    stiffness_ratio_ = std::max(stiffness_ratio_, kappa / mu);
    const double mass = volume[e] / (20 * kappa), jump = tau * volume[e] / (20 * mu);
    for (const int j : of_corner_.col(e)) {
      for (const int i : of_corner_.col(e)) {
        if (i > j) continue;
        const auto column = A_.row.begin() + A_.begin[j];
        const auto found = std::lower_bound(column, A_.row.begin() + A_.begin[j + 1], i);
        A_.value[found - A_.row.begin()] += i == j ? 2 * mass + 0.75 * jump : mass - 0.25 * jump;
      }
    }
  }
  factor_.analyze(A_, std::vector<int>(node_.size(), 1));
  if (factor_.factorize(A_) != Pivots::Right) {
    throw std::invalid_argument("the compliance of the pressure is singular in working precision");
  }
}

}  // namespace articular::fem
