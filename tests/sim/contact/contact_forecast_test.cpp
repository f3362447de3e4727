// What a correction is foreseen to open and close, between two tissues whose meshes don't match.
#include "sim/contact/contact_forecast.hpp"
#include "sim/assembly/dynamics.hpp"
#include "sim/build/build_model.hpp"
#include "sim/contact/contact_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/found_contacts.hpp"

namespace articular::sim::contact_forecast_test {

using Foreseen = ContactPairState::Foreseen;

constexpr double kSide = 0.02;  // [m]

/// A block on a wider one, all nodes displaced at random: around some nodes they touch, around
/// others they are apart.
struct UnevenBlocks {
  /// @param stiffens  between them is a layer that does
  explicit UnevenBlocks(bool stiffens = false)
      : model(model_of(stiffens)), search(model, {}), dynamics(model), forecast(model) {
    Random random(1);
    const int n = 3 * model.layout.num_free_nodes;
    y = initial_state(model);
    y.head(n) += 0.02 * kSide * random.vector(n);
    find_contacts(model, y, 0.1 * kSide, search, dynamics);
    dynamics.evaluate(y.data(), 0);
  }

  static Scenario scenario() {
    Scenario s = scene(1e-3);
    s.analysis = Scenario::Analysis::Static;
    s.contact = true;
    s.bodies = {box_body("lower", Body::Kind::Tissue, {2 * kSide, 2 * kSide, kSide}, Vec3::Zero(),
                         {5, 5, 1}),
                box_body("upper", Body::Kind::Tissue, Vec3::Constant(kSide),
                         Vec3(0.1, 0.07, 1.01) * kSide, {6, 6, 2})};
    return s;
  }

  static Model model_of(bool stiffens) {
    Model model = build_model(scenario());
    const LogarithmicLayer layer{20e3, 0.05 * kSide};
    if (stiffens)
      model.contacts.change([layer](ContactModel& contact) {
        contact.logarithmic[0] = layer;
        contact.layers = layer.compliance();
      });
    return model;
  }

  const ContactPairState& pair_state() { return *dynamics.contact().pair_states()[0]; }
  const GroupChanges& foresee(const Eigen::VectorXd& correction) {
    return forecast.foresee(dynamics.contact(), dynamics.now().configuration, correction);
  }
  void move(const Eigen::VectorXd& w, double part) {
    Eigen::VectorXd there = y;
    there.head(w.size()) += part * w;
    dynamics.evaluate(there.data(), 0);
  }
  /// Of the upper block's way down by this.
  Eigen::VectorXd down(double way) const {
    Eigen::VectorXd w = Eigen::VectorXd::Zero(3 * model.layout.num_unknown_blocks());
    for (const NodeRef& node : model.tissues[1].nodes) w[3 * node.block + 2] = -way;
    return w;
  }
  /// Of the upper block's nodes up and down at random: next to each other some open, some close.
  Eigen::VectorXd shaken(double way) const {
    Random random(3);
    Eigen::VectorXd w = down(0);
    for (const NodeRef& node : model.tissues[1].nodes)
      w[3 * node.block + 2] = way * random.vector(1)[0];
    return w;
  }
  /// ∂g/∂w of all groups, by central differences.
  Eigen::VectorXd depth_rates(const Eigen::VectorXd& w) {
    constexpr double kPart = 1e-6;
    move(w, kPart);
    Eigen::VectorXd rate = pair_state().depth;
    move(w, -kPart);
    rate -= pair_state().depth;
    move(w, 0);
    return rate / (2 * kPart);
  }
  Eigen::VectorXd random_way() const {
    Random random(7);
    return kSide * random.vector(3 * model.layout.num_unknown_blocks());
  }

  const Model model;
  ContactSearch search;
  Dynamics dynamics;
  ContactForecast forecast;
  Eigen::VectorXd y;
};

/// Of the upper block down, and whether a layer stiffens.
const std::vector<std::pair<double, bool>> kWays{
    {0.01 * kSide, false}, {-0.02 * kSide, false}, {0.01 * kSide, true}, {-0.02 * kSide, true}};

std::vector<bool> pressing(const ContactPairState& pair_state) {
  std::vector<bool> result;
  for (const double p : pair_state.pressure) result.push_back(p > 0);
  return result;
}

// Nearly all as foreseen: weights of what fades in are not linear.
TEST(ContactForecast, GroupsOpenAndCloseAsForeseen) {
  for (const auto& [way, stiffens] : kWays) {
    UnevenBlocks blocks(stiffens);
    blocks.move(blocks.y, 0);
    const std::vector<bool> before = pressing(blocks.pair_state());
    const std::vector<int> near = blocks.pair_state().groups;
    blocks.foresee(blocks.down(way));
    const std::vector<Foreseen> foreseen = blocks.pair_state().foreseen;
    blocks.move(blocks.down(way), 1);
    const std::vector<bool> after = pressing(blocks.pair_state());
    int changed = 0, wrong = 0;
    for (const int a : near) {
      const auto g = static_cast<std::size_t>(a);
      changed += before[g] != after[g] ? 1 : 0;
      wrong += (foreseen[g] == Foreseen::Presses) != after[g] ? 1 : 0;
    }
    EXPECT_GT(changed, way > 0 ? 10 : 4) << way;
    EXPECT_LE(10 * wrong, changed) << way;
  }
}

TEST(ContactForecast, WhatIsForeseenAgainIsNoChange) {
  UnevenBlocks blocks;
  const Eigen::VectorXd w = blocks.down(0.01 * kSide);
  EXPECT_GT(blocks.foresee(w).size(), 10U);
  EXPECT_TRUE(ContactForecast::is_made(blocks.dynamics.contact()));
  EXPECT_EQ(blocks.foresee(w).size(), 0U);
  EXPECT_GT(blocks.foresee(Eigen::VectorXd::Zero(w.size())).size(), 10U);
  EXPECT_FALSE(ContactForecast::is_made(blocks.dynamics.contact()));
}

// Contact is a hundred times as stiff as the blocks: what these do on the way hardly counts.
TEST(ContactForecast, MissesTheForcesThatTheLinearOnesAreNot) {
  UnevenBlocks blocks;
  for (const Eigen::VectorXd& w :
       {blocks.down(0.01 * kSide), blocks.down(-0.004 * kSide), blocks.shaken(0.01 * kSide)}) {
    blocks.move(w, 0);
    Eigen::VectorXd difference(w.size());
    blocks.dynamics.assemble({0, 0, 1}, fem::Tangent::Consistent).A.multiply(w, difference);
    difference -= blocks.dynamics.now().forces.head(w.size());
    blocks.foresee(w);
    const double missed = blocks.forecast.missed();
    blocks.dynamics.contact().forget_foreseen();
    blocks.move(w, 1);
    difference += blocks.dynamics.now().forces.head(w.size());
    EXPECT_NEAR(missed, difference.norm(), 0.1 * missed);
    EXPECT_GT(missed, 1e-3);
  }
}

// Against depths by differences: wᵀ ΔA w = Σ ± k A (∂g/∂w)², k the slope of the pressure.
TEST(ContactForecast, MatrixGainsTheStiffnessOfWhatClosesAndLosesThatOfWhatOpens) {
  for (const auto& [way, stiffens] : kWays) {
    UnevenBlocks blocks(stiffens);
    const Eigen::VectorXd w = blocks.random_way(), rates = blocks.depth_rates(w);
    const auto quadratic = [&](const fem::BlockMatrix& A) {
      Eigen::VectorXd product(w.size());
      A.multiply(w, product);
      return w.dot(product);
    };
    const SystemScale scale{0, 0, 1};
    double before = quadratic(blocks.dynamics.assemble(scale, fem::Tangent::Consistent).A);
    const GroupChanges& changes = blocks.foresee(blocks.down(way));
    const ContactPairState& state = blocks.pair_state();
    double expected = 0;
    for (const int a : state.groups) {
      const bool takes = state.presses_in_matrix(a), acts = state.pressure[a] > 0;
      if (takes != acts)
        expected += (takes ? 1 : -1) * state.slope(a) * state.measure[a] * std::pow(rates[a], 2);
    }
    const double after =
        quadratic(blocks.dynamics.assemble_again(changes, scale, fem::Tangent::Consistent).A);
    EXPECT_NEAR(after - before, expected, 1e-5 * std::abs(expected)) << way;
    EXPECT_EQ(expected > 0, way > 0);
  }
}

// Where a coupling was not in the pattern, the matrix is made anew, with the same groups in it.
TEST(ContactForecast, MatrixMadeAnewHasWhatIsForeseen) {
  const SystemScale scale{0, 0, 1};
  UnevenBlocks one, other;
  const Eigen::VectorXd w = one.random_way();
  Eigen::VectorXd changed(w.size()), anew(w.size());
  one.dynamics.assemble(scale, fem::Tangent::Projected);
  one.dynamics.assemble_again(one.foresee(one.down(0.01 * kSide)), scale, fem::Tangent::Projected)
      .A.multiply(w, changed);
  other.foresee(other.down(0.01 * kSide));
  other.dynamics.assemble(scale, fem::Tangent::Projected).A.multiply(w, anew);
  EXPECT_LT((changed - anew).norm(), 1e-12 * anew.norm());
}

// A closed gap pulls, as its line goes on beyond the kink, and what opens does no longer push.
TEST(ContactForecast, ForcesAreThoseOfTheLinesBeyondTheKinks) {
  for (const auto& [way, stiffens] : kWays) {
    UnevenBlocks blocks(stiffens);
    const Eigen::VectorXd w = blocks.random_way(), rates = blocks.depth_rates(w);
    blocks.foresee(blocks.down(way));
    Eigen::VectorXd f = Eigen::VectorXd::Zero(w.size());
    blocks.forecast.add_force(blocks.dynamics.contact(), blocks.dynamics.now().configuration, f);
    const ContactPairState& state = blocks.pair_state();
    double expected = 0;
    for (const int a : state.groups) {
      const bool takes = state.presses_in_matrix(a), acts = state.pressure[a] > 0;
      if (takes != acts)
        expected -= (takes ? 1 : -1) * state.signed_pressure(a) * state.measure[a] * rates[a];
    }
    EXPECT_NEAR(f.dot(w), expected, 1e-5 * std::abs(expected)) << way;
    EXPECT_NE(expected, 0);
  }
}

}  // namespace articular::sim::contact_forecast_test
