#include "tests/fem/support/newton.hpp"

#include <array>
#include <cmath>
#include <ctime>
#include <vector>

namespace articular::fem {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The linear systems of one formulation on one body.
class System {
 public:
  System(const Formulation& formulation, const LoadedBody& body, LinearSolver& solver)
      : formulation_(formulation), body_(body), solver_(solver), K_(formulation.make_matrix()) {
    if (formulation.smoothed == nullptr) return;
    plain_ = formulation.smoothed->make_plain_matrix();
    G_ = formulation.smoothed->make_pressure_gradient();
  }

  void assemble(const Positions& x, const Eigen::VectorXd& p, Tangent tangent, Tangent of_plain) {
    K_.set_zero();
    formulation_.add_stiffness(x, p, tangent, K_);
    if (formulation_.smoothed != nullptr) {
      plain_.set_zero();
      formulation_.smoothed->add_plain_stiffness(x, of_plain, 1, plain_);
      formulation_.smoothed->set_pressure_gradient(x, G_);
      fix_components(body_.fixed, G_);
      fix_components(body_.fixed, diagonal(), plain_);
    }
    fix_components(body_.fixed, diagonal(), K_);
  }

  bool solve(const Positions& r, Positions& dx, int& iterations) {
    const PressureTerm term{.G = &G_,
                            .pressure = formulation_.smoothed == nullptr
                                            ? nullptr
                                            : &formulation_.smoothed->nodal_pressure()};
    const FactorStatus status =
        formulation_.smoothed == nullptr
            ? solver_.prepare(K_)
            : solver_.prepare_with_pressure(K_, {.terms = {&term, 1}, .plain = &plain_});
    if (status != FactorStatus::Ready) return false;
    Eigen::VectorXd solution = Eigen::VectorXd::Zero(r.size());
    const SolveReport report = solver_.solve(r.reshaped(), solution);
    iterations += report.iterations;
    dx = solution.reshaped(3, r.cols());
    return report.converged && dx.cwiseProduct(r).sum() > 0;
  }

  /// dxᵀ K dx, without the pressure's part.
  double curvature(const Positions& dx) const {
    Eigen::VectorXd y;
    K_.multiply(dx.reshaped(), y);
    return y.dot(dx.reshaped());
  }

  const PressureGradient& G() const { return G_; }

 private:
  /// Of the order of the other entries.
  double diagonal() const {
    double sum = 0;
    for (int i = 0; i < K_.num_blocks(); ++i) sum += K_.block(K_.slot(i, i)).trace();
    return sum / (3 * K_.num_blocks());
  }

  const Formulation& formulation_;
  const LoadedBody& body_;
  LinearSolver& solver_;
  BlockMatrix K_, plain_;
  PressureGradient G_;
};

}  // namespace

Formulation formulation_of(const SmoothedElasticity& elasticity) {
  return {.energy = [&](const Positions& x,
                        const Eigen::VectorXd& p) { return elasticity.energy(x, p); },
          .add_internal_force = [&](const Positions& x,
                                    Positions& f) { elasticity.add_internal_force(x, f); },
          .make_matrix = [&] { return elasticity.make_matrix(); },
          .add_stiffness = [&](const Positions& x, const Eigen::VectorXd& p, Tangent tangent,
                               BlockMatrix& K) { elasticity.add_stiffness(x, p, tangent, 1, K); },
          .smoothed = &elasticity};
}

NewtonReport equilibrate(const Formulation& formulation, const LoadedBody& body,
                         LinearSolver& solver, Positions& x, const NewtonSettings& settings) {
  NewtonReport report;
  System system(formulation, body, solver);
  Eigen::VectorXd p, p_next;
  if (formulation.smoothed != nullptr) formulation.smoothed->pressure(x, p);
  Positions dx;
  for (;; ++report.iterations) {
    Positions r = Positions::Zero(3, x.cols());
    formulation.add_internal_force(x, r);
    r = body.fixed.select(0.0, body.f_ext - r);
    report.converged = r.norm() <= settings.tolerance * body.f_ext.norm();
    if (report.converged || report.iterations == settings.max_iterations || !r.allFinite()) break;

    bool solved = false;
    // To project is dear: the preconditioner's matrix first, and only then the other as well.
    constexpr std::array<std::array<Tangent, 2>, 3> kTangents{
        {{Tangent::Consistent, Tangent::Consistent},
         {Tangent::Consistent, Tangent::Projected},
         {Tangent::Projected, Tangent::Projected}}};
    for (const auto& [tangent, of_plain] : kTangents) {
      double start = cpu_seconds();
      system.assemble(x, p, tangent, of_plain);
      report.assembly += cpu_seconds() - start;
      start = cpu_seconds();
      solved = system.solve(r, dx, report.linear_iterations);
      report.solution += cpu_seconds() - start;
      if (solved) break;
      ++report.projections;
    }
    if (!solved) break;

    p_next = p;
    if (formulation.smoothed != nullptr && settings.pressure_unknown) {
      formulation.smoothed->predicted_pressure(x, system.G(), dx, p_next);
    }
    // With p an unknown, the merit is that of x at the next p; its slope is −dxᵀK dx. Without,
    // it is the energy W.
    const bool mixed = settings.pressure_unknown && formulation.smoothed != nullptr;
    const auto merit = [&](const Positions& at) {
      const double W = mixed || formulation.smoothed == nullptr ? formulation.energy(at, p_next)
                                                                : formulation.smoothed->energy(at);
      return W - body.f_ext.cwiseProduct(at - body.mesh.X).sum();
    };
    const double slope = mixed ? -system.curvature(dx) : -dx.cwiseProduct(r).sum();
    const double before = merit(x), round_off = 1e-11 * (std::abs(slope) + std::abs(before));
    double step = 1;
    while (step > 1e-4 && slope < 0 &&
           !(merit(x + step * dx) <= before + 1e-4 * step * slope + round_off)) {
      step /= 2;
      ++report.cut_steps;
    }
    x += step * dx;
    if (mixed) {
      p += step * (p_next - p);
    } else if (formulation.smoothed != nullptr) {
      formulation.smoothed->pressure(x, p);
    }
  }
  return report;
}

}  // namespace articular::fem
