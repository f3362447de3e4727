#include "sim/time/anderson.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace articular::sim {
namespace {

/// Slow: still this part of what the correction was kBack iterations before, by wᵀ M w.
constexpr double kSlow = 0.25;
/// Where a correction is so many times the last one, by wᵀ M w, earlier ones say nothing of it.
constexpr double kLost = 100;
/// Changes are taken for dependent on each other below this part of the largest, by its square.
constexpr double kDependent = 1e-10;

}  // namespace

void Anderson::see(const Eigen::VectorXd& w, const Eigen::VectorXd& weighted, bool has_grown) {
  if (has_improved_ && has_grown) restart();
  has_improved_ = false;
  const double size = w.dot(weighted);
  const auto turn = [](int iteration) { return static_cast<std::size_t>(iteration % kBack); };
  if (num_seen_ > 0 && size > kLost * sizes_[turn(num_seen_ - 1)]) num_seen_ = 0;
  is_slow_ = num_seen_ >= kBack && size > kSlow * sizes_[turn(num_seen_)];
  sizes_[turn(num_seen_)] = size;
  if (num_seen_ == 0) {
    for (Eigen::MatrixXd* columns : {&change_, &weighted_change_, &way_})
      columns->resize(w.size(), kDepth);
  } else {
    const int column = num_seen_ % kDepth;
    change_.col(column) = w - last_;
    weighted_change_.col(column) = weighted - last_weighted_;
    way_.col(column) = taken_;
  }
  last_ = w;
  last_weighted_ = weighted;
  ++num_seen_;
}

void Anderson::improve(Eigen::VectorXd& w) {
  has_improved_ = true;
  // Of the first correction not all is along the unknowns: what it has to close between positions
  // and velocities is gone from the second on.
  const int num = std::min(num_seen_ - 2, kDepth);
  if (num < 1) return;
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kDepth, kDepth>;
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kDepth, 1>;
  const auto column = [this](int i) { return (num_seen_ - 1 - i) % kDepth; };
  // min |w - Σ c change|, by M: normal equations, without what is dependent.
  Small products(num, num);
  SmallVector rhs(num);
  for (int i = 0; i < num; ++i) {
    rhs[i] = weighted_change_.col(column(i)).dot(w);
    for (int j = 0; j < num; ++j)
      products(i, j) = weighted_change_.col(column(i)).dot(change_.col(column(j)));
  }
  const Eigen::SelfAdjointEigenSolver<Small> axes(products);
  const double least = kDependent * axes.eigenvalues().maxCoeff();
  SmallVector part = axes.eigenvectors().transpose() * rhs;
  for (int i = 0; i < num; ++i)
    part[i] = axes.eigenvalues()[i] > least ? part[i] / axes.eigenvalues()[i] : 0;
  const SmallVector c = axes.eigenvectors() * part;
  for (int i = 0; i < num; ++i) w -= c[i] * (change_.col(column(i)) + way_.col(column(i)));
}

}  // namespace articular::sim
