#pragma once

#include <vector>

#include "fem/any_material.hpp"
#include "fem/block_matrix.hpp"
#include "fem/projected_tangent.hpp"
#include "fem/types.hpp"

namespace articular::fem {

/// Elastic energy, internal force and stiffness of one mesh of linear tetrahedra with one material.
/// Materials with fibres pull along them with the given activation, in [0, 1]; others ignore it.
class Elasticity {
 public:
  /// @throws std::invalid_argument naming the element where its rest volume is not positive
  ///         (inverted or flat), or an index that is out of range, or a fibre that is not a unit
  ///         vector; and where a material with fibres has not got one an element
  Elasticity(const Positions& X, const Tetrahedra& tets, Material material,
             FibreDirections fibres = {});

  int num_nodes() const { return num_nodes_; }
  int num_elements() const { return static_cast<int>(volume_.size()); }
  const Tetrahedra& tets() const { return tets_; }
  const std::vector<double>& rest_volume() const { return volume_; }  // [m³], one an element

  /// W [J]
  double energy(const Positions& x, double activation = 0) const;
  /// f += ∂W/∂x [N]: the force needed to hold the shape.
  void add_internal_force(const Positions& x, Positions& f, double activation = 0) const;
  /// A matrix with the pattern of this mesh: one block row a node.
  BlockMatrix make_matrix() const;
  /// K += scale * ∂²W/∂x² [N/m], for a K of make_matrix().
  void add_stiffness(const Positions& x, Tangent tangent, double scale, BlockMatrix& K,
                     double activation = 0) const;

  /// Per element, for output. cauchy_stress: 6 x M (xx yy zz xy yz xz) [Pa].
  Eigen::MatrixXd cauchy_stress(const Positions& x, double activation = 0) const;
  Eigen::VectorXd von_mises(const Positions& x, double activation = 0) const;              // [Pa]
  Eigen::VectorXd volume_ratio(const Positions& x) const;                                  // J
  Eigen::VectorXd strain_energy_density(const Positions& x, double activation = 0) const;  // [J/m³]
  /// |F a0|, for a mesh that was given fibres.
  Eigen::VectorXd fibre_stretch(const Positions& x) const;

 private:
  template <class Function>
  void for_each_element(const Positions& x, double activation, Function function) const;

  int num_nodes_ = 0;
  Tetrahedra tets_;
  Material material_;
  FibreDirections fibres_;           // none, or one an element
  std::vector<Mat3> inverse_edges_;  // (X1-X0, X2-X0, X3-X0)⁻¹ [1/m]
  std::vector<double> volume_;       // [m³]
  std::vector<int> slots_;           // 16 an element, 4b + a, into the matrix of make_matrix()
};

/// One entry a node: a quarter of the mass of each of its elements [kg].
/// @param density  [kg/m³], > 0, else std::invalid_argument
Eigen::VectorXd lumped_mass(const Positions& X, const Tetrahedra& tets, double density);

}  // namespace articular::fem
