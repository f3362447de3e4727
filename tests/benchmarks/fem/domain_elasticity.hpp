#pragma once

#include <vector>

#include "fem/material/mooney_rivlin.hpp"
#include "fem/material/projected_tangent.hpp"
#include "fem/mesh/edge_domains.hpp"
#include "fem/sparse/block_matrix.hpp"
#include "tests/fem/support/newton.hpp"

namespace articular::fem {

/// The whole energy of a material on domains that share the volume of a mesh: W = Σ_k V_k Ψ(F_k).
/// With elements as domains these are plain tetrahedra, with edges ES, with nodes (a quarter of
/// each element around) NS, nodal averaging [Dohrmann 2000]. For comparison only: all of them lock
/// or have soft modes.
///
/// [Dohrmann 2000] Dohrmann, Heinstein, Jung, Key, Witkowski. Node-based uniform strain elements
/// for
///                 three-node triangular and four-node tetrahedral meshes. Int. J. Numer. Meth.
///                 Engng 47:1549.
class DomainElasticity {
 public:
  enum class Domains { Elements, Edges, Nodes };

  DomainElasticity(const TetMesh& mesh, Domains domains, const MooneyRivlin<>& material);

  Formulation formulation() const;
  /// κ Θ [Pa] of each domain, and the domains that share a face (elements) or an element with it.
  Eigen::VectorXd pressure(const Positions& x) const;
  const std::vector<std::vector<int>>& neighbours() const { return neighbours_; }

 private:
  template <class Function>
  void for_each_domain(const Positions& x, Function function) const;
  double energy(const Positions& x) const;
  void add_internal_force(const Positions& x, Positions& f) const;
  void add_stiffness(const Positions& x, Tangent tangent, BlockMatrix& K) const;

  int num_nodes_;
  MooneyRivlin<> material_;
  EdgeDomains domains_;  // volumes, nodes and gradients of any kind of domain
  std::vector<std::vector<int>> neighbours_;
};

/// rms(p − mean of the neighbours' p) / rms(p): 0.1 to 0.2 for a smooth pressure on a coarse mesh,
/// 1 for a checkerboard.
double roughness(const Eigen::VectorXd& p, const std::vector<std::vector<int>>& neighbours);

/// The nodes that share an element with each node.
std::vector<std::vector<int>> node_neighbours(const BlockMatrix& plain);

}  // namespace articular::fem
