#include "sim/assembly/dynamics.hpp"
#include "sim/build/build_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/time/newton_system.hpp"
#include "tests/sim/support/found_contacts.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::dynamics_test {

constexpr double kSide = 0.02;  // of the blocks [m]

/// A block of tissue hangs on a rigid box (its upper nodes are attached) and sits `depth` deep in a
/// second block of tissue, which is free and narrower. A muscle and a ligament pull on patches.
Scenario everything(double depth) {
  Scenario s = scene(1e-3);
  s.contact = true;
  s.bodies = {box_body("bone", Body::Kind::Rigid, {kSide, kSide, kSide}, {0, 0, 2 * kSide}),
              box_body("hung", Body::Kind::Tissue, {kSide, kSide, kSide}, {0, 0, kSide}, {2, 2, 2}),
              box_body("free", Body::Kind::Tissue, {0.7 * kSide, 0.7 * kSide, kSide}, {0, 0, depth},
                       {1, 1, 2}),
              stand("frame")};
  s.contacts = {{"hung", "free", {}}};
  s.attachments = {attach("hung", "bone", {-1, -1, 1.4 * kSide}, {1, 1, 1})};
  Muscle muscle;
  muscle.name = "muscle";
  muscle.path = {anchor("frame", {0.05, 0.01, 0}), anchor("free", {0.3 * kSide, 0, 0}, 0.5 * kSide),
                 anchor("hung", {-0.5 * kSide, 0, kSide}, 0.6 * kSide)};
  muscle.max_force = 2;
  muscle.optimal_length = 0.08;
  s.muscles = {muscle};
  Ligament ligament;
  ligament.name = "ligament";
  ligament.path = {anchor("bone", {0.01, 0.005, 2.2 * kSide}), anchor("frame", {0.03, 0.04, 0.1}),
                   anchor("free", {0, 0, -0.5 * kSide}, 0.6 * kSide)};
  ligament.stiffness = 200;
  ligament.damping = 0.5;
  ligament.slack_length = 0.05;
  s.ligaments = {ligament};
  return s;
}

double position_scale(const Model& model, int block) {
  for (int r = 0; r < model.layout.num_rigid; ++r)
    if (block == model.rigid_bodies[static_cast<std::size_t>(r)].block + 1) return 1;  // an angle
  return kSide;
}

/// y displaced by block displacements (rotation vectors for bones), velocities as in `velocity`.
Eigen::VectorXd moved(const Model& model, const Eigen::VectorXd& y, const Eigen::VectorXd& by) {
  const Layout& layout = model.layout;
  Eigen::VectorXd result = y;
  result.head(3 * layout.num_free_nodes) += by.head(3 * layout.num_free_nodes);
  for (int r = 0; r < layout.num_rigid; ++r) {
    const int row = 3 * model.rigid_bodies[static_cast<std::size_t>(r)].block;
    result.segment<3>(layout.rigid_p(r)) += by.segment<3>(row);
    const double* q = y.data() + layout.rigid_q(r);
    const Vec3 theta = by.segment<3>(row + 3);
    const Eigen::Quaterniond turned =
        Eigen::Quaterniond(rotation_matrix(theta)) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    result.segment<4>(layout.rigid_q(r)) << turned.w(), turned.x(), turned.y(), turned.z();
  }
  return result;
}

/// Everything displaced, turned, moving and half active at random.
/// @param speed  [m/s], and rad/s of bones
Eigen::VectorXd random_state(const Model& model, double amplitude, double speed, Random& random) {
  const int num_velocities = 3 * model.layout.num_unknown_blocks();
  Eigen::VectorXd by = amplitude * random.vector(num_velocities);
  for (int block = 0; block < model.layout.num_unknown_blocks(); ++block)
    by.segment<3>(3 * block) *= position_scale(model, block);
  Eigen::VectorXd y = moved(model, initial_state(model), by);
  y.segment(model.layout.velocities(), num_velocities) = speed * random.vector(num_velocities);
  y.tail(model.layout.num_muscles).setConstant(0.5);
  return y;
}

/// Contact is far stiffer than the tissue.
Model model_of(const Scenario& scenario) {
  Model model = build_model(scenario);
  contact_stiffness_of(1e8)(model);
  return model;
}

/// The scene's forces with the contact candidates of its start.
struct Forces {
  Forces(const Scenario& scenario, double margin) : model(model_of(scenario)), dynamics(model) {
    if (model.contacts.empty()) return;
    search = std::make_unique<ContactSearch>(model, step_settings(scenario));
    find_contacts(model, initial_state(model), margin, *search, dynamics);
  }
  const Eigen::VectorXd& at(const Eigen::VectorXd& y) {
    dynamics.evaluate(y.data(), 0);
    return dynamics.now().forces;
  }
  const Model model;
  Dynamics dynamics;
  std::unique_ptr<ContactSearch> search;
};

TEST(Dynamics, InternalContactAndLineForcesHaveNoNetForceOrMoment) {
  Random random(1);
  Forces scene(everything(0.05 * kSide), 0.3 * kSide);
  for (int n = 0; n < 20; ++n) {
    const Eigen::VectorXd f = scene.at(random_state(scene.model, 0.05, 0.1, random));
    EXPECT_GT(scene.dynamics.contact_summary(0).force.norm(), 1e-3);
    EXPECT_GT(scene.dynamics.now().lines[0].tension, 0);
    EXPECT_GT(scene.dynamics.now().lines[1].tension, 0);
    const Configuration& now = scene.dynamics.now().configuration;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double sum = 0;  // of all forces
    for (int b = 0; b < scene.model.layout.num_free_nodes; ++b) {
      force += f.segment<3>(3 * b);
      moment += now.x.col(b).cross(f.segment<3>(3 * b));
      sum += f.segment<3>(3 * b).norm();
    }
    for (std::size_t b = 0; b < scene.model.rigid_bodies.size(); ++b) {
      const int row = 3 * scene.model.rigid_bodies[b].block;
      force += f.segment<3>(row);
      moment += now.poses[b].p.cross(f.segment<3>(row)) + f.segment<3>(row + 3);
      sum += f.segment<3>(row).norm();
    }
    EXPECT_LT(force.norm(), 1e-12 * sum);
    EXPECT_LT(moment.norm(), 1e-12 * sum * 0.1);
  }
}

Eigen::VectorXd dense_product(const fem::BlockMatrix& A, const Eigen::VectorXd& w) {
  Eigen::VectorXd result(w.size());
  A.multiply(w, result);
  return result;
}

/// −γ d/dε f(x + ε γ w, v + ε w) over the unknown blocks, by central differences.
Eigen::VectorXd stiffness_product(Forces& scene, const Eigen::VectorXd& y, double gamma,
                                  const Eigen::VectorXd& w, double epsilon) {
  const auto at = [&](double e) -> Eigen::VectorXd {
    Eigen::VectorXd there = moved(scene.model, y, e * gamma * w);
    there.segment(scene.model.layout.velocities(), w.size()) += e * w;
    return scene.at(there).head(w.size());
  };
  return -gamma / (2 * epsilon) * (at(epsilon) - at(-epsilon));
}

/// Largest relative difference of the Newton matrix, less its mass, from differences of the force.
/// The matrix lacks [τ]×/2 of the moment τ on a bone, which is not symmetric.
double matrix_error(Forces& scene, const Eigen::VectorXd& y, double step) {
  Random random(7);
  const double gamma = 2e-3;
  const Model& model = scene.model;
  double worst = 0;
  for (int n = 0; n < 6; ++n) {
    Eigen::VectorXd w = random.vector(3 * model.layout.num_unknown_blocks());
    for (int block = 0; block < model.layout.num_unknown_blocks(); ++block)
      if (position_scale(model, block) == 1) w.segment<3>(3 * block) /= kSide;
    scene.at(y);
    const fem::BlockMatrix& A =
        scene.dynamics.assemble({1, gamma, gamma * gamma}, fem::Tangent::Consistent).A;
    Eigen::VectorXd mass;
    scene.dynamics.multiply_mass(w, mass);
    Eigen::VectorXd K = dense_product(A, w) - mass;
    for (int r = 0; r < model.layout.num_rigid; ++r) {
      const int turning = 3 * model.rigid_bodies[static_cast<std::size_t>(r)].block + 3;
      const Vec3 moment = scene.dynamics.now().forces.segment<3>(turning);
      const Vec3 turn = gamma * gamma * w.segment<3>(turning);
      K.segment<3>(turning) += 0.5 * moment.cross(turn);
    }
    const Eigen::VectorXd numeric = stiffness_product(scene, y, gamma, w, step);
    worst = std::max(worst, (K - numeric).norm() / numeric.norm());
  }
  return worst;
}

Scenario everything_apart() {
  Scenario scenario = everything(0);
  scenario.contact = false;
  scenario.contacts.clear();
  return scenario;
}

// Deformed tissue, a taut ligament, a force and an active muscle with its force–velocity, at rest.
TEST(Dynamics, TheNewtonMatrixIsTheDerivativeOfTheForces) {
  Scenario scenario = everything_apart();
  ForceLoad force;
  force.at = anchor("bone", {-0.01, 0.008, 2.4 * kSide});
  force.force = {2, -3, 4};
  scenario.loads = {force, gravity({0, 3, -9.81})};
  scenario.ligaments[0].damping = 0;  // it sets in with a kink, just here
  Forces scene(scenario, 0);
  Random random(2);
  const Eigen::VectorXd y = random_state(scene.model, 0.02, 0, random);
  scene.at(y);
  // The muscle is on the rising side of force-length: falling parts count as zero in the matrix.
  ASSERT_GT(scene.dynamics.now().lines[0].stiffness, 0);
  ASSERT_GT(scene.dynamics.now().lines[0].viscosity, 0);
  ASSERT_GT(scene.dynamics.now().lines[1].tension, 0);
  // Hill's curve changes its curvature at rest: differences are of first order there.
  EXPECT_LT(matrix_error(scene, y, 1e-6), 1e-5);
}

/// A stretched block with sheets on two of its sides, in part on nodes that go with a bone.
Scenario with_sheets(TissueMaterial::Element element) {
  Scenario scenario = everything_apart();
  scenario.muscles.clear();
  scenario.ligaments.clear();
  scenario.bodies[1].material->element = element;
  const auto sheet = [](const char* name, const Vec3& low, const Vec3& high, const Vec3& along) {
    Sheet made;
    made.name = name;
    made.at.tissue = "hung";
    made.at.region.box = {low, high};
    made.thickness = 1e-3;
    made.young_modulus = 1e5;
    made.toe_strain = 0.02;
    made.fibres = Fibres{along};
    return made;
  };
  const double side = 0.5 * kSide;
  scenario.sheets = {sheet("side", {side - 1e-6, -1, -1}, {1, 1, 1}, Vec3(0, 1, 2).normalized()),
                     sheet("below", {-1, -1, -1}, {1, 1, side + 1e-6}, Vec3::UnitX())};
  return scenario;
}

// Sheets pull on nodes of plain and of smoothed elements, on free ones and on those of a bone. What
// they add to the matrix is the derivative of what they add to the forces. As above, it lacks
// [τ]×/2 of their moment τ on the bone.
TEST(Dynamics, WithSheetsTheNewtonMatrixIsTheDerivativeOfTheForces) {
  for (const auto element : {TissueMaterial::Element::Plain, TissueMaterial::Element::Smoothed}) {
    Scenario bare = with_sheets(element);
    bare.sheets.clear();
    Forces with(with_sheets(element), 0), without(bare, 0);
    Random random(5);
    const Eigen::VectorXd y = random_state(with.model, 0.02, 0, random);
    const int count = 3 * with.model.layout.num_unknown_blocks();
    const auto pull = [&](const Eigen::VectorXd& there) -> Eigen::VectorXd {
      return with.at(there).head(count) - without.at(there).head(count);
    };
    const int bone = 3 * with.model.rigid_bodies[0].block;
    const Eigen::VectorXd force = pull(y);
    ASSERT_GT(force.head(bone).norm(), 0.01);
    ASSERT_GT(force.segment<3>(bone).norm(), 0.01);
    const auto matrix_product = [&](Forces& scene, const Eigen::VectorXd& w) {
      scene.at(y);
      return dense_product(scene.dynamics.assemble({0, 0, 1}, fem::Tangent::Consistent).A, w);
    };
    for (int n = 0; n < 6; ++n) {
      Eigen::VectorXd w = kSide * random.vector(count);
      w.segment<3>(bone + 3) /= kSide;
      Eigen::VectorXd K = matrix_product(with, w) - matrix_product(without, w);
      K.segment<3>(bone + 3) += 0.5 * force.segment<3>(bone + 3).cross(w.segment<3>(bone + 3));
      constexpr double kStep = 1e-6;
      const Eigen::VectorXd numeric =
          -(pull(moved(with.model, y, kStep * w)) - pull(moved(with.model, y, -kStep * w))) /
          (2 * kStep);
      EXPECT_LT((K - numeric).norm(), 1e-6 * numeric.norm());
    }
  }
}

// M + γ D + γ² K: D is half the difference of the matrices for γ and −γ, over γ.
TEST(Dynamics, TheNewtonMatrixsDampingIsTheDerivativeByTheVelocities) {
  Forces scene(everything_apart(), 0);
  const Model& model = scene.model;
  Random random(2);
  Eigen::VectorXd y = random_state(model, 0.02, 0.1, random);
  const int begin = model.layout.velocities(), count = 3 * model.layout.num_unknown_blocks();
  scene.at(y);
  if (scene.dynamics.now().lines[1].rate < 0) y.segment(begin, count) *= -1;
  scene.at(y);
  ASSERT_GT(scene.dynamics.now().lines[1].damping, 0);  // stretching: the damper works
  const double gamma = 1e-3, e = 1e-4;
  const Eigen::VectorXd w = random.vector(count);
  const Eigen::VectorXd D =
      0.5 / gamma *
      (dense_product(scene.dynamics.assemble({1, gamma, gamma * gamma}, fem::Tangent::Consistent).A,
                     w) -
       dense_product(
           scene.dynamics.assemble({1, -gamma, gamma * gamma}, fem::Tangent::Consistent).A, w));
  const auto at = [&](double by) -> Eigen::VectorXd {
    Eigen::VectorXd there = y;
    there.segment(begin, count) += by * w;
    return scene.at(there).head(count);
  };
  const Eigen::VectorXd numeric = -(at(e) - at(-e)) / (2 * e);
  EXPECT_LT((D - numeric).norm(), 1e-7 * numeric.norm());
}

TEST(Dynamics, AtRestTheNewtonMatrixIsTheDerivativeOfTheElasticForces) {
  Scenario scenario = everything_apart();
  scenario.muscles.clear();
  scenario.ligaments.clear();
  Forces scene(scenario, 0);
  EXPECT_LT(matrix_error(scene, initial_state(scene.model), 1e-4), 1e-7);
}

// Off the middle, where edges of one mesh lie over those of the other and forces have kinks.
TEST(Dynamics, InContactTheNewtonMatrixIsTheDerivativeOfTheForces) {
  for (const double depth : {1e-3 * kSide, 1e-2 * kSide}) {
    Scenario scenario = everything(depth);
    std::get<BoxGeometry>(scenario.bodies[2].geometry).center += Vec3(0.03, 0.02, 0) * kSide;
    scenario.muscles.clear();
    scenario.ligaments.clear();
    Forces scene(scenario, 0.1 * kSide);
    const Eigen::VectorXd y = initial_state(scene.model);
    scene.at(y);
    EXPECT_GT(scene.dynamics.contact_summary(0).area, 0.9 * 0.49 * kSide * kSide);
    EXPECT_LT(matrix_error(scene, y, 1e-3 * depth / kSide), 1e-7);
  }
}

// A box that is tilted and pressed in by its own pose: normals, levers and places of contact turn.
TEST(Dynamics, TheNewtonMatrixOfARigidBodyInContactIsTheDerivativeOfTheForces) {
  const double depth = 1e-2 * kSide;
  Scenario scenario = everything(depth);
  scenario.bodies[2] = box_body("free", Body::Kind::Rigid, {0.7 * kSide, 0.7 * kSide, kSide},
                                Vec3(0.03 * kSide, 0.02 * kSide, depth));
  scenario.muscles.clear();
  scenario.ligaments.clear();
  Forces scene(scenario, 0.1 * kSide);
  Eigen::VectorXd tilt = Eigen::VectorXd::Zero(3 * scene.model.layout.num_unknown_blocks());
  tilt.segment<3>(3 * scene.model.rigid_bodies[1].block + 3) << 4e-3, -3e-3, 0.02;
  const Eigen::VectorXd y = moved(scene.model, initial_state(scene.model), tilt);
  scene.at(y);
  ASSERT_GT(scene.dynamics.contact_summary(0).area, 0.5 * 0.49 * kSide * kSide);
  EXPECT_LT(matrix_error(scene, y, 1e-3 * depth / kSide), 1e-7);
}

// (I − γ ∂rate/∂y) x = b for the whole state vector, quaternions and activations too. The bone does
// not turn and nothing loads it: what the matrix leaves out vanishes.
TEST(Dynamics, TheNewtonSystemSolvesWithTheJacobianOfTheRate) {
  Scenario scenario = everything_apart();
  scenario.ligaments.clear();
  scenario.muscles[0].path = {anchor("frame", {0.05, 0.01, 0}),
                              anchor("free", {0.3 * kSide, 0, 0}, 0.5 * kSide)};
  scenario.muscles[0].optimal_length = 0.06;
  Forces scene(scenario, 0);
  const Model& model = scene.model;
  Random random(3);
  Eigen::VectorXd y = random_state(model, 0.02, 0, random);
  const Eigen::VectorXd start = initial_state(model);
  for (const Tissue& tissue : model.tissues)  // the hung block and the bone as they were
    for (const NodeRef& node : tissue.nodes)
      if (node.rigid < 0 && tissue.body == 1)
        y.segment<3>(model.layout.node_x(node.block)) =
            start.segment<3>(model.layout.node_x(node.block));
  y.segment<7>(model.layout.rigid_p(0)) = start.segment<7>(model.layout.rigid_p(0));

  const double gamma = 2e-3;
  const auto rate = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd result(at.size());
    scene.dynamics.evaluate(at.data(), 0);
    scene.dynamics.rate(at.data(), result.data());
    return result;
  };
  Eigen::VectorXd x = random.vector(y.size());
  x.head(model.layout.velocities()) *= gamma;
  const double e = 1e-5;
  const Eigen::VectorXd b = x - gamma / (2 * e) * (rate(y + e * x) - rate(y - e * x));

  scene.at(y);
  NewtonSystem newton(model, scene.dynamics);
  SolverCounts counts;
  Eigen::VectorXd solved(y.size());
  ASSERT_TRUE(newton.solve(y.data(), gamma, b.data(), solved.data(), {}, counts));
  EXPECT_EQ(counts.projected_tangents, 0);
  const auto split = model.layout.velocities();
  // Hill's curve changes its curvature at rest: differences are of first order there.
  EXPECT_LT((solved - x).head(split).norm(), 1e-4 * x.head(split).norm());
  EXPECT_LT((solved - x).tail(y.size() - split).norm(), 1e-4 * x.tail(y.size() - split).norm());
}

TEST(Dynamics, ASupportCarriesTheWholeWeightOfTheTissueThatHangsOnIt) {
  Scenario s = scene(1e-3);
  const Vec3 size(0.02, 0.02, 0.04);
  s.bodies = {box_body("block", Body::Kind::Tissue, size, Vec3::Zero(), {2, 2, 4}), stand("wall")};
  s.attachments = {attach("block", "wall", {-1, -1, 0.0199}, {1, 1, 1})};
  s.loads = {gravity({0, 0, -10})};
  s.integrator.step = 0.02;
  Simulation run(s);
  run.advance(4);  // implicit Euler's damping brings it to rest
  const double weight = 1000 * size.prod() * 10;
  EXPECT_NEAR(run.force_on(0).z(), -weight, 1e-6 * weight);
}

}  // namespace articular::sim::dynamics_test
