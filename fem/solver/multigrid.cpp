#include "fem/solver/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace articular::fem {
namespace {

// Couplings count as strong from here on, half of it on each further level [Vanek 1996].
constexpr float kStrong = 0.08F;
// Coarser levels shall have at most this part of the blocks; couplings that weak are taken for
// that.
constexpr double kLargestShare = 0.25;
constexpr float kWeakestStrong = 0.01F;
// Above this share a coarser level is not worth its cost.
constexpr double kHopelessShare = 0.7;
// Rows with more neighbours (a bone's) are prolongated as they are: smoothed, they would couple all
// the aggregates around them with one another.
constexpr int kLongRow = 200;
// Unknowns that a dense factorization may have, and those that it has if coarsening ends early.
constexpr int kDirect = 300, kMostDirect = 1500;
constexpr int kMostLevels = 20;
// The smoother acts on the upper part of the spectrum, [λ/20, λ].
constexpr float kSmoothedRange = 20;

void set_interval(float largest, ChebyshevSmoother& smoother) {
  smoother.high = largest;
  smoother.low = largest / kSmoothedRange;
}

template <int N>
std::vector<float> coupling_weights(const BlockRows<N>& A, ThreadPool& pool) {
  std::vector<float> weight(A.column.size());
  const float scale = 1 / std::sqrt(static_cast<float>(N));  // the identity counts 1
  pool.run_pieces(A.num_rows(), kRowsPerPiece<N>, [&](int begin, int end, int) {
    for (int k = A.row_begin[begin]; k < A.row_begin[end]; ++k) {
      float squares = 0;
      for (int c = 0; c < N * N; ++c) squares += A.block(k)[c] * A.block(k)[c];
      weight[k] = scale * std::sqrt(squares);
    }
  });
  return weight;
}

template <int N>
Aggregation find_aggregates(const BlockRows<N>& A, float strong, const std::vector<char>& alone,
                            ThreadPool& pool) {
  const std::vector<float> weight = coupling_weights(A, pool);
  const CouplingGraph graph{A.row_begin, A.column, weight};
  Aggregation aggregation = aggregate(graph, strong, alone);
  const auto too_many = [&] { return aggregation.num_aggregates > kLargestShare * A.num_rows(); };
  while (too_many() && strong > kWeakestStrong) {
    strong /= 2;
    aggregation = aggregate(graph, strong, alone);
  }
  return aggregation;
}

template <int N>
void resize_vectors(MultigridLevel<N>& level) {
  level.reach = reach_of_pieces(level.A);
  const auto size = static_cast<std::size_t>(N) * static_cast<std::size_t>(level.A.num_rows());
  LevelVectors& v = level.vectors;
  for (std::vector<float>* vector : {&v.x, &v.r, &v.d, &v.d_next}) *vector = padded(size);
}

/// Where the coarser level has blocks. @return false where there is no use in one
template <int N>
bool find_pattern(MultigridLevel<N>& fine, float strong, const std::vector<char>& alone,
                  MultigridLevel<6>& coarse, ThreadPool& pool) {
  const int n = fine.A.num_rows();
  fine.aggregation = find_aggregates(fine.A, strong, alone, pool);
  const int num_aggregates = fine.aggregation.num_aggregates;
  if (num_aggregates == 0 || num_aggregates > kHopelessShare * n) return false;
  fine.unsmoothed = alone;
  fine.unsmoothed.resize(n, 0);
  for (int i = 0; i < n; ++i) {
    if (fine.A.row_begin[i + 1] - fine.A.row_begin[i] > kLongRow) fine.unsmoothed[i] = 1;
  }
  fine.P = prolongation_pattern(fine.A, fine.aggregation, fine.unsmoothed);
  fine.galerkin = galerkin_pattern(fine.A, fine.P, coarse.A);
  resize_vectors(coarse);
  return true;
}

template <int N>
void bound_spectrum(MultigridLevel<N>& level, ThreadPool& pool) {
  level.largest = largest_eigenvalue(level.A, pool);
  set_interval(level.largest.likely_bound, level.smoother);
}

/// Values of the coarser level; modes become its modes.
template <int N>
bool find_values(MultigridLevel<N>& fine, RigidModes& modes, MultigridLevel<6>& coarse,
                 ThreadPool& pool) {
  const float omega = 4 / (3 * fine.largest.likely_bound);
  modes =
      smoothed_prolongation(fine.A, fine.aggregation, fine.unsmoothed, modes, omega, fine.P, pool);
  return galerkin_product(fine.A, fine.galerkin, fine.P, modes, coarse.A, pool);
}

template <int N>
Eigen::MatrixXd dense_matrix(const BlockRows<N>& A) {
  const Eigen::Index n = Eigen::Index{N} * A.num_rows();
  Eigen::MatrixXd result = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < A.num_rows(); ++i) {
    for (int k = A.row_begin[i]; k < A.row_begin[i + 1]; ++k) {
      result.block<N, N>(Eigen::Index{N} * i, Eigen::Index{N} * A.column[k]) =
          Eigen::Map<const Eigen::Matrix<float, N, N>>(A.block(k)).template cast<double>();
    }
  }
  return result;
}

}  // namespace

bool Multigrid::set_up(BlockRows<3> A, RigidModes modes, std::vector<char> alone,
                       ThreadPool& pool) {
  finest_ = {};
  coarse_.clear();
  coarse_.reserve(kMostLevels);  // levels stay where they are
  finest_.A = std::move(A);
  finest_.unsmoothed = std::move(alone);
  resize_vectors(finest_);
  return build(std::move(modes), true, pool);
}

bool Multigrid::refresh(RigidModes modes, ThreadPool& pool) {
  return build(std::move(modes), false, pool);
}

bool Multigrid::build(RigidModes modes, bool new_pattern, ThreadPool& pool) {
  bound_spectrum(finest_, pool);
  float strong = kStrong;
  // The first step goes from blocks of three to blocks of six, the others from six to six.
  const auto coarsen = [&](auto& fine, std::size_t level) {
    if (!new_pattern && coarse_.size() == level) return false;
    if (new_pattern) {
      MultigridLevel<6> coarse;
      const std::vector<char> alone = std::exchange(fine.unsmoothed, {});
      if (!find_pattern(fine, strong, alone, coarse, pool)) return false;
      coarse_.push_back(std::move(coarse));
    }
    return true;
  };
  const auto finish = [&](std::size_t level) { bound_spectrum(coarse_[level], pool); };

  if (3 * finest_.A.num_rows() > kDirect && coarsen(finest_, 0)) {
    if (!find_values(finest_, modes, coarse_[0], pool)) return false;
    finish(0);
    for (std::size_t level = 1; level < kMostLevels; ++level) {
      if (6 * coarse_[level - 1].A.num_rows() <= kDirect) break;
      strong /= 2;
      if (!coarsen(coarse_[level - 1], level)) break;
      if (!find_values(coarse_[level - 1], modes, coarse_[level], pool)) return false;
      finish(level);
    }
  }
  return factorize_last();
}

bool Multigrid::factorize_last() {
  const int size = coarse_.empty() ? 3 * finest_.A.num_rows() : 6 * coarse_.back().A.num_rows();
  direct_ = size <= kMostDirect;
  if (!direct_) return true;
  dense_.compute(coarse_.empty() ? dense_matrix(finest_.A) : dense_matrix(coarse_.back().A));
  return dense_.info() == Eigen::Success && dense_.matrixLLT().diagonal().allFinite();
}

void Multigrid::apply(ThreadPool& pool) { cycle(0, pool); }

void Multigrid::cycle(std::size_t level, ThreadPool& pool) {
  const auto visit = [&](auto& fine) {
    LevelVectors& v = fine.vectors;
    if (level == coarse_.size() && direct_) {
      const Eigen::Index n = dense_.rows();
      dense_x_ = Eigen::Map<const Eigen::VectorXf>(v.r.data(), n).cast<double>();
      dense_.solveInPlace(dense_x_);
      Eigen::Map<Eigen::VectorXf>(v.x.data(), n) = dense_x_.cast<float>();
      return;
    }
    smooth_before(fine.A, fine.reach, fine.smoother, v, pool);
    if (level == coarse_.size()) return;
    LevelVectors& below = coarse_[level].vectors;
    restrict_to_coarse(fine.P, v.r, below.r, pool);
    cycle(level + 1, pool);
    prolong(fine.P, below.x, v.d, pool);
    smooth_after(fine.A, fine.reach, fine.smoother, v, pool);
  };
  if (level == 0) {
    visit(finest_);
  } else {
    visit(coarse_[level - 1]);
  }
}

void Multigrid::use_sure_bounds() {
  set_interval(finest_.largest.sure_bound, finest_.smoother);
  for (MultigridLevel<6>& level : coarse_) set_interval(level.largest.sure_bound, level.smoother);
}

int Multigrid::num_levels() const { return static_cast<int>(coarse_.size()) + 1; }

double Multigrid::operator_complexity() const {
  const double finest = 9.0 * (static_cast<double>(finest_.A.column.size()) + finest_.A.num_rows());
  double sum = finest;
  for (const MultigridLevel<6>& level : coarse_) {
    sum += 36.0 * (static_cast<double>(level.A.column.size()) + level.A.num_rows());
  }
  return sum / finest;
}

}  // namespace articular::fem
