#include "fem/element/dashpots.hpp"

#include <Eigen/LU>

#include "fem/material/viscosity.hpp"
#include "fem/mesh/rest_shape.hpp"
#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {

Dashpots::Dashpots(const Positions& X, const Tetrahedra& tets, const KelvinVoigt& law,
                   const BlockMatrix& matrix)
    : tets_(tets), law_(std::make_shared<const KelvinVoigt>(law)) {
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    volume_.push_back(checked_volume(X, tets, e));
    inverse_edges_.push_back(edge_matrix(gather(X, tets, e)).inverse());
    for (const int b : tets.col(e))
      for (const int a : tets.col(e)) slots_.push_back(matrix.slot(a, b));
  }
}

void Dashpots::add_force(const Positions& x, const Positions& v, Positions& f) const {
  for (std::size_t e = 0; e < volume_.size(); ++e) {
    const auto column = static_cast<Eigen::Index>(e);
    const Mat3 F = deformation_gradient(gather(x, tets_, column), inverse_edges_[e]);
    const Mat3 rate = deformation_gradient(gather(v, tets_, column), inverse_edges_[e]);
    const Mat34 f_e =
        nodal_force(law_->first_piola(F, rate), shape_gradients(inverse_edges_[e]), volume_[e]);
    for (int a = 0; a < 4; ++a) f.col(tets_(a, column)) += f_e.col(a);
  }
}

void Dashpots::add_tangent(const Positions& x, const Positions& v, double damping, double stiffness,
                           BlockMatrix& K) const {
  const int* slot = slots_.data();
  for (std::size_t e = 0; e < volume_.size(); ++e) {
    const auto column = static_cast<Eigen::Index>(e);
    const Mat3 F = deformation_gradient(gather(x, tets_, column), inverse_edges_[e]);
    Mat9 tangent = damping * law_->rate_tangent(F);
    if (stiffness != 0) {
      const Mat3 rate = deformation_gradient(gather(v, tets_, column), inverse_edges_[e]);
      const Mat9 by_F = law_->tangent(F, rate);
      tangent += 0.5 * stiffness * (by_F + by_F.transpose());
    }
    const Mat12 K_e = fem::stiffness(tangent, shape_gradients(inverse_edges_[e]), volume_[e]);
    for (int b = 0; b < 4; ++b)
      for (int a = 0; a < 4; ++a) K.block(*slot++) += K_e.block<3, 3>(3 * a, 3 * b);
  }
}

double Dashpots::power(const Positions& x, const Positions& v) const {
  double sum = 0;
  for (std::size_t e = 0; e < volume_.size(); ++e) {
    const auto column = static_cast<Eigen::Index>(e);
    sum += volume_[e] *
           law_->dissipation(deformation_gradient(gather(x, tets_, column), inverse_edges_[e]),
                             deformation_gradient(gather(v, tets_, column), inverse_edges_[e]));
  }
  return sum;
}

}  // namespace articular::fem
