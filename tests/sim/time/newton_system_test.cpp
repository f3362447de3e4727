// Newton's corrections of implicit Euler where contacts open and close.
#include "sim/time/newton_system.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "sim/build/build_model.hpp"
#include "sim/contact/contact_search.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/found_contacts.hpp"

namespace articular::sim::newton_system_test {

constexpr double kSide = 0.02, kStep = 0.01;  // [m], [s]

/// A block just above a wider one or a little into it, all nodes displaced a little at random:
/// around some they touch, around others they are apart.
struct UnevenBlocks {
  /// @param speed  of the upper one, upwards [m/s]
  UnevenBlocks(TissueMaterial::Element element, double speed)
      : model(build_model(scenario(element))), search(model, {}), dynamics(model) {
    Random random(1);
    const int n = 3 * model.layout.num_free_nodes;
    y = initial_state(model);
    y.head(n) += 5e-4 * kSide * random.vector(n);
    for (const NodeRef& node : model.tissues[1].nodes)
      y[model.layout.velocities() + 3 * node.block + 2] = speed;
    find_contacts(model, y, 0.1 * kSide, search, dynamics);
  }

  static Scenario scenario(TissueMaterial::Element element) {
    Scenario s = contact_scene(kStep);
    s.bodies = {box_body("lower", Body::Kind::Tissue, {2 * kSide, 2 * kSide, kSide}, Vec3::Zero(),
                         {8, 8, 2}),
                box_body("upper", Body::Kind::Tissue, Vec3::Constant(kSide),
                         Vec3(0.1, 0.07, 1) * kSide, {6, 6, 2})};
    for (Body& body : s.bodies) {
      body.material = neo_hookean(1e5, 0.45);
      body.material->element = element;
    }
    return s;
  }

  /// By how much the first correction of a step divides the residual of the velocities.
  double fall_of_residual() {
    NewtonSystem newton(model, dynamics);
    newton.begin_step(false, fem::Tangent::Consistent);
    newton.begin_iteration();
    const Eigen::VectorXd b = residual(y);
    Eigen::VectorXd x(y.size());
    EXPECT_TRUE(newton.solve(y.data(), kStep, b.data(), x.data(), {}, counts));
    EXPECT_FALSE(newton.changed());
    const int first = model.layout.velocities();
    return b.tail(b.size() - first).norm() / residual(y + x).tail(b.size() - first).norm();
  }
  /// y + h f(z) − z
  Eigen::VectorXd residual(const Eigen::VectorXd& z) {
    Eigen::VectorXd rate(y.size());
    dynamics.evaluate(z.data(), kStep);
    dynamics.rate(z.data(), rate.data());
    return y + kStep * rate - z;
  }

  const Model model;
  ContactSearch search;
  Dynamics dynamics;
  SolverCounts counts;
  Eigen::VectorXd y;
};

// The parameter is the kind of element, without and with pressures, and the upper block's speed
// upwards [m/s]: contacts close, or open.
class FirstCorrection : public testing::TestWithParam<std::pair<TissueMaterial::Element, double>> {
};

// With the contacts of the start alone it is 0.3 to 0.8 where they close: more is off than before.
TEST_P(FirstCorrection, LeadsToTheContactsThatThereAre) {
  const auto& [element, speed] = GetParam();
  EXPECT_GT(UnevenBlocks(element, speed).fall_of_residual(), 8);
}
INSTANTIATE_TEST_SUITE_P(All, FirstCorrection,
                         testing::Values(std::pair(TissueMaterial::Element::Plain, -0.1),
                                         std::pair(TissueMaterial::Element::Plain, 0.05),
                                         std::pair(TissueMaterial::Element::Smoothed, -0.02),
                                         std::pair(TissueMaterial::Element::Smoothed, -0.05),
                                         std::pair(TissueMaterial::Element::Smoothed, 0.05)));

}  // namespace articular::sim::newton_system_test
