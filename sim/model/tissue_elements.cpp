#include "sim/model/tissue_elements.hpp"

#include <utility>
#include <variant>

#include "fem/element/elasticity.hpp"
#include "fem/element/smoothed_elasticity.hpp"

namespace articular::sim {

// Behind a pointer: the headers of the elements bring in those of all laws.
struct TissueElements::Elements {
  std::variant<fem::Elasticity, fem::SmoothedElasticity> kind;
};

TissueElements::TissueElements(fem::Elasticity elements)
    : elements_(std::make_shared<const Elements>(Elements{std::move(elements)})) {}
TissueElements::TissueElements(fem::SmoothedElasticity elements)
    : elements_(std::make_shared<const Elements>(Elements{std::move(elements)})) {}

const fem::SmoothedElasticity* TissueElements::smoothed() const {
  return std::get_if<fem::SmoothedElasticity>(&elements_->kind);
}

const fem::Elasticity& TissueElements::plain() const {
  return std::get<fem::Elasticity>(elements_->kind);
}

const Tetrahedra& TissueElements::tets() const {
  return std::visit([](const auto& e) -> const Tetrahedra& { return e.tets(); }, elements_->kind);
}

const std::vector<double>& TissueElements::rest_volume() const {
  return std::visit([](const auto& e) -> const std::vector<double>& { return e.rest_volume(); },
                    elements_->kind);
}

double TissueElements::energy(const Positions& x, double activation) const {
  return std::visit([&](const auto& e) { return e.energy(x, activation); }, elements_->kind);
}

void TissueElements::pressure(const Positions& x, Eigen::VectorXd& p) const {
  if (const fem::SmoothedElasticity* e = smoothed()) e->pressure(x, p);
}

void TissueElements::add_internal_force(const Positions& x, const Eigen::VectorXd& p,
                                        double activation, Positions& f) const {
  if (const fem::SmoothedElasticity* e = smoothed()) {
    e->add_internal_force(x, p, f, activation);
    return;
  }
  plain().add_internal_force(x, f, activation);
}

fem::BlockMatrix TissueElements::make_matrix() const {
  return std::visit([](const auto& e) { return e.make_matrix(); }, elements_->kind);
}

void TissueElements::add_stiffness(const Positions& x, const Eigen::VectorXd& p, double activation,
                                   fem::Tangent tangent, double scale, fem::BlockMatrix& K) const {
  if (const fem::SmoothedElasticity* e = smoothed()) {
    e->add_stiffness(x, p, tangent, scale, K, activation);
    return;
  }
  plain().add_stiffness(x, tangent, scale, K, activation);
}

fem::StiffnessSlots TissueElements::slots_in(const fem::BlockMatrix& A,
                                             std::span<const int> block_of_node) const {
  return plain().slots_in(A, block_of_node);
}

void TissueElements::add_stiffness(const Positions& x, double activation, fem::Tangent tangent,
                                   double scale, const fem::StiffnessSlots& slots,
                                   fem::BlockMatrix& A) const {
  plain().add_stiffness(x, tangent, scale, slots, A, activation);
}

fem::BlockMatrix TissueElements::make_plain_matrix() const {
  if (const fem::SmoothedElasticity* e = smoothed()) return e->make_plain_matrix();
  return make_matrix();
}

fem::DistortionPoints TissueElements::distortion_points(const Positions& X) const {
  return std::visit([&](const auto& e) { return fem::distortion_points(X, e); }, elements_->kind);
}

Eigen::MatrixXd TissueElements::cauchy_stress(const Positions& x, double activation) const {
  return std::visit([&](const auto& e) { return e.cauchy_stress(x, activation); }, elements_->kind);
}

Eigen::VectorXd TissueElements::fibre_stretch(const Positions& x) const {
  return std::visit([&](const auto& e) { return e.fibre_stretch(x); }, elements_->kind);
}

Eigen::VectorXd TissueElements::volume_ratio(const Positions& x) const {
  return std::visit([&](const auto& e) { return e.volume_ratio(x); }, elements_->kind);
}

Eigen::VectorXd TissueElements::strain_energy_density(const Positions& x, double activation) const {
  return std::visit([&](const auto& e) { return e.strain_energy_density(x, activation); },
                    elements_->kind);
}

}  // namespace articular::sim
