#include "fem/smoothed_elasticity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fem/point_law.hpp"
#include "fem/projected_tangent.hpp"
#include "fem/rest_shape.hpp"
#include "fem/tetrahedron.hpp"

namespace articular::fem {
namespace {

void check(const Smoothing& smoothing, const Tetrahedra& tets,
           const std::vector<Material>& materials, const std::vector<int>& of_element) {
  std::ostringstream message;
  if (!(smoothing.plain_share >= 0 && smoothing.plain_share <= 1)) {
    message << "plain_share is " << smoothing.plain_share << ", must lie in [0, 1]";
  } else if (!(smoothing.tau > 0) || !std::isfinite(smoothing.tau)) {
    message << "tau is " << smoothing.tau << ", must be positive and finite";
  } else if (of_element.size() != static_cast<std::size_t>(tets.cols())) {
    message << of_element.size() << " indices of materials for " << tets.cols() << " elements";
  } else {
    for (std::size_t e = 0; e < of_element.size(); ++e) {
      if (of_element[e] >= 0 && of_element[e] < static_cast<int>(materials.size())) continue;
      message << "tetrahedron " << e << " has material " << of_element[e] << ": there are "
              << materials.size() << " materials";
      break;
    }
  }
  if (!message.str().empty()) throw std::invalid_argument(message.str());
}

/// All slots of the pairs of `rows` (a) and `columns` (b) of each element, 4b + a.
template <class Matrix>
std::vector<int> pair_slots(const Matrix& matrix, const Tetrahedra& rows,
                            const Tetrahedra& columns) {
  std::vector<int> slots;
  slots.reserve(16 * static_cast<std::size_t>(rows.cols()));
  for (Eigen::Index e = 0; e < rows.cols(); ++e) {
    for (const int b : columns.col(e)) {
      for (const int a : rows.col(e)) slots.push_back(matrix.slot(a, b));
    }
  }
  return slots;
}

std::vector<int> offsets_by_four(std::size_t num_elements) {
  std::vector<int> offsets(num_elements + 1);
  for (std::size_t e = 0; e < offsets.size(); ++e) offsets[e] = static_cast<int>(4 * e);
  return offsets;
}

}  // namespace

SmoothedElasticity::SmoothedElasticity(const Positions& X, const Tetrahedra& tets,
                                       const Material& material, const Smoothing& smoothing,
                                       FibreDirections fibres)
    : SmoothedElasticity(X, tets, std::vector{material},
                         std::vector<int>(static_cast<std::size_t>(tets.cols()), 0), smoothing,
                         std::move(fibres)) {}

SmoothedElasticity::SmoothedElasticity(const Positions& X, const Tetrahedra& tets,
                                       std::vector<Material> materials,
                                       std::vector<int> material_of_element,
                                       const Smoothing& smoothing, FibreDirections fibres)
    : num_nodes_(static_cast<int>(X.cols())),
      tets_(tets),
      materials_(std::move(materials)),
      material_of_element_(std::move(material_of_element)),
      smoothing_(smoothing),
      fibres_(std::move(fibres)) {
  check(smoothing_, tets_, materials_, material_of_element_);
  for (const Material& material : materials_) check_fibres(material, fibres_, tets_);
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    volume_.push_back(checked_volume(X, tets, e));
    inverse_edges_.push_back(edge_matrix(gather(X, tets, e)).inverse());
  }
  const int num_materials = static_cast<int>(materials_.size());
  element_begin_.push_back(0);
  for (int m = 0; m < num_materials; ++m) {
    for (int e = 0; e < num_elements(); ++e) {
      if (material_of_element_[e] == m) elements_.push_back(e);
    }
    element_begin_.push_back(static_cast<int>(elements_.size()));
  }
  std::vector<PressureModuli> moduli;
  for (const Material& material : materials_) {
    moduli.push_back({.kappa = bulk_modulus(material), .mu = shear_modulus(material)});
  }
  domains_ = make_edge_domains(tets_, inverse_edges_, volume_, material_of_element_, num_materials);
  if (fibres_.cols() > 0) domain_fibres_ = mean_fibres(domains_, volume_, fibres_);
  pressure_ =
      NodalPressure(num_nodes_, tets_, volume_, material_of_element_, moduli, smoothing_.tau);

  const BlockMatrix K = make_matrix();
  slots_ = pair_slots(K, tets_, tets_);
  plain_slots_ = pair_slots(make_plain_matrix(), tets_, tets_);
  gradient_slots_ = pair_slots(make_pressure_gradient(), tets_, pressure_.of_corner());
  std::size_t most_nodes = 0;
  for (int k = 0; k < domains_.size(); ++k) {
    domain_slot_begin_.push_back(static_cast<int>(domain_slots_.size()));
    const int* node = domains_.node.data() + domains_.node_begin[k];
    const int n = domains_.num_nodes(k);
    for (int b = 0; b < n; ++b) {
      for (int a = b; a < n; ++a) {
        domain_slots_.push_back(K.slot(node[a], node[b]));
        domain_slots_.push_back(K.slot(node[b], node[a]));
      }
    }
    most_nodes = std::max(most_nodes, static_cast<std::size_t>(n));
  }
  columns_.resize(most_nodes);
  p_work_.resize(num_pressures());
}

/// Calls function(law, k, F_k) for the domains in their order.
template <class Function>
void SmoothedElasticity::for_each_domain(const Positions& x, double activation,
                                         Function function) const {
  assert(x.cols() == num_nodes_);
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    for (int k = domains_.material_begin[m]; k < domains_.material_begin[m + 1]; ++k) {
      function(PointLaw(materials_[m], domain_fibres_, k, activation), k, gradient_of_domain(x, k));
    }
  }
}

/// Calls function(law, e, F_e) for the elements of one material after the other.
template <class Function>
void SmoothedElasticity::for_each_element(const Positions& x, double activation,
                                          Function function) const {
  assert(x.cols() == num_nodes_);
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    for (int i = element_begin_[m]; i < element_begin_[m + 1]; ++i) {
      const int e = elements_[i];
      function(PointLaw(materials_[m], fibres_, e, activation), e,
               deformation_gradient(gather(x, tets_, e), inverse_edges_[e]));
    }
  }
}

/// F_k, written with edges so that a translation cancels first.
Mat3 SmoothedElasticity::gradient_of_domain(const Positions& x, int k) const {
  const int begin = domains_.node_begin[k], end = domains_.node_begin[k + 1];
  const Vec3 origin = x.col(domains_.node[begin]);
  Mat3 F = Mat3::Zero();
  for (int i = begin + 1; i < end; ++i) {
    F += (x.col(domains_.node[i]) - origin) * domains_.gradient[i].transpose();
  }
  return F;
}

double SmoothedElasticity::mean_pressure(int e, const Eigen::VectorXd& p) const {
  double sum = 0;
  for (const int c : pressure_.of_corner().col(e)) sum += p[c];
  return sum / 4;
}

void SmoothedElasticity::dilatation(const Positions& x, Eigen::VectorXd& b) const {
  b.setZero(num_pressures());
  for_each_element(x, 0, [&](const PointLaw& law, int e, const Mat3& F) {
    const double quarter = volume_[e] / 4 * law.dilatation(F);
    for (const int c : pressure_.of_corner().col(e)) b[c] += quarter;
  });
}

void SmoothedElasticity::pressure(const Positions& x, Eigen::VectorXd& p) const {
  dilatation(x, p);
  pressure_.solve(p);
}

void SmoothedElasticity::predicted_pressure(const Positions& x, const PressureGradient& G,
                                            const Positions& dx, Eigen::VectorXd& p) const {
  G.multiply_transposed(dx.reshaped(), p);
  dilatation(x, p_work_);
  p += p_work_;
  pressure_.solve(p);
}

double SmoothedElasticity::energy(const Positions& x, const Eigen::VectorXd& p,
                                  double activation) const {
  const double share = smoothing_.plain_share;
  double W = 0;
  for_each_domain(x, activation, [&](const PointLaw& law, int k, const Mat3& F) {
    W += (1 - share) * domains_.volume[k] * law.distortion_energy_density(F);
  });
  for_each_element(x, activation, [&](const PointLaw& law, int e, const Mat3& F) {
    if (share > 0) W += share * volume_[e] * law.distortion_energy_density(F);
    W += volume_[e] * mean_pressure(e, p) * law.dilatation(F);
  });
  return W;
}

double SmoothedElasticity::energy(const Positions& x, double activation) const {
  pressure(x, p_work_);
  // ½ bᵀp instead of bᵀp: the latter is what energy(x, p) holds.
  double half = 0;
  for_each_element(x, 0, [&](const PointLaw& law, int e, const Mat3& F) {
    half += 0.5 * volume_[e] * mean_pressure(e, p_work_) * law.dilatation(F);
  });
  return energy(x, p_work_, activation) - half;
}

void SmoothedElasticity::add_internal_force(const Positions& x, Positions& f,
                                            double activation) const {
  pressure(x, p_work_);
  add_internal_force(x, p_work_, f, activation);
}

void SmoothedElasticity::add_internal_force(const Positions& x, const Eigen::VectorXd& p,
                                            Positions& f, double activation) const {
  assert(f.cols() == num_nodes_ && p.size() == num_pressures());
  const double share = smoothing_.plain_share;
  for_each_domain(x, activation, [&](const PointLaw& law, int k, const Mat3& F) {
    const Mat3 P = (1 - share) * domains_.volume[k] * law.distortion_first_piola(F);
    for (int i = domains_.node_begin[k]; i < domains_.node_begin[k + 1]; ++i) {
      f.col(domains_.node[i]) += P * domains_.gradient[i];
    }
  });
  for_each_element(x, activation, [&](const PointLaw& law, int e, const Mat3& F) {
    Mat3 P = mean_pressure(e, p) * law.dilatation_gradient(F);
    if (share > 0) P += share * law.distortion_first_piola(F);
    const Mat34 f_e = nodal_force(P, shape_gradients(inverse_edges_[e]), volume_[e]);
    for (int a = 0; a < 4; ++a) f.col(tets_(a, e)) += f_e.col(a);
  });
}

BlockMatrix SmoothedElasticity::make_matrix() const {
  return {num_nodes_, domains_.node, domains_.node_begin};
}

BlockMatrix SmoothedElasticity::make_plain_matrix() const {
  return {num_nodes_, {tets_.data(), 4 * volume_.size()}, offsets_by_four(volume_.size())};
}

PressureGradient SmoothedElasticity::make_pressure_gradient() const {
  const std::vector<int> offsets = offsets_by_four(volume_.size());
  const std::size_t count = 4 * volume_.size();
  return {num_nodes_,
          num_pressures(),
          {tets_.data(), count},
          offsets,
          {pressure_.of_corner().data(), count},
          offsets};
}

/// K_ab += scale V_k ∂N_a/∂X · C · ∂N_b/∂X
void SmoothedElasticity::add_domain_stiffness(int k, const Mat9& C, double scale,
                                              BlockMatrix& K) const {
  const int n = domains_.num_nodes(k);
  const Vec3* gradient = domains_.gradient.data() + domains_.node_begin[k];
  const int* slot = domain_slots_.data() + domain_slot_begin_[k];
  for (int b = 0; b < n; ++b) {
    const Vec3 g = scale * domains_.volume[k] * gradient[b];
    columns_[b].noalias() =
        C.middleCols<3>(0) * g[0] + C.middleCols<3>(3) * g[1] + C.middleCols<3>(6) * g[2];
  }
  for (int b = 0; b < n; ++b) {
    const Eigen::Matrix<double, 9, 3>& CB = columns_[b];
    for (int a = b; a < n; ++a) {
      const Vec3& g = gradient[a];
      const Mat3 K_ab =
          CB.middleRows<3>(0) * g[0] + CB.middleRows<3>(3) * g[1] + CB.middleRows<3>(6) * g[2];
      K.block(*slot++) += K_ab;
      if (a != b) K.block(*slot) += K_ab.transpose();
      ++slot;
    }
  }
}

/// K_ab += scale V_e ∂N_a/∂X · C · ∂N_b/∂X
void SmoothedElasticity::add_element_stiffness(int e, const Mat9& C, double scale,
                                               std::span<const int> slots, BlockMatrix& K) const {
  const Mat12 K_e = stiffness(C, shape_gradients(inverse_edges_[e]), scale * volume_[e]);
  const int* slot = &slots[16 * static_cast<std::size_t>(e)];
  for (int b = 0; b < 4; ++b) {
    for (int a = 0; a < 4; ++a) K.block(*slot++) += K_e.block<3, 3>(3 * a, 3 * b);
  }
}

void SmoothedElasticity::add_stiffness(const Positions& x, const Eigen::VectorXd& p,
                                       Tangent tangent, double scale, BlockMatrix& K,
                                       double activation) const {
  assert(K.num_blocks() == num_nodes_ && p.size() == num_pressures());
  const double share = smoothing_.plain_share;
  for_each_domain(x, activation, [&](const PointLaw& law, int k, const Mat3& F) {
    const Mat9 C = law.distortion_tangent(F, tangent);
    add_domain_stiffness(k, C, (1 - share) * scale, K);
  });
  for_each_element(x, activation, [&](const PointLaw& law, int e, const Mat3& F) {
    Mat9 C = mean_pressure(e, p) * law.dilatation_hessian(F);
    if (share > 0) C += share * law.distortion_tangent(F, Tangent::Consistent);
    if (tangent == Tangent::Projected) C = projected(C);
    add_element_stiffness(e, C, scale, slots_, K);
  });
}

void SmoothedElasticity::add_plain_stiffness(const Positions& x, Tangent tangent, double scale,
                                             BlockMatrix& K, double activation) const {
  assert(K.num_blocks() == num_nodes_);
  for_each_element(x, activation, [&](const PointLaw& law, int e, const Mat3& F) {
    const Mat9 C = law.distortion_tangent(F, tangent);
    add_element_stiffness(e, C, scale, plain_slots_, K);
  });
}

void SmoothedElasticity::set_pressure_gradient(const Positions& x, PressureGradient& G) const {
  assert(G.num_nodes() == num_nodes_ && G.num_pressures() == num_pressures());
  G.set_zero();
  for_each_element(x, 0, [&](const PointLaw& law, int e, const Mat3& F) {
    const Mat34 G_e =
        nodal_force(law.dilatation_gradient(F), shape_gradients(inverse_edges_[e]), volume_[e] / 4);
    const int* slot = &gradient_slots_[16 * static_cast<std::size_t>(e)];
    for (int c = 0; c < 4; ++c) {
      for (int a = 0; a < 4; ++a) G.block(*slot++) += G_e.col(a);
    }
  });
}

Eigen::MatrixXd SmoothedElasticity::cauchy_stress(const Positions& x, double activation) const {
  const double share = smoothing_.plain_share;
  Eigen::MatrixXd of_domain(6, domains_.size()), stress(6, num_elements());
  const auto components = [](const Mat3& s) {
    return Eigen::Vector<double, 6>(s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2));
  };
  for_each_domain(x, activation, [&](const PointLaw& law, int k, const Mat3& F) {
    of_domain.col(k) = components(law.distortion_cauchy_stress(F));
  });
  pressure(x, p_work_);
  for_each_element(x, activation, [&](const PointLaw& law, int e, const Mat3& F) {
    const Mat3 plain =
        share * law.distortion_cauchy_stress(F) +
        mean_pressure(e, p_work_) * law.dilatation_gradient(F) * F.transpose() / F.determinant();
    stress.col(e) = components(plain);
    const int* k = &domains_.of_element[6 * static_cast<std::size_t>(e)];
    for (int i = 0; i < 6; ++i) stress.col(e) += (1 - share) / 6 * of_domain.col(k[i]);
  });
  return stress;
}

Eigen::VectorXd SmoothedElasticity::volume_ratio(const Positions& x) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, 0,
                   [&](const PointLaw&, int e, const Mat3& F) { result[e] = F.determinant(); });
  return result;
}

Eigen::VectorXd SmoothedElasticity::fibre_stretch(const Positions& x) const {
  assert(fibres_.cols() == num_elements());
  Eigen::VectorXd result(num_elements());
  for_each_element(x, 0, [&](const PointLaw&, int e, const Mat3& F) {
    result[e] = (F * fibres_.col(e)).norm();
  });
  return result;
}

Eigen::VectorXd SmoothedElasticity::strain_energy_density(const Positions& x,
                                                          double activation) const {
  const double share = smoothing_.plain_share;
  Eigen::VectorXd of_domain(domains_.size()), result(num_elements());
  for_each_domain(x, activation, [&](const PointLaw& law, int k, const Mat3& F) {
    of_domain[k] = law.distortion_energy_density(F);
  });
  pressure(x, p_work_);
  for_each_element(x, activation, [&](const PointLaw& law, int e, const Mat3& F) {
    result[e] = share * law.distortion_energy_density(F) +
                0.5 * mean_pressure(e, p_work_) * law.dilatation(F);
    const int* k = &domains_.of_element[6 * static_cast<std::size_t>(e)];
    for (int i = 0; i < 6; ++i) result[e] += (1 - share) / 6 * of_domain[k[i]];
  });
  return result;
}

}  // namespace articular::fem
