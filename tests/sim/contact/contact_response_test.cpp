// The response of averaged depths from its energy to its tangent, between two tissues whose meshes
// don't match.
#include "sim/contact/contact_response.hpp"
#include "sim/build/build_model.hpp"
#include "sim/contact/contact_stencils.hpp"
#include "sim/contact/contact_stiffness.hpp"
#include "sim/contact/contact_summary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_response_test {

constexpr double kSide = 0.02;  // [m]

/// A block that has sunk into a wider one, all nodes displaced at random. The finer one's nodes
/// carry.
struct SunkBlock {
  /// @param center  of the upper block [kSide]
  /// @param uneven  how far nodes are displaced [kSide]
  explicit SunkBlock(const Vec3& center = {0.1, 0.07, 0.96}, double uneven = 0.005)
      : SunkBlock(scenario(center), uneven) {}
  SunkBlock(const Scenario& scenario, double uneven)
      : model(build_model(scenario)), search(model, {}), response(model) {
    Random random(1);
    y = initial_state(model);
    y.head(3 * model.layout.num_free_nodes) +=
        uneven * kSide * random.vector(3 * model.layout.num_free_nodes);
    search.find(at(y), 0.01 * kSide);
  }

  static Scenario scenario(const Vec3& center) {
    Scenario s = scene(1e-3);
    s.analysis = Scenario::Analysis::Static;
    s.contact = true;
    s.bodies = {
        box_body("lower", Body::Kind::Tissue, {2 * kSide, 2 * kSide, kSide}, Vec3::Zero(),
                 {3, 3, 1}),
        box_body("upper", Body::Kind::Tissue, Vec3::Constant(kSide), center * kSide, {3, 3, 2})};
    return s;
  }

  const Configuration& at(const Eigen::VectorXd& state) {
    read_state(model, state.data(), 0, configuration);
    return configuration;
  }
  double energy(const Eigen::VectorXd& state) {
    response.evaluate(at(state), search.candidates(), {});
    return response.stored_energy();
  }
  Eigen::VectorXd forces(const Eigen::VectorXd& state) {
    response.evaluate(at(state), search.candidates(), {});
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * model.num_blocks);
    response.add_force(configuration, f);
    return f;
  }
  /// A way for all free nodes to go; none for bones.
  Eigen::VectorXd way(Random& random) const {
    Eigen::VectorXd w = Eigen::VectorXd::Zero(3 * model.num_blocks);
    w.head(3 * model.layout.num_free_nodes) = random.vector(3 * model.layout.num_free_nodes);
    return w;
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

constexpr double kMove = 2e-5 * kSide;

/// The upper block's underside is folded into ridges of 45 degrees, so that each of its triangles
/// there stands oblique to what it meets.
/// @param lower  its kind: a fixed one is flat
/// @param layer  on a fixed one
SunkBlock ridged_block(Body::Kind lower, const std::optional<Layer>& layer = {}) {
  constexpr int kCells = 12;
  constexpr double kCell = kSide / kCells;
  const TemporaryFolder folder;
  Scenario s = SunkBlock::scenario(Vec3::Zero());
  const BoxGeometry box{Vec3::Constant(kSide), {kCells, 3, 2}, {0.1 * kSide, 0.07 * kSide, kSide}};
  const double bottom = 0.5 * kSide;
  const auto fold = [&](Vec3 X) {
    const long column = std::lround((X.x() - box.center.x() + 0.5 * kSide) / kCell);
    if (X.z() < bottom + 1e-9) X.z() += column % 2 == 0 ? -0.9 * kCell : 0.1 * kCell;
    return X;
  };
  s.bodies[0].kind = lower;
  s.bodies[0].layer = layer;
  const Body upper = mesh_body("upper", Body::Kind::Tissue, bent(box, fold), folder);
  s.bodies[1].geometry = upper.geometry;
  return SunkBlock(s, 0.001);
}

TEST(AveragedContact, CarriesAtTheNodesOfOneSideOnly) {
  SunkBlock block;
  block.forces(block.y);
  ASSERT_EQ(block.search.candidates().size(), 1U);
  EXPECT_TRUE(block.model.contacts[0].reversed);  // the second body's
  const ContactSummary sum = contact_summaries(block.model, block.response, block.configuration)[0];
  EXPECT_NEAR(sum.area, kSide * kSide, 1e-12);
  EXPECT_GT(sum.max_depth, 0.03 * kSide);
}

/// In time, as statics has one response only.
Scenario in_time(Scenario::Response response) {
  Scenario s = SunkBlock::scenario({0.1, 0.07, 0.96});
  s.analysis = Scenario::Analysis::Dynamic;
  s.contact_response = response;
  return s;
}

// What steps need of all contacts, without a summary of each.
TEST(ContactResponse, StoresWhatTheSummariesOfItsContactsAddUpTo) {
  for (const auto response : {Scenario::Response::Averaged, Scenario::Response::Pointwise}) {
    SunkBlock block(in_time(response), 0.005);
    const double energy = block.energy(block.y);
    const ContactSummary sum =
        contact_summaries(block.model, block.response, block.configuration)[0];
    EXPECT_GT(energy, 0);
    EXPECT_NEAR(energy, sum.energy, 1e-12 * energy);
    EXPECT_GT(sum.max_depth, 0);
    EXPECT_EQ(block.response.node_depths().of(0), sum.max_depth);
  }
}

/// The largest difference between the forces along a way and differences of the energy, of their
/// size.
double error_of_forces(SunkBlock& block) {
  Random random(2);
  double error = 0;
  for (int n = 0; n < 10; ++n) {
    const Eigen::VectorXd w = block.way(random);
    const double numeric =
        (block.energy(block.moved(w, kMove)) - block.energy(block.moved(w, -kMove))) / (2 * kMove);
    const Eigen::VectorXd f = block.forces(block.y);
    error = std::max(error, std::abs(numeric + f.dot(w)) / f.norm());
  }
  return error;
}

TEST(AveragedContact, ForcesAreTheDerivativeOfTheEnergy) {
  SunkBlock block;
  EXPECT_LT(error_of_forces(block), 1e-6);
}

fem::BlockMatrix matrix_of(const SunkBlock& block, const Stencils& stencils) {
  return {block.model.num_blocks, stencils.blocks, stencils.offsets};
}

/// The tangent of the forces, in the pattern of all candidates.
fem::BlockMatrix tangent_of(SunkBlock& block) {
  Stencils stencils;
  append_missing_stencils(block.model, block.search.candidates(), matrix_of(block, {}), stencils);
  fem::BlockMatrix K = matrix_of(block, stencils);
  K.set_zero();
  block.response.evaluate(block.at(block.y), block.search.candidates(), {});
  SystemScale scale;
  scale.stiffness = 1;
  ContactStiffness stiffness(block.model);
  FrictionCoupling friction;
  for (const ContactPairState* direction : block.response.pair_states())
    stiffness.add(*direction, block.configuration, fem::Tangent::Consistent, scale, K, friction);
  return K;
}

/// The largest difference between the tangent and differences of the forces, of these.
double error_of_tangent(SunkBlock& block) {
  Random random(3);
  const fem::BlockMatrix K = tangent_of(block);
  double error = 0;
  for (int n = 0; n < 5; ++n) {
    const Eigen::VectorXd w = block.way(random);
    const Eigen::VectorXd numeric =
        -(block.forces(block.moved(w, kMove)) - block.forces(block.moved(w, -kMove))) / (2 * kMove);
    Eigen::VectorXd product(w.size());
    K.multiply(w, product);
    const Eigen::Index free = 3 * block.model.layout.num_free_nodes;
    error = std::max(error, (product - numeric).head(free).norm() / numeric.head(free).norm());
  }
  return error;
}

TEST(AveragedContact, TheTangentIsTheDerivativeOfTheForces) {
  SunkBlock block;
  EXPECT_LT(error_of_tangent(block), 1e-5);
}

/// On bone with a layer that stiffens, pressed in by half of its thickness, more or less.
Scenario block_on_a_layer(Scenario::Analysis analysis) {
  Scenario s = SunkBlock::scenario({0.1, 0.07, 0.98});
  s.analysis = analysis;
  s.bodies[0].kind = Body::Kind::Fixed;
  s.bodies[0].layer = Layer{0.035 * kSide, 20e3, 0.3, Layer::Law::Logarithmic};
  return s;
}

// The layer and the elements of the block give way in series.
TEST(AveragedContact, OnALayerThatStiffensForcesAndTangentAreDerivatives) {
  for (const auto analysis : {Scenario::Analysis::Static, Scenario::Analysis::Dynamic}) {
    SunkBlock block(block_on_a_layer(analysis), 0.005);
    const double energy = block.energy(block.y);
    const ContactPairState& pair_state = *block.response.pair_states()[0];
    double stiffest = 0;
    for (const int group : pair_state.groups)
      stiffest = std::max(stiffest, pair_state.slope(group) / pair_state.stiffness(group));
    EXPECT_GT(stiffest, 1.5);
    const ContactSummary sum =
        contact_summaries(block.model, block.response, block.configuration)[0];
    EXPECT_NEAR(energy, sum.energy, 1e-12 * energy);
    EXPECT_LT(error_of_forces(block), 1e-6);
    EXPECT_LT(error_of_tangent(block), 1e-5);
  }
}

// Just those pairs of blocks are needed that the tangent has a stiffness between.
TEST(ContactStencils, AreLackedWhereAForceCouplesWhatThePatternDoesNot) {
  for (const auto response : {Scenario::Response::Averaged, Scenario::Response::Pointwise}) {
    SunkBlock block(in_time(response), 0.005);
    const fem::BlockMatrix K = tangent_of(block);
    std::vector<std::array<int, 2>> needed;
    for (int i = 0; i < K.num_blocks(); ++i)
      for (int slot = K.row_begin()[i]; K.column()[slot] < i; ++slot)
        if (!K.block(slot).isZero(0)) needed.push_back({i, K.column()[slot]});
    BlocksOfGroups blocks;
    const auto lacks = [&](const fem::BlockMatrix& A) {
      return lacks_stencils(block.model, block.response.pair_states(), A, blocks);
    };
    const auto all_but = [&](std::size_t left_out) {
      Stencils stencils;
      for (std::size_t k = 0; k < needed.size(); ++k) {
        if (k == left_out) continue;
        stencils.blocks.insert(stencils.blocks.end(), needed[k].begin(), needed[k].end());
        stencils.close();
      }
      return matrix_of(block, stencils);
    };
    ASSERT_EQ(block.model.contacts[0].averaged, response == Scenario::Response::Averaged);
    ASSERT_GT(needed.size(), 100U);
    EXPECT_FALSE(lacks(K));
    EXPECT_FALSE(lacks(all_but(needed.size())));
    // Pointwise, nodes of one face are coupled by their element at any rate.
    const auto is_of_element = [&](const std::array<int, 2>& pair) {
      const auto is_lower = [&](int b) { return b < block.model.tissues[1].nodes[0].block; };
      return response == Scenario::Response::Pointwise && is_lower(pair[0]) == is_lower(pair[1]);
    };
    for (std::size_t k = 0; k < needed.size(); k += 7)
      EXPECT_NE(lacks(all_but(k)), is_of_element(needed[k])) << k;
  }
}

// The means' areas A_a turn with the patches too, and the next face takes over but a part of what
// an edge sweeps.
TEST(AveragedContact, ForcesAreTheDerivativeOfTheEnergyWhereFacesStandOblique) {
  SunkBlock block = ridged_block(Body::Kind::Tissue);
  block.forces(block.y);
  ASSERT_GT(block.response.pair_states()[0]->num_patches, 50U);
  for (const ContactPairState::Patch& entry : block.response.pair_states()[0]->patches())
    EXPECT_NE(entry.patch.turning, 0);
  EXPECT_LT(error_of_forces(block), 1e-6);
}

TEST(AveragedContact, TheTangentIsTheDerivativeOfTheForcesWhereFacesStandOblique) {
  SunkBlock block = ridged_block(Body::Kind::Fixed);
  EXPECT_LT(error_of_tangent(block), 1e-5);
  SunkBlock on_layer =
      ridged_block(Body::Kind::Fixed, Layer{0.1 * kSide, 20e3, 0.3, Layer::Law::Logarithmic});
  EXPECT_LT(error_of_forces(on_layer), 1e-6);
  EXPECT_LT(error_of_tangent(on_layer), 1e-5);
}

/// Beyond x = 0 the lower block's top rises by 58 degrees. What has sunk in there falls off by 20:
/// it faces the top wholly, and the slope not at all.
SunkBlock block_before_a_slope() {
  constexpr double kCell = kSide / 3;
  const TemporaryFolder folder;
  Scenario s = SunkBlock::scenario(Vec3::Zero());
  const auto rise = [&](Vec3 X) {
    if (X.z() > 0.5 * kSide - 1e-9 && X.x() > 0.5 * kCell)
      X.z() += std::tan(58 * std::numbers::pi / 180) * kCell;
    return X;
  };
  const auto fall = [&](Vec3 X) {
    X.z() -= std::tan(20 * std::numbers::pi / 180) * X.x();
    return X;
  };
  const BoxGeometry below{{2 * kSide, 2 * kSide, kSide}, {6, 3, 1}, Vec3::Zero()};
  const BoxGeometry above{
      {0.3 * kSide, kSide, 0.5 * kSide}, {3, 4, 2}, {-0.1 * kSide, 0.07 * kSide, 0.73 * kSide}};
  s.bodies[0].geometry = mesh_body("lower", Body::Kind::Tissue, bent(below, rise), folder).geometry;
  s.bodies[1].geometry = mesh_body("upper", Body::Kind::Tissue, bent(above, fall), folder).geometry;
  return SunkBlock(s, 0.001);
}

// No other patch takes over at the edge what the ones before it sweep.
TEST(AveragedContact, ForcesAreTheDerivativeOfTheEnergyBeforeASlopeThatDoesNotFace) {
  SunkBlock block = block_before_a_slope();
  block.forces(block.y);
  ASSERT_GT(block.response.pair_states()[0]->num_patches, 20U);
  for (const ContactPairState::Patch& entry : block.response.pair_states()[0]->patches())
    EXPECT_EQ(entry.patch.turning, 0);
  EXPECT_LT(error_of_forces(block), 1e-6);
  EXPECT_LT(error_of_tangent(block), 1e-5);
}

/// A block that has sunk in over an edge of the lower one [kSide], tilted along it.
struct BlockOverAnEdge : SunkBlock {
  BlockOverAnEdge(double depth, double tilt) : SunkBlock({0.8, 0.07, 1 - depth}, 0.1 * depth) {
    for (const NodeRef& node : model.tissues[1].nodes)
      y[3 * node.block + 2] += tilt * y[3 * node.block + 1];
  }
};

// Where surfaces slip off each other, energy is kept only so.
TEST(AveragedContact, OverAnEdgeForcesAreTheDerivativeOfTheEnergy) {
  BlockOverAnEdge block(0.05, 0.2);
  block.forces(block.y);
  int at_rims = 0, open = 0;
  for (const ContactPairState::Patch& entry : block.response.pair_states()[0]->patches())
    for (int k = 0; k < entry.patch.num_edges; ++k) {
      const PatchEdge& edge = entry.patch.edge[static_cast<std::size_t>(k)];
      at_rims += edge.is_end && edge.kind == PatchEdge::Kind::FaceEdge ? 1 : 0;
      open += edge.kind == PatchEdge::Kind::OpenDepth ? 1 : 0;
    }
  EXPECT_GT(at_rims, 3);
  EXPECT_GT(open, 3);
  EXPECT_LT(error_of_forces(block), 1e-6);
}

/// The largest change of the forces from step to step as a tilted block comes down onto the other.
double largest_change(int num_steps) {
  BlockOverAnEdge block(-0.05, 0.06);
  Eigen::VectorXd down = Eigen::VectorXd::Zero(3 * block.model.num_blocks);
  for (const NodeRef& node : block.model.tissues[1].nodes) down[3 * node.block + 2] = -0.15 * kSide;
  double largest = 0;
  Eigen::VectorXd before = block.forces(block.y);
  EXPECT_EQ(before.norm(), 0);
  for (int step = 1; step <= num_steps; ++step) {
    const Eigen::VectorXd f = block.forces(block.moved(down, double(step) / num_steps));
    largest = std::max(largest, (f - before).norm());
    before = f;
  }
  EXPECT_GT(before.norm(), 0);
  return largest;
}

// Nor where a triangle begins to count beside others that carry: else Newton's method goes to and
// fro across the jump.
TEST(AveragedContact, ForcesDoNotJumpWhereSurfacesMeet) {
  const double change = largest_change(200), half = largest_change(400);
  EXPECT_NEAR(change / half, 2, 0.1);
}

TEST(AveragedContact, OverAnEdgeTheTangentIsTheDerivativeOfTheForces) {
  for (const double depth : {0.05, 0.01}) {
    BlockOverAnEdge block(depth, 2 * depth);
    EXPECT_LT(error_of_tangent(block), 1e-5);
  }
}

}  // namespace articular::sim::contact_response_test
