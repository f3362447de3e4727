#include "fem/solver/multigrid_preconditioner.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <utility>

#include "fem/solver/nodal_rotations.hpp"

namespace articular::fem {
namespace {

Eigen::Map<const Mat3> block(const double* values) { return Eigen::Map<const Mat3>(values); }

}  // namespace

bool MultigridPreconditioner::build(const MirroredMatrix& A, bool new_pattern, const Positions& x,
                                    ThreadPool& pool) {
  const int n = A.num_rows();
  inverse_factor_.resize(n);
  S_.resize(n);
  std::atomic<bool> positive = true;
  pool.run_pieces(n, kRowsOfSums, [&](int begin, int end, int) {
    for (int i = begin; i < end; ++i) {
      const Eigen::LLT<Mat3> factor(block(A.diagonal(i)));
      if (factor.info() != Eigen::Success) {
        positive = false;
        return;
      }
      inverse_factor_[i] = factor.matrixU().solve(Mat3::Identity().eval());
      S_[i] = inverse_factor_[i].cast<float>();
    }
  });
  if (!positive) return false;
  const bool same_nodes = X_.cols() == x.cols();
  X_ = x;
  rotation_.assign(x.cols(), Mat3::Identity());
  if (!new_pattern && same_nodes) {
    cycle_.matrix() = scaled_matrix(A, pool);
    return cycle_.refresh(modes(A), pool);
  }
  std::vector<char> alone;
  if (x.cols() > 0 && x.cols() < n) {
    alone.assign(n, 1);
    std::fill_n(alone.begin(), x.cols(), char{0});
  }
  return cycle_.set_up(scaled_matrix(A, pool), modes(A), std::move(alone), pool);
}

BlockRows<3> MultigridPreconditioner::scaled_matrix(const MirroredMatrix& A,
                                                    ThreadPool& pool) const {
  const int n = A.num_rows();
  BlockRows<3> scaled;
  scaled.row_begin.resize(static_cast<std::size_t>(n) + 1);
  scaled.column.resize(A.column().size() - static_cast<std::size_t>(n));
  scaled.values = padded(9 * scaled.column.size());
  pool.run_pieces(n, kRowsOfSums, [&](int begin, int end, int) {
    for (int i = begin; i < end; ++i) {
      int slot = A.row_begin()[i] - i;  // a diagonal block less for each row before
      scaled.row_begin[i] = slot;
      for (int k = A.row_begin()[i]; k < A.row_begin()[i + 1]; ++k) {
        const int j = A.column()[k];
        if (j == i) continue;
        scaled.column[slot] = j;
        const Mat3 half = inverse_factor_[i].transpose() * block(A.block(k));
        Eigen::Map<Eigen::Matrix3f>(scaled.block(slot++)) =
            (half * inverse_factor_[j]).cast<float>();
      }
    }
  });
  scaled.row_begin[n] = static_cast<int>(scaled.column.size());
  return scaled;
}

RigidModes MultigridPreconditioner::modes(const MirroredMatrix& A) const {
  const int n = A.num_rows();
  const auto num_nodes = static_cast<int>(X_.cols());
  RigidModes modes;
  modes.values.assign(std::size_t{3} * kModes * static_cast<std::size_t>(n), 0.0);
  modes.center.assign(n, Vec3::Zero());
  for (int i = 0; i < n; ++i) {
    // Lᵀ, the inverse of an upper triangle, against the translations; a node has no rotation.
    Eigen::Map<Eigen::Matrix<double, 3, kModes, Eigen::RowMajor>> B(modes.values.data() +
                                                                    std::ptrdiff_t{3} * kModes * i);
    B.leftCols<3>() =
        inverse_factor_[i].triangularView<Eigen::Upper>().solve(Mat3::Identity().eval());
    if (i < num_nodes) {
      modes.center[i] = X_.col(i);
      continue;
    }
    // What is not a node counts as in the middle of the nodes that it is coupled to.
    int count = 0;
    for (int k = A.row_begin()[i]; k < A.row_begin()[i + 1]; ++k) {
      if (A.column()[k] >= num_nodes) continue;
      modes.center[i] += X_.col(A.column()[k]);
      ++count;
    }
    if (count > 0) modes.center[i] /= count;
  }
  return modes;
}

void MultigridPreconditioner::turn(const MirroredMatrix& A, const Positions& x, ThreadPool& pool) {
  if (x.cols() == 0 || x.cols() != X_.cols()) return;
  update_nodal_rotations(A.row_begin(), A.column(), X_, x, rotation_, pool);
  pool.run_pieces(static_cast<int>(x.cols()), kRowsOfSums, [&](int begin, int end, int) {
    for (int i = begin; i < end; ++i) S_[i] = (rotation_[i] * inverse_factor_[i]).cast<float>();
  });
}

void MultigridPreconditioner::enter(Eigen::Index begin, Eigen::Index end, const double* r,
                                    double scale) {
  float* to = cycle_.residual().data();
  for (Eigen::Index i = begin; i < end; ++i) {
    Eigen::Map<Eigen::Vector3f>(to + 3 * i).noalias() =
        S_[i].transpose() * (scale * Eigen::Map<const Vec3>(r + 3 * i)).cast<float>();
  }
}

void MultigridPreconditioner::apply_nothing() { cycle_.apply_identity(); }

void MultigridPreconditioner::leave(Eigen::Index begin, Eigen::Index end, double scale,
                                    double* z) const {
  const float* from = cycle_.result().data();
  for (Eigen::Index i = begin; i < end; ++i) {
    const Eigen::Vector3f turned = S_[i] * Eigen::Map<const Eigen::Vector3f>(from + 3 * i);
    Eigen::Map<Vec3>(z + 3 * i) = scale * turned.cast<double>();
  }
}

}  // namespace articular::fem
