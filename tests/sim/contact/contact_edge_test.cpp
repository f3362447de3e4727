// Bodies whose sharp edges meet.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/build/build_model.hpp"
#include "sim/contact/contact_summary.hpp"
#include "sim/model/tissue.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_edge_test {

constexpr double kSide = 0.01;  // [m]

ContactSummary contact_at_start(const Scenario& s) {
  const Model model = build_model(s);
  const Eigen::VectorXd y = initial_state(model);
  Configuration now;
  read_state(model, y.data(), 0, now);
  ContactSearch search(model, {});
  search.find(now, 0.01 * kSide);
  ContactResponse response(model);
  response.evaluate(now, search.candidates(), {});
  return contact_summaries(model, response, now).at(0);
}

/// Two blocks of which an edge of one has passed an edge of the other, in two directions [m]. The
/// finer one, whose triangles look, is narrower: its ends stay clear of the other's.
ContactSummary passed_edges(double across, double down, int finer) {
  const auto block = [&](int i, const Vec3& center) {
    const Vec3 size(kSide, i == finer ? 0.8 * kSide : kSide, kSide);
    return box_body(i == 0 ? "lower" : "upper", Body::Kind::Tissue, size, center,
                    Eigen::Vector3i::Constant(i == finer ? 3 : 1));
  };
  Scenario s = contact_scene(1e-3);
  s.contact_response = Scenario::Response::Pointwise;
  s.bodies = {block(0, Vec3::Zero()), block(1, {kSide - across, 0, kSide - down})};
  return contact_at_start(s);
}

// A point is as deep as it is far from where it came in. With the depth a of the upper block's side
// behind the lower one's instead, its force would be ½ k a² L however little it reaches down.
TEST(EdgesThatMeet, HaveTheEnergyOfTheLesserDepth) {
  for (const int finer : {0, 1}) {
    const double unit = passed_edges(1e-4, 1e-4, finer).energy / (2.0 / 3);  // ½ k L a³
    for (const double a : {1e-4, 2e-4, 5e-4})
      for (const double b : {1e-6, 1e-4, 3e-4}) {
        const double less = std::min(a, b), more = std::max(a, b);
        const ContactSummary sum = passed_edges(a, b, finer);
        const double exact = less * less * (more - less / 3) / 1e-12;
        EXPECT_NEAR(sum.energy / unit, exact, 1e-9 * exact) << a << " " << b;
        EXPECT_NEAR(sum.max_point_depth, less, 1e-12);
      }
  }
}

/// A block pressed onto one as wide as itself, by `depth` into the layer between them [m].
Scenario blocks_of_one_outline(double depth, const Layer& layer, const Eigen::Vector3i& cells) {
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("base", Body::Kind::Fixed, Vec3::Constant(kSide), Vec3::Zero(), cells),
              box_body("top", Body::Kind::Rigid, Vec3::Constant(kSide), {0, 0, kSide - depth},
                       Eigen::Vector3i::Ones())};
  s.bodies[0].layer = layer;
  return s;
}

// The layer is compressed all over but for a strip along the edges, a thirtieth of the depth wide.
// Were the strip as wide as the layer is pressed, a third of the force would be missing.
// Beside the layer the bones give way, by 1.3e-4 of it.
TEST(EdgesThatMeet, HardlyTakeForceFromALayerBetweenFacesOfOneOutline) {
  const Layer layer{2e-3, 1e6, 0.3};
  const double stiffness =
      constrained_modulus(layer.young_modulus, layer.poisson_ratio) / layer.thickness;  // [Pa/m]
  for (const double depth : {1e-5, 1e-4, 1e-3})
    for (const int cells : {1, 3}) {
      const ContactSummary sum =
          contact_at_start(blocks_of_one_outline(depth, layer, {cells, cells, cells}));
      const double whole = stiffness * kSide * kSide * depth, strip = depth / 30;
      const double inner = kSide - 2 * strip;
      EXPECT_NEAR(-sum.force.z() / whole, inner * inner / (kSide * kSide), 2e-4) << depth;
      // ½ k ∫ d² dA, with depths that rise to d over the strip.
      const double energy = 0.5 * stiffness *
                            (depth * depth * inner * inner +
                             900 * 4 * (kSide * std::pow(strip, 3) / 3 - 0.5 * std::pow(strip, 4)));
      EXPECT_NEAR(sum.energy / energy, 1, 2e-4) << depth;
    }
}

// It bears on narrow strips at its edges, whose depth in one direction is nothing, in the other one
// is their width.
TEST(EdgesThatMeet, ACubeComesToRestOnTwoLedges) {
  constexpr double kLedge = 0.05 * kSide;
  for (const Scenario::Response response :
       {Scenario::Response::Pointwise, Scenario::Response::Averaged}) {
    Scenario s = contact_scene(1e-3);
    s.contact_response = response;
    s.bodies = {box_body("cube", Body::Kind::Tissue, Vec3::Constant(kSide),
                         {0.01 * kLedge, 0, kSide}, {1, 1, 1}),
                box_body("left", Body::Kind::Fixed, {kSide, 2 * kSide, kSide},
                         {kLedge - kSide, 0, 0}, {2, 2, 2}),
                box_body("right", Body::Kind::Fixed, {kSide, 2 * kSide, kSide},
                         {kSide - kLedge, 0, 0}, {2, 2, 2})};
    // Else it would slide off sooner or later: nothing centres it.
    for (const char* ledge : {"left", "right"}) {
      ContactPair pair{"cube", ledge, {}};
      pair.friction = 0.3;
      s.contacts.push_back(pair);
    }
    s.loads = {gravity({0, 0, -9.81})};
    Simulation run(s);
    run.advance(0.1);
    const double weight = 1000 * kSide * kSide * kSide * 9.81;
    EXPECT_LT(kinetic_energy(run), 1e-6 * weight * kSide);
    double carried = 0;
    for (const ContactSummary& sum :
         contact_summaries(run.model, run.stepper.now().contact, run.now())) {
      carried += std::abs(sum.force.z());
      EXPECT_LT(sum.max_point_depth, 0.1 * kLedge);
    }
    EXPECT_NEAR(carried, weight, 1e-3 * weight);
    EXPECT_LT(run.state.counts.newton_iterations, 300);
    EXPECT_EQ(run.state.counts.rejected_newton, 0);
  }
}

}  // namespace articular::sim::contact_edge_test
