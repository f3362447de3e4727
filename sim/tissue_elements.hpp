#pragma once

#include <variant>

#include "fem/elasticity.hpp"
#include "fem/smoothed_elasticity.hpp"

namespace articular::sim {

/// The elements of one tissue: plain linear tetrahedra or smoothed ones. An activation, in [0, 1],
/// is that of fibres, where there are any.
class TissueElements {
 public:
  template <class Elements>
  explicit TissueElements(Elements elements) : elements_(std::move(elements)) {}

  const Tetrahedra& tets() const;
  int num_elements() const { return static_cast<int>(tets().cols()); }
  const std::vector<double>& rest_volume() const;  // [m³], one an element

  double energy(const Positions& x, double activation) const;  // [J]
  void add_internal_force(const Positions& x, double activation, Positions& f) const;
  fem::BlockMatrix make_matrix() const;
  /// K += scale times the stiffness; of smoothed elements, without what couples all nodes through
  /// the pressure.
  void add_stiffness(const Positions& x, double activation, fem::Tangent tangent, double scale,
                     fem::BlockMatrix& K) const;
  /// Not null where the pressure is an unknown of the nodes.
  const fem::SmoothedElasticity* smoothed() const {
    return std::get_if<fem::SmoothedElasticity>(&elements_);
  }

  /// Per element, for output; see fem::Elasticity.
  Eigen::MatrixXd cauchy_stress(const Positions& x, double activation) const;
  Eigen::VectorXd von_mises(const Positions& x, double activation) const;
  Eigen::VectorXd volume_ratio(const Positions& x) const;
  Eigen::VectorXd strain_energy_density(const Positions& x, double activation) const;

 private:
  std::variant<fem::Elasticity, fem::SmoothedElasticity> elements_;
  mutable Eigen::VectorXd pressure_;  // work
};

}  // namespace articular::sim
