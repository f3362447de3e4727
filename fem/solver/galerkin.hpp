#pragma once

#include <vector>

#include "fem/solver/prolongation.hpp"

namespace articular::fem {

/// Where the product Pᵀ A P and its intermediate A P have blocks; kept as long as A's pattern
/// stays.
struct GalerkinPattern {
  std::vector<int> product_begin{0}, product_column;  // of A P, by rows of A
  std::vector<int> upper_begin{0}, upper_column;      // of Pᵀ A P, from the diagonal on
  std::vector<int> mirror;                            // slot of the coarse matrix -> upper slot
};

/// @param[out] coarse  its pattern
template <int N>
GalerkinPattern galerkin_pattern(const BlockRows<N>& A, const Prolongation<N>& P,
                                 BlockRows<kModes>& coarse);

/// coarse = L⁻¹ Pᵀ A P L⁻ᵀ, where L Lᵀ are the diagonal blocks of Pᵀ A P, so that those of the
/// coarse matrix are identities. P becomes P L⁻ᵀ, and the coarse modes B become Lᵀ B. Where P has a
/// zero column, L has a one on its diagonal.
/// @return false where a diagonal block is not positive definite, or not finite
template <int N>
[[nodiscard]] bool galerkin_product(const BlockRows<N>& A, const GalerkinPattern& pattern,
                                    Prolongation<N>& P, RigidModes& coarse_modes,
                                    BlockRows<kModes>& coarse, ThreadPool& pool);

}  // namespace articular::fem
