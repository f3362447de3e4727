// Who may touch whom, and how much of it counts.
#include "sim/contact/contact_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "fem/mesh/mesh_parts.hpp"
#include "sim/build/build_model.hpp"
#include "sim/contact/contact_summary.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_search_test {

constexpr double kAbove = 0.1;  // [m]

/// A small fixed box above a block of tissue. Moved down by kAbove it lies wholly inside it: no
/// triangle of the tissue is in it.
Scenario block_and_seed() {
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.1, 0.1, 0.1}, Vec3::Zero(), {10, 10, 10}),
              box_body("seed", Body::Kind::Fixed, {0.012, 0.012, 0.012},
                       {0.002, 0.001, 0.021 + kAbove}, {2, 2, 2})};
  return s;
}

TEST(ContactSearch, WhatLiesDeepInsideTheNonMortarSideIsACandidateOfItsFaces) {
  for (const Detection::Tree tree : {Detection::Tree::Blocks, Detection::Tree::Buckets}) {
    Scenario scenario = block_and_seed();
    scenario.detection.tree = tree;
    const Model model = build_model(scenario);
    ASSERT_EQ(model.contacts.size(), 1U);
    ASSERT_FALSE(model.contacts[0].reversed);  // the block's triangles look for the seed's faces
    ContactSearch search(model, step_settings(scenario));
    Configuration now;
    read_state(model, initial_state(model).data(), 0, now);
    now.poses[0].p.z() -= kAbove;
    search.find(now, model.detection_margin);
    ASSERT_EQ(search.candidates().size(), 1U);
    const DepthRange range =
        depth_range(*model.bodies[0].collider, *model.bodies[1].collider, true);
    for (const ContactCandidate& candidate : search.candidates()[0].pairs) {
      EXPECT_GT(candidate.reach, range.reach);
      EXPECT_LT(candidate.triangle, model.bodies[0].collider->surface.faces.cols());
      EXPECT_LT(candidate.face, model.bodies[1].collider->surface.faces.cols());
    }
    EXPECT_GT(search.counts().deep_pairs, 0);
  }
}

/// A plate of elements of 1 mm that touches itself.
Model plate_model() {
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("plate", Body::Kind::Tissue, {8e-3, 8e-3, 1e-3}, Vec3::Zero(), {8, 8, 1})};
  ContactPair itself;
  itself.a = itself.b = "plate";
  s.contacts = {itself};
  return build_model(s);
}

TEST(ContactSearch, TrianglesAreTwoSidesWithTheFacesOppositeInTheSamePart) {
  const Model model = plate_model();
  const Collider& plate = *model.bodies[0].collider;
  const auto middle = [&](int k) -> Vec3 {
    return plate.X(Eigen::all, plate.surface.faces.col(k)).rowwise().mean();
  };
  const std::vector<int> part = fem::parts_of_nodes(static_cast<int>(plate.X.cols()), plate.tets);
  int two_sides = 0;
  for (int s = 0; s < plate.surface.faces.cols(); ++s)
    for (int f = 0; f < plate.surface.faces.cols(); ++f) {
      const Vec3 way = middle(s) - middle(f);
      const bool through = std::abs(std::abs(way.z()) - 1e-3) < 1e-9;
      if (!are_two_sides(plate, part, s, f)) {
        EXPECT_FALSE(through && way.head<2>().norm() < 1e-3);
        continue;
      }
      ++two_sides;
      EXPECT_LT(way.head<2>().norm(), 2e-3);
      EXPECT_TRUE(are_two_sides(plate, part, f, s));
    }
  EXPECT_GT(two_sides, 2 * plate.surface.faces.cols());
}

// Pressed to a fifth, and its upper side through the lower one along a line, triangles lie in
// elements that are not theirs, as shallow behind the other side as what came in through it.
TEST(ContactSearch, TheTwoSidesOfAThinPlateAreNoCandidates) {
  const Model model = plate_model();
  Configuration now;
  read_state(model, initial_state(model).data(), 0, now);
  for (const NodeRef& node : model.tissues[0].nodes) {
    auto x = now.x.col(node.block);
    const bool upper = x.z() > 0;
    x.z() = upper && std::abs(x.x()) < 0.1e-3 ? -0.9e-3 : 0.2 * x.z();
  }
  ContactSearch search(model, step_settings(contact_scene(1e-3)));
  search.find(now, model.detection_margin);
  EXPECT_GT(search.counts().narrow_tests, 0);
  EXPECT_TRUE(search.candidates().empty());
}

MeshData block(const Vec3& center) { return box_mesh({{0.02, 0.02, 0.01}, {4, 4, 2}, center}); }

MeshData joined(const MeshData& p, const MeshData& q) {
  MeshData both = p;
  both.X.conservativeResize(3, p.X.cols() + q.X.cols());
  both.X.rightCols(q.X.cols()) = q.X;
  both.tets.conservativeResize(4, p.tets.cols() + q.tets.cols());
  both.tets.rightCols(q.tets.cols()) = q.tets.array() + static_cast<int>(p.X.cols());
  return both;
}

/// The sum of the contact forces that push upwards [N].
double force_upwards(const Simulation& run) {
  double sum = 0;
  for (const Positions& forces : run.stepper.contact_forces())
    sum += forces.row(2).cwiseMax(0).sum();
  return sum;
}

// Two blocks press each other as much as one tissue of two pieces presses itself, though there each
// piece looks for the other.
TEST(ContactSearch, ABodyInTwoPiecesPressesItselfAsTwoBodiesPressEachOther) {
  const double overlap = 1e-4;
  const MeshData lower = block({0, 0, -0.005}), upper = block({0, 0, 0.005 - overlap});
  for (const auto response : {Scenario::Response::Pointwise, Scenario::Response::Averaged}) {
    const TemporaryFolder folder;
    Scenario two = contact_scene(1e-3), one = two;
    two.contact_response = one.contact_response = response;
    two.bodies = {mesh_body("lower", Body::Kind::Tissue, lower, folder),
                  mesh_body("upper", Body::Kind::Tissue, upper, folder)};
    one.bodies = {mesh_body("both", Body::Kind::Tissue, joined(lower, upper), folder)};
    ContactPair itself;
    itself.a = itself.b = "both";
    one.contacts = {itself};
    const Simulation apart(two), together(one);
    EXPECT_GT(force_upwards(apart), 0);
    EXPECT_NEAR(force_upwards(together), force_upwards(apart), 1e-6 * force_upwards(apart));
  }
}

/// Two blocks, or one tissue in two pieces, of which the upper one comes down on the lower one.
Scenario pressed(bool is_one, Scenario::Response response, const TemporaryFolder& folder) {
  const MeshData lower = block({0, 0, -0.005}), upper = block({0, 0, 0.005 - 1e-4});
  Scenario s = contact_scene(1e-3);
  s.contact_response = response;
  ContactPair pair;
  pair.a = is_one ? "both" : "lower";
  pair.b = is_one ? "both" : "upper";
  pair.damping = 1e5;
  s.contacts = {pair};
  if (is_one)
    s.bodies = {mesh_body("both", Body::Kind::Tissue, joined(lower, upper), folder)};
  else
    s.bodies = {mesh_body("lower", Body::Kind::Tissue, lower, folder),
                mesh_body("upper", Body::Kind::Tissue, upper, folder)};
  return s;
}

/// Lets the upper block move downwards [m/s].
void throw_down(double speed, Simulation& run) {
  std::size_t node = 0;  // of the lower block first, of either scene
  const std::size_t num_lower = 5 * 5 * 3;
  for (const Tissue& tissue : run.model.tissues)
    for (const NodeRef& moved : tissue.nodes)
      if (node++ >= num_lower)
        run.state.y[run.model.layout.velocities() + 3 * moved.block + 2] = -speed;
  run.stepper.restart(run.state);
}

// The same with dampers, and in what is told of the contact as a whole.
TEST(ContactSearch, ABodyInTwoPiecesTellsOfItselfWhatTwoBodiesTell) {
  constexpr double kPart = 1e-6;
  for (const auto response : {Scenario::Response::Pointwise, Scenario::Response::Averaged}) {
    const TemporaryFolder of_two, of_one;
    Simulation apart(pressed(false, response, of_two)), together(pressed(true, response, of_one));
    const double undamped = force_upwards(apart);
    throw_down(0.1, apart);
    throw_down(0.1, together);
    EXPECT_GT(force_upwards(apart), 1.2 * undamped);
    EXPECT_NEAR(force_upwards(together), force_upwards(apart), kPart * force_upwards(apart));
    const ContactSummary two = apart.stepper.dynamics().contact_summary(0),
                         one = together.stepper.dynamics().contact_summary(0);
    EXPECT_NEAR(one.area, two.area, kPart * two.area);
    EXPECT_NEAR(one.normal_force, two.normal_force, kPart * two.normal_force);
    EXPECT_NEAR(one.max_pressure, two.max_pressure, kPart * two.max_pressure);
    EXPECT_NEAR(one.energy, two.energy, kPart * two.energy);
    EXPECT_NEAR(one.max_depth, two.max_depth, kPart * two.max_depth);
    EXPECT_NEAR(together.stepper.now().contact.damping_power(),
                apart.stepper.now().contact.damping_power(),
                kPart * apart.stepper.now().contact.damping_power());
  }
}

/// By node, of all bodies [Pa].
std::vector<double> nodal_pressures_of(const Simulation& run) {
  std::vector<double> all;
  for (const SurfaceContact& surface :
       surface_contacts(run.model, run.stepper.now().contact, run.now()))
    all.insert(all.end(), surface.node_pressure.begin(), surface.node_pressure.end());
  return all;
}

// Of two bodies one looks for the other, of a body with itself each piece does, with half of the
// stiffness: as ∫ N p dA counts on either side, it makes no difference here.
TEST(ContactSearch, ABodyInTwoPiecesHasThePressuresOfTwoBodiesAtItsNodes) {
  for (const auto response : {Scenario::Response::Pointwise, Scenario::Response::Averaged}) {
    const TemporaryFolder of_two, of_one;
    const Simulation apart(pressed(false, response, of_two)),
        together(pressed(true, response, of_one));
    const std::vector<double> two = nodal_pressures_of(apart), one = nodal_pressures_of(together);
    ASSERT_EQ(one.size(), two.size());
    const double largest = *std::max_element(two.begin(), two.end());
    EXPECT_GT(largest, 0);
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i], two[i], 1e-9 * largest) << i;
  }
}

/// A block over a wider table, which it is this deep in.
Scenario on_a_table(double depth) {
  Scenario s = contact_scene(1e-3);
  s.contact_response = Scenario::Response::Averaged;
  s.bodies = {
      box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.02}, {0, 0, 0.01 - depth}, {4, 4, 4}),
      box_body("table", Body::Kind::Fixed, {0.06, 0.06, 0.02}, {0, 0, -0.01}, {6, 6, 2})};
  return s;
}

/// All candidates of a block in or above a table, with this margin.
std::vector<ContactCandidate> candidates_at(double depth, double margin) {
  const Model model = build_model(on_a_table(depth));
  ContactSearch search(model, {});
  Configuration now;
  read_state(model, initial_state(model).data(), 0, now);
  search.find(now, margin);
  std::vector<ContactCandidate> all;
  for (const CandidateList& list : search.candidates())
    all.insert(all.end(), list.pairs.begin(), list.pairs.end());
  return all;
}

// Triangles a bit deeper than faces reach are found by their nearness and by their depth: the
// latter reaches them.
TEST(ContactSearch, OfAPairThatIsFoundTwiceTheOneThatReachesDeeperIsKept) {
  const Model model = build_model(on_a_table(0));
  ASSERT_FALSE(model.contacts[0].reversed);
  const double reach =
      depth_range(*model.bodies[0].collider, *model.bodies[1].collider, true).reach;
  const double margin = 0.2 * reach, depth = reach + 0.5 * margin;
  const std::vector<ContactCandidate> found = candidates_at(depth, margin);
  EXPECT_GT(found.size(), 32U);
  for (const ContactCandidate& candidate : found) EXPECT_GT(candidate.reach, depth);
}

// A side of the block sinks in with it, and looks through the block towards the side of the table
// that is nearest behind it. That one is outside the block.
TEST(ContactSearch, ASideThatIsOutsideTheOtherBodyIsNoCandidate) {
  constexpr double kWidth = 0.006, kDip = 2e-4, kInFromSide = 1e-3;
  Scenario s = contact_scene(1e-3);
  s.contact_response = Scenario::Response::Pointwise;
  s.bodies = {box_body("block", Body::Kind::Tissue, {kWidth, 0.02, 0.02},
                       {kInFromSide + kWidth / 2, 0, 0.01 - kDip}, {1, 1, 1}),
              box_body("table", Body::Kind::Fixed, {0.03, 0.03, 0.03}, {0.015, 0, -0.015})};
  const Model model = build_model(s);
  ASSERT_FALSE(model.contacts[0].reversed);
  const Collider& table = *model.bodies[1].collider;
  ASSERT_GT(depth_range(*model.bodies[0].collider, table, false).reach, kInFromSide + kWidth);
  ContactSearch search(model, {});
  Configuration now;
  read_state(model, initial_state(model).data(), 0, now);
  search.find(now, 1e-6);
  ASSERT_EQ(search.candidates().size(), 1U);
  for (const ContactCandidate& candidate : search.candidates()[0].pairs)
    for (const int node : table.surface.faces.col(candidate.face))
      EXPECT_NEAR(table.X(2, node), 0, 1e-12);
}

// It is nowhere near the block at first.
TEST(ContactSearch, ADrivenBodyIsFoundWhereItWasDrivenTo) {
  Scenario s = on_a_table(-0.01);
  s.loads = {shift("table", 1, {0, 0, 0.011})};
  const Model model = build_model(s);
  ContactSearch search(model, {});
  Configuration now;
  for (const double t : {0.0, 1.0}) {
    read_state(model, initial_state(model).data(), t, now);
    search.find(now, 1e-4);
    EXPECT_EQ(search.candidates().empty(), t == 0) << t;
  }
}

// Pressure begins the open depth in front of a face: pairs are found that far beyond the margin.
TEST(ContactSearch, FindsPairsAsFarApartAsTheMarginAndTheOpenDepth) {
  const Model model = build_model(on_a_table(0));
  const double open = depth_range(*model.bodies[0].collider, *model.bodies[1].collider, true).open;
  ASSERT_GT(open, 0);
  const double margin = 0.5 * open;
  EXPECT_FALSE(candidates_at(-0.99 * (margin + open), margin).empty());
  EXPECT_TRUE(candidates_at(-4 * (margin + open), margin).empty());
}

// One block passes through another from any side, or one of its corners does.
TEST(ContactSearch, SeesWhatPassesTheOtherBodyUnseen) {
  const double size = 0.02, way = 0.06;
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) {
    Scenario s = contact_scene(1e-3);
    s.bodies = {
        box_body("a", Body::Kind::Tissue, Vec3::Constant(size), -0.5 * way * direction, {2, 2, 2}),
        box_body("b", Body::Kind::Tissue, Vec3::Constant(size), Vec3::Zero(), {2, 2, 2})};
    const Model model = build_model(s);
    ContactSearch search(model, {});
    const Eigen::VectorXd start = initial_state(model);
    Configuration from, to;
    read_state(model, start.data(), 0, from);
    const auto passes = [&](auto&& way_of) {  // of a tissue's node
      Eigen::VectorXd y = start;
      for (std::size_t t = 0; t < 2; ++t)
        for (std::size_t i = 0; i < model.tissues[t].nodes.size(); ++i)
          y.segment<3>(model.layout.node_x(model.tissues[t].nodes[i].block)) +=
              way_of(t, model.tissues[t].X.col(static_cast<Eigen::Index>(i)));
      read_state(model, y.data(), 0, to);
      return search.passes_unseen(from, to);
    };
    const Vec3 through = way * direction;
    const auto only = [&](bool moves, const Vec3& by) -> Vec3 {
      return moves ? 1.0 * by : 0.0 * by;
    };
    EXPECT_FALSE(passes([&](std::size_t, const Vec3&) { return only(false, through); }));
    EXPECT_TRUE(passes([&](std::size_t t, const Vec3&) { return only(t == 0, through); }));
    EXPECT_TRUE(passes([&](std::size_t t, const Vec3&) { return only(t == 1, -through); }));
    EXPECT_FALSE(passes([&](std::size_t, const Vec3&) { return only(true, through); }));
    EXPECT_FALSE(passes([&](std::size_t t, const Vec3&) { return only(t == 0, -through); }));
    const auto is_front = [&](const Vec3& X) {
      return (X.dot(direction) + 0.5 * way) > 0.4 * size;
    };
    EXPECT_TRUE(
        passes([&](std::size_t t, const Vec3& X) { return only(t == 0 && is_front(X), through); }));
  }
}

}  // namespace articular::sim::contact_search_test
