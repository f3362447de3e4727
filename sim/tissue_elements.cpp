#include "sim/tissue_elements.hpp"

namespace articular::sim {

const Tetrahedra& TissueElements::tets() const {
  return std::visit([](const auto& e) -> const Tetrahedra& { return e.tets(); }, elements_);
}

const std::vector<double>& TissueElements::rest_volume() const {
  return std::visit([](const auto& e) -> const std::vector<double>& { return e.rest_volume(); },
                    elements_);
}

double TissueElements::energy(const Positions& x, double activation) const {
  return std::visit([&](const auto& e) { return e.energy(x, activation); }, elements_);
}

void TissueElements::add_internal_force(const Positions& x, double activation, Positions& f) const {
  std::visit([&](const auto& e) { e.add_internal_force(x, f, activation); }, elements_);
}

fem::BlockMatrix TissueElements::make_matrix() const {
  return std::visit([](const auto& e) { return e.make_matrix(); }, elements_);
}

void TissueElements::add_stiffness(const Positions& x, double activation, fem::Tangent tangent,
                                   double scale, fem::BlockMatrix& K) const {
  if (const fem::SmoothedElasticity* e = smoothed()) {
    e->pressure(x, pressure_);
    e->add_stiffness(x, pressure_, tangent, scale, K, activation);
    return;
  }
  std::get<fem::Elasticity>(elements_).add_stiffness(x, tangent, scale, K, activation);
}

Eigen::MatrixXd TissueElements::cauchy_stress(const Positions& x, double activation) const {
  return std::visit([&](const auto& e) { return e.cauchy_stress(x, activation); }, elements_);
}

Eigen::VectorXd TissueElements::von_mises(const Positions& x, double activation) const {
  return std::visit([&](const auto& e) { return e.von_mises(x, activation); }, elements_);
}

Eigen::VectorXd TissueElements::volume_ratio(const Positions& x) const {
  return std::visit([&](const auto& e) { return e.volume_ratio(x); }, elements_);
}

Eigen::VectorXd TissueElements::strain_energy_density(const Positions& x, double activation) const {
  return std::visit([&](const auto& e) { return e.strain_energy_density(x, activation); },
                    elements_);
}

}  // namespace articular::sim
