#include "fem/elasticity.hpp"

#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fem/projected_tangent.hpp"
#include "fem/rest_shape.hpp"
#include "fem/tetrahedron.hpp"

namespace articular::fem {
Elasticity::Elasticity(const Positions& X, const Tetrahedra& tets, Material material,
                       FibreDirections fibres)
    : num_nodes_(static_cast<int>(X.cols())),
      tets_(tets),
      material_(std::move(material)),
      fibres_(std::move(fibres)) {
  check_fibres(material_, fibres_, tets_);
  volume_.reserve(static_cast<std::size_t>(tets.cols()));
  inverse_edges_.reserve(static_cast<std::size_t>(tets.cols()));
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    volume_.push_back(checked_volume(X, tets, e));
    inverse_edges_.push_back(edge_matrix(gather(X, tets, e)).inverse());
  }
  const BlockMatrix K = make_matrix();
  slots_.reserve(16 * volume_.size());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    for (int b = 0; b < 4; ++b) {
      for (int a = 0; a < 4; ++a) slots_.push_back(K.slot(tets(a, e), tets(b, e)));
    }
  }
}

/// Calls function(law, e, F) for the elements in their order; the material is chosen once.
template <class Function>
void Elasticity::for_each_element(const Positions& x, double activation, Function function) const {
  assert(x.cols() == num_nodes_);
  assert(activation >= 0 && activation <= 1);
  std::visit(
      [&](const auto& material) {
        for (int e = 0; e < num_elements(); ++e) {
          const Mat3 F = deformation_gradient(gather(x, tets_, e), inverse_edges_[e]);
          function(element_law(material, fibres_, e, activation), e, F);
        }
      },
      material_);
}

double Elasticity::energy(const Positions& x, double activation) const {
  double W = 0;
  for_each_element(x, activation, [&](const auto& material, int e, const Mat3& F) {
    W += volume_[e] * material.energy_density(F);
  });
  return W;
}

void Elasticity::add_internal_force(const Positions& x, Positions& f, double activation) const {
  assert(f.cols() == num_nodes_);
  for_each_element(x, activation, [&](const auto& material, int e, const Mat3& F) {
    const Mat34 f_e =
        nodal_force(material.first_piola(F), shape_gradients(inverse_edges_[e]), volume_[e]);
    for (int a = 0; a < 4; ++a) f.col(tets_(a, e)) += f_e.col(a);
  });
}

BlockMatrix Elasticity::make_matrix() const {
  std::vector<int> offsets(volume_.size() + 1);
  for (std::size_t e = 0; e < offsets.size(); ++e) offsets[e] = static_cast<int>(4 * e);
  return {num_nodes_, {tets_.data(), 4 * volume_.size()}, offsets};
}

void Elasticity::add_stiffness(const Positions& x, Tangent tangent, double scale, BlockMatrix& K,
                               double activation) const {
  assert(K.num_blocks() == num_nodes_);
  const auto scatter = [&](int e, const Mat9& C) {
    const Mat12 K_e = stiffness(C, shape_gradients(inverse_edges_[e]), scale * volume_[e]);
    const int* slot = &slots_[16 * static_cast<std::size_t>(e)];
    for (int b = 0; b < 4; ++b) {
      for (int a = 0; a < 4; ++a) K.block(*slot++) += K_e.block<3, 3>(3 * a, 3 * b);
    }
  };
  if (tangent == Tangent::Projected) {
    for_each_element(x, activation, [&](const auto& material, int e, const Mat3& F) {
      scatter(e, projected_tangent(material, F));
    });
  } else {
    for_each_element(x, activation, [&](const auto& material, int e, const Mat3& F) {
      scatter(e, material.tangent(F));
    });
  }
}

Eigen::MatrixXd Elasticity::cauchy_stress(const Positions& x, double activation) const {
  Eigen::MatrixXd stress(6, num_elements());
  for_each_element(x, activation, [&](const auto& material, int e, const Mat3& F) {
    const Mat3 s = cauchy(material, F);
    stress.col(e) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
  });
  return stress;
}

Eigen::VectorXd Elasticity::von_mises(const Positions& x, double activation) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, activation, [&](const auto& material, int e, const Mat3& F) {
    const Mat3 sigma = cauchy(material, F);
    const Mat3 deviator = sigma - sigma.trace() / 3 * Mat3::Identity();
    result[e] = std::sqrt(1.5) * deviator.norm();
  });
  return result;
}

Eigen::VectorXd Elasticity::volume_ratio(const Positions& x) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, 0, [&](const auto&, int e, const Mat3& F) { result[e] = F.determinant(); });
  return result;
}

Eigen::VectorXd Elasticity::strain_energy_density(const Positions& x, double activation) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, activation, [&](const auto& material, int e, const Mat3& F) {
    result[e] = material.energy_density(F);
  });
  return result;
}

Eigen::VectorXd Elasticity::fibre_stretch(const Positions& x) const {
  assert(fibres_.cols() == num_elements());
  Eigen::VectorXd result(num_elements());
  for_each_element(
      x, 0, [&](const auto&, int e, const Mat3& F) { result[e] = (F * fibres_.col(e)).norm(); });
  return result;
}

Eigen::VectorXd lumped_mass(const Positions& X, const Tetrahedra& tets, double density) {
  if (!(density > 0) || !std::isfinite(density)) {
    std::ostringstream message;
    message << "density is " << density << " kg/m^3, must be positive and finite";
    throw std::invalid_argument(message.str());
  }
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(X.cols());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const double quarter = density * checked_volume(X, tets, e) / 4;
    for (int a = 0; a < 4; ++a) mass[tets(a, e)] += quarter;
  }
  return mass;
}

}  // namespace articular::fem
