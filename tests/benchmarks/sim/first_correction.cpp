#include "tests/benchmarks/sim/first_correction.hpp"

#include <stdexcept>

#include "sim/assembly/solver_setup.hpp"
#include "sim/model/displace.hpp"
#include "sim/model/held_blocks.hpp"
#include "tests/benchmarks/support/timing.hpp"

namespace articular::sim {
namespace {

template <class Work>
double cpu_seconds_of(Work&& work) {
  const double start = benchmarks::cpu_seconds();
  work();
  return benchmarks::cpu_seconds() - start;
}

}  // namespace

/// The state that the correction begins at.
Eigen::VectorXd FirstCorrection::place_to_start(const State& state, double step) const {
  Eigen::VectorXd y = state.y;
  const Layout& layout = model_.layout;
  if (model_.is_static)
    for (std::size_t m = 0; m < model_.muscles.size(); ++m)
      y[layout.activations() + static_cast<Eigen::Index>(m)] =
          steady_activation(model_.muscles[m], state.t + step);
  else
    displace(model_, step * y.segment(layout.velocities(), 3 * layout.num_unknown_blocks()), y);
  return y;
}

FirstCorrection::FirstCorrection(const Model& model, const StepSettings& settings,
                                 const State& state)
    : model_(model), dynamics_(model) {
  const double step = settings.step, t = state.t + step;
  const Eigen::VectorXd y = place_to_start(state, step);
  dynamics_.set_wraps(state.wraps);
  if (!model.contacts.empty()) {
    Configuration where;
    read_state(model, y.data(), t, where);
    search_.emplace(model, settings);
    times_.search = cpu_seconds_of([&] { search_->find(where, state.next_margin); });
    dynamics_.set_candidates(search_->candidates());
  }
  times_.evaluation =
      cpu_seconds_of([&] { dynamics_.evaluate(y.data(), t, {.step_start = state.t}); });

  const SystemScale scale =
      model.is_static ? SystemScale{0, 0, 1} : SystemScale{1, step, step * step, step};
  right_side_ = dynamics_.now().forces.head(Eigen::Index{3} * model.layout.num_unknown_blocks());
  if (!model.is_static) right_side_ *= step;
  keep_free_part(model, right_side_);

  const auto assemble = [&](fem::Tangent tangent) {
    dynamics_.contact();  // or it would take what it has
    return cpu_seconds_of([&] { dynamics_.assemble(scale, tangent); });
  };
  times_.first_assembly = assemble(fem::Tangent::Consistent);
  for (const fem::Tangent tangent : {fem::Tangent::Consistent, fem::Tangent::Projected}) {
    times_.assembly = assemble(tangent);
    const auto solver = make_linear_solver(model);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(right_side_.size());
    if (prepare_linear(*solver, equations(), nodes()) && solver->solve(right_side_, x).converged)
      return;
  }
  throw std::runtime_error("no tangent gives a matrix that is positive definite");
}

Eigen::MatrixXd FirstCorrection::rigid_motions() const {
  const Configuration& now = dynamics_.now().configuration;
  const Vec3 middle = now.x.cols() > 0 ? Vec3(now.x.rowwise().mean()) : Vec3(Vec3::Zero());
  Eigen::MatrixXd motions =
      Eigen::MatrixXd::Zero(Eigen::Index{3} * model_.layout.num_unknown_blocks(), 6);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 e = Vec3::Unit(axis);
    const auto move = [&](int block, const Vec3& at) {
      motions.col(axis).segment<3>(Eigen::Index{3} * block) = e;
      motions.col(3 + axis).segment<3>(Eigen::Index{3} * block) = e.cross(at - middle);
    };
    for (int block = 0; block < model_.layout.num_free_nodes; ++block)
      move(block, now.x.col(block));
    for (int r = 0; r < model_.layout.num_rigid; ++r) {
      const auto rigid = static_cast<std::size_t>(r);
      const int block = model_.rigid_bodies[rigid].block;
      move(block, now.poses[rigid].p);
      motions.col(3 + axis).segment<3>(Eigen::Index{3} * (block + 1)) = e;
    }
  }
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    Eigen::VectorXd motion = motions.col(k);
    keep_free_part(model_, motion);
    motions.col(k) = motion;
  }
  return motions;
}

}  // namespace articular::sim
