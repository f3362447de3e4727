#include "tools/verify/motions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sim/model/configuration.hpp"
#include "tools/verify/scene.hpp"

namespace articular::tools {
namespace {

constexpr double kGravity = 9.81;  // [m/s²]

// --- periods

/// scenarios/verification/pendulum.toml: T = 4 √(I/(m g d)) K(sin(θ0/2)), θ0 = 60°. [Landau,
/// Lifshitz, Mechanics, § 11]. With 200 steps of third order a period its error is 1e-5.
std::vector<Finding> pendulum(const Laboratory& laboratory) {
  constexpr double kSteps = 1e-4;
  constexpr double length = 0.2, width = 0.01, d = length / 2, amplitude = std::numbers::pi / 3;
  const double inertia_by_mass = (length * length + width * width) / 12 + d * d;  // [m²]
  const double period = 4 * std::sqrt(inertia_by_mass / (kGravity * d)) *
                        std::comp_ellint_1(std::sin(amplitude / 2));  // [s]
  const Curves curves = run_scene(laboratory, shipped_scene("pendulum", {}));
  // Down to -120 degrees and up again: it hangs at -60.
  const std::vector<double>& angle = curves("swing.angle [deg]");
  const double lowest = *std::min_element(angle.begin(), angle.end());
  const std::vector<double> up = curves.upward_crossings("swing.angle [deg]", -60);
  if (up.empty()) throw std::runtime_error("the pendulum does not swing back");
  return {relative("period at 60 degrees", "ms", 1e3 * period, 1e3 * up.front() * 4 / 3, kSteps),
          relative("amplitude on the other side", "deg", -120, lowest, 1e-3)};
}

/// scenarios/verification/hanging_beam.toml, undamped: gravity that is there at once sets the bar
/// swinging about ρ g L²/2E = 2.4525 mm, from 0 to twice that, with the period 4 L/c, c = √(E/ρ).
/// Between L/c and 3 L/c its end is on the parabola of [Timoshenko 1955, Vibration problems in
/// engineering, art. 49], and passes the middle at these two times. 20 elements along and 180
/// steps a period leave some 0.1 % (4e-4 of the chain of elements, the rest of the steps).
std::vector<Finding> bar(const Laboratory& laboratory) {
  constexpr double kDiscretisation = 0.005;
  constexpr double L = 0.1, E = 20e3, density = 1000;
  const double half_period = 2 * L / std::sqrt(E / density);  // [s]
  const Curves curves = run_scene(
      laboratory,
      shipped_scene("hanging_beam", {"integrator.scheme=dirk-3", "integrator.step=0.5 ms",
                                     "duration=0.1 s", "body.beam.material.element=plain"}));
  const std::string column = "end.position.z [mm]";
  const double middle = 1e3 * density * kGravity * L * L / (2 * E);  // [mm]
  const std::vector<double> up = curves.upward_crossings(column, -1e3 * L - middle);
  const std::vector<double>& z = curves(column);
  const double lowest = *std::min_element(z.begin(), z.end());
  if (up.empty()) throw std::runtime_error("the bar does not swing back");
  // From the start to the second passage: three quarters of the period.
  return {relative("period of a bar", "ms", 2e3 * half_period, 1e3 * up.front() / 0.75,
                   kDiscretisation),
          relative("greatest way of its end", "mm", 2 * middle, -1e3 * L - lowest,
                   2 * kDiscretisation)};
}

// --- momentum

struct Momentum {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  // [kg m/s], [kg m²/s] about the origin
};

Momentum momentum(const sim::Model& model, const Eigen::VectorXd& y, double t) {
  sim::Configuration now;
  sim::read_state(model, y.data(), t, now);
  Momentum sum;
  const auto add = [&](const Vec3& x, const Vec3& p) {
    sum.linear += p;
    sum.angular += x.cross(p);
  };
  for (const sim::Tissue& tissue : model.tissues)
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      add(now.position(tissue.nodes[i]),
          tissue.lumped_mass[static_cast<Eigen::Index>(i)] * now.velocity(tissue.nodes[i]));
  for (int r = 0; r < model.layout.num_rigid; ++r) {
    const auto i = static_cast<std::size_t>(r);
    add(now.poses[i].p, model.rigid_bodies[i].mass.mass * now.velocities[i].linear);
    sum.angular += sim::world_inertia(model, now, r) * now.velocities[i].angular;
  }
  return sum;
}

/// What a scene of free bodies has of momentum at its start and at its end.
struct FreeFlight {
  Momentum before, after;
  Curves curves;
};

FreeFlight fly(const Laboratory& laboratory, const Scene& scene) {
  Momentum before, after;
  const Curves curves =
      run_scene(laboratory, scene, [&](const sim::Model& model, const sim::State& state) {
        before = momentum(model, sim::initial_state(model), 0);
        after = momentum(model, state.y, state.t);
        return false;
      });
  return {before, after, curves};
}

/// scenarios/verification/collision.toml. Forces that are equal and opposite leave the momentum to
/// the tolerance of Newton's iteration. Angular momentum drifts with the order of the scheme: steps
/// of 0.25 ms.
std::vector<Finding> collision(const Laboratory& laboratory) {
  constexpr double kIteration = 1e-6, kSteps = 2e-3;
  const FreeFlight flight = fly(laboratory, shipped_scene("collision", {}));
  const double linear = flight.before.linear.norm(), arm = 0.02;  // [m] side of the blocks
  return {relative("momentum, x", "kg m/s", 8e-3 * 0.5, flight.after.linear.x(), kIteration),
          vanishing("momentum, across", "kg m/s", flight.after.linear.tail<2>().norm(), linear,
                    kIteration),
          vanishing("change of angular momentum", "kg m^2/s",
                    (flight.after.angular - flight.before.angular).norm(), linear * arm, kSteps)};
}

/// scenarios/verification/tumbling_body.toml: a body of three different moments of inertia, on
/// which nothing acts. dirk-3 with 314 steps a turn: the energy drifts by 3e-7, by eight times that
/// with half as many. What Newton's iteration leaves must not count in it.
std::vector<Finding> tumbling(const Laboratory& laboratory) {
  constexpr double kSteps = 5e-6;
  const FreeFlight flight =
      fly(laboratory,
          shipped_scene("tumbling_body", {"integrator.scheme=dirk-3", "integrator.step=1 ms",
                                          "integrator.position_tolerance=0.00001 um"}));
  const double size = flight.before.angular.norm();
  const std::vector<double>& kinetic = flight.curves("energy.kinetic [J]");
  return {relative("angular momentum, y", "kg m^2/s", flight.before.angular.y(),
                   flight.after.angular.y(), kSteps),
          vanishing("its change", "kg m^2/s", (flight.after.angular - flight.before.angular).norm(),
                    size, kSteps),
          relative("energy", "J", kinetic.front(), kinetic.back(), kSteps)};
}

}  // namespace

std::vector<Problem> motion_problems() {
  return {{"period/pendulum", true, pendulum},
          {"period/bar", true, bar},
          {"momentum/collision", false, collision},
          {"momentum/tumbling-body", true, tumbling}};
}

}  // namespace articular::tools
