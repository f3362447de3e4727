// What a detection covers in a load step.
#include "sim/statics/contact_hooks.hpp"

#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_hooks_test {

Scenario block_above_floor() {
  Scenario s = contact_scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.02}, {0, 0, 0.02}, {2, 2, 2}),
              box_body("floor", Body::Kind::Fixed, {0.04, 0.04, 0.01}, {0, 0, -0.005}, {2, 2, 1})};
  return s;
}

// Two bodies may come nearer by the margin: each by half of it.
TEST(ContactHooks, ABodyMayMoveByHalfOfTheMargin) {
  const Model model = build_model(block_above_floor());
  ContactSearch search(model, {});
  Dynamics dynamics(model);
  for (const double part : {0.45, 0.55}) {
    Eigen::VectorXd y = initial_state(model);
    Configuration start;
    read_state(model, y.data(), 0, start);
    double margin = 1e-3;
    std::int64_t rejected = 0;
    const ContactHooks hooks = contact_hooks(model, search, dynamics, margin, rejected);
    hooks.find(start, 0);
    for (const NodeRef& node : model.tissues[0].nodes)
      y[model.layout.node_x(node.block) + 2] -= part * margin;
    dynamics.evaluate(y.data(), 0);
    EXPECT_EQ(hooks.covered(), part < 0.5);
    EXPECT_EQ(rejected, part < 0.5 ? 0 : 1);
  }
}

// Where a motion stays within what was found, nothing is looked for; else it is found for all of
// it.
TEST(ContactHooks, WhatMayLeaveWhatWasFoundIsLookedForAgain) {
  const Model model = build_model(block_above_floor());
  ContactSearch search(model, {});
  Dynamics dynamics(model);
  double margin = 1e-3;
  std::int64_t rejected = 0;
  const ContactHooks hooks = contact_hooks(model, search, dynamics, margin, rejected);
  Eigen::VectorXd y = initial_state(model);
  Configuration start;
  read_state(model, y.data(), 0, start);
  hooks.find(start, 0);
  const std::int64_t first = search.counts().tree_updates;
  hooks.cover(start, 0.45e-3);
  EXPECT_EQ(search.counts().tree_updates, first);
  hooks.cover(start, 0.55e-3);
  const std::int64_t second = search.counts().tree_updates;
  EXPECT_GT(second, first);
  hooks.cover(start, 3e-3);
  EXPECT_GT(search.counts().tree_updates, second);
  for (const NodeRef& node : model.tissues[0].nodes)
    y[model.layout.node_x(node.block) + 2] -= 2.9e-3;
  dynamics.evaluate(y.data(), 0);
  EXPECT_TRUE(hooks.covered());
}

}  // namespace articular::sim::contact_hooks_test
