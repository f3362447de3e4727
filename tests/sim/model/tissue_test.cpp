// Tissue of any element and law in a scene: what it carries, how it is damped, how its fibres pull.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>

#include "fem/material/any_material.hpp"
#include "fem/material/point_law.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::tissue_test {

TissueMaterial smoothed(const fem::AnyMaterial& law) {
  TissueMaterial material = material_of(law);
  material.element = TissueMaterial::Element::Smoothed;
  return material;
}

/// A slender bar tied at z = 0, E = 15 kPa.
Scenario bar(const TissueMaterial& material, const Eigen::Vector3i& cells) {
  Scenario s = scene(1);
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.01, 0.01, 0.06}, {0, 0, 0.03}, cells),
              stand("wall")};
  s.bodies[0].material = material;
  s.attachments = {attach("bar", "wall", {-1, -1, -1e-6}, {1, 1, 1e-6})};
  return s;
}

/// Mean sideways displacement of the free end [m].
double end_shift(const Simulation& run) {
  const Tissue& tissue = run.model.tissues[0];
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (tissue.X(2, column) < 0.06 - 1e-9) continue;
    sum += run.now().position(tissue.nodes[i]).x() - tissue.X(0, column);
    ++count;
  }
  return sum / count;
}

// Euler–Bernoulli: u = q L⁴/(8 E I), q = ρ A g; shear adds a few per cent. Plain elements lock in
// bending, and more so near ν = 0.5; smoothed ones do neither.
TEST(Tissue, SmoothedElementsBendAsABeamDoesAtAnyPoissonRatio) {
  const double g = 0.05, L = 0.06, b = 0.01;
  const double expected = 1000 * b * b * g * std::pow(L, 4) / (8 * 15e3 * std::pow(b, 4) / 12);
  for (const double nu : {0.3, 0.499}) {
    const auto deflection = [&](const TissueMaterial& material) {
      Scenario s = bar(material, {4, 4, 24});
      s.analysis = Scenario::Analysis::Static;
      s.loads = {gravity({g, 0, 0})};
      Simulation run(s);
      run.advance(1);
      EXPECT_NEAR(run.force_on(0).x(), 1000 * b * b * L * g, 1e-5 * 1000 * b * b * L * g);
      return end_shift(run);
    };
    const auto law = fem::MooneyRivlin<>(15e3 / (4 * (1 + nu)), 0, 15e3 / (3 * (1 - 2 * nu)));
    EXPECT_NEAR(deflection(smoothed(law)), expected, 0.05 * expected) << nu;
    EXPECT_LT(deflection(material_of(law)), 0.9 * expected) << nu;
  }
}

// A user who says nothing of elements gets a cantilever that is right near ν = 0.5, where plain
// ones bend too little.
TEST(Tissue, ACantileverNearIncompressibilityIsRightByDefault) {
  const auto tip = [](bool is_plain) {
    TissueMaterial material;
    material.law = std::make_shared<const fem::AnyMaterial>(fem::NeoHookean(15e3, 0.499));
    if (is_plain) material.element = TissueMaterial::Element::Plain;
    Scenario s = bar(material, {4, 4, 24});
    s.analysis = Scenario::Analysis::Static;
    s.loads = {gravity({0.05, 0, 0})};
    Simulation run(s);
    run.advance(1);
    return end_shift(run);
  };
  const double L = 0.06, b = 0.01;
  const double expected = 1000 * 0.05 * std::pow(L, 4) * b * b / (8 * 15e3 * std::pow(b, 4) / 12);
  EXPECT_NEAR(tip(false), expected, 0.05 * expected);
  EXPECT_LT(tip(true), 0.9 * expected);
}

// With the pressure as an unknown the bulk modulus costs no iterations: with p = A⁻¹ b(x) they
// would be 50 and more at ν = 0.499999.
TEST(Tissue, StaticsNearIncompressibilityTakesNoMoreIterations) {
  const auto iterations = [](double nu) {
    Scenario s = bar(smoothed(fem::isochoric_neo_hookean<fem::VolumeChange>(15e3, nu)), {3, 3, 12});
    s.analysis = Scenario::Analysis::Static;
    s.integrator.max_iterations = 200;
    s.loads = {gravity({0.4, 0, 0})};
    Simulation run(s);
    run.advance(1);
    EXPECT_EQ(run.state.counts.steps, 1);
    EXPECT_NEAR(run.force_on(0).x(), 0.4 * 6e-3, 1e-5 * 0.4 * 6e-3);
    return run.state.counts.newton_iterations;
  };
  const auto compressible = iterations(0.3);
  for (const double nu : {0.49, 0.499, 0.49999, 0.499999})
    EXPECT_LE(iterations(nu), compressible + 4) << nu;
}

// Bones and smoothed tissue: the pressure pushes a bone through the nodes tied to it.
TEST(Tissue, SmoothedTissueBetweenTwoBonesCarriesTheLowerOnesWeight) {
  Scenario s = bar(smoothed(fem::isochoric_neo_hookean<fem::VolumeChange>(15e3, 0.49)), {2, 2, 6});
  s.analysis = Scenario::Analysis::Static;
  s.bodies.push_back(mass_body("weight", 1e-3, {0, 0, 0.06}, {1e-7, 1e-7, 1e-7}));
  s.attachments.push_back(attach("bar", "weight", {-1, -1, 0.0599}, {1, 1, 0.0601}));
  s.loads = {gravity({0, 0, 9.81})};
  Simulation run(s);
  run.advance(1);
  const double weight = 9.81 * (1e-3 + 1000 * 0.01 * 0.01 * 0.06);
  EXPECT_NEAR(run.force_on(1).z(), weight, 1e-5 * weight);
  EXPECT_EQ(run.stepper.indifferent().size(), 0u);
  EXPECT_LE(run.state.counts.newton_iterations, 12);
}

// In time: the period of a smoothed bar is that of the beam, f = 1.875²/(2π L²) sqrt(E I/(ρ A)),
// and once the modes that the steps do not resolve are gone (a kick at a tied end has many),
// nothing more is lost.
TEST(Tissue, ASmoothedBarSwingsWithTheBeamsPeriod) {
  Scenario s = bar(smoothed(fem::isochoric_neo_hookean<fem::VolumeChange>(15e3, 0.49)), {2, 2, 12});
  s.integrator.scheme = Integrator::Scheme::Dirk3;
  s.integrator.step = 0.625e-3;
  s.bodies[0].velocity = {1e-3, 0, 0};
  Simulation run(s);
  const double f = 1.875104 * 1.875104 / (2 * std::numbers::pi * 0.06 * 0.06) *
                   std::sqrt(15e3 * 1e-4 / 12 / 1000);
  // The end comes back through its place of rest after each half period.
  double crossing = 0, before = 0;
  double early_loss = 0;
  run.advance(0.75 / f, [&] {
    if (run.state.t < 0.25 / f) early_loss = run.loss();
    const double now = end_shift(run);
    if (before > 0 && now <= 0 && crossing == 0)
      crossing = run.state.t - s.integrator.step * now / (now - before);
    before = now;
  });
  EXPECT_NEAR(crossing, 0.5 / f, 0.05 * 0.5 / f);
  EXPECT_LT(std::abs(run.loss() - early_loss), 0.01 * run.state.energy.start);
}

// A bar 1024 times longer or shorter, of the same tissue, that falls in as much longer or shorter a
// time under as much less or more of gravity: the same motion, in the same iterations.
TEST(Tissue, MotionDoesNotDependOnTheUnit) {
  for (const auto element : {TissueMaterial::Element::Plain, TissueMaterial::Element::Smoothed}) {
    const auto result = [&](double scale) {
      TissueMaterial material = material_of(fem::MooneyRivlin<>(2.5e3, 0, 50e3));
      material.element = element;
      material.relaxation = {{.weight = 0.3, .time = 20e-3 * scale}};
      Scenario s = scene(1e-3 * scale, Integrator::Scheme::TrBdf2);
      s.integrator.position_tolerance.reset();
      s.duration = scale;
      s.bodies = {box_body("bar", Body::Kind::Tissue, scale * Vec3(0.01, 0.01, 0.06),
                           scale * Vec3(0, 0, 0.03), {2, 2, 6}),
                  stand("wall")};
      s.bodies[0].material = material;
      s.attachments = {
          attach("bar", "wall", scale * Vec3(-1, -1, -1e-6), scale * Vec3(1, 1, 1e-6))};
      s.loads = {gravity({1 / scale, 0, 0})};
      Simulation run(s);
      run.advance(20e-3 * scale);
      return std::pair(run.now().x(0, run.now().x.cols() - 1) / scale,
                       run.state.counts.newton_iterations);
    };
    const auto [x, iterations] = result(1);
    for (const double scale : {1.0 / 1024, 1024.0}) {
      const auto [x_scaled, iterations_scaled] = result(scale);
      EXPECT_NEAR(x_scaled, x, 1e-12 * std::abs(x)) << scale;
      EXPECT_EQ(iterations_scaled, iterations) << scale;
    }
  }
}

// Pure bending at a rate ω/L of the length, without change of volume: v = (x z, −y z/2, (y² − z²)/4
// − x²/2), so that strains change by (z, −z/2, −z/2), and 2 β μ |Ė|² is lost in each volume. With
// two elements across the height 18 % more is lost; in half as large ones a quarter of that, or
// less. With a bulk viscosity β κ it would be thousands of times as much.
TEST(Tissue, DampersOfSmoothedElementsDoNotLockInBending) {
  const double beta = 2e-3, mu = 5e3, side = 0.01;
  const auto excess = [&](double kappa, int cells) {
    TissueMaterial material = smoothed(fem::MooneyRivlin<>(mu / 2, 0, kappa));
    material.stiffness_damping = beta;
    Scenario s = scene(1);
    s.bodies = {box_body("block", Body::Kind::Tissue, {side, side, side}, {0, 0, 0},
                         {cells, cells, cells})};
    s.bodies[0].material = material;
    const Model model = build_model(s);
    const Tissue& tissue = model.tissues[0];
    Positions v(3, tissue.X.cols());
    for (Eigen::Index i = 0; i < v.cols(); ++i) {
      const Vec3 X = tissue.X.col(i);
      v.col(i) = Vec3(X.x() * X.z(), -X.y() * X.z() / 2,
                      (X.y() * X.y() - X.z() * X.z()) / 4 - X.x() * X.x() / 2);
    }
    const double exact = 2 * beta * mu * 1.5 * std::pow(side, 5) / 12;
    return tissue.dashpots->power(tissue.X, v) / exact - 1;
  };
  const double coarse = excess(2e7, 2), fine = excess(2e7, 4), finest = excess(2e7, 8);
  EXPECT_GT(finest, 0);
  EXPECT_LT(coarse, 0.2);
  EXPECT_GT(coarse / fine, 4);
  EXPECT_GT(fine / finest, 4);
  EXPECT_EQ(excess(1e4, 4), fine);
}

// Rayleigh: an oscillation decays by exp(−ζ ω t), ζ = α/(2ω) + β ω/2, and what the dampers take is
// in the balance.
TEST(Tissue, DampingTakesTheEnergyThatItsRatioSays) {
  TissueMaterial material = neo_hookean(15e3, 0.3);
  const auto remaining = [&](double alpha, double beta, double& omega) {
    material.mass_damping = alpha;
    material.stiffness_damping = beta;
    Scenario s = bar(material, {1, 1, 4});
    s.integrator.scheme = Integrator::Scheme::Dirk3;
    s.integrator.step = 0.5e-3;
    s.bodies[0].velocity = {0, 0, 1e-4};
    Simulation run(s);
    double crossing = 0, before = 0;
    const auto end = [&] {
      double most = 0;
      for (const NodeRef& node : run.model.tissues[0].nodes)
        most = std::max(most, run.now().position(node).z());
      return most - 0.06;
    };
    run.advance(0.3, [&] {
      const double now = end();
      if (before > 0 && now <= 0 && crossing == 0) crossing = run.state.t;
      before = now;
    });
    omega = std::numbers::pi / crossing;
    EXPECT_LT(std::abs(run.loss()), 0.02 * run.state.energy.start);
    EXPECT_NEAR(run.loss() + run.state.energy.tissue_loss + run.stepper.stored_energy().total(),
                run.state.energy.start, 1e-9 * run.state.energy.start);
    return run.stepper.stored_energy().total() / run.state.energy.start;
  };
  double omega = 0;
  const double undamped = remaining(0, 0, omega);
  EXPECT_GT(undamped, 0.97);
  const double w = omega;
  EXPECT_NEAR(remaining(2, 0, omega), undamped * std::exp(-2 * 0.3), 0.02);
  // β damps what is slow as βω²; higher modes, which have a fifth of the energy, fade at once.
  const double stiff = remaining(0, 1.0 / (w * w), omega);
  EXPECT_LT(stiff, undamped * std::exp(-0.3));
  EXPECT_GT(stiff, 0.7 * undamped * std::exp(-0.3));
}

const std::vector<fem::PronyTerm> kRelaxation{{0.3, 20e-3}, {0.2, 5e-3}};

/// A light bar between two friction duals of which one draws it out by a tenth in 2 ms.
Scenario stretched_bar(const fem::AnyMaterial& law, TissueMaterial::Element element,
                       const std::vector<fem::PronyTerm>& relaxation) {
  TissueMaterial material = material_of(law);
  material.element = element;
  material.relaxation = relaxation;
  Scenario s = bar(material, {2, 2, 6});
  s.bodies[0].density = 1;
  s.bodies.push_back(stand("grip"));
  s.attachments.push_back(attach("bar", "grip", {-1, -1, 0.0599}, {1, 1, 0.0601}));
  s.loads = {shift("grip", 2e-3, {0, 0, 0.006})};
  s.integrator.step = 0.5e-3;
  s.integrator.position_tolerance = 1e-10;
  return s;
}

/// Pull on the friction dual when the bar has been drawn out, and everything is at rest.
double static_pull(double mu, double kappa, TissueMaterial::Element element,
                   const std::vector<fem::PronyTerm>& relaxation = {}) {
  Scenario s = stretched_bar(fem::MooneyRivlin<>(mu / 2, 0, kappa), element, relaxation);
  s.analysis = Scenario::Analysis::Static;
  Simulation run(s);
  run.advance(2e-3);
  EXPECT_NEAR(run.loss(), 0, 5e-3 * run.state.energy.motion_work);
  return -run.force_on(1).z();
}

// Held, the bar relaxes: at first it pulls as its law says, in the end as that with what is left of
// the shear modulus, which is what static analysis finds; in between as the series says.
TEST(Tissue, AStretchedBarRelaxes) {
  const double mu = 5e3, kappa = 50e3;
  const auto element = TissueMaterial::Element::Plain;
  const double sudden = static_pull(mu, kappa, element);
  const double at_rest = static_pull(0.5 * mu, kappa, element);
  EXPECT_NEAR(static_pull(mu, kappa, element, kRelaxation), at_rest, 1e-5 * at_rest);

  Simulation run(stretched_bar(fem::MooneyRivlin<>(mu / 2, 0, kappa), element, kRelaxation));
  run.advance(2e-3);
  EXPECT_GT(-run.force_on(1).z(), 0.8 * sudden);
  run.advance(22e-3);
  const auto remaining = [](double t) {
    return 1 - 0.3 * (1 - std::exp(-t / 20e-3)) - 0.2 * (1 - std::exp(-t / 5e-3));
  };
  // The pressure does not relax: what of the pull does, follows the series.
  const double relaxing = (0.5 * (remaining(20e-3) + remaining(22e-3)) - 0.5) / 0.5;
  const double expected = at_rest + relaxing * (sudden - at_rest);
  EXPECT_NEAR(-run.force_on(1).z(), expected, 0.02 * expected);
  run.advance(0.4);
  EXPECT_NEAR(-run.force_on(1).z(), at_rest, 1e-5 * at_rest);
  EXPECT_LT(std::abs(run.loss()), 0.05 * run.state.energy.motion_work);
}

// The same of smoothed elements, but that their pressure is stabilised with the modulus at rest.
TEST(Tissue, ASmoothedBarRelaxesToItsStaticState) {
  const double mu = 5e3, kappa = 250e3;
  const auto element = TissueMaterial::Element::Smoothed;
  const double at_rest = static_pull(mu, kappa, element, kRelaxation);
  EXPECT_NEAR(at_rest, 0.5 * static_pull(mu, kappa, element), 0.03 * at_rest);
  Simulation run(stretched_bar(fem::MooneyRivlin<>(mu / 2, 0, kappa), element, kRelaxation));
  run.advance(0.4);
  EXPECT_NEAR(-run.force_on(1).z(), at_rest, 1e-5 * at_rest);
}

// The internal variables are integrated as accurately as all else: the error of the pull falls with
// the order of the scheme.
TEST(Tissue, RelaxationHasTheOrderOfTheScheme) {
  const auto pull = [&](Integrator::Scheme scheme, double step) {
    Scenario s = stretched_bar(fem::MooneyRivlin<>(2.5e3, 0, 20e3), TissueMaterial::Element::Plain,
                               kRelaxation);
    s.bodies[0].density = 0.1;  // waves are over at once
    s.integrator.scheme = scheme;
    s.integrator.step = step;
    s.loads = {shift("grip", 32e-3, {0, 0, 0.006})};
    std::get<MotionLoad>(s.loads[0]).motion.interpolation = Motion::Interpolation::Smooth;
    Simulation run(s);
    run.advance(24e-3);
    return -run.force_on(1).z();
  };
  using Scheme = Integrator::Scheme;
  const double exact = pull(Scheme::Dirk3, 0.2e-3);
  const auto error = [&](Scheme scheme, double step) {
    return std::abs(pull(scheme, step) - exact);
  };
  EXPECT_NEAR(std::log2(error(Scheme::ImplicitEuler, 3e-3) / error(Scheme::ImplicitEuler, 1.5e-3)),
              1, 0.2);
  EXPECT_NEAR(std::log2(error(Scheme::TrBdf2, 3e-3) / error(Scheme::TrBdf2, 1.5e-3)), 2, 0.4);
}

/// A block with fibres along z between two walls, activated in the first 10 ms.
Scenario muscle_block(TissueMaterial::Element element) {
  fem::MuscleFibre::Constants fibre;
  fem::BlemkerMuscle<fem::LogVolumeChange>::Constants ground;
  ground.c10 = 1e4;
  ground.kappa = 1e6;
  TissueMaterial material = material_of(fem::BlemkerMuscle<>(fem::MuscleFibre(fibre), ground));
  material.element = element;
  material.fibres = Fibres{Vec3::UnitZ()};
  Scenario s = scene(1e-3);
  s.bodies = {box_body("muscle", Body::Kind::Tissue, {0.01, 0.01, 0.02}, Vec3::Zero(), {2, 2, 4}),
              stand("low"), stand("high")};
  s.bodies[0].material = material;
  s.attachments = {attach("muscle", "low", {-1, -1, -0.0101}, {1, 1, -0.0099}),
                   attach("muscle", "high", {-1, -1, 0.0099}, {1, 1, 0.0101})};
  Muscle muscle;
  muscle.name = "muscle";
  muscle.tissue = "muscle";
  muscle.activation_time = 5e-3;
  muscle.excitation = {{0, 1e-3}, {0, 0.02}};
  s.muscles = {muscle};
  return s;
}

// Collagen that pulls as the heart does, and with a force that does not depend on the length.
TEST(ActiveMuscle, CollagenPullsWithItsActiveStressInTimeWhateverTheGroundSubstanceIs) {
  const fem::ForceLength curve({});
  for (const std::optional<fem::ForceLength>& force_length : {std::optional(curve), {}}) {
    Scenario s = muscle_block(TissueMaterial::Element::Smoothed);
    s.bodies[0].material->law =
        material_of(fem::TransverselyIsotropic<>(
                        2e3, 0,
                        fem::ToeLinearFibre({.c3 = 1e3, .c4 = 20, .c5 = 1e6, .toe_end = 1.1}), 1e6,
                        fem::ActiveFibre({.stress = 1e5, .force_length = force_length})))
            .law;
    s.muscles[0].excitation = {{0, 0.02}, {0, 0.5}};
    Simulation run(s);
    run.advance(0.08);
    const double factor = force_length ? curve.factor(1) : 1;
    EXPECT_NEAR(run.force_on(0).z(), 0.5 * 1e5 * factor * 1e-4, 1e-3 * 5) << factor;
  }
}

// Held at both ends at 0.8 of its best length: a σ_max n f(n) A, whatever the ground substance is.
// Fibres that did not feel the volume folded such a block, where nothing but tension was stiff.
TEST(ActiveMuscle, PullsWithItsActiveStressInTimeWhateverTheGroundSubstanceIs) {
  for (const double c10 : {0.0, 2e3}) {
    Scenario s = muscle_block(TissueMaterial::Element::Smoothed);
    fem::MuscleFibre::Constants fibre;
    fibre.optimal_stretch = 1.25;
    fem::BlemkerMuscle<fem::LogVolumeChange>::Constants ground;
    ground.c10 = c10;
    ground.kappa = 1e6;
    s.bodies[0].material->law =
        material_of(fem::BlemkerMuscle<>(fem::MuscleFibre(fibre), ground)).law;
    s.muscles[0].excitation = {{0, 0.02}, {0, 0.5}};
    Simulation run(s);
    run.advance(0.08);
    EXPECT_NEAR(run.force_on(0).z(), 0.5 * 0.3e6 * 0.8 * 0.84 * 1e-4, 1e-3 * 10) << c10;
  }
}

// Isometric at its optimal length: the force is a σ_max A, as nothing draws the sides in, and
// static analysis has the same.
TEST(Tissue, AnActivatedBlockPullsWithItsActiveStress) {
  const double expected = 0.02 * 0.3e6 * 1e-4;
  for (const auto element : {TissueMaterial::Element::Plain, TissueMaterial::Element::Smoothed}) {
    Scenario s = muscle_block(element);
    s.integrator.step = 5e-3;
    Simulation moving(s);
    moving.advance(0.3);
    EXPECT_NEAR(moving.force_on(0).z(), expected, 1e-5 * expected);
    EXPECT_NEAR(moving.force_on(0).z(), -moving.force_on(1).z(), 1e-3 * expected);
    EXPECT_GT(moving.state.energy.muscle_work, 0);

    s.analysis = Scenario::Analysis::Static;
    s.integrator.step = 0.1;
    Simulation still(s);
    still.advance(0.2);
    EXPECT_NEAR(still.force_on(0).z(), moving.force_on(0).z(), 1e-3 * expected);
  }
}

}  // namespace articular::sim::tissue_test
