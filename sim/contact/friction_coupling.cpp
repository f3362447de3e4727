#include "sim/contact/friction_coupling.hpp"

#include "fem/solver/flexible_gmres.hpp"

namespace articular::sim {
namespace {

/// Of the pressures: Newton's iteration corrects the rest.
constexpr double kCouplingTolerance = 1e-3;
constexpr int kMostGmresIterations = 30;

}  // namespace

void FrictionCoupling::clear() {
  entries_.clear();
  begin_.assign(1, 0);
}

void FrictionCoupling::add_group(const std::vector<Entry>& entries) {
  entries_.insert(entries_.end(), entries.begin(), entries.end());
  begin_.push_back(static_cast<int>(entries_.size()));
}

Eigen::VectorXd FrictionCoupling::pressures(const Eigen::VectorXd& w) const {
  Eigen::VectorXd p = Eigen::VectorXd::Zero(num_groups());
  for (std::size_t a = 0; a + 1 < begin_.size(); ++a)
    for (int e = begin_[a]; e < begin_[a + 1]; ++e) {
      const Entry& entry = entries_[static_cast<std::size_t>(e)];
      p[static_cast<Eigen::Index>(a)] += entry.pressure.dot(w.segment<3>(3 * entry.block));
    }
  return p;
}

void FrictionCoupling::add_drag(const Eigen::VectorXd& p, double scale, Eigen::VectorXd& f) const {
  for (std::size_t a = 0; a + 1 < begin_.size(); ++a)
    for (int e = begin_[a]; e < begin_[a + 1]; ++e) {
      const Entry& entry = entries_[static_cast<std::size_t>(e)];
      f.segment<3>(3 * entry.block) += scale * p[static_cast<Eigen::Index>(a)] * entry.drag;
    }
}

bool solve_with_friction(const FrictionCoupling& coupling, const SymmetricSolve& solve,
                         const Eigen::VectorXd& b, Eigen::VectorXd& w) {
  Eigen::VectorXd p = coupling.pressures(w);
  double residual = p.norm();
  if (!(residual > 0)) return true;
  const double goal = kCouplingTolerance * residual;
  fem::FlexibleGmres gmres;
  gmres.start(p, kMostGmresIterations);
  Eigen::VectorXd r, part;
  while (residual > goal && !gmres.is_full() && !gmres.is_exhausted()) {
    const Eigen::VectorXf direction = gmres.next().cast<float>();
    const Eigen::VectorXd rounded = direction.cast<double>();
    r.setZero(b.size());
    coupling.add_drag(rounded, 1, r);
    if (!solve(r, part)) return false;
    Eigen::VectorXd image = rounded + coupling.pressures(part);
    residual = gmres.add(direction, image);
  }
  p.setZero();
  gmres.add_best_to(p);
  r = b;
  coupling.add_drag(p, -1, r);
  return solve(r, w);
}

}  // namespace articular::sim
