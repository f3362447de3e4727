// Supports that are driven: closed forms in statics and in time, reactions, work, refusals.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/assembly/reactions.hpp"
#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/probes.hpp"
#include "tests/sim/support/scenario_file.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::driven_support_test {

using Element = TissueMaterial::Element;
using Scheme = Integrator::Scheme;
using Solver = Integrator::Solver;

constexpr double kEnd = 1e-7;  // [m] around a plane
constexpr double kSide = 0.01;

/// Holds the nodes of `block` in a box along some axes.
Support support(const std::string& name, const Vec3& low, const Vec3& high,
                const Eigen::Matrix3Xd& held) {
  Support made;
  made.name = name;
  made.body = "block";
  made.region.box = {low, high};
  made.held = held;
  return made;
}

/// The plane through the origin across an axis.
Support plane(int axis) {
  Vec3 high = Vec3::Ones();
  high[axis] = kEnd;
  return support(std::string(1, static_cast<char>('x' + axis)), Vec3::Constant(-kEnd), high,
                 Vec3::Unit(axis));
}

MotionLoad drive(const std::string& support, double duration, const Vec3& way,
                 Motion::Interpolation interpolation) {
  MotionLoad load = shift("", duration, way);
  load.support = support;
  load.motion.interpolation = interpolation;
  return load;
}

/// From 0 to 1 in a duration, at rest at both ends, and its derivatives by s = t/duration.
double path_rate(double s) { return 6 * s * (1 - s); }
double path_acceleration(double s) { return 6 - 12 * s; }

struct Setting {
  Element element;
  Solver solver;
};
class UniaxialTest : public ::testing::TestWithParam<Setting> {};
INSTANTIATE_TEST_SUITE_P(ElementAndSolver, UniaxialTest,
                         ::testing::Values(Setting{Element::Plain, Solver::Cholesky},
                                           Setting{Element::Plain, Solver::ConjugateGradients},
                                           Setting{Element::Smoothed, Solver::Cholesky},
                                           Setting{Element::Smoothed, Solver::Multigrid}));

// A bar of length 2 a on three planes, its end drawn along z and free to narrow: ε = d/(2 a) along
// it and −ν ε across, the force E a² ε and the work half of force times way. Elements hold the
// uniform strain exactly: what is left is where forces balance, 1e-6 of the largest, or where an
// iterative solver stops.
TEST_P(UniaxialTest, ABarThatIsDrawnAtItsEndTakesTheForceEATimesStrain) {
  constexpr double kE = 1e4, kNu = 0.3, kWay = 4e-4;
  const double tolerance = GetParam().solver == Solver::Cholesky ? 2e-6 : 1e-4;
  Scenario s = scene(0.25);
  s.analysis = Scenario::Analysis::Static;
  s.integrator.solver = GetParam().solver;
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3(1, 1, 2) * kSide,
                       Vec3(0.5, 0.5, 1) * kSide, {2, 3, 4})};
  s.bodies[0].material = linear(kE, kNu);
  s.bodies[0].material->element = GetParam().element;
  s.supports = {plane(0), plane(1), plane(2),
                support("end", {-kEnd, -kEnd, 2 * kSide - kEnd}, Vec3::Ones(), Vec3::UnitZ())};
  s.loads = {drive("end", 1, {0, 0, kWay}, Motion::Interpolation::Linear)};
  s.probes = {{"end", SupportProbe{"end"}}, {"z", SupportProbe{"z"}}, {"x", SupportProbe{"x"}}};
  Simulation run(s);
  run.advance(1);
  const double strain = kWay / (2 * kSide), force = kE * kSide * kSide * strain;
  const Vec3 stretch = Vec3(1 - kNu * strain, 1 - kNu * strain, 1 + strain);
  const Tissue& tissue = run.model.tissues[0];
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const Vec3 X = tissue.X.col(static_cast<Eigen::Index>(i));
    EXPECT_LT((run.now().position(tissue.nodes[i]) - stretch.cwiseProduct(X)).norm(),
              tolerance * kWay)
        << i;
  }
  const Probes probes(run);
  EXPECT_LT((probes.vec3("end.force", "N") - Vec3(0, 0, -force)).norm(), tolerance * force);
  EXPECT_LT((probes.vec3("z.force", "N") - Vec3(0, 0, force)).norm(), tolerance * force);
  EXPECT_LT(probes.vec3("x.force", "N").norm(), tolerance * force);
  EXPECT_NEAR(run.state.energy.motion_work, 0.5 * force * kWay, tolerance * force * kWay);
  EXPECT_NEAR(run.stepper.stored_energy().elastic, 0.5 * force * kWay, tolerance * force * kWay);
}

// In one load step: the elements at the end would be inside out before anything follows.
TEST(DrivenSupport, ALargeStretchInOneLoadStepIsFound) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide),
                       Vec3::Constant(0.5 * kSide), {4, 4, 4})};
  s.bodies[0].material = neo_hookean(1e4, 0.45);
  s.supports = {plane(0), plane(1), plane(2),
                support("end", {-kEnd, -kEnd, kSide - kEnd}, Vec3::Ones(), Vec3::UnitZ())};
  s.loads = {drive("end", 1, {0, 0, -0.4 * kSide}, Motion::Interpolation::Linear)};
  Simulation run(s);
  run.advance(1);
  EXPECT_EQ(run.state.counts.steps, 1);
  for (const SupportModel::Node& node : run.model.supports[3].nodes)
    EXPECT_NEAR(
        run.now().position(run.model.tissues[0].nodes[static_cast<std::size_t>(node.node)]).z(),
        0.6 * kSide, 1e-15);
}

// Two supports with axes that are not at right angles: their common node goes as far along each
// axis as this one says.
TEST(DrivenSupport, OfCommonNodesEachGoesItsWayAlongItsOwnAxis) {
  const Vec3 n1 = Vec3(1, 0.5, 0).normalized(), n2 = Vec3(-0.2, 1, 0.3).normalized();
  constexpr double kWay1 = 3e-4, kWay2 = -2e-4;
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {
      box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), Vec3::Zero(), {2, 2, 2})};
  s.bodies[0].material = linear(1e4, 0.3);
  const Vec3 low(-1, -1, 0.5 * kSide - kEnd);
  s.supports = {support("low", Vec3::Constant(-1), {1, 1, -0.5 * kSide + kEnd}, Mat3::Identity()),
                support("first", low, Vec3::Ones(), n1), support("second", low, Vec3::Ones(), n2)};
  s.loads = {drive("first", 1, kWay1 * n1, Motion::Interpolation::Linear),
             drive("second", 1, kWay2 * n2, Motion::Interpolation::Linear)};
  Simulation run(s);
  run.advance(1);
  for (const SupportModel::Node& node : run.model.supports[1].nodes) {
    const Vec3 u =
        run.now().position(run.model.tissues[0].nodes[static_cast<std::size_t>(node.node)]) -
        run.model.tissues[0].X.col(node.node);
    EXPECT_NEAR(n1.dot(u), kWay1, 1e-16);
    EXPECT_NEAR(n2.dot(u), kWay2, 1e-16);
  }
  // Linear: work is half of the sum of force times way.
  const Probes none(run);
  double work = 0;
  for (std::size_t k : {1, 2})
    work -= 0.5 * force_on_support(run.stepper.now(), run.model.supports[k])
                      .first.dot(k == 1 ? kWay1 * n1 : kWay2 * n2);
  EXPECT_NEAR(run.state.energy.motion_work, work, 1e-12 * work);
  EXPECT_NEAR(run.stepper.stored_energy().elastic, work, 1e-6 * work);
}

class DrivenSupportInTime : public ::testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, DrivenSupportInTime,
                         ::testing::Values(Scheme::ImplicitEuler, Scheme::TrBdf2, Scheme::Dirk3,
                                           Scheme::Explicit));

Scenario carried_block(Scheme scheme, Motion::Interpolation interpolation) {
  Scenario s = scene(1e-3, scheme);
  s.bodies = {
      box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), Vec3::Zero(), {2, 2, 2})};
  s.bodies[0].material = neo_hookean(1e4, 0.3);
  s.supports = {support("all", Vec3::Constant(-1), Vec3::Ones(), Vec3::UnitZ())};
  s.loads = {drive("all", 0.02, {0, 0, 0.01}, interpolation)};
  s.probes = {{"all", SupportProbe{"all"}}};
  return s;
}

// All nodes are carried along z: the block is rigid there, its force −m a, and its energy ½ m v².
TEST_P(DrivenSupportInTime, ABlockThatIsCarriedPutsItsInertiaOnTheSupport) {
  constexpr double kTime = 0.02, kWay = 0.01;
  Simulation run(carried_block(GetParam(), Motion::Interpolation::Smooth));
  const double mass = run.model.node_mass.sum();
  run.advance(kTime, [&] {
    const double p = run.state.t / kTime, v = kWay / kTime * path_rate(p);
    const double a = kWay / (kTime * kTime) * path_acceleration(p);
    const auto [force, moment] = force_on_support(run.stepper.now(), run.model.supports[0]);
    EXPECT_NEAR(force.z(), -mass * a, 1e-9 * mass * kWay / (kTime * kTime)) << p;
    EXPECT_LT(force.head<2>().norm(), 1e-9 * mass * kWay / (kTime * kTime));
    EXPECT_NEAR(run.state.energy.motion_work, 0.5 * mass * v * v,
                1e-9 * mass * kWay * kWay / (kTime * kTime));
    EXPECT_NEAR(run.stepper.stored_energy().kinetic, 0.5 * mass * v * v,
                1e-9 * mass * kWay * kWay / (kTime * kTime));
  });
}

// With a velocity that jumps, force times step adds up to the change of momentum: none from rest to
// rest.
TEST_P(DrivenSupportInTime, ImpulsesOfAJumpingVelocityAreTheChangesOfMomentum) {
  constexpr double kTime = 0.02, kWay = 0.01;
  Simulation run(carried_block(GetParam(), Motion::Interpolation::Linear));
  const double momentum = run.model.node_mass.sum() * kWay / kTime;
  double impulse = 0, before = 0;
  run.advance(kTime, [&] {
    impulse -= force_on_support(run.stepper.now(), run.model.supports[0]).first.z() *
               (run.state.t - before);
    before = run.state.t;
    if (run.state.t < kTime * (1 - 1e-9)) {
      EXPECT_NEAR(impulse, momentum, 1e-9 * momentum);
    }
  });
  EXPECT_NEAR(impulse, 0, 1e-9 * momentum);
}

// A support that drives all three axes and a driven body that the same nodes are attached to are
// the same thing.
TEST_P(DrivenSupportInTime, AlongAllAxesIsWhatADrivenBodyIs) {
  const Vec3 way(0.001, -0.0005, 0.002), low(-1, -1, 0.5 * kSide - kEnd);
  Scenario s = scene(GetParam() == Scheme::Explicit ? 1e-3 : 2e-4, GetParam());
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), Vec3::Zero(), {2, 2, 3}),
              stand("grip"), stand("floor")};
  s.bodies[0].material = neo_hookean(1e4, 0.3);
  s.bodies[0].material->mass_damping = 5;
  s.attachments = {attach("block", "floor", Vec3::Constant(-1), {1, 1, -0.5 * kSide + kEnd})};
  Scenario with_body = s;
  with_body.attachments.push_back(attach("block", "grip", low, Vec3::Ones()));
  with_body.loads = {shift("grip", 0.01, way)};
  std::get<MotionLoad>(with_body.loads[0]).motion.interpolation = Motion::Interpolation::Smooth;
  s.supports = {support("grip", low, Vec3::Ones(), Mat3::Identity())};
  s.loads = {drive("grip", 0.01, way, Motion::Interpolation::Smooth)};
  Simulation run(s), other(with_body);
  run.advance(0.014);
  other.advance(0.014);
  const double tolerance = GetParam() == Scheme::Explicit ? 1e-4 : 1e-6;
  for (std::size_t i = 0; i < run.model.tissues[0].nodes.size(); ++i)
    EXPECT_LT((run.now().position(run.model.tissues[0].nodes[i]) -
               other.now().position(other.model.tissues[0].nodes[i]))
                  .norm(),
              tolerance * way.norm())
        << i;
  const double work = other.state.energy.motion_work;
  EXPECT_GT(work, 0);
  // A driven body's mass is not damped, and nodes on a support are: by ∫ α m ḋ² dt of them.
  double held_mass = 0;
  for (const SupportModel::Node& node : run.model.supports[0].nodes)
    held_mass +=
        run.model.node_mass[run.model.tissues[0].nodes[static_cast<std::size_t>(node.node)].block];
  const double damped = 5 * held_mass * way.squaredNorm() / 0.01 * 1.2;  // ∫ (6 s (1 − s))² ds
  EXPECT_NEAR(run.state.energy.motion_work, work + damped, 2e-3 * work);
  EXPECT_LT(std::abs(run.loss()), 0.05 * work);
}

// What the ledger does not explain falls as the scheme's error does: the trapezoidal work of a
// force and the steps are of second order.
TEST(DrivenSupport, TheEnergyOfADrawnBarBalancesToSecondOrder) {
  const auto loss = [](double step) {
    Scenario s = scene(step, Scheme::TrBdf2);
    s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide),
                         Vec3::Constant(0.5 * kSide), {2, 2, 2})};
    s.bodies[0].material = neo_hookean(1e4, 0.3);
    s.supports = {plane(0), plane(1), plane(2),
                  support("end", {-kEnd, -kEnd, kSide - kEnd}, Vec3::Ones(), Vec3::UnitZ())};
    s.loads = {drive("end", 0.02, {0, 0, 0.2 * kSide}, Motion::Interpolation::Smooth)};
    Simulation run(s);
    run.advance(0.02);
    return std::abs(run.loss()) / run.state.energy.motion_work;
  };
  const double coarse = loss(4e-4), fine = loss(2e-4);
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
}

TEST(DrivenSupport, AnAxisThatAnotherSupportHoldsTooIsRefused) {
  Scenario s = scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Ones())};
  s.supports = {support("roller", Vec3::Constant(-1), Vec3::Ones(), Vec3::UnitX()),
                support("grip", Vec3::Constant(-1), {1, 1, 0}, Vec3::UnitX())};
  s.supports[0].where = {"scene.toml", 12, 1};
  s.supports[1].where = {"scene.toml", 17, 1};
  s.loads = {drive("grip", 1, {0.1, 0, 0}, Motion::Interpolation::Linear)};
  try {
    build_model(s);
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("scene.toml:17:1: support `grip` is driven, and its node of `block`"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("by the [[support]] at scene.toml:12"), std::string::npos) << message;
  }
  s.loads.clear();
  build_model(s);
}

using DrivenSupportFile = ScenarioTest;

std::string with_motion(const std::string& keys) {
  return kStart + R"(
[[support]]
name = "grip"
body = "disc_left"
region = {}
freedoms = ["translation.x", "translation.z"]
turned = "0 0 90 deg"
[[load]]
kind = "motion"
)" + keys;
}

TEST_F(DrivenSupportFile, MotionGoesAlongTheAxesOfTheSupport) {
  const Scenario s =
      read(with_motion("support = \"grip\"\ntime = [\"0 s\", \"1 s\"]\ntranslation = [\"0 0 0 "
                       "mm\", \"1 0 2 mm\"]\n"));
  const auto& load = std::get<MotionLoad>(s.loads.at(0));
  EXPECT_EQ(load.support, "grip");
  EXPECT_EQ(load.body, "");
  EXPECT_LT((load.motion.translation.at(1) - Vec3(0, 1e-3, 2e-3)).norm(), 1e-18);
}

TEST_F(DrivenSupportFile, WithMistakesIsRefused) {
  const std::string times = "time = [\"0 s\", \"1 s\"]\n";
  const std::pair<std::string, std::string> mistakes[] = {
      {"support = \"grip\"\nbody = \"skull\"\n" + times, "`body` and `support` exclude each other"},
      {times, "expected `body` or `support`, found none of them"},
      {"support = \"grap\"\n" + times, "no [[support]] has the name `grap`; did you mean `grip`?"},
      {"support = \"grip\"\n" + times + "translation = [\"0 0 0 mm\", \"0 1 0 mm\"]\n",
       "drives `translation.y`, which support `grip` leaves free"},
      {"support = \"grip\"\n" + times + "translation = [\"1 0 0 mm\", \"2 0 0 mm\"]\n",
       "expected 0 at t = 0"},
      {"support = \"grip\"\n" + times + "rotation = [\"0 0 0 deg\", \"0 1 0 deg\"]\n",
       "nodes of tissue have no rotation"},
      {"support = \"grip\"\nabout = \"0 0 1 mm\"\n" + times +
           "translation = [\"0 0 0 mm\", \"1 0 0 mm\"]\n",
       "does not turn"},
      {"support = \"grip\"\n" + times +
           "translation = [\"0 0 0 mm\", \"1 0 0 mm\"]\n[[load]]\nkind = \"motion\"\nsupport = "
           "\"grip\"\n" +
           times + "translation = [\"0 0 0 mm\", \"1 0 0 mm\"]\n",
       "support `grip` already has a motion"}};
  for (const auto& [keys, message] : mistakes)
    EXPECT_NE(refusal(with_motion(keys)).find(message), std::string::npos)
        << refusal(with_motion(keys));
}

}  // namespace articular::sim::driven_support_test
