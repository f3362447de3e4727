#include "fem/solver/mixed_system.hpp"

#include <cassert>

namespace articular::fem {

bool MixedSystem::set(const BlockMatrix& A, std::span<const PressureTerm> terms, ThreadPool& pool) {
  if (!A_.has_pattern_of(A)) A_.take_pattern(A);
  terms_.assign(terms.begin(), terms.end());
  begin_.assign(1, 0);
  for (const PressureTerm& term : terms) {
    assert(term.G->num_nodes() == A.num_blocks());
    begin_.push_back(begin_.back() + term.G->num_pressures());
  }
  condensed_.set(terms);
  return A_.take_values(A, pool);
}

void MixedSystem::changes_of_volume(const Eigen::VectorXd& x, Eigen::VectorXd& q) const {
  q.resize(num_pressures());
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    terms_[t].G->multiply_transposed(x, q_);
    q.segment(begin_[t], q_.size()) = q_;
  }
}

void MixedSystem::forces(const Eigen::VectorXd& x, const Eigen::VectorXd& p, Eigen::VectorXd& r,
                         ThreadPool& pool) const {
  r.resize(x.size());
  pool.run_pieces(num_blocks(), kRowsOfSums, [&](int begin, int end, int) {
    A_.multiply_rows(begin, end, x.data(), r.data());
  });
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    p_ = p.segment(begin_[t], begin_[t + 1] - begin_[t]);
    terms_[t].G->add_product(p_, 1, r);
  }
}

void MixedSystem::subtract_compliance(const Eigen::VectorXd& p, Eigen::VectorXd& q) const {
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    const Eigen::Index size = begin_[t + 1] - begin_[t];
    p_ = p.segment(begin_[t], size);
    terms_[t].pressure->compliance().multiply(p_, q_);
    q.segment(begin_[t], size) -= q_ / terms_[t].scale;
  }
}

double MixedSystem::condensed_residual(const Eigen::VectorXd& b, const Eigen::VectorXd& x,
                                       Eigen::VectorXd& r, ThreadPool& pool) {
  r.resize(x.size());
  pool.run_pieces(num_blocks(), kRowsOfSums, [&](int begin, int end, int) {
    A_.multiply_rows(begin, end, x.data(), r.data());
  });
  condensed_.add_product(x, r);
  r = b - r;
  return r.norm();
}

}  // namespace articular::fem
