// Each term of the energy ledger beside a closed form or an integral of its own. What the terms
// leave, numerical_loss(), proves nothing about them. Work of lines that are muscles:
// stepper_test.cpp; what friction takes from a sliding block and dampers in contact from a bouncing
// one: contact_friction_test.cpp; pseudo-time: equilibrium_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fem/material/any_material.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::ledger_test {

using Scheme = Integrator::Scheme;

/// ∫ f(t) dt from 0 to T by Simpson's rule, round-off for smooth f.
template <class Function>
double integral(double T, Function&& f) {
  constexpr int kParts = 2000;
  const double h = T / kParts;
  double sum = 0;
  for (int i = 0; i < kParts; ++i)
    sum += h / 6 * (f(i * h) + 4 * f((i + 0.5) * h) + f((i + 1) * h));
  return sum;
}

/// log2(error(h) / error(h/2)).
template <class Error>
double measured_order(const Error& error, double h) {
  return std::log2(error(h) / error(h / 2));
}

/// A body moved from rest to rest.
MotionLoad drive(const std::string& body, double duration, const Vec3& way,
                 const Vec3& turn = Vec3::Zero()) {
  MotionLoad load = shift(body, duration, way);
  load.motion.rotation = {Vec3::Zero(), turn};
  load.motion.interpolation = Motion::Interpolation::Smooth;
  return load;
}
double path(double s) { return s * s * (3 - 2 * s); }
double path_rate(double s) { return 6 * s * (1 - s); }

constexpr double kSide = 0.01, kVolume = kSide * kSide * kSide;  // of a block [m], [m³]
constexpr double kDuration = 0.02;                               // of its stretching [s]
constexpr double kStrain = 0.2;

double stretch(double t) { return 1 + kStrain * path(t / kDuration); }
double stretch_rate(double t) { return kStrain * path_rate(t / kDuration) / kDuration; }

/// A block whose nodes all lie on one of two walls, which are drawn apart: F = diag(1, 1, stretch).
Scenario drawn_block(double h, const TissueMaterial& material) {
  Scenario s = scene(h, Scheme::TrBdf2);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide)), stand("low"),
              stand("high")};
  s.bodies[0].material = material;
  s.attachments = {attach("block", "low", {-1, -1, -1}, {1, 1, 0}),
                   attach("block", "high", {-1, -1, 0}, {1, 1, 1})};
  s.loads = {drive("high", kDuration, {0, 0, kStrain * kSide})};
  return s;
}

TEST(Ledger, StartsWithKineticGravityAndLineEnergy) {
  Scenario s = scene(1e-3);
  s.bodies = {mass_body("mass", 2, {0, 0, 0.3}, {0.1, 0.2, 0.3}), stand("wall")};
  s.bodies[0].velocity = {1, -2, 0.5};
  s.bodies[0].angular_velocity = {3, 2, -1};
  Ligament band;
  band.name = "band";
  band.path = {anchor("wall", {0, 0, 1}), anchor("mass", {0, 0, 0.3})};
  band.stiffness = 50;
  band.slack_length = 0.6;
  s.ligaments = {band};
  s.loads = {gravity({0, 0, -10})};
  const Simulation run(s);
  const double kinetic = 0.5 * 2 * 5.25 + 0.5 * (0.1 * 9 + 0.2 * 4 + 0.3);
  EXPECT_NEAR(run.state.energy.start, kinetic + 2 * 10 * 0.3 + 0.5 * 50 * 0.01, 1e-12);
}

/// a' = (1 − a)/τ while fibres are drawn out: the work is ∫ ∂W/∂a a' dt, to second order in the
/// step. @param per_activation  ∂W/∂a at a stretch λ with held sides [J/m³]
void expect_work_of_fibres(TissueMaterial material,
                           const std::function<double(double stretch)>& per_activation) {
  const double tau = 5e-3, begin = 1e-9;
  material.fibres = Fibres{.along = Vec3::UnitZ()};
  const double expected = integral(kDuration, [&](double t) {
    return kVolume * per_activation(stretch(t)) * std::exp(-t / tau) / tau;
  });
  const auto error = [&](double h) {
    Scenario s = drawn_block(h, material);
    Muscle muscle;
    muscle.name = muscle.tissue = "block";
    muscle.activation_time = tau;
    muscle.excitation = {{0, begin}, {0, 1}};
    s.muscles = {muscle};
    Simulation run(s);
    run.advance(begin);
    run.advance(kDuration);
    return std::abs(run.state.energy.muscle_work - expected);
  };
  EXPECT_LT(error(2.5e-4), 1e-3 * expected);
  EXPECT_NEAR(measured_order(error, 1e-3), 2, 0.2);
}

TEST(Ledger, WorkOfFibresInTissueIsTheIntegralOverTheirActivation) {
  const fem::MuscleFibre::Constants constants;
  expect_work_of_fibres(
      material_of(fem::BlemkerMuscle<>(fem::MuscleFibre(constants), {})),
      [&](double s) { return constants.max_stress * fem::MuscleFibre::active_integral(s); });
}

// At once active fibres of a constant activation, which lengthen: what is lost is the integral of
// what they pull more for that.
TEST(Ledger, FibresLoseWhatTheirForceVelocityTakes) {
  const fem::MuscleFibre fibre({.max_velocity = 4});
  TissueMaterial material = material_of(fem::BlemkerMuscle<>(fibre, {}));
  material.fibres = Fibres{.along = Vec3::UnitZ()};
  const double expected = integral(kDuration, [&](double t) {
    const fem::MuscleFibre::Drag drag = fibre.drag(stretch(t), 0.5);
    const double factor = fem::force_velocity(drag.per_rate * stretch_rate(t)).value;
    return kVolume * drag.pull * (factor - 1) * stretch_rate(t);
  });
  const auto error = [&](double h) {
    Scenario s = drawn_block(h, material);
    Muscle muscle;
    muscle.name = muscle.tissue = "block";
    muscle.excitation = {{0}, {0.5}};
    s.muscles = {muscle};
    Simulation run(s);
    run.advance(kDuration);
    return std::abs(run.state.energy.tissue_loss - expected);
  };
  EXPECT_LT(error(2.5e-4), 1e-3 * expected);
  EXPECT_GT(measured_order(error, 1e-3), 1.8);
}

// At rest a muscle is drawn at its far end, from its optimal length on by 20 mm: its passive force
// rises to 1 N, and who draws gives the 10 mJ that it stores.
TEST(Ledger, DrawingAMuscleBeyondItsPathGivesWhatItStores) {
  const double length = 0.1, force = 40, duration = 0.02;
  Scenario s = scene(1e-3);
  s.bodies = {stand("low"), stand("high")};
  Muscle muscle;
  muscle.name = "muscle";
  muscle.path = {anchor("low", Vec3::Zero()), anchor("high", {0, 0, length})};
  muscle.beyond = {{0, duration}, {0, 0.02}};
  muscle.optimal_length = length;
  muscle.max_length_ratio = 1.4;
  muscle.passive_fraction = 0.05;
  muscle.max_force = force;
  muscle.excitation = {{0}, {0}};
  s.muscles = {muscle};
  Simulation run(s);
  run.advance(duration);
  EXPECT_NEAR(run.state.energy.muscle_work, 0.01, 1e-9);
  EXPECT_NEAR(run.stepper.now().lines[0].stored, 0.01, 1e-9);
}

// With all calcium there f = 1 − exp(−b (λ − λ0)): ∫ f dλ/λ is an exponential integral.
TEST(Ledger, WorkOfFibresWithAForceLengthIsTheIntegralOverTheirActivation) {
  const double T = 1e5, b = 4.75 * 1.85, zero = 1.58 / 1.85;
  const fem::ToeLinearFibre fibre({.c3 = 1e3, .c4 = 10, .c5 = 1e5, .toe_end = 1.3});
  const fem::ActiveFibre active({.stress = T, .force_length = fem::ForceLength({})});
  expect_work_of_fibres(
      material_of(fem::TransverselyIsotropic<>(1e4, 0, fibre, 1e6, active)), [&](double s) {
        return T * (std::log(s / zero) -
                    std::exp(b * zero) * (std::expint(-b * s) - std::expint(-b * zero)));
      });
}

// A force that rises as F t/T moves a mass by F t³/(6 T m), and does the work F² T²/(8 m) until T.
TEST(Ledger, WorkOfARisingLoadIsWhatItGivesAMass) {
  const double F = 3, T = 0.1, m = 2, expected = F * F * T * T / (8 * m);
  const auto error = [&](double h) {
    Scenario s = scene(h, Scheme::TrBdf2);
    s.bodies = {mass_body("mass", m)};
    ForceLoad load;
    load.at = anchor("mass", Vec3::Zero());
    load.force = {0, 0, F};
    load.profile = {{0, T}, {0, 1}};
    s.loads = {load};
    Simulation run(s);
    run.advance(T);
    return std::abs(run.state.energy.load_work - expected);
  };
  EXPECT_LT(error(1e-3), 1e-3 * expected);
  EXPECT_NEAR(measured_order(error, 4e-3), 2, 0.2);
}

// Drawn out from its slack length at v the tension is k v t and that of the damper c v, at most as
// large. It takes k v² t₁²/2 + c v² (t − t₁) with t₁ = c/k, and who draws gives that and ½ k (v
// t)².
TEST(Ledger, ALigamentsDamperTakesItsForceTimesTheWayAndTheDriveGivesIt) {
  const double k = 100, c = 1, v = 0.1, t = 0.04;
  Scenario s = scene(1e-3);
  s.bodies = {stand("wall"), stand("hand")};
  Ligament band;
  band.name = "band";
  band.path = {anchor("wall", Vec3::Zero()), anchor("hand", {0, 0, 0.03})};
  band.stiffness = k;
  band.damping = c;
  s.ligaments = {band};
  s.loads = {shift("hand", 2 * t, {0, 0, 2 * v * t})};
  Simulation run(s);
  run.advance(t);
  const double loss = v * v * (c * c / (2 * k) + c * (t - c / k));
  EXPECT_NEAR(run.state.energy.ligament_loss, loss, 1e-9 * loss);
  const double work = loss + 0.5 * k * v * v * t * t;
  EXPECT_NEAR(run.state.energy.motion_work, work, 1e-9 * work);
}

// A body that is shifted and turned against a spring gives what the spring stores.
TEST(Ledger, WorkOfAShiftWithATurnIsWhatASpringStores) {
  const Vec3 turn(0, 0, 1.2), way(0.02, -0.01, 0.03), rim(0.1, 0, 0), wall(0.3, 0.1, 0);
  const double stiffness = 80, slack = 0.1;
  const double before = (wall - rim).norm() - slack;
  const double after = (wall - rotation_matrix(turn) * rim - way).norm() - slack;
  const double expected = 0.5 * stiffness * (after * after - before * before);
  const auto error = [&](double h) {
    Scenario s = scene(h);
    s.bodies = {stand("wall"), stand("wheel")};
    Ligament spring;
    spring.name = "spring";
    spring.path = {anchor("wall", wall), anchor("wheel", rim)};
    spring.stiffness = stiffness;
    spring.slack_length = slack;
    s.ligaments = {spring};
    s.loads = {drive("wheel", 1, way, turn)};
    Simulation run(s);
    run.advance(1);
    return std::abs(run.state.energy.motion_work - expected);
  };
  EXPECT_LT(error(0.01), 1e-3 * expected);
  EXPECT_NEAR(measured_order(error, 0.05), 2, 0.2);
}

// Of viscosities η = β μ and ζ = β κ the block loses (4η/3 + ζ) λ² λ̇² by volume.
TEST(Ledger, WhatDashpotsTakeFromADrawnBlockIsTheIntegralOfItsPower) {
  const double beta = 0.01, E = 20e3, nu = 0.3;
  TissueMaterial material = linear(E, nu);
  material.stiffness_damping = beta;
  const double eta = beta * E / (2 * (1 + nu)), zeta = beta * E / (3 * (1 - 2 * nu));
  const double expected = integral(kDuration, [&](double t) {
    const double rate = stretch(t) * stretch_rate(t);
    return kVolume * (4 * eta / 3 + zeta) * rate * rate;
  });
  const auto error = [&](double h) {
    Simulation run(drawn_block(h, material));
    run.advance(kDuration);
    return std::abs(run.state.energy.tissue_loss - expected);
  };
  EXPECT_LT(error(5e-4), 1e-4 * expected);
}

// What has relaxed pushes where the block is drawn out: −g V λ L λ̇, with L' = (S − L)/τ and S =
// P/λ, P = 4μ/3 (λ − 1) of the law's distortion.
TEST(Ledger, WhatRelaxesGivesTheIntegralOfItsPower) {
  const double g = 0.6, tau = 5e-3, mu = 20e3 / 2.6;
  TissueMaterial material = linear(20e3, 0.3);
  material.relaxation = {{.weight = g, .time = tau}};
  constexpr int kParts = 20000;
  double L = 0, expected = 0;
  for (int i = 0; i < kParts; ++i) {  // the midpoint rule
    const double h = kDuration / kParts, t = (i + 0.5) * h;
    const double S = 4 * mu / 3 * (stretch(t) - 1) / stretch(t);
    const double L_next = (L * (1 - 0.5 * h / tau) + S * h / tau) / (1 + 0.5 * h / tau);
    expected -= h * g * kVolume * stretch(t) * 0.5 * (L + L_next) * stretch_rate(t);
    L = L_next;
  }
  EXPECT_LT(expected, 0);
  const auto error = [&](double h) {
    Simulation run(drawn_block(h, material));
    run.advance(kDuration);
    return std::abs(run.state.energy.tissue_loss - expected);
  };
  EXPECT_LT(error(2.5e-4), -1e-3 * expected);
  EXPECT_NEAR(measured_order(error, 1e-3), 2, 0.3);
}

constexpr double kStiffness = 1e7;  // of a contact [Pa/m]
constexpr double kDepth = 2e-5;     // [m]

/// A driven box that lies in a table this deep.
Scenario driven_box(double h, const Vec3& way) {
  Scenario s = contact_scene(h);
  s.bodies = {
      box_body("table", Body::Kind::Fixed, {8 * kSide, 8 * kSide, 2 * kSide}, {0, 0, -kSide}),
      box_body("box", Body::Kind::Fixed, {2 * kSide, 2 * kSide, 2 * kSide},
               {0, 0, kSide - kDepth})};
  s.contacts = {{"box", "table", {}}};
  s.loads = {drive("box", kDuration, way)};
  return s;
}

// With the pressure k d everywhere, friction takes μ k d A V²/√(V² + v_s²).
TEST(Ledger, WhatFrictionTakesIsTheIntegralOfItsPower) {
  const double friction = 0.3, slip = 5e-3, way = 2e-3, area = 4 * kSide * kSide;
  const double expected = integral(kDuration, [&](double t) {
    const double V = way * path_rate(t / kDuration) / kDuration;
    return friction * kStiffness * kDepth * area * V * V / std::hypot(V, slip);
  });
  Scenario s = driven_box(2.5e-4, {way, 0, 0});
  s.contacts[0].friction = friction;
  s.contacts[0].slip_velocity = slip;
  Simulation run(s, contact_stiffness_of(kStiffness));
  run.advance(kDuration);
  EXPECT_NEAR(run.state.energy.contact_loss, expected, 1e-3 * expected);
  run.advance(2 * kDuration);
  EXPECT_NEAR(run.state.energy.contact_loss, expected, 1e-3 * expected);
}

// Where the box sinks deeper dampers take c A ḋ². Halfway there, a sum of rectangles misses 2 %.
TEST(Ledger, WhatDampersInContactTakeIsTheIntegralOfTheirPower) {
  const double damping = 2e3, way = 2e-5, area = 4 * kSide * kSide;
  const double expected = integral(0.5 * kDuration, [&](double t) {
    const double rate = way * path_rate(t / kDuration) / kDuration;
    return damping * area * rate * rate;
  });
  Scenario s = driven_box(2.5e-4, {0, 0, -way});
  s.contacts[0].damping = damping;
  Simulation run(s, contact_stiffness_of(kStiffness));
  run.advance(0.5 * kDuration);
  EXPECT_NEAR(run.state.energy.contact_loss, expected, 2e-3 * expected);
}

// On the way that it goes on alone nothing presses on it. What contact stores is all that may be
// missed: a trapezoid of the whole step is off by seven times that.
TEST(Ledger, ADriveThatPartsFromWhatItPressesDoesNoMoreWork) {
  const double way = 1e-5, time = 0.01, area = 4 * kSide * kSide;
  Scenario s = driven_box(1e-3, Vec3::Zero());
  Motion& motion = std::get<MotionLoad>(s.loads.back()).motion;
  motion.time = {0, time, time + 1e-3};
  motion.translation = {Vec3::Zero(), {0, 0, -way}, {0, 0, 20 * way}};
  motion.rotation = {};
  motion.interpolation = Motion::Interpolation::Linear;
  Simulation run(s, contact_stiffness_of(kStiffness));
  const auto stored = [&](double depth) { return 0.5 * kStiffness * depth * depth * area; };
  run.advance(time);
  const double pressed = stored(kDepth + way) - stored(kDepth);
  EXPECT_NEAR(run.state.energy.motion_work, pressed, 1e-6 * pressed);
  run.advance(time + 2e-3);
  EXPECT_NEAR(run.state.energy.motion_work, pressed, stored(kDepth + way));
}

}  // namespace articular::sim::ledger_test
