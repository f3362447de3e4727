// Who may touch whom, and how much of it counts.
#include "sim/contact/contact_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/build/build_model.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_search_test {

/// A small fixed box that lies wholly inside a block of tissue: no triangle of the tissue is in it.
Scenario swallowed() {
  Scenario s = contact_scene(1e-3);
  s.bodies = {
      box_body("block", Body::Kind::Tissue, {0.1, 0.1, 0.1}, Vec3::Zero(), {10, 10, 10}),
      box_body("seed", Body::Kind::Fixed, {0.012, 0.012, 0.012}, {0.002, 0.001, 0.021}, {2, 2, 2})};
  return s;
}

TEST(ContactSearch, WhatLiesDeepInsideTheNonMortarSideIsACandidateOfItsFaces) {
  for (const Detection::Tree tree : {Detection::Tree::Blocks, Detection::Tree::Buckets}) {
    Scenario scenario = swallowed();
    scenario.detection.tree = tree;
    const Model model = build_model(scenario);
    ASSERT_EQ(model.contacts.size(), 1U);
    ASSERT_FALSE(model.contacts[0].reversed);  // the block's triangles look for the seed's faces
    ContactSearch search(model, step_settings(scenario));
    Configuration now;
    read_state(model, initial_state(model).data(), 0, now);
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

}  // namespace articular::sim::contact_search_test
