#pragma once

#include <span>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::fem {

/// The smoothing domains of the edges of a tetrahedral mesh [Cazes 2013]: each tetrahedron gives a
/// sixth of its volume to each of its edges, and the domain of edge k has the volume-weighted mean
/// of their deformation gradients,
///
///   V_k = Σ_e V_e/6,   F_k = Σ_e V_e/6 F_e / V_k = Σ_a x_a ⊗ ∂N_ka/∂X,   e: tetrahedra around edge
///   k.
///
/// Where elements of two materials meet at an edge, it has one domain in each: a mean of both
/// strains would tie the soft material to the stiff one.
///
/// [Cazes 2013] Cazes, Meschke. An edge-based smoothed finite element method for 3D analysis of
/// solid
///              mechanics problems. Int. J. Numer. Meth. Engng 94:715.
struct EdgeDomains {
  std::vector<double> volume;       // V_k [m³]
  std::vector<int> node_begin;      // domain k has the nodes node[node_begin[k] .. node_begin[k+1])
  std::vector<int> node;            // of all tetrahedra around the edge, ascending
  std::vector<Vec3> gradient;       // ∂N_ka/∂X [1/m], one for each entry of `node`
  std::vector<int> of_element;      // 6 an element: its domains
  std::vector<int> material_begin;  // material m has the domains [material_begin[m], [m+1])

  int size() const { return static_cast<int>(volume.size()); }
  int num_nodes(int k) const { return node_begin[k + 1] - node_begin[k]; }
};

/// @param inverse_edges        edge_matrix(X)⁻¹ of each element [1/m]
/// @param volume               of each element [m³]
/// @param material_of_element  index in [0, num_materials), one an element
EdgeDomains make_edge_domains(const Tetrahedra& tets, std::span<const Mat3> inverse_edges,
                              std::span<const double> volume,
                              std::span<const int> material_of_element, int num_materials);

/// The mean direction of the fibres of each domain's elements, whose sense does not matter: the
/// eigenvector to the largest eigenvalue of Σ_e V_e/6 a_e ⊗ a_e/|a_e|, as long as their mean.
FibreDirections mean_fibres(const EdgeDomains& domains, std::span<const double> volume,
                            const FibreDirections& fibres);

}  // namespace articular::fem
