#include "sim/wrap/string_hessian.hpp"

#include <Eigen/Cholesky>

namespace articular::sim {
namespace {

/// (I − u uᵀ)/l of a segment.
Mat3 across(const StringShape& s, std::size_t i) {
  if (!(s.l[i] > 0)) return Mat3::Zero();
  return (Mat3::Identity() - s.u[i] * s.u[i].transpose()) / s.l[i];
}

auto rows(const Eigen::MatrixXd& m, std::size_t i) {
  return m.middleRows<3>(3 * static_cast<Eigen::Index>(i));
}

}  // namespace

Eigen::MatrixXd held_hessian(const StringShape& s, const StringMotion& motion) {
  const Eigen::Index size = motion.points.cols();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < s.l.size(); ++i) {
    const Eigen::Matrix3Xd d = rows(motion.points, i + 1) - rows(motion.points, i);
    K.noalias() += d.transpose() * (across(s, i) * d);
  }
  return K;
}

Eigen::MatrixXd taut_hessian(const StringShape& s, const StringMotion& motion) {
  Eigen::MatrixXd K = held_hessian(s, motion);
  const auto n = static_cast<Eigen::Index>(s.e.size());
  if (n == 0) return K;
  Eigen::MatrixXd by_t = Eigen::MatrixXd::Zero(n, n), by_x(n, motion.points.cols());
  for (std::size_t k = 0; k < s.e.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    by_x.row(i).setZero();
    if (s.fixed[k] != 0) {
      by_t(i, i) = 1;
      continue;
    }
    const Mat3 before = across(s, k), after = across(s, k + 1);
    by_t(i, i) = s.e[k].dot((before + after) * s.e[k]);
    if (k + 1 < s.e.size() && s.fixed[k + 1] == 0)
      by_t(i, i + 1) = by_t(i + 1, i) = -s.e[k].dot(after * s.e[k + 1]);
    const Eigen::Matrix3Xd du = before * (rows(motion.points, k + 1) - rows(motion.points, k)) -
                                after * (rows(motion.points, k + 2) - rows(motion.points, k + 1));
    by_x.row(i) =
        s.e[k].transpose() * du + (s.u[k] - s.u[k + 1]).transpose() * rows(motion.edges, k);
  }
  K.noalias() -= by_x.transpose() * by_t.ldlt().solve(by_x);
  return K;
}

}  // namespace articular::sim
