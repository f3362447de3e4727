#pragma once

#include <algorithm>
#include <cmath>

#include "sim/assembly/energies.hpp"
#include "sim/time/runge_kutta.hpp"
#include "tests/sim/support/scene.hpp"

/// Whether steps of a fixed length make energy, by taking them.
namespace articular::sim {

/// A nudge to all free nodes, so small that everything stays linear: each frequency has some of it.
inline Eigen::VectorXd nudged(const Model& model, double speed) {
  Eigen::VectorXd y = initial_state(model);
  Random random(3);
  const Layout& layout = model.layout;
  y.segment(layout.velocities(), 3 * layout.num_free_nodes) +=
      speed * random.vector(3 * layout.num_free_nodes);
  return y;
}

/// Takes steps of length h [s] and compares the energy [J] of motion and strain after all of them
/// with that after half: at the limit of stability what is fastest neither fades nor grows. And
/// with that at the start: what has grown until it is no longer linear may go to and fro there.
inline bool steps_grow(const Model& model, Dynamics& dynamics, TimeIntegrator& integrator, double h,
                       int steps) {
  const double speed = 1e-4 * model.trusted_motion / h;
  Eigen::VectorXd y = nudged(model, speed);
  const auto energy = [&](double t) {
    dynamics.evaluate(y.data(), t);
    return kinetic_energy(dynamics.now()) + elastic_energy(dynamics.now());
  };
  const double start = energy(0);
  double half = 0;
  for (int k = 0; k < steps; ++k) {
    if (!integrator.advance(y, k * h, h)) return true;
    if (k + 1 == steps / 2) half = energy((k + 1) * h);
  }
  return !(energy(steps * h) <= std::min(start, half));
}

inline bool explicit_steps_grow(const Model& model, double h, int steps) {
  Dynamics dynamics(model);
  const auto integrator = make_explicit_runge_kutta(model, dynamics, {}, ExplicitSteps::Fixed);
  return steps_grow(model, dynamics, *integrator, h, steps);
}

}  // namespace articular::sim
