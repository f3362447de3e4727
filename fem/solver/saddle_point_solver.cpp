#include <algorithm>
#include <cassert>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fem/solver/linear_solver.hpp"
#include "fem/solver/preconditioned_iteration.hpp"
#include "fem/sparse/lower_blocks.hpp"
#include "fem/sparse/signed_cholesky.hpp"

namespace articular::fem {
namespace {

/// The upper half of [K G; Gᵀ −C/scale] by columns: those of the blocks of K first, then those of
/// the pressures of one term after the other.
class SaddlePointMatrix {
 public:
  bool has_pattern_of(const BlockMatrix& K, std::span<const PressureTerm> terms) const {
    return K.pattern_id() == pattern_id_ &&
           std::equal(terms.begin(), terms.end(), patterns_.begin(), patterns_.end(),
                      [](const PressureTerm& term, const Pattern& pattern) {
                        return std::ranges::equal(term.G->row_begin(), pattern.row_begin) &&
                               std::ranges::equal(term.G->column(), pattern.column);
                      });
  }

  void take_pattern(const BlockMatrix& K, std::span<const PressureTerm> terms) {
    pattern_id_ = K.pattern_id();
    matrix_ = {};
    append_pattern(K, matrix_);
    signs_.assign(3 * static_cast<std::size_t>(K.num_blocks()), 1);
    groups_ = groups_of_three(K.num_blocks());
    patterns_.clear();
    for (const PressureTerm& term : terms) {
      patterns_.emplace_back(*term.G);
      const SymmetricMatrix& C = term.pressure->compliance();
      const int offset = static_cast<int>(signs_.size());
      for (int c = 0; c < C.size(); ++c) {
        for (const Entry& entry : patterns_.back().of_pressure[c]) {
          for (int q = 0; q < 3; ++q) matrix_.row.push_back(3 * entry.node + q);
        }
        for (int k = C.begin[c]; k < C.begin[c + 1]; ++k) matrix_.row.push_back(offset + C.row[k]);
        matrix_.end_column();
        groups_.push_back(groups_.back() + 1);
      }
      signs_.insert(signs_.end(), static_cast<std::size_t>(C.size()), -1);
    }
    matrix_.value.resize(matrix_.row.size());
  }

  void take_values(const BlockMatrix& K, std::span<const PressureTerm> terms) {
    double* value = copy_values(K, matrix_.value.data());
    for (std::size_t t = 0; t < terms.size(); ++t) {
      const SymmetricMatrix& C = terms[t].pressure->compliance();
      for (int c = 0; c < C.size(); ++c) {
        for (const Entry& entry : patterns_[t].of_pressure[c]) {
          for (int q = 0; q < 3; ++q) *value++ = terms[t].G->block(entry.slot)[q];
        }
        for (int k = C.begin[c]; k < C.begin[c + 1]; ++k) *value++ = -C.value[k] / terms[t].scale;
      }
    }
    assert(value == matrix_.value.data() + matrix_.value.size());
  }

  const SymmetricMatrix& matrix() const { return matrix_; }
  const std::vector<int>& signs() const { return signs_; }
  /// Nodes and pressures, of each unknown.
  const std::vector<int>& groups() const { return groups_; }

 private:
  struct Entry {
    int node, slot;
  };
  /// That of one G, and its blocks by columns.
  struct Pattern {
    explicit Pattern(const PressureGradient& G)
        : row_begin(G.row_begin().begin(), G.row_begin().end()),
          column(G.column().begin(), G.column().end()),
          of_pressure(static_cast<std::size_t>(G.num_pressures())) {
      for (int i = 0; i < G.num_nodes(); ++i) {
        for (int s = row_begin[i]; s < row_begin[i + 1]; ++s) {
          of_pressure[column[s]].push_back({.node = i, .slot = s});
        }
      }
    }
    std::vector<int> row_begin, column;
    std::vector<std::vector<Entry>> of_pressure;
  };

  std::uint64_t pattern_id_ = 0;
  std::vector<Pattern> patterns_;
  SymmetricMatrix matrix_;
  std::vector<int> signs_, groups_;
};

/// The factor is a preconditioner, so single precision will do: it takes half the memory and two
/// thirds of the time. Double precision decides where single says that a sign may be wrong, or
/// takes too many iterations; it then stays, as what comes next is alike. It also serves near ν =
/// 0.5: there what a factor leaves of a change of volume is a large force.
class SaddlePointSolver final : public LinearSolver {
 public:
  SaddlePointSolver(double tolerance, int max_iterations, std::shared_ptr<ThreadPool> pool)
      : tolerance_(tolerance),
        max_iterations_(max_iterations),
        pool_(std::move(pool)),
        single_(pool_),
        double_(pool_) {}

  using LinearSolver::prepare;
  FactorStatus prepare(const BlockMatrix& A, const Positions& x) override {
    return prepare_with_pressure(A, x, {});
  }

  using LinearSolver::prepare_with_pressure;
  FactorStatus prepare_with_pressure(const BlockMatrix& A, const Positions&,
                                     const PressurePart& part) override {
    ready_ = false;
    const BlockMatrix& plain = part.plain != nullptr ? *part.plain : A;
    assert(plain.num_blocks() == A.num_blocks());
    if (!saddle_.has_pattern_of(plain, part.terms)) {
      saddle_.take_pattern(plain, part.terms);
      precision_ = Precision::Unknown;
    }
    pool_->run(2, [&](int k, int) {
      if (k == 0)
        saddle_.take_values(plain, part.terms);
      else
        A_.take(A);
    });
    if (factorize(fits_single(part.terms)) != Pivots::Right)
      return FactorStatus::NotPositiveDefinite;
    pressure_.set(part.terms);
    memory_.resize(3 * Eigen::Index{A.num_blocks()});
    extended_.resize(saddle_.matrix().size());
    ready_ = true;
    return FactorStatus::Ready;
  }

  SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) override {
    assert(ready_);
    if (precision_ == Precision::Double) return iterate(max_iterations_, b, x);
    const SolveReport report = iterate(std::min(kMostInSingle, max_iterations_), b, x);
    const bool is_settled = report.converged || report.is_indefinite;
    if (is_settled || factorize_in_double() != Pivots::Right) return report;
    SolveReport again = iterate(max_iterations_, b, x);
    again.iterations += report.iterations;
    ++again.repairs;
    return again;
  }

 private:
  enum class Precision { Unknown, Single, Double };
  /// Far more than there are with an exact factor.
  static constexpr int kMostInSingle = 60;
  /// κ/μ up to which Newton's method takes no more iterations than with double precision: ν =
  /// 0.4995. With 5000 it does, see fem/RESULTS.md.
  static constexpr double kMostStiffness = 1000;

  static bool fits_single(std::span<const PressureTerm> terms) {
    return std::ranges::all_of(terms, [](const PressureTerm& term) {
      return term.pressure->stiffness_ratio() <= kMostStiffness;
    });
  }

  Pivots factorize(bool fits_single) {
    if (precision_ == Precision::Double) return double_.factorize(saddle_.matrix());
    if (!fits_single) return factorize_in_double();
    if (precision_ == Precision::Unknown) analyze(single_);
    precision_ = Precision::Single;
    const Pivots pivots = single_.factorize(saddle_.matrix());
    return pivots == Pivots::Unclear ? factorize_in_double() : pivots;
  }
  Pivots factorize_in_double() {
    analyze(double_);
    precision_ = Precision::Double;
    return double_.factorize(saddle_.matrix());
  }
  template <class Real>
  void analyze(SignedCholesky<Real>& factor) {
    factor.analyze(saddle_.matrix(), saddle_.signs(), saddle_.groups());
  }
  SolveReport iterate(int max_iterations, const Eigen::VectorXd& b, Eigen::VectorXd& x) {
    return preconditioned_iteration(
        [this](const Eigen::VectorXd& v, Eigen::VectorXd& y) {
          A_.multiply(v, y, *pool_);
          pressure_.add_product(v, y);
        },
        [this](const Eigen::VectorXd& r, Eigen::VectorXd& z) {
          // The upper left part of the inverse of the saddle matrix is that of the sum.
          extended_.head(r.size()) = r;
          extended_.tail(extended_.size() - r.size()).setZero();
          precision_ == Precision::Single ? single_.solve(extended_) : double_.solve(extended_);
          z = extended_.head(r.size());
        },
        tolerance_, max_iterations, b, x, memory_);
  }

  double tolerance_;
  int max_iterations_;
  std::shared_ptr<ThreadPool> pool_;
  bool ready_ = false;
  Precision precision_ = Precision::Unknown;  // of the factor that serves
  LowerBlocks A_;
  PressureOperator pressure_;
  SaddlePointMatrix saddle_;
  SignedCholesky<float> single_;
  SignedCholesky<double> double_;
  IterationMemory memory_;
  Eigen::VectorXd extended_;
};

}  // namespace

FactorStatus LinearSolver::prepare_with_pressure(const BlockMatrix&, const Positions&,
                                                 const PressurePart&) {
  throw std::logic_error("this linear solver has no way to add the terms of a nodal pressure");
}

std::unique_ptr<LinearSolver> make_saddle_point_solver(double tolerance, int max_iterations,
                                                       std::shared_ptr<ThreadPool> pool) {
  if (!(tolerance > 0) || max_iterations < 1) {
    std::ostringstream message;
    message << "saddle point solver: tolerance is " << tolerance << ", must be positive; at most "
            << max_iterations << " iterations, must be at least 1";
    throw std::invalid_argument(message.str());
  }
  return std::make_unique<SaddlePointSolver>(tolerance, max_iterations, std::move(pool));
}

}  // namespace articular::fem
