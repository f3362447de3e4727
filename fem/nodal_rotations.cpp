#include "fem/nodal_rotations.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

namespace articular::fem {
namespace {

// Preconditioners turn with these; how exactly hardly matters to them.
constexpr double kAngle = 1e-3;  // [rad] at which the iteration stops
constexpr int kMostTurns = 20;   // reached from half a turn away only
constexpr int kNodesPerPiece = 512;

/// The rotation next to M, from R.
Mat3 nearest_rotation(const Mat3& M, const Mat3& R) {
  Eigen::Quaterniond q(R);
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
    q = Eigen::Quaterniond(1, half.x(), half.y(), half.z()) * q;
    q.normalize();
    turned = q.toRotationMatrix();
  }
  return turned;
}

}  // namespace

void update_nodal_rotations(std::span<const int> row_begin, std::span<const int> column,
                            const Positions& X, const Positions& x, std::vector<Mat3>& R,
                            ThreadPool& pool) {
  assert(X.cols() == x.cols());
  const auto num_nodes = static_cast<int>(x.cols());
  R.resize(num_nodes, Mat3::Identity());
  pool.run_pieces(num_nodes, kNodesPerPiece, [&](int begin, int end, int) {
    for (int i = begin; i < end; ++i) {
      Mat3 M = Mat3::Zero();
      for (int k = row_begin[i]; k < row_begin[i + 1]; ++k) {
        const int j = column[k];
        if (j >= num_nodes) continue;
        M += (x.col(j) - x.col(i)) * (X.col(j) - X.col(i)).transpose();
      }
      R[i] = nearest_rotation(M, R[i]);
    }
  });
}

}  // namespace articular::fem
