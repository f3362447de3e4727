#pragma once

#include <variant>
#include <vector>

#include "fem/block_matrix.hpp"
#include "fem/corotated.hpp"
#include "fem/linear.hpp"
#include "fem/neo_hookean.hpp"
#include "fem/projected_tangent.hpp"
#include "fem/types.hpp"

namespace articular::fem {

using Material = std::variant<Linear, Corotated, NeoHookean>;

/// Elastic energy, internal force and stiffness of one mesh of linear tetrahedra with one material.
class Elasticity {
 public:
  /// @throws std::invalid_argument naming the element where its rest volume is not positive
  ///         (inverted or flat), or an index that is out of range
  Elasticity(const Positions& X, const Tetrahedra& tets, Material material);

  int num_nodes() const { return num_nodes_; }
  int num_elements() const { return static_cast<int>(volume_.size()); }
  const Tetrahedra& tets() const { return tets_; }
  const std::vector<double>& rest_volume() const { return volume_; }  // [m³], one an element

  /// W [J]
  double energy(const Positions& x) const;
  /// f += ∂W/∂x [N]: the force needed to hold the shape.
  void add_internal_force(const Positions& x, Positions& f) const;
  /// A matrix with the pattern of this mesh: one block row a node.
  BlockMatrix make_matrix() const;
  /// K += scale * ∂²W/∂x² [N/m], for a K of make_matrix().
  void add_stiffness(const Positions& x, Tangent tangent, double scale, BlockMatrix& K) const;

  /// Per element, for output. cauchy_stress: 6 x M (xx yy zz xy yz xz) [Pa].
  Eigen::MatrixXd cauchy_stress(const Positions& x) const;
  Eigen::VectorXd von_mises(const Positions& x) const;              // [Pa]
  Eigen::VectorXd volume_ratio(const Positions& x) const;           // J
  Eigen::VectorXd strain_energy_density(const Positions& x) const;  // [J/m³]

 private:
  template <class Function>
  void for_each_element(const Positions& x, Function function) const;

  int num_nodes_ = 0;
  Tetrahedra tets_;
  Material material_;
  std::vector<Mat3> inverse_edges_;  // (X1-X0, X2-X0, X3-X0)⁻¹ [1/m]
  std::vector<double> volume_;       // [m³]
  std::vector<int> slots_;           // 16 an element, 4b + a, into the matrix of make_matrix()
};

/// One entry a node: a quarter of the mass of each of its elements [kg].
/// @param density  [kg/m³], > 0, else std::invalid_argument
Eigen::VectorXd lumped_mass(const Positions& X, const Tetrahedra& tets, double density);

}  // namespace articular::fem
