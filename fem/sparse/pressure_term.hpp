#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fem/sparse/block_matrix.hpp"
#include "fem/sparse/nodal_pressure.hpp"
#include "fem/sparse/pressure_gradient.hpp"

namespace articular::fem {

/// scale · G A⁻¹ Gᵀ, the part of a stiffness that couples all nodes through a nodal pressure, by
/// its factors. Views: what they show must stay as it is from prepare_with_pressure() to the last
/// solve().
struct PressureTerm {
  const PressureGradient* G;      // rows: the blocks of the matrix that this term is added to
  const NodalPressure* pressure;  // A and its factorization
  double scale = 1;               // > 0
};

/// y += Σ scale G A⁻¹ Gᵀ x, with work memory of its own.
class PressureOperator {
 public:
  void set(std::span<const PressureTerm> terms) { terms_.assign(terms.begin(), terms.end()); }
  void add_product(const Eigen::VectorXd& x, Eigen::VectorXd& y);
  /// Of the diagonal block i, from the diagonal of A.
  Mat3 diagonal_estimate(int i) const;

 private:
  std::vector<PressureTerm> terms_;
  Eigen::VectorXd p_;
};

}  // namespace articular::fem
