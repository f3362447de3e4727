#include "tests/benchmarks/extremes/spin.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "sim/build/build_model.hpp"
#include "sim/output/checkpoint.hpp"
#include "sim/output/fingerprint.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"

namespace articular::benchmarks {
namespace {

struct Spin {
  double energy = 0;                  // [J]
  Eigen::Vector3d momentum{0, 0, 0};  // [kg m²/s]
};

Spin spin_of(const sim::Model& model, const Eigen::VectorXd& y) {
  const Eigen::Vector4d q = y.segment<4>(model.layout.rigid_q(0));
  const Eigen::Matrix3d R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const Eigen::Vector3d omega = y.segment<3>(model.layout.velocities() + 3);
  const Eigen::Vector3d L = R * model.rigid_bodies[0].mass.inertia * R.transpose() * omega;
  return {0.5 * omega.dot(L), L};
}

}  // namespace

SpinDrift spin_drift(const Bench& bench, const std::string& name, double step, double time,
                     const std::string& integrator) {
  const std::string scene =
      fmt::format(
          "duration = \"{} s\"\n[integrator]\nstep = \"{} s\"\n{}"
          "[output]\ninterval = \"{} s\"\ncheckpoint_interval = \"{} s\"\n",
          digits(time + step), digits(step), integrator, digits(time), digits(time)) +
      box("bone", "rigid", {.size = {0.01, 0.02, 0.03}, .cells = {1, 1, 1}},
          density(1000) + "angular_velocity = \"60 50 60 rad/s\"\n");
  SpinDrift drift{.run = bench.run(name, scene, 600)};
  if (drift.run.exit_code != 0) return drift;
  const sim::Scenario scenario = sim::read_scenario(bench.folder() / (name + ".toml"));
  const sim::Model model = sim::build_model(scenario);
  const auto last =
      sim::read_checkpoint(drift.run.results / "checkpoint", sim::fingerprint(scenario, model), {});
  if (!last) throw std::runtime_error("the run left no checkpoint");
  const Spin start = spin_of(model, sim::initial_state(model)), end = spin_of(model, last->state.y);
  drift.energy = end.energy / start.energy - 1;
  drift.momentum = (end.momentum - start.momentum).norm() / start.momentum.norm();
  return drift;
}

}  // namespace articular::benchmarks
