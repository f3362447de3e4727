#pragma once

#include <span>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/mesh/edge_domains.hpp"
#include "fem/mesh/tetrahedron.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

/// The means of the dilatation Θ over the domains of edges, for the energy of what single elements
/// differ from them,
///
///   ½ κ' Σ_k Σ_e V_e/6 (Θ_e − Θ̄_k)²,   Θ̄_k = Σ_e V_e/6 Θ_e / V_k,
///
/// e around edge k. The domains and volumes are given anew each time, and have to be the same.
///
/// Holds work memory: one object serves one thread at a time.
class DilatationMeans {
 public:
  DilatationMeans() = default;
  /// @param K  one block row a node, with the couplings of the domains
  DilatationMeans(const Tetrahedra& tets, const EdgeDomains& domains, const BlockMatrix& K);

  /// Θ_e − Σ_k Θ̄_k/6 for Θ_e: the energy's derivative by V_e κ' Θ_e.
  /// @param volume      of each element [m³]
  /// @param dilatation  Θ_e [-], one an element
  void subtract(const EdgeDomains& domains, std::span<const double> volume,
                Eigen::VectorXd& dilatation) const;
  /// K −= Σ_k factor V_k ∂Θ̄_k/∂x ⊗ ∂Θ̄_k/∂x
  /// @param slope   V_e ∂Θ_e/∂x [m²], one an element
  /// @param factor  one a material [Pa], for a K in [N/m]
  void subtract_stiffness(const EdgeDomains& domains, std::span<const Mat34> slope,
                          std::span<const double> factor, BlockMatrix& K) const;

 private:
  /// An element of a domain, and which of the domain's nodes its own are.
  struct Member {
    int element = 0, node[4] = {};
  };
  std::vector<int> begin_;  // of each domain, into members_
  std::vector<Member> members_;
  std::vector<int> slots_;           // in K: of all pairs of nodes of a domain, row by row
  mutable Eigen::VectorXd mean_;     // Θ̄_k
  mutable std::vector<Vec3> slope_;  // V_k ∂Θ̄_k/∂x [m²], one a node of a domain
};

}  // namespace articular::fem
