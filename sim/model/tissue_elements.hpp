#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fem/base/tangent.hpp"
#include "fem/element/distortion_points.hpp"
#include "fem/element/stiffness_slots.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {
class Elasticity;
class SmoothedElasticity;
}  // namespace articular::fem

namespace articular::sim {

/// The elements of one tissue: plain linear tetrahedra or smoothed ones. An activation, in [0, 1],
/// is that of fibres, where there are any. They never change: copies share them.
class TissueElements {
 public:
  explicit TissueElements(fem::Elasticity elements);
  explicit TissueElements(fem::SmoothedElasticity elements);

  const Tetrahedra& tets() const;
  int num_elements() const { return static_cast<int>(tets().cols()); }
  const std::vector<double>& rest_volume() const;  // [m³], one an element

  double energy(const Positions& x, double activation) const;  // [J]
  /// Smoothed elements: the nodal pressure of x [Pa]; of plain ones empty.
  void pressure(const Positions& x, Eigen::VectorXd& p) const;
  /// @param p  the nodal pressure of smoothed elements, see pressure()
  void add_internal_force(const Positions& x, const Eigen::VectorXd& p, double activation,
                          Positions& f) const;
  fem::BlockMatrix make_matrix() const;
  /// K += scale times the stiffness; of smoothed elements, without what couples all nodes through
  /// the pressure.
  void add_stiffness(const Positions& x, const Eigen::VectorXd& p, double activation,
                     fem::Tangent tangent, double scale, fem::BlockMatrix& K) const;
  /// Straight into a larger matrix; plain elements only.
  fem::StiffnessSlots slots_in(const fem::BlockMatrix& A, std::span<const int> block_of_node) const;
  void add_stiffness(const Positions& x, double activation, fem::Tangent tangent, double scale,
                     const fem::StiffnessSlots& slots, fem::BlockMatrix& A) const;
  /// The pattern of the elements alone, without smoothing domains.
  fem::BlockMatrix make_plain_matrix() const;
  fem::DistortionPoints distortion_points(const Positions& X) const;
  /// Not null where the pressure is an unknown of the nodes.
  const fem::SmoothedElasticity* smoothed() const;

  /// Per element, for output; see fem::Elasticity.
  Eigen::MatrixXd cauchy_stress(const Positions& x, double activation) const;
  Eigen::VectorXd fibre_stretch(const Positions& x) const;
  Eigen::VectorXd volume_ratio(const Positions& x) const;
  Eigen::VectorXd strain_energy_density(const Positions& x, double activation) const;

 private:
  struct Elements;
  const fem::Elasticity& plain() const;

  std::shared_ptr<const Elements> elements_;  // of all copies
};

}  // namespace articular::sim
