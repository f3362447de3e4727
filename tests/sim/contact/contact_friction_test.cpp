// Friction and damping in contact: a law at one node, and its forces.
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
#include "tests/sim/support/found_contacts.hpp"
#include "tests/sim/support/patch_triangles.hpp"

namespace articular::sim::contact_friction_test {

constexpr double kFriction = 0.3;  // 16.7 degrees
constexpr double kSlip = 1e-4;     // [m/s]
constexpr double kWidth = 0.02;    // of the blocks [m]
constexpr double kHeight = 0.01;   // of the blocks [m]

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

// --- forces

/// Contact is far stiffer than tissue.
Model stiff_model(const Scenario& s) {
  Model model = build_model(s);
  contact_stiffness_of(1e8)(model);
  return model;
}

/// The same with layers that stiffen, and are pressed in by a third of their thickness.
Model stiffening_model(const Scenario& s) {
  Model model = stiff_model(s);
  model.contacts.change([](ContactModel& contact) {
    constexpr double kThickness = 0.3e-3;  // [m]
    contact.logarithmic[0] = {kThickness * contact.mean_stiffness, kThickness};
    contact.averaged = true;
  });
  return model;
}

/// A block of tissue, tilted and spinning, pressed into a softer one; it also has a rigid one on
/// it.
Model stack(double friction, double damping, bool stiffens = false) {
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
  return stiffens ? stiffening_model(s) : stiff_model(s);
}

/// Forces of a scene at its start, with contacts found there.
/// @param jitter  of velocities [m/s]
struct Forces {
  explicit Forces(const Model& model, double jitter = 0.01)
      : dynamics(model), search(model, {}), y(initial_state(model)) {
    Random random(2);
    const int first = model.layout.velocities(), n = 3 * model.layout.num_unknown_blocks();
    y.segment(first, n) += jitter * random.vector(n);
    find_contacts(model, y, 1e-4, search, dynamics);
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
  for (const bool stiffens : {false, true}) {
    const Model smooth = stack(0, 0, stiffens), rough = stack(0.5, 0, stiffens),
                damped = stack(0.5, 1e3, stiffens);
    const double elastic = contact_power(smooth, Forces(smooth));
    for (const Model* model : {&rough, &damped}) {
      const Forces now(*model);
      const double taken = elastic - contact_power(*model, now);
      EXPECT_GT(taken, 0);
      EXPECT_NEAR(now.dynamics.now().contact.damping_power(), taken, 1e-9 * taken);
    }
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
  const FrictionCoupling& coupling = dynamics.matrix().equations().friction;
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
  for (const bool stiffens : {false, true}) {
    const Model model = stack(0.5, 1e3, stiffens);
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
}

// A block that slides is pressed down as a whole: nothing turns, and all that friction does is to
// follow the pressure.
TEST(ContactDrag, CouplingIsTheDerivativeOfFrictionByTheDepth) {
  for (const auto& [response, stiffens] : {std::pair(Scenario::Response::Pointwise, false),
                                           std::pair(Scenario::Response::Averaged, false),
                                           std::pair(Scenario::Response::Averaged, true)}) {
    Scenario s = contact_scene(1e-4);
    s.contact_response = response;
    s.bodies = {box_body("lower", Body::Kind::Fixed, {0.03, 0.03, 0.01}, {0, 0, -0.005}, {3, 3, 1}),
                box_body("upper", Body::Kind::Tissue, {kWidth, kWidth, kHeight}, {1e-3, 0, 0.0049},
                         {2, 2, 1})};
    s.bodies[1].velocity = {-0.03, 0.02, 0};
    s.contacts = {{"lower", "upper", {}}};
    s.contacts[0].friction = 0.5;
    s.contacts[0].slip_velocity = 0.03;
    const Model model = stiffens ? stiffening_model(s) : stiff_model(s);
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

}  // namespace articular::sim::contact_friction_test
