// The longest stable step of the explicit scheme: from the eigenvalues of a scene, and by trying.
#include "sim/time/explicit_limit.hpp"
#include "sim/build/build_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "fem/sparse/pressure_term.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/stability_trial.hpp"

namespace articular::sim::explicit_limit_test {

constexpr double kRoot3 = 1.7320508075688772;

/// R(z) of a three-stage method of order 3, 1 + z + z²/2 + z³/6, is 1 in size at i√3; on the
/// negative real axis where 1 + z/2 + z²/6 + 2/z = 0.
TEST(ExplicitLimit, TheBoundaryIsThatOfBogackiAndShampinesMethod) {
  const std::vector<double> c = explicit_growth();
  const std::vector<double> expected = {1, 1, 1.0 / 2, 1.0 / 6, 0};
  ASSERT_EQ(c.size(), expected.size());
  for (std::size_t k = 0; k < c.size(); ++k) EXPECT_NEAR(c[k], expected[k], 1e-15) << k;
  EXPECT_NEAR(longest_explicit_step(MotionRates{{0, 50}}), kRoot3 / 50, 1e-9);
  const double real = 10 * longest_explicit_step(MotionRates{{-10, 0}});
  EXPECT_NEAR(1 - real + real * real / 2 - real * real * real / 6, -1, 1e-9);
  EXPECT_TRUE(std::isinf(longest_explicit_step(MotionRates{{3, 0}, {0, 0}})));
}

/// A mass that hangs on a taut band: ω² = k/m along it.
Scenario hanging_mass() {
  Scenario s = scene(1e-3, Integrator::Scheme::Explicit);
  s.bodies = {mass_body("mass", 2, Vec3::Zero(), {10, 10, 10}), stand("ceiling")};
  Ligament band;
  band.name = "band";
  band.path = {anchor("ceiling", {0, 0, 1}), anchor("mass", Vec3::Zero())};
  band.stiffness = 800;
  band.slack_length = 0.5;
  s.ligaments = {band};
  return s;
}

MotionRates rates_of(const Scenario& s) {
  const Model model = build_model(s);
  Dynamics dynamics(model);
  return fastest_rates(model, dynamics, initial_state(model), 0, 1e-6);
}

TEST(ExplicitLimit, AMassOnABandHasTheFrequencyOfItsClosedForm) {
  EXPECT_NEAR(std::abs(rates_of(hanging_mass())[0].imag()), 20, 1e-5);
  EXPECT_NEAR(longest_explicit_step(rates_of(hanging_mass())), kRoot3 / 20, 1e-6);
}

/// All eigenvalues of M⁻¹ K from the matrix that Newton's iteration has, at rest.
double largest_frequency(const Model& model) {
  Dynamics dynamics(model);
  const Eigen::VectorXd y = initial_state(model);
  dynamics.evaluate(y.data(), 0);
  const NewtonEquations equations = dynamics.assemble({0, 0, 1}, fem::Tangent::Consistent);
  const fem::BlockMatrix& A = equations.A;
  fem::PressureOperator pressure;
  pressure.set(equations.pressure.terms);
  const int size = 3 * A.num_blocks();
  Eigen::MatrixXd K(size, size);
  Eigen::VectorXd root(size);
  for (int i = 0; i < size; ++i) {
    Eigen::VectorXd column;
    A.multiply(Eigen::VectorXd::Unit(size, i), column);
    pressure.add_product(Eigen::VectorXd::Unit(size, i), column);
    K.col(i) = column;
    root[i] = 1 / std::sqrt(model.node_mass[i / 3]);
  }
  K = root.asDiagonal() * K * root.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (K + K.transpose()));
  return std::sqrt(eigen.eigenvalues().maxCoeff());
}

Scenario bar(TissueMaterial::Element element, double stiffness_damping = 0) {
  Scenario s = scene(1e-3, Integrator::Scheme::Explicit);
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.01, 0.01, 0.03}, {0, 0, 0.015}, {2, 2, 4}),
              stand("wall")};
  s.bodies[0].material = neo_hookean(20e3, 0.45);
  s.bodies[0].material->element = element;
  s.bodies[0].material->stiffness_damping = stiffness_damping;
  s.attachments = {attach("bar", "wall", {-1, -1, -1e-6}, {1, 1, 1e-6})};
  return s;
}

class EachElement : public ::testing::TestWithParam<TissueMaterial::Element> {};
INSTANTIATE_TEST_SUITE_P(ExplicitLimit, EachElement,
                         ::testing::Values(TissueMaterial::Element::Plain,
                                           TissueMaterial::Element::Smoothed),
                         [](const auto& info) {
                           return info.param == TissueMaterial::Element::Plain ? "Plain"
                                                                               : "Smoothed";
                         });

TEST_P(EachElement, TheHighestFrequencyIsThatOfTheAssembledMatrices) {
  const double omega = largest_frequency(build_model(bar(GetParam())));
  const MotionRates rates = rates_of(bar(GetParam()));
  EXPECT_NEAR(std::abs(rates[0]), omega, 1e-4 * omega);
  EXPECT_LT(std::abs(rates[0].real()), 1e-4 * omega);
}

TEST_P(EachElement, StepsGrowEnergyBeyondTheLimitAndNotBelow) {
  const Model model = build_model(bar(GetParam()));
  Dynamics dynamics(model);
  const double limit =
      longest_explicit_step(fastest_rates(model, dynamics, initial_state(model), 0, 1e-4));
  EXPECT_FALSE(explicit_steps_grow(model, 0.99 * limit, 1000));
  EXPECT_TRUE(explicit_steps_grow(model, 1.01 * limit, 1000));
}

// So strong that what is fastest creeps: the limit is that of the real axis.
TEST(ExplicitLimit, DampersBoundTheStepToo) {
  const Scenario damped = bar(TissueMaterial::Element::Plain, 5e-3);
  const Model model = build_model(damped);
  const MotionRates rates = rates_of(damped);
  EXPECT_LT(rates[0].real(), -0.99 * std::abs(rates[0]));
  const double limit = longest_explicit_step(rates);
  EXPECT_LT(limit, 0.5 * longest_explicit_step(rates_of(bar(TissueMaterial::Element::Plain))));
  EXPECT_FALSE(explicit_steps_grow(model, 0.99 * limit, 400));
  EXPECT_TRUE(explicit_steps_grow(model, 1.01 * limit, 400));
}

}  // namespace articular::sim::explicit_limit_test
