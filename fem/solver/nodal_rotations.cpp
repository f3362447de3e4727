#include "fem/solver/nodal_rotations.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "fem/sparse/block_rows.hpp"

namespace articular::fem {
namespace {

// Preconditioners turn with these; how exactly hardly matters to them.
constexpr double kAngle = 5e-3;  // [rad] at which the iteration stops
constexpr int kMostTurns = 20;   // reached from half a turn away only
constexpr int kNodesPerPiece = 512;

/// The rotation next to M, from R.
Mat3 nearest_rotation(const Mat3& M, const Mat3& R) {
  const double smallest = 1e-9 * M.norm();
  if (!(smallest > 0)) return R;  // NaN included
  Mat3 turned = R;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const Vec3 torque = turned.col(0).cross(M.col(0)) + turned.col(1).cross(M.col(1)) +
                        turned.col(2).cross(M.col(2));
    const double stiffness = std::abs(turned.cwiseProduct(M).sum()) + smallest;
    const Vec3 omega = torque / stiffness;
    if (omega.squaredNorm() < kAngle * kAngle) break;
    // The rotation by 2 atan(|ω|/2): that by |ω| up to its cube, without sine and cosine.
    const Vec3 half = 0.5 * omega;
    const Eigen::Quaterniond q(1, half.x(), half.y(), half.z());
    turned = (q.normalized() * Eigen::Quaterniond(turned)).normalized().toRotationMatrix();
  }
  return turned;
}

/// Four numbers a node, the last 0: single precision is enough for differences of neighbours.
std::vector<float> from_first_node(const Positions& x, ThreadPool& pool) {
  std::vector<float> result(4 * static_cast<std::size_t>(x.cols()));
  pool.run_pieces(static_cast<int>(x.cols()), kNodesPerPiece, [&](int begin, int end, int) {
    for (Eigen::Index i = begin; i < end; ++i) {
      Eigen::Map<Eigen::Vector3f>(result.data() + 4 * i) = (x.col(i) - x.col(0)).cast<float>();
    }
  });
  return result;
}

}  // namespace

void update_nodal_rotations(std::span<const int> row_begin, std::span<const int> column,
                            const Positions& X, const Positions& x, std::vector<Mat3>& R,
                            ThreadPool& pool) {
  assert(X.cols() == x.cols());
  const auto num_nodes = static_cast<int>(x.cols());
  R.resize(num_nodes, Mat3::Identity());
  const std::vector<float> X4 = from_first_node(X, pool), x4 = from_first_node(x, pool);
  pool.run_pieces(num_nodes, kNodesPerPiece, [&](int begin, int end, int) {
    for (int i = begin; i < end; ++i) {
      const Float4 X_i = load4(&X4[4 * static_cast<std::size_t>(i)]),
                   x_i = load4(&x4[4 * static_cast<std::size_t>(i)]);
      Float4 m0{}, m1{}, m2{};  // the columns of M
      for (int k = row_begin[i]; k < row_begin[i + 1]; ++k) {
        const int j = column[k];
        if (j >= num_nodes) continue;
        const Float4 dX = load4(&X4[4 * static_cast<std::size_t>(j)]) - X_i;
        const Float4 dx = load4(&x4[4 * static_cast<std::size_t>(j)]) - x_i;
        m0 += dx * __builtin_shufflevector(dX, dX, 0, 0, 0, 0);
        m1 += dx * __builtin_shufflevector(dX, dX, 1, 1, 1, 1);
        m2 += dx * __builtin_shufflevector(dX, dX, 2, 2, 2, 2);
      }
      Mat3 M;
      M << m0[0], m1[0], m2[0], m0[1], m1[1], m2[1], m0[2], m1[2], m2[2];
      R[i] = nearest_rotation(M, R[i]);
    }
  });
}

}  // namespace articular::fem
