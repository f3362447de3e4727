// The response of averaged depths from its energy to its tangent, between two tissues whose meshes
// don't match.
#include "sim/contact_response.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene.hpp"

namespace articular::sim {
namespace {

constexpr double kSide = 0.02;  // [m]

/// A block that has sunk into a wider one, all nodes displaced at random. The finer one's nodes
/// carry, and what is opposite them has no rim.
struct SunkBlock {
  SunkBlock() : model(build_model(scenario())), search(model), response(model) {
    Random random(1);
    y = initial_state(model);
    y.head(3 * model.layout.num_free_nodes) +=
        0.005 * kSide * random.vector(3 * model.layout.num_free_nodes);
    search.find(at(y), 0.01 * kSide);
  }

  static Scenario scenario() {
    Scenario s = scene(1e-3);
    s.analysis = Scenario::Analysis::Static;
    s.contact = true;
    s.bodies = {box_body("lower", Body::Kind::Tissue, {2 * kSide, 2 * kSide, kSide}, Vec3::Zero(),
                         {3, 3, 1}),
                box_body("upper", Body::Kind::Tissue, Vec3::Constant(kSide),
                         Vec3(0.1, 0.07, 0.96) * kSide, {3, 3, 2})};
    return s;
  }

  const Configuration& at(const Eigen::VectorXd& state) {
    read_state(model, state.data(), 0, configuration);
    return configuration;
  }
  double energy(const Eigen::VectorXd& state) {
    response.evaluate(at(state), search.candidates());
    return response.summaries(configuration)[0].energy;
  }
  Eigen::VectorXd forces(const Eigen::VectorXd& state) {
    response.evaluate(at(state), search.candidates());
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * model.num_blocks);
    response.add_force(configuration, f);
    return f;
  }
  /// The state moved by w of all free nodes.
  Eigen::VectorXd moved(const Eigen::VectorXd& w, double by) const {
    Eigen::VectorXd there = y;
    there.head(w.size()) += by * w;
    return there;
  }

  const Model model;
  ContactSearch search;
  ContactResponse response;
  Configuration configuration;
  Eigen::VectorXd y;
};

constexpr double kMove = 1e-4 * kSide;

TEST(AveragedContact, CarriesAtTheNodesOfOneSideOnly) {
  SunkBlock block;
  block.forces(block.y);
  ASSERT_EQ(block.search.candidates().size(), 1U);
  EXPECT_TRUE(block.search.candidates()[0].reversed);  // the second body's
  const ContactSummary sum = block.response.summaries(block.configuration)[0];
  EXPECT_NEAR(sum.area, kSide * kSide, 1e-12);
  EXPECT_GT(sum.max_depth, 0.03 * kSide);
}

TEST(AveragedContact, ForcesAreTheDerivativeOfTheEnergy) {
  SunkBlock block;
  Random random(2);
  for (int n = 0; n < 10; ++n) {
    const Eigen::VectorXd w = random.vector(3 * block.model.num_blocks);
    const double numeric =
        (block.energy(block.moved(w, kMove)) - block.energy(block.moved(w, -kMove))) / (2 * kMove);
    const Eigen::VectorXd f = block.forces(block.y);
    EXPECT_NEAR(numeric, -f.dot(w), 1e-6 * f.norm());
  }
}

TEST(AveragedContact, TheTangentIsTheDerivativeOfTheForces) {
  SunkBlock block;
  Random random(3);
  const std::vector<int> none, offsets{0};
  Stencils stencils;
  append_missing_stencils(block.model, block.search.candidates(),
                          fem::BlockMatrix(block.model.num_blocks, none, offsets), stencils);
  fem::BlockMatrix K(block.model.num_blocks, stencils.blocks, stencils.offsets);
  K.set_zero();
  block.response.evaluate(block.at(block.y), block.search.candidates());
  SystemScale scale;
  scale.stiffness = 1;
  block.response.add_stiffness(block.configuration, fem::Tangent::Consistent, scale, K);
  for (int n = 0; n < 5; ++n) {
    const Eigen::VectorXd w = random.vector(3 * block.model.num_blocks);
    const Eigen::VectorXd numeric =
        -(block.forces(block.moved(w, kMove)) - block.forces(block.moved(w, -kMove))) / (2 * kMove);
    Eigen::VectorXd product(w.size());
    K.multiply(w, product);
    EXPECT_LT((product - numeric).norm(), 1e-5 * numeric.norm());
  }
}

}  // namespace
}  // namespace articular::sim
