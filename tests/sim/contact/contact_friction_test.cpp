// Friction and damping in contact: a law at one node, its forces, and blocks that stick, slide,
// stop and bounce.
#include "sim/contact/contact_friction.hpp"
#include "sim/build/build_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "sim/contact/contact_search.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/patch_triangles.hpp"

namespace articular::sim::contact_friction_test {

constexpr double kGravity = 9.81;  // [m/s²]
constexpr double kFriction = 0.3;  // 16.7 degrees
constexpr double kSlip = 1e-4;     // [m/s]
constexpr double kWidth = 0.02;    // of the blocks [m]
constexpr double kHeight = 0.01;   // of the blocks [m]
constexpr double kDegree = std::numbers::pi / 180;

// --- the law

/// A triangle that looks down, partly over a tilted face in which it is about 0.2 m deep.
const Mat3 kTriangle{{0, 0, 1}, {0, 1, 0}, {0, 0, 0}};
const Mat3 kFace{{-2, 0.6, -1.5}, {-2, -1.5, 4}, {0.6, 0.25, 0.4}};

ContactPatch patch() {
  ContactPatch result;
  EXPECT_TRUE(contact_patch(flat_triangle(kTriangle), flat_triangle(kFace), 0.5, {1, 1}, result));
  EXPECT_GT(result.depth_max, 0.05);
  EXPECT_LT(result.area, 0.4);
  return result;
}

/// The same triangle in front of the face, where depths fade in.
ContactPatch fading_patch() {
  const Mat3 lifted = kTriangle.colwise() + Vec3(0, 0, 1);
  ContactPatch result;
  EXPECT_TRUE(contact_patch(flat_triangle(lifted), flat_triangle(kFace), 0.5, {1, 1}, result,
                            ContactPatch::kFading));
  EXPECT_GT(result.area, 0.1 * result.Q.sum());
  EXPECT_LT(result.area, 0.9 * result.Q.sum());
  return result;
}

TEST(Slip, IsTheMotionRelativeToTheFaceAndItsGradientTheTranspose) {
  Random random(1);
  for (const ContactPatch& contact : {patch(), fading_patch()}) {
    for (int trial = 0; trial < 5; ++trial) {
      const Eigen::Matrix<double, 3, 6> v = random.vector(18).reshaped(3, 6);
      const Mat3 t = random.vector(9).reshaped(3, 3);
      const double power = (slip_integrals(contact, v).array() * t.array()).sum();
      EXPECT_NEAR(slip_gradient(contact, t).dot(v.reshaped()), power, 1e-14);
    }
    // The triangle alone slides.
    Eigen::Matrix<double, 3, 6> v = Eigen::Matrix<double, 3, 6>::Zero();
    v.leftCols<3>().colwise() = Vec3(1, 2, 0);
    const Mat3 slip = slip_integrals(contact, v);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR((slip.col(i) - nodal_areas(contact)[i] * Vec3(1, 2, 0)).norm(), 0, 1e-14);
  }
}

TEST(Slip, IsNoneInARigidMotion) {
  Random random(4);
  const ContactPatch contact = patch();
  const Vec3 omega = random.vec3();
  Eigen::Matrix<double, 3, 6> x, v;
  x << kTriangle, kFace;
  for (int k = 0; k < 6; ++k) v.col(k) = Vec3(1, 2, 3) + omega.cross(Vec3(x.col(k)));
  EXPECT_LT(slip_integrals(contact, v).norm(), 1e-14);
}

TEST(Drag, IsNoMoreThanCoulombsAndAgainstTheSlip) {
  const SurfaceLaw law{kFriction, kSlip, 0};
  for (const double speed : {0.0, 0.1 * kSlip, kSlip, 100 * kSlip}) {
    const Vec3 slip = speed * Vec3(0.6, 0.8, 0);
    const NodalDrag drag = nodal_drag(law, 200, 0.7, slip + Vec3(0, 0, 3), Vec3::UnitZ());
    const double expected = kFriction * 200 * speed / std::hypot(speed, kSlip);
    EXPECT_NEAR((drag.traction + expected * Vec3(0.6, 0.8, 0)).norm(), 0, 1e-12);
    EXPECT_EQ(drag.pressure, 0);
  }
}

TEST(Drag, OfDampingNeverPullsAndIsContinuousWhereSurfacesMeet) {
  const SurfaceLaw law{0, 0, 1e3};
  EXPECT_EQ(nodal_drag(law, 200, 0.1, Vec3::Zero(), Vec3::UnitZ()).pressure, 100);
  EXPECT_EQ(nodal_drag(law, 200, -0.1, Vec3::Zero(), Vec3::UnitZ()).pressure, -100);
  EXPECT_EQ(nodal_drag(law, 200, -9, Vec3::Zero(), Vec3::UnitZ()).pressure, -200);
  EXPECT_EQ(nodal_drag(law, 1e-9, 9, Vec3::Zero(), Vec3::UnitZ()).pressure, 1e-9);
}

/// The matrix that stands for −∂t/∂V, in space.
Mat3 resistance(const NodalDrag& drag) {
  return drag.drag_along * drag.along * drag.along.transpose() +
         drag.drag_across * drag.across * drag.across.transpose();
}

TEST(Grip, ThatOfTheSlipMakesTheMatrixTheDerivativeOfTheTraction) {
  const SurfaceLaw law{kFriction, kSlip, 0};
  const Vec3 normal = Vec3(1, 2, -3).normalized(), slip(2 * kSlip, -kSlip, 0.5 * kSlip);
  const auto traction = [&](const Vec3& v) { return nodal_drag(law, 200, 0, v, normal).traction; };
  const Mat3 matrix = resistance(nodal_drag(law, 200, 0, slip, normal));
  constexpr double kDifference = 1e-5 * kSlip;
  for (int i = 0; i < 3; ++i) {
    const Vec3 d = kDifference * Vec3::Unit(i);
    const Vec3 change = (traction(slip + d) - traction(slip - d)) / (2 * kDifference);
    EXPECT_LT((matrix.col(i) + change).norm(), 1e-8 * matrix.norm());
  }
}

TEST(Grip, OfAnyDirectionGivesTheMatrixThatItIsDefinedBy) {
  const SurfaceLaw law{kFriction, kSlip, 0};
  Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const Vec3 normal = random.vec3().normalized(), slip = 5 * kSlip * random.vec3();
    const NodalDrag plain = nodal_drag(law, 200, 0, slip, normal);
    const double regular = std::hypot(plain.slip.norm(), kSlip);
    const Vec3 own = plain.slip / regular;
    // Opposite, none, or any.
    const Vec3 friction_dual = trial == 0   ? Vec3(-own)
                               : trial == 1 ? Vec3::Zero().eval()
                                            : random.vec3();
    const Vec3 g = friction_dual - normal.dot(friction_dual) * normal;
    const Mat3 plane = Mat3::Identity() - normal * normal.transpose();
    const Mat3 expected =
        kFriction * 200 / regular * (plane - 0.5 * (g * own.transpose() + own * g.transpose()));
    const NodalDrag drag = nodal_drag(law, 200, 0, slip, normal, friction_dual);
    EXPECT_LT((resistance(drag) - expected).norm(), 1e-12 * expected.norm()) << trial;
    EXPECT_EQ(drag.traction, plain.traction);
    if (g.norm() > 1) continue;
    EXPECT_GE(drag.drag_along, 0);
    EXPECT_GE(drag.drag_across, 0);
  }
}

/// Newton's iterations for a mass on a spring that friction holds, F = K V + μ p V/s, from a slip
/// of 300 v_s; 50: it does not get there.
int iterations(bool with_grip, double force) {
  constexpr double kSpring = 1e-3;
  const SurfaceLaw law{1, 1, 0};
  Vec3 slip(300, 0, 0);
  std::optional<Vec3> friction_dual;
  for (int i = 0; i < 50; ++i) {
    const NodalDrag drag = nodal_drag(law, 1, 0, slip, Vec3::UnitZ(), friction_dual);
    const Vec3 residual = Vec3(force, 0, 0) - kSpring * slip + drag.traction;
    if (residual.norm() < 1e-9) return i;
    const Mat3 K = resistance(drag) + kSpring * Mat3::Identity();
    const Vec3 change = K.inverse() * residual;
    if (with_grip) friction_dual = next_friction_dual(law, drag.slip, change, friction_dual);
    slip += change;
  }
  return 50;
}

TEST(Grip, LetsNewtonsIterationStopWhatSlides) {
  for (const double force : {0.0, 0.3, -0.7, 0.9}) {
    EXPECT_LT(iterations(true, force), 15) << force;
    EXPECT_EQ(iterations(false, force), 50) << force;
  }
}

TEST(Grip, IsShortenedToOneAndFollowsTheSlip) {
  const SurfaceLaw law{1, kSlip, 0};
  const Vec3 slip(3 * kSlip, 0, 0);
  EXPECT_NEAR((next_friction_dual(law, slip, Vec3::Zero(), Vec3(0, 0.2, 0)) -
               slip / std::hypot(3 * kSlip, kSlip))
                  .norm(),
              0, 1e-14);
  EXPECT_NEAR(next_friction_dual(law, slip, Vec3(0, 100 * kSlip, 0), {}).norm(), 1, 1e-14);
}

TEST(FrictionCoupling, IsSolvedForByAFewSolutionsOfTheSymmetricMatrix) {
  constexpr int kBlocks = 12, kSheets = 8;
  Random random(6);
  const Eigen::MatrixXd R = random.vector(9 * kBlocks * kBlocks).reshaped(3 * kBlocks, 3 * kBlocks);
  const Eigen::MatrixXd A = R * R.transpose() + Eigen::MatrixXd::Identity(3 * kBlocks, 3 * kBlocks);
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  Eigen::MatrixXd all = A;
  FrictionCoupling coupling;
  for (int a = 0; a < kSheets; ++a) {
    Eigen::MatrixXd s = Eigen::MatrixXd::Zero(3 * kBlocks, 1), g = s;
    std::vector<FrictionCoupling::Entry> entries;
    for (int k = 0; k < 3; ++k) {
      const int block = (a + 4 * k) % kBlocks;
      entries.push_back({block, 0.3 * random.vec3(), random.vec3()});
      s.middleRows<3>(3 * block) = entries.back().drag;
      g.middleRows<3>(3 * block) = entries.back().pressure;
    }
    coupling.add_group(entries);
    all += s * g.transpose();
  }
  int solutions = 0;
  const auto solve = [&](Eigen::VectorXd& r, Eigen::VectorXd& w) {
    ++solutions;
    w = factor.solve(r);
    return true;
  };
  const Eigen::VectorXd b = random.vector(3 * kBlocks);
  Eigen::VectorXd w = factor.solve(b);
  const Eigen::VectorXd expected = all.partialPivLu().solve(b);
  EXPECT_GT((w - expected).norm(), 0.01 * expected.norm());
  ASSERT_TRUE(solve_with_friction(coupling, solve, b, w));
  EXPECT_LT((w - expected).norm(), 2e-3 * expected.norm());
  EXPECT_LE(solutions, kSheets + 1);

  const auto fails = [](Eigen::VectorXd&, Eigen::VectorXd&) { return false; };
  EXPECT_FALSE(solve_with_friction(coupling, fails, b, w));
}

// --- forces

/// Contact is far stiffer than tissue.
Model stiff_model(const Scenario& s) {
  Model model = build_model(s);
  contact_stiffness_of(1e8)(model);
  return model;
}

/// A block of tissue, tilted and spinning, pressed into a softer one; it also has a rigid one on
/// it.
Model stack(double friction, double damping) {
  Scenario s = contact_scene(1e-4);
  s.bodies = {box_body("lower", Body::Kind::Tissue, {0.03, 0.03, 0.01}, {0, 0, -0.005}, {3, 3, 1}),
              box_body("upper", Body::Kind::Tissue, {kWidth, kWidth, kHeight}, {1e-3, 0, 0.0049},
                       {2, 2, 1}),
              box_body("bone", Body::Kind::Rigid, {0.016, 0.015, 0.01}, {0, 0, 0.0148}, {2, 2, 1})};
  s.bodies[2].velocity = {0.02, -0.01, -0.02};
  s.bodies[2].angular_velocity = {0.3, -0.5, 4};
  s.bodies[1].velocity = {-0.03, 0.02, -0.01};
  s.contacts = {{"lower", "upper", {}}, {"upper", "bone", {}}};
  for (ContactPair& pair : s.contacts) {
    pair.friction = friction;
    pair.slip_velocity = 0.03;
    pair.damping = damping;
  }
  return stiff_model(s);
}

/// Forces of a scene at its start, with contacts found there.
/// @param jitter  of velocities [m/s]
struct Forces {
  explicit Forces(const Model& model, double jitter = 0.01)
      : dynamics(model), search(model, {}), y(initial_state(model)) {
    Random random(2);
    const int first = model.layout.velocities(), n = 3 * model.layout.num_unknown_blocks();
    y.segment(first, n) += jitter * random.vector(n);
    Configuration start;
    read_state(model, y.data(), 0, start);
    search.find(start, 1e-4);
    dynamics.set_candidates(search.candidates());
    dynamics.evaluate(y.data(), 0);
  }
  Dynamics dynamics;
  ContactSearch search;
  Eigen::VectorXd y;
};

TEST(ContactDrag, ForcesAreEqualAndOppositeWithoutNetMoment) {
  const Model model = stack(0.5, 1e3);
  Forces now(model);
  const std::vector<Positions> forces = nodal_contact_forces(model, now.dynamics.contact());
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double sum = 0, sideways = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    Positions x;
    positions_of(now.dynamics.now().configuration, model.bodies[b].collider->nodes, x);
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const Vec3 f = forces[b].col(i);
      force += f;
      moment += Vec3(x.col(i)).cross(f);
      sum += f.norm();
      sideways += f.head<2>().norm();
    }
  }
  EXPECT_GT(sideways, 0.1 * sum);
  EXPECT_LT(force.norm(), 1e-14 * sum);
  EXPECT_LT(moment.norm(), 1e-14 * sum * kWidth);
}

/// Power of all contact forces of a scene [W].
double contact_power(const Model& model, const Forces& now) {
  const std::vector<Positions> forces = nodal_contact_forces(model, now.dynamics.now().contact);
  const Configuration& configuration = now.dynamics.now().configuration;
  double power = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    for (std::size_t i = 0; i < model.bodies[b].collider->nodes.size(); ++i)
      power += forces[b]
                   .col(static_cast<Eigen::Index>(i))
                   .dot(configuration.velocity(model.bodies[b].collider->nodes[i]));
  return power;
}

// What the forces take besides those of the depths, which have an energy.
TEST(ContactDrag, TakesThePowerOfItsForces) {
  const Model smooth = stack(0, 0), rough = stack(0.5, 0), damped = stack(0.5, 1e3);
  const double elastic = contact_power(smooth, Forces(smooth));
  for (const Model* model : {&rough, &damped}) {
    const Forces now(*model);
    const double taken = elastic - contact_power(*model, now);
    EXPECT_GT(taken, 0);
    EXPECT_NEAR(now.dynamics.now().contact.damping_power(), taken, 1e-9 * taken);
  }
}

/// y = A w
Eigen::VectorXd times(const fem::BlockMatrix& A, const Eigen::VectorXd& w) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(w.size());
  for (int i = 0; i < A.num_blocks(); ++i)
    for (int s = A.row_begin()[static_cast<std::size_t>(i)];
         s < A.row_begin()[static_cast<std::size_t>(i) + 1]; ++s)
      y.segment<3>(3 * i) += A.block(s) * w.segment<3>(3 * A.column()[static_cast<std::size_t>(s)]);
  return y;
}

/// What friction adds to a product with the last matrix.
Eigen::VectorXd coupled(const Dynamics& dynamics, const Eigen::VectorXd& w) {
  const FrictionCoupling& coupling = dynamics.matrix().friction_coupling();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(w.size());
  coupling.add_drag(coupling.pressures(w), 1, y);
  return y;
}

/// Minus the derivative of the unknown blocks' forces by the state along w, from its entry `first`
/// on.
Eigen::VectorXd minus_derivative(Forces& now, int first, const Eigen::VectorXd& w,
                                 double difference) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(w.size());
  for (const double sign : {1.0, -1.0}) {
    Eigen::VectorXd y = now.y;
    y.segment(first, w.size()) += sign * difference * w;
    now.dynamics.evaluate(y.data(), 0);
    change -= sign / (2 * difference) * now.dynamics.now().forces.head(w.size());
  }
  return change;
}

// With both, friction also follows the damped pressure.
TEST(ContactDrag, MatrixAndCouplingAreTheDerivativeOfTheForcesByVelocity) {
  const Model model = stack(0.5, 1e3);
  Forces now(model);
  const int n = 3 * model.layout.num_unknown_blocks();
  Random random(3);
  const Eigen::VectorXd w = random.vector(n);
  const Eigen::VectorXd by_matrix =
      times(now.dynamics.assemble({0, 1, 0}, fem::Tangent::Consistent).A, w);
  const Eigen::VectorXd by_both = by_matrix + coupled(now.dynamics, w);
  const Eigen::VectorXd change = minus_derivative(now, model.layout.velocities(), w, 1e-5);
  EXPECT_LT((change - by_both).norm(), 1e-6 * by_both.norm());
  EXPECT_GT((change - by_matrix).norm(), 1e-3 * by_matrix.norm());
}

// A block that slides is pressed down as a whole: nothing turns, and all that friction does is to
// follow the pressure.
TEST(ContactDrag, CouplingIsTheDerivativeOfFrictionByTheDepth) {
  for (const Scenario::Response response :
       {Scenario::Response::Pointwise, Scenario::Response::Averaged}) {
    Scenario s = contact_scene(1e-4);
    s.contact_response = response;
    s.bodies = {box_body("lower", Body::Kind::Fixed, {0.03, 0.03, 0.01}, {0, 0, -0.005}, {3, 3, 1}),
                box_body("upper", Body::Kind::Tissue, {kWidth, kWidth, kHeight}, {1e-3, 0, 0.0049},
                         {2, 2, 1})};
    s.bodies[1].velocity = {-0.03, 0.02, 0};
    s.contacts = {{"lower", "upper", {}}};
    s.contacts[0].friction = 0.5;
    s.contacts[0].slip_velocity = 0.03;
    const Model model = stiff_model(s);
    Forces now(model, 0);
    const int n = 3 * model.layout.num_unknown_blocks();
    const Eigen::VectorXd down = Vec3(0, 0, -1).replicate(n / 3, 1);
    const Eigen::VectorXd by_matrix =
        times(now.dynamics.assemble({0, 0, 1}, fem::Tangent::Consistent).A, down);
    const Eigen::VectorXd friction = coupled(now.dynamics, down);
    const Eigen::VectorXd change = minus_derivative(now, 0, down, 1e-7);
    // Along the table; with the depth, friction also gets a longer lever.
    const auto sideways = [n](const Eigen::VectorXd& f) {
      return f.reshaped(3, n / 3).topRows<2>();
    };
    EXPECT_LT((sideways(change) - sideways(friction)).norm(), 1e-6 * friction.norm());
    EXPECT_LT(sideways(by_matrix).norm(), 1e-6 * friction.norm());
    EXPECT_GT(friction.norm(), 0.1 * by_matrix.norm());
  }
}

TEST(ContactDrag, MatrixAndProductAreTheDerivativeOfTheForcesByVelocity) {
  for (const auto& [friction, damping] : {std::pair(0.5, 0.0), std::pair(0.0, 1e3)}) {
    const Model model = stack(friction, damping);
    Forces now(model);
    const int n = 3 * model.layout.num_unknown_blocks();
    Random random(3);
    const Eigen::VectorXd w = random.vector(n);
    const fem::BlockMatrix& A = now.dynamics.assemble({0, 1, 0}, fem::Tangent::Consistent).A;
    const Eigen::VectorXd by_matrix = times(A, w);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(3 * model.num_blocks), product = all;
    all.head(n) = w;
    const Moment& moment = now.dynamics.now();
    moment.contact.add_damping_product(moment.configuration, all, 1, product);
    EXPECT_GT(by_matrix.norm(), 0);
    EXPECT_LT((product.head(n) - by_matrix).norm(), 1e-12 * by_matrix.norm());

    const Eigen::VectorXd change = minus_derivative(now, model.layout.velocities(), w, 1e-5);
    EXPECT_LT((change - by_matrix).norm(), 1e-6 * by_matrix.norm()) << friction;
  }
}

// --- blocks on a table

/// A block at rest on a table; gravity is turned as if the table were an incline that falls to +x.
Scenario incline(Body::Kind kind, double angle, double step) {
  Scenario s = contact_scene(step);
  s.bodies = {box_body("table", Body::Kind::Fixed, {0.1, 0.04, 0.01}, {0.02, 0, -0.005}, {7, 3, 1}),
              box_body("block", kind, {kWidth, kWidth, kHeight}, {0, 0, 0.5 * kHeight}, {4, 4, 2})};
  if (kind == Body::Kind::Tissue) {
    s.bodies[1].material = neo_hookean(100e3, 0.3);
    s.bodies[1].material->stiffness_damping = 1e-3;
  }
  s.contacts = {{"block", "table", {}}};
  s.integrator.position_tolerance = 1e-9;
  s.contacts[0].friction = kFriction;
  s.contacts[0].slip_velocity = kSlip;
  s.loads = {gravity(kGravity * Vec3(std::sin(angle), 0, -std::cos(angle)))};
  return s;
}

/// Of two bones the default presses them 1e-14 m into each other, beyond any tolerance.
ModelChange contact_of(Body::Kind kind) {
  return kind == Body::Kind::Rigid ? contact_stiffness_of(1e9) : ModelChange{};
}

double mass() { return 1000 * kWidth * kWidth * kHeight; }

/// Mean velocity of the block down the incline [m/s].
double speed(const Simulation& run) {
  if (run.model.tissues.empty()) return run.now().velocities[0].linear.x();
  return momentum(run).x() / mass();
}

class Incline : public testing::TestWithParam<Body::Kind> {};

TEST_P(Incline, BelowTheAngleOfFrictionTheBlockCreepsAndNoMore) {
  const double angle = 10 * kDegree;
  Simulation run(incline(GetParam(), angle, 1e-3), contact_of(GetParam()));
  run.advance(0.2);
  const double ratio = std::tan(angle) / kFriction;
  const double creep = kSlip * ratio / std::sqrt(1 - ratio * ratio);
  EXPECT_NEAR(speed(run), creep, 0.02 * creep);
  const Vec3 force = run.stepper.dynamics().contact_summary(0).force;  // on the block
  const double weight = mass() * kGravity;
  EXPECT_NEAR(-force.x(), weight * std::sin(angle), 2e-3 * weight);
  EXPECT_NEAR(force.z(), weight * std::cos(angle), 2e-3 * weight);
  EXPECT_EQ(run.state.counts.rejected_newton, 0);
}

TEST_P(Incline, AboveItTheBlockSlidesWithTheAccelerationThatFrictionLeaves) {
  const double angle = 30 * kDegree;
  Simulation run(incline(GetParam(), angle, 1e-3), contact_of(GetParam()));
  run.advance(0.05);
  const double before = speed(run);
  run.advance(0.15);
  const double expected = kGravity * (std::sin(angle) - kFriction * std::cos(angle));
  EXPECT_NEAR((speed(run) - before) / 0.1, expected, 0.01 * expected);
  const Vec3 force = run.stepper.dynamics().contact_summary(0).force;
  EXPECT_NEAR(-force.x() / force.z(), kFriction, 1e-3 * kFriction);
  EXPECT_LE(run.state.counts.rejected_newton, 2);
}

// Implicit Euler makes the way shorter by half a step at the first speed, h v/2.
TEST_P(Incline, OnTheLevelABlockStopsAfterItsBrakingDistanceAndFrictionTakesItsEnergy) {
  const double v = 0.3, h = 5e-4;
  Scenario s = incline(GetParam(), 0, h);
  s.bodies[1].velocity = {v, 0, 0};
  Simulation run(s, contact_of(GetParam()));
  double distance = 0;
  run.advance(0.15, [&] { distance += h * speed(run); });
  const double expected = v * v / (2 * kFriction * kGravity);
  EXPECT_NEAR(distance, expected - 0.5 * h * v, 0.01 * expected);
  EXPECT_LT(std::abs(speed(run)), kSlip);
  const double energy = 0.5 * mass() * v * v;
  EXPECT_NEAR(run.state.energy.contact_loss, energy, 0.01 * energy);
  EXPECT_LT(std::abs(run.loss()), 0.01 * energy);
}

INSTANTIATE_TEST_SUITE_P(Contact, Incline, testing::Values(Body::Kind::Rigid, Body::Kind::Tissue),
                         [](const auto& info) {
                           return info.param == Body::Kind::Rigid ? "Rigid" : "Tissue";
                         });

TEST(Friction, WithTheDefaultSlipVelocityABlockCreepsByAFewHundredthsOfAnElement) {
  Scenario s = incline(Body::Kind::Tissue, 10 * kDegree, 1e-3);
  s.duration = 0.2;
  s.contacts[0].slip_velocity.reset();
  Simulation run(s);
  double distance = 0, before = 0;
  run.advance(0.2, [&] {
    distance += (run.state.t - before) * speed(run);
    before = run.state.t;
  });
  EXPECT_GT(distance, 0);
  EXPECT_LT(distance, 0.06 * kWidth / 4);
}

// Nothing but the end of a scene depends on its duration.
TEST(Friction, TheFirstStepsAreTheSameHoweverLongTheSceneIs) {
  const auto after_steps = [](double duration) {
    Scenario s = incline(Body::Kind::Tissue, 10 * kDegree, 1e-3);
    s.contacts[0].slip_velocity.reset();
    s.integrator.position_tolerance.reset();
    s.duration = duration;
    Simulation run(s);
    run.advance(5e-3);
    return run.state.y;
  };
  const Eigen::VectorXd expected = after_steps(0.1);
  for (const double duration : {10.0, 1e3, 1e5}) EXPECT_EQ(after_steps(duration), expected);
}

// Of steps a hundred times shorter, too: a finer step must not slip more.
TEST(Friction, TheDefaultSlipVelocityIsOfTheMeshAndGrowsShorterWithLongSteps) {
  const auto slip = [](double step) {
    Scenario s = incline(Body::Kind::Tissue, 0, step);
    s.contacts[0].slip_velocity.reset();
    return Simulation(s).model.contacts[0].law.slip_velocity;
  };
  EXPECT_EQ(slip(1e-5), slip(1e-3));
  EXPECT_NEAR(slip(1), 1e-3 * slip(1e-3), 1e-18);
}

// A table that is driven sideways takes the block along, and then leaves it behind.
TEST(Friction, ADrivenTableTakesABlockAlongAsFarAsFrictionCan) {
  for (const double acceleration : {0.5 * kFriction * kGravity, 2 * kFriction * kGravity}) {
    Scenario s = incline(Body::Kind::Rigid, 0, 1e-3);
    MotionLoad load = shift("table", 0.1, Vec3::Zero());
    load.motion.time.clear();
    load.motion.translation.clear();
    for (int k = 0; k <= 110; ++k) {  // straight pieces of a parabola
      load.motion.time.push_back(1e-3 * k);
      load.motion.translation.push_back({0.5e-6 * acceleration * k * k, 0, 0});
    }
    s.loads.push_back(load);
    Simulation run(s, contact_of(Body::Kind::Rigid));
    run.advance(0.1);
    const double expected = 0.1 * std::min(acceleration, kFriction * kGravity);
    EXPECT_NEAR(speed(run), expected, 0.02 * expected);
  }
}

TEST(Friction, OfZeroChangesNoBitAndLosesNothing) {
  Scenario with = incline(Body::Kind::Tissue, 10 * kDegree, 1e-3);
  with.contacts[0].friction = 0;
  Scenario without = with;
  without.contacts[0] = {"block", "table", {}};
  Simulation a(with), b(without);
  a.advance(0.02);
  b.advance(0.02);
  EXPECT_TRUE(a.state.y == b.state.y);
  EXPECT_EQ(a.state.energy.contact_loss, 0);
  EXPECT_NEAR(speed(a), 0.02 * kGravity * std::sin(10 * kDegree), 1e-6);
}

// --- bouncing

struct Bounce {
  double restitution, least_force, loss, numerical;  // forces [N], parts of the energy
};

/// A rigid block that falls flat onto a table with a stiffness of 1e7 Pa/m.
Bounce bounce(double damping) {
  Scenario s = contact_scene(2e-5, Integrator::Scheme::TrBdf2);
  s.integrator.position_tolerance = 1e-10;
  s.bodies = {box_body("table", Body::Kind::Fixed, {0.04, 0.04, 0.01}, {0, 0, -0.005}, {2, 2, 1}),
              box_body("block", Body::Kind::Rigid, {kWidth, kWidth, kHeight},
                       {0, 0, 0.5 * kHeight + 1e-5}, {2, 2, 1})};
  const double v = 0.1;
  s.bodies[1].velocity = {0, 0, -v};
  s.contacts = {{"block", "table", {}}};
  s.contacts[0].damping = damping;
  Simulation run(s, contact_stiffness_of(1e7));
  Bounce result{0, std::numeric_limits<double>::infinity(), 0, 0};
  run.advance(8e-3, [&] {
    result.least_force =
        std::min(result.least_force, run.stepper.dynamics().contact_summary(0).force.z());
  });
  const double energy = 0.5 * mass() * v * v;
  result.restitution = run.now().velocities[0].linear.z() / v;
  result.loss = run.state.energy.contact_loss / energy;
  result.numerical = run.loss() / energy;
  return result;
}

/// The same of a mass on one spring, by small steps: x is how deep it is.
double restitution_of_a_mass(double damping) {
  const double m = mass() / (kWidth * kWidth), k = 1e7, h = 1e-7;
  double x = 0, v = 0.1;
  do {
    const double spring = k * x;
    v -= h / m * (spring + std::clamp(damping * v, -spring, spring));
    x += h * v;
  } while (x > 0);
  return -v / 0.1;
}

// Weakly damped, e = exp(−πζ/√(1 − ζ²)).
TEST(ContactDamping, RestitutionFallsWithItAndNothingSticks) {
  const double critical = 2 * std::sqrt(1e7 * mass() / (kWidth * kWidth));  // [Pa s/m]
  EXPECT_NEAR(bounce(0).restitution, 1, 0.01);
  EXPECT_NEAR(bounce(0.02 * critical).restitution, std::exp(-std::numbers::pi * 0.02), 0.01);
  double last = 1;
  for (const double zeta : {0.05, 0.2, 0.5, 2.0}) {
    const Bounce result = bounce(zeta * critical);
    EXPECT_NEAR(result.restitution, restitution_of_a_mass(zeta * critical), 0.01) << zeta;
    EXPECT_LT(result.restitution, last - 0.05);
    EXPECT_GE(result.least_force, 0);
    EXPECT_NEAR(result.loss, 1 - result.restitution * result.restitution, 0.02);
    EXPECT_LT(std::abs(result.numerical), 0.02);
    last = result.restitution;
  }
}

}  // namespace articular::sim::contact_friction_test
