#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fem/base/tangent.hpp"
#include "fem/base/types.hpp"
#include "fem/element/element_batches.hpp"
#include "fem/element/stiffness_slots.hpp"
#include "fem/simd/element_kernels.hpp"
#include "fem/sparse/block_matrix.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

struct AnyMaterial;  // any_material.hpp

/// How to compute, not what: the same sums but for round-off.
struct AssemblyOptions {
  InstructionSet instruction_set = best_instruction_set();  // one that the machine has
  /// Shared with others who compute at other times. Up to ElementBatches::kInnerParts of its
  /// threads work; their number changes no bit of a result.
  std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1);
};

/// Elastic energy, internal force and stiffness of one mesh of linear tetrahedra with one material.
/// Materials that are Batched run in vectors of elements, others element by element. Sums have a
/// fixed order: the same bits in every run, with any number of threads.
/// Materials with fibres pull along them with the given activation, in [0, 1]; others ignore it.
class Elasticity {
 public:
  /// @throws std::invalid_argument naming the element where its rest volume is not positive
  ///         (inverted or flat), or an index that is out of range, or a fibre that is 0 or
  ///         not finite; and where a material with fibres has not got one an element
  Elasticity(const Positions& X, const Tetrahedra& tets, AnyMaterial material,
             FibreDirections fibres = {}, AssemblyOptions options = {});

  int num_nodes() const { return num_nodes_; }
  int num_elements() const { return static_cast<int>(volume_.size()); }
  const Tetrahedra& tets() const { return tets_; }
  const std::vector<double>& rest_volume() const { return volume_; }  // [m³], one an element

  const FibreDirections& fibres() const { return fibres_; }  // one an element, or none

  /// W [J]
  double energy(const Positions& x, double activation = 0) const;
  /// f += ∂W/∂x [N]: the force needed to hold the shape.
  void add_internal_force(const Positions& x, Positions& f, double activation = 0) const;

  /// A matrix with the pattern of this mesh: one block row a node.
  BlockMatrix make_matrix() const;
  /// K += scale * ∂²W/∂x² [N/m], for a symmetric K of make_matrix().
  void add_stiffness(const Positions& x, Tangent tangent, double scale, BlockMatrix& K,
                     double activation = 0) const;

  /// For a matrix that holds more, or less, than this mesh: see StiffnessSlots.
  StiffnessSlots slots_in(const BlockMatrix& A, std::span<const int> block_of_node) const;
  /// A += scale * ∂²W/∂x² [N/m], for a symmetric A with the pattern that the slots were made for.
  void add_stiffness(const Positions& x, Tangent tangent, double scale, const StiffnessSlots& slots,
                     BlockMatrix& A, double activation = 0) const;
  /// Both at once, for less than the two calls: f += ∂W/∂x, A += scale * ∂²W/∂x².
  void add_force_and_stiffness(const Positions& x, Tangent tangent, double scale,
                               const StiffnessSlots& slots, Positions& f, BlockMatrix& A,
                               double activation = 0) const;

  /// Per element, for output. cauchy_stress: 6 x M (xx yy zz xy yz xz) [Pa].
  Eigen::MatrixXd cauchy_stress(const Positions& x, double activation = 0) const;
  Eigen::VectorXd volume_ratio(const Positions& x) const;                                  // J
  Eigen::VectorXd strain_energy_density(const Positions& x, double activation = 0) const;  // [J/m³]
  /// Where there are fibres; from their free length.
  Eigen::VectorXd fibre_stretch(const Positions& x) const;

 private:
  template <class Function>
  void for_each_element(const Positions& x, double activation, Function function) const;
  template <class Function>
  void for_each_element(int chunk, const Positions& x, double activation, Function function) const;
  ChunkJob job(const BatchLaw& law, const Positions& x, int chunk) const;
  void add(const Positions& x, Tangent tangent, double scale, const StiffnessSlots& slots,
           double activation, Positions* f, BlockMatrix& A) const;
  void add_force(int chunk, const Positions& x, double activation, Positions& f) const;

  int num_nodes_ = 0;
  Tetrahedra tets_;
  std::shared_ptr<const AnyMaterial> material_;
  FibreDirections fibres_;  // one an element, or none
  AssemblyOptions options_;
  std::vector<double> volume_;  // [m³]
  ElementBatches elements_;
  StiffnessSlots slots_;  // into the matrix of make_matrix()
};

/// One entry a node: a quarter of the mass of each of its elements [kg].
/// @param density  [kg/m³], > 0, else std::invalid_argument
Eigen::VectorXd lumped_mass(const Positions& X, const Tetrahedra& tets, double density);

}  // namespace articular::fem
