#include "fem/solver/mixed_preconditioner.hpp"

#include <Eigen/Cholesky>

namespace articular::fem {
namespace {

// Both chosen with `solver_speed pressure`; see fem/RESULTS.md.
constexpr double kSchur = 2;           // α [-]
constexpr double kOverRelaxation = 2;  // σ [-]
constexpr double kRowScale = 3;        // [-] how much more a change of volume counts than its force

}  // namespace

bool MixedPreconditioner::set_matrix(const BlockMatrix& near, ThreadPool& pool) {
  if (!near_.has_pattern_of(near)) {
    near_.take_pattern(near);
    has_pattern_ = false;
  }
  if (!near_.take_values(near, pool)) return false;
  for (int i = 0; i < near_.num_rows(); ++i) {
    const Eigen::LLT<Mat3> factor(Eigen::Map<const Mat3>(near_.diagonal(i)));
    if (factor.info() != Eigen::Success) return false;
  }
  z_.resize(3 * Eigen::Index{near_.num_rows()});
  return true;
}

bool MixedPreconditioner::build(const Positions& x, ThreadPool& pool) {
  has_pattern_ = multigrid_.build(near_, !has_pattern_, x, pool);
  return has_pattern_;
}

void MixedPreconditioner::set_pressures(const MixedSystem& system) {
  T_.setZero(system.num_pressures());
  row_scale_.setZero(system.num_pressures());
  for (std::size_t t = 0; t < system.terms().size(); ++t) {
    const PressureTerm& term = system.terms()[t];
    auto T = T_.segment(system.begin(t), term.G->num_pressures());
    auto squares = row_scale_.segment(system.begin(t), term.G->num_pressures());
    const SymmetricMatrix& C = term.pressure->compliance();
    for (int c = 0; c < C.size(); ++c) T[c] = C.value[C.begin[c + 1] - 1] / term.scale;
    for (int i = 0; i < term.G->num_nodes(); ++i) {
      const int begin = term.G->row_begin()[i], end = term.G->row_begin()[i + 1];
      if (begin == end) continue;
      const Mat3 inverse =
          Eigen::LLT<Mat3>(Eigen::Map<const Mat3>(near_.diagonal(i))).solve(Mat3::Identity());
      for (int s = begin; s < end; ++s) {
        const Vec3& g = term.G->block(s);
        T[term.G->column()[s]] += kSchur * g.dot(inverse * g);
        squares[term.G->column()[s]] += g.squaredNorm();
      }
    }
  }
  // A pressure whose nodes are all held has no force: any scale will do.
  row_scale_ = (row_scale_.array() > 0).select(row_scale_.cwiseSqrt(), 1.0);
  row_scale_ = kRowScale * row_scale_.cwiseQuotient(T_);
}

double MixedPreconditioner::displacements(const Eigen::VectorXd& r, bool use_cycle,
                                          Eigen::VectorXf& x, ThreadPool& pool) {
  const double norm = r.norm();
  x.setZero(r.size());
  if (norm == 0) return std::numeric_limits<double>::min();
  pool.run_pieces(near_.num_rows(), kRowsOfSums, [&](int begin, int end, int) {
    multigrid_.enter(begin, end, r.data(), 1 / norm);
  });
  use_cycle ? multigrid_.apply_cycle(pool) : multigrid_.apply_nothing();
  pool.run_pieces(near_.num_rows(), kRowsOfSums,
                  [&](int begin, int end, int) { multigrid_.leave(begin, end, norm, z_.data()); });
  x = z_.cast<float>();
  return r.dot(z_);
}

void MixedPreconditioner::pressures(const Eigen::VectorXd& q, const Eigen::VectorXd& q_x,
                                    Eigen::VectorXf& p) const {
  p = (kOverRelaxation * q_x - q).cwiseQuotient(T_).cast<float>();
}

}  // namespace articular::fem
