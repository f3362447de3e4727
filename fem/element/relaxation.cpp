#include "fem/element/relaxation.hpp"

#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fem/base/on_columns.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/material.hpp"
#include "fem/material/point_law.hpp"

namespace articular::fem {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;  // xx yy zz xy yz xz

Mat3 matrix_of(const Vec6& s) {
  Mat3 S;
  S << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return S;
}

Vec6 entries_of(const Mat3& S) {
  return (Vec6() << S(0, 0), S(1, 1), S(2, 2), S(0, 1), S(1, 2), S(0, 2)).finished();
}

Mat3 second_piola(const Mat3& F, const Mat3& P) {
  const Mat3 S = F.inverse() * P;
  return 0.5 * (S + S.transpose());  // round-off
}

void check(const std::vector<PronyTerm>& terms) {
  double sum = 0;
  for (const PronyTerm& term : terms) {
    checked_positive(term.time, "relaxation time", "s");
    sum += checked_positive(term.weight, "weight of a relaxation time", "(no unit)");
  }
  if (sum < 1) return;
  std::ostringstream message;
  message << "weights of the relaxation times sum up to " << sum
          << ", must be below 1: nothing would be left of the stress";
  throw std::invalid_argument(message.str());
}

}  // namespace

Relaxation::Relaxation(std::vector<PronyTerm> terms, const AnyMaterial& law,
                       DistortionPoints points, const BlockMatrix& matrix)
    : terms_(std::move(terms)),
      law_(std::make_shared<const AnyMaterial>(law)),
      points_(std::move(points)) {
  check(terms_);
  for (int k = 0; k < num_points(); ++k)
    for (int a = points_.node_begin[k]; a < points_.node_begin[k + 1]; ++a)
      for (int b = points_.node_begin[k]; b < points_.node_begin[k + 1]; ++b)
        slots_.push_back(matrix.slot(points_.node[a], points_.node[b]));
}

/// F_k, written with edges so that a translation cancels first.
Mat3 Relaxation::gradient(const Positions& x, int k) const {
  const int begin = points_.node_begin[k];
  const Vec3 origin = x.col(points_.node[begin]);
  Mat3 F = Mat3::Zero();
  for (int a = begin + 1; a < points_.node_begin[k + 1]; ++a)
    F += (x.col(points_.node[a]) - origin) * points_.gradient[a].transpose();
  return F;
}

Mat3 Relaxation::relaxed(const Eigen::VectorXd& internal_variables, int k) const {
  Vec6 sum = Vec6::Zero();
  const double* internal_variable = internal_variables.data() + 6 * k;
  for (const PronyTerm& term : terms_) {
    sum += term.weight * Eigen::Map<const Vec6>(internal_variable);
    internal_variable += 6 * num_points();
  }
  return matrix_of(sum);
}

void Relaxation::stress(const Positions& x, double activation, Eigen::VectorXd& S0) const {
  S0.resize(6 * num_points());
  for (int k = 0; k < num_points(); ++k) {
    const Mat3 F = gradient(x, k);
    const PointLaw law(*law_, points_.fibres, k, activation);
    S0.segment<6>(6 * k) = entries_of(second_piola(F, law.distortion_first_piola(F)));
  }
}

void Relaxation::rate(const Eigen::VectorXd& S0, const Eigen::VectorXd& internal_variables,
                      Eigen::Ref<Eigen::VectorXd> rate) const {
  assert(internal_variables.size() == num_internal_variables());
  const Eigen::Index n = S0.size();
  for (int i = 0; i < num_terms(); ++i)
    rate.segment(n * i, n) = (S0 - internal_variables.segment(n * i, n)) / terms_[i].time;
}

void Relaxation::settle(const Eigen::VectorXd& S0, Eigen::VectorXd& internal_variables) const {
  internal_variables = S0.replicate(num_terms(), 1);
}

double Relaxation::settled_energy(const Positions& x, double activation) const {
  double energy = 0;
  for (int k = 0; k < num_points(); ++k)
    energy +=
        points_.volume[k] *
        PointLaw(*law_, points_.fibres, k, activation).distortion_energy_density(gradient(x, k));
  double weights = 0;
  for (const PronyTerm& term : terms_) weights += term.weight;
  return -weights * energy;
}

void Relaxation::add_force(const Positions& x, const Eigen::VectorXd& internal_variables,
                           double scale, Positions& f) const {
  for (int k = 0; k < num_points(); ++k) {
    const Mat3 P = -scale * points_.volume[k] * gradient(x, k) * relaxed(internal_variables, k);
    for (int a = points_.node_begin[k]; a < points_.node_begin[k + 1]; ++a)
      f.col(points_.node[a]) += P * points_.gradient[a];
  }
}

// δP0 = δF S0 + F δS0, so that F δS0 = (∂P0/∂F − on_columns(S0)) δF; and with L at the end of the
// step Σ g_i δL_i = φ δS0, φ = Σ g_i h/(τ_i + h).
void Relaxation::add_stiffness(const Positions& x, double activation, Tangent tangent,
                               const Eigen::VectorXd& S0, const Eigen::VectorXd& internal_variables,
                               double h, double scale, BlockMatrix& K) const {
  double phi = 0;
  for (const PronyTerm& term : terms_) phi += term.weight / (1 + term.time / h);
  const int* slot = slots_.data();
  for (int k = 0; k < num_points(); ++k) {
    const PointLaw law(*law_, points_.fibres, k, activation);
    Mat9 C = -phi * law.distortion_tangent(gradient(x, k), tangent);
    if (tangent == Tangent::Consistent)
      C += on_columns(phi * matrix_of(S0.segment<6>(6 * k)) - relaxed(internal_variables, k));
    C *= scale * points_.volume[k];
    for (int a = points_.node_begin[k]; a < points_.node_begin[k + 1]; ++a) {
      const Vec3& g = points_.gradient[a];
      const Eigen::Matrix<double, 3, 9> row =
          g[0] * C.middleRows<3>(0) + g[1] * C.middleRows<3>(3) + g[2] * C.middleRows<3>(6);
      for (int b = points_.node_begin[k]; b < points_.node_begin[k + 1]; ++b) {
        const Vec3& h_b = points_.gradient[b];
        K.block(*slot++) += h_b[0] * row.middleCols<3>(0) + h_b[1] * row.middleCols<3>(3) +
                            h_b[2] * row.middleCols<3>(6);
      }
    }
  }
}

void Relaxation::add_cauchy_stress(const Positions& x, const Eigen::VectorXd& internal_variables,
                                   Eigen::MatrixXd& cauchy_stress) const {
  for (int e = 0; e < cauchy_stress.cols(); ++e) {
    const Mat3 F = gradient(x, e);
    cauchy_stress.col(e) -=
        entries_of(F * relaxed(internal_variables, e) * F.transpose() / F.determinant());
  }
}

}  // namespace articular::fem
