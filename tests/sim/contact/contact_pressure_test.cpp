// What is told of the pressure, on configurations that are given: bodies lie in each other, and
// nothing is solved. Point by point the pressure is then k d.
#include "sim/contact/contact_pressure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/build/build_model.hpp"
#include "sim/contact/contact_summary.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/probes.hpp"

namespace articular::sim::contact_pressure_test {

constexpr double kStiffness = 1e9;  // k [Pa/m]
constexpr double kDepth = 1e-3;     // [m]

Scenario scene_of(std::vector<Body> bodies, Scenario::Response response, double damping = 0) {
  Scenario s = contact_scene(1e-3);
  s.contact_response = response;
  for (Body& body : bodies)
    if (body.material) body.material->element = TissueMaterial::Element::Plain;
  s.bodies = std::move(bodies);
  ContactPair pair;
  pair.a = s.bodies.front().name;
  pair.b = s.bodies.back().name;
  pair.damping = damping;
  s.contacts = {pair};
  return s;
}

/// The first two bodies, as they are, in contact.
struct Pressed {
  /// @param uneven  how far free nodes are displaced at random [m]
  /// @param speed  at random, of free nodes [m/s]
  explicit Pressed(const Scenario& scenario, double uneven = 0, double speed = 0)
      : model(with_stiffness(scenario)), search(model, {}), response(model) {
    Random random(1);
    Eigen::VectorXd y = initial_state(model);
    const int n = 3 * model.layout.num_free_nodes;
    y.head(n) += uneven * random.vector(n);
    y.segment(model.layout.velocities(), n) += speed * random.vector(n);
    read_state(model, y.data(), 0, now);
    search.find(now, 2 * kDepth);
    response.evaluate(now, search.candidates(), {});
    loads = pressure_loads(model, response, now);
  }
  static Model with_stiffness(const Scenario& scenario) {
    Model made = build_model(scenario);
    contact_stiffness_of(kStiffness)(made);
    return made;
  }
  const Collider& collider(std::size_t body) const { return *model.bodies[body].collider; }
  Eigen::VectorXd at_nodes(std::size_t body) const {
    return node_pressures(collider(body), loads[body]);
  }
  ContactSummary summary() const { return contact_summaries(model, response, now).at(0); }

  const Model model;
  ContactSearch search;
  ContactResponse response;
  Configuration now;
  std::vector<PressureLoad> loads;
};

/// Two rough blocks, which do not match, lie in each other.
Scenario rough(Scenario::Response response, double damping) {
  return scene_of({box_body("lower", Body::Kind::Tissue, {0.3, 0.3, 0.1}, {0, 0, -0.05}, {4, 4, 1}),
                   box_body("upper", Body::Kind::Tissue, {0.21, 0.22, 0.1},
                            {0.011, 0.017, 0.05 - kDepth}, {5, 4, 1})},
                  response, damping);
}

TEST(ContactPressure, IsNowhereNegativeAndSumsUpToTheForceOnBothBodies) {
  int num_blank = 0;
  for (const auto response : {Scenario::Response::Pointwise, Scenario::Response::Averaged})
    for (const double damping : {0.0, 0.3 * kStiffness}) {
      const Pressed pressed(rough(response, damping), kDepth, 1);
      const ContactSummary sum = pressed.summary();
      ASSERT_GT(sum.normal_force, 0);
      const std::size_t triangles = pressed.model.contacts[0].reversed ? 1 : 0;
      for (const std::size_t b : {0, 1}) {
        const PressureLoad& load = pressed.loads[b];
        EXPECT_GE(load.force.minCoeff(), 0);
        EXPECT_GE(load.covered.minCoeff(), 0);
        const Eigen::VectorXd faces = face_pressures(load);
        EXPECT_GE(faces.minCoeff(), 0);
        for (const double p : pressed.at_nodes(b)) {
          EXPECT_FALSE(p < 0) << p;
          num_blank += std::isnan(p) ? 1 : 0;
        }
        // Around the nodes is what goes through the faces, by the normals of one body or the other.
        const double force = load.force.sum();
        EXPECT_NEAR(force, faces.dot(load.face_area), 1e-12 * force);
        EXPECT_NEAR(force, sum.normal_force, (b == triangles ? 1e-12 : 1e-2) * force);
      }
      EXPECT_TRUE(sum.is_resolved);
    }
  EXPECT_GT(num_blank, 0);  // the scenes have slivers
}

constexpr double kBallRadius = 10;  // [m]

/// A block with its top at 0 under a paraboloid z = r²/2R, kDepth in it. Lines of both grids go
/// through the middle.
Scenario under_a_ball(int cells, const TemporaryFolder& folder,
                      Scenario::Response response = Scenario::Response::Pointwise) {
  const MeshData ball =
      bent({{0.66, 0.66, 0.1}, {cells + 2, cells + 2, 1}, {0, 0, 0.05}}, [](Vec3 X) {
        X.z() += X.head<2>().squaredNorm() / (2 * kBallRadius) - kDepth;
        return X;
      });
  return scene_of(
      {box_body("block", Body::Kind::Tissue, {0.6, 0.6, 0.1}, {0, 0, -0.05}, {cells, cells, 1}),
       mesh_body("ball", Body::Kind::Fixed, ball, folder)},
      response);
}

// On such springs the pressure is p₀ (1 − r²/a²) with a² = 2 R δ and p₀ = k δ = 2 F/(π a²). The
// mean around a node takes a part of order h²/a² off the peak.
TEST(ContactPressure, ThePeakUnderABallConvergesWithTheSquareOfTheElementsOnBothBodies) {
  const double peak = kStiffness * kDepth;
  const double force = std::numbers::pi * kBallRadius * kStiffness * kDepth * kDepth;
  double before[2] = {0, 0}, force_before = 0;
  for (const int cells : {12, 24}) {
    const TemporaryFolder folder;
    const Pressed pressed(under_a_ball(cells, folder));
    EXPECT_NEAR(pressed.summary().max_pressure, peak, 0.1 * peak);
    for (const std::size_t b : {0, 1}) {
      Eigen::VectorXd p = pressed.at_nodes(b);
      for (double& value : p)
        if (std::isnan(value)) value = 0;
      const double error = std::abs(p.maxCoeff() / peak - 1);
      if (before[b] > 0) {
        EXPECT_NEAR(std::log2(before[b] / error), 2, 0.3) << "body " << b;
      }
      before[b] = error;
    }
    const double force_error = std::abs(pressed.summary().normal_force / force - 1);
    if (force_before > 0) {
      EXPECT_LT(force_error, 0.4 * force_before);
    }
    force_before = force_error;
  }
}

TEST(ContactPressure, WhatGoesThroughTheFacesIsTheForceOnTheBody) {
  const TemporaryFolder folder;
  const Pressed pressed(under_a_ball(12, folder));
  const std::vector<Positions> forces = nodal_contact_forces(pressed.model, pressed.response);
  for (const std::size_t b : {0, 1}) {
    const Collider& collider = pressed.collider(b);
    const Eigen::VectorXd p = face_pressures(pressed.loads[b]);
    const Vec3 force = forces[b].rowwise().sum();
    Vec3 through = Vec3::Zero();
    for (int f = 0; f < p.size(); ++f) {
      const FlatTriangle face = flat_triangle(corners_of(pressed.now, collider, f));
      through -= p[f] * face.twice_area / 2 * face.normal;
    }
    EXPECT_LT((through - force).norm(), 1e-12 * force.norm()) << "body " << b;
  }
}

TEST(ContactPressure, ASymmetricSceneHasASymmetricField) {
  for (const auto response : {Scenario::Response::Pointwise, Scenario::Response::Averaged}) {
    const TemporaryFolder folder;
    const Pressed pressed(under_a_ball(16, folder, response));
    const double peak = pressed.summary().max_pressure;
    for (const std::size_t b : {0, 1}) {
      const Eigen::VectorXd p = pressed.at_nodes(b);
      const Positions& X = pressed.collider(b).X;
      int compared = 0;
      for (Eigen::Index i = 0; i < X.cols(); ++i)
        for (Eigen::Index j = 0; j < i; ++j) {
          if ((X.col(i) - Vec3(-X(0, j), X(1, j), X(2, j))).norm() > 1e-9) continue;
          EXPECT_EQ(std::isnan(p[i]), std::isnan(p[j])) << X.col(i).transpose();
          if (std::isnan(p[i]) || std::isnan(p[j])) continue;
          EXPECT_NEAR(p[i], p[j], 1e-9 * peak) << X.col(i).transpose();
          compared += p[i] > 0 ? 1 : 0;
        }
      EXPECT_GT(compared, 15) << "body " << b;
    }
  }
}

constexpr double kCell = 0.1;  // of the block's top [m]

/// A block of 4 x 4 cells, its top at 0, under a plate that is kDepth in it from x on.
Scenario under_a_plate_from(double x) {
  return scene_of(
      {box_body("block", Body::Kind::Tissue, {0.4, 0.4, 0.1}, {0, 0, -0.05}, {4, 4, 1}),
       box_body("plate", Body::Kind::Fixed, {1, 1, 0.1}, {x + 0.5, 0, 0.05 - kDepth}, {20, 20, 1})},
      Scenario::Response::Pointwise);
}

// Uniform pressure, whose edge lies t of a cell beyond a line of nodes: (1 − t)²/2 of the area
// around these is under the plate.
TEST(ContactPressure, IsUniformUpToTheEdgeAndBlankWhereOnlyASliverTouches) {
  const double p = kStiffness * kDepth;
  for (const double t : {0.05, 0.9}) {
    const Pressed pressed(under_a_plate_from(t * kCell));
    const Eigen::VectorXd nodes = pressed.at_nodes(0);
    const Positions& X = pressed.collider(0).X;
    const bool is_blank = 0.5 * (1 - t) * (1 - t) < kBlankShare;
    int num_there = 0;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      if (std::abs(X(2, i)) > 1e-9) continue;
      if (std::abs(X(0, i)) < 1e-9) {
        EXPECT_EQ(std::isnan(nodes[i]), is_blank);
        if (!is_blank) {
          EXPECT_NEAR(nodes[i], p, 1e-6 * p);
        }
        ++num_there;
      } else {
        EXPECT_NEAR(nodes[i], X(0, i) > 0 ? p : 0, 1e-6 * p) << X.col(i).transpose();
      }
    }
    EXPECT_EQ(num_there, 5);
    EXPECT_TRUE(pressed.summary().is_resolved);
    EXPECT_NEAR(pressed.summary().max_pressure, p, 1e-6 * p);
  }
}

// Dampers add c v where surfaces meet, and take it away where they part.
TEST(ContactPressure, HasThePressureOfDampers) {
  constexpr double kDamping = 0.1 * kStiffness, kSpeed = 5e-3;  // [Pa s/m], [m/s]
  for (const auto response : {Scenario::Response::Pointwise, Scenario::Response::Averaged})
    for (const double upwards : {kSpeed, -kSpeed}) {
      Scenario s = under_a_plate_from(-0.3);
      s.contact_response = response;
      s.contacts[0].damping = kDamping;
      s.bodies[0].velocity = {0, 0, upwards};
      const Pressed pressed(s);
      const double p = kStiffness * kDepth + kDamping * upwards;
      EXPECT_NEAR(pressed.summary().max_pressure, p, 1e-6 * p);
      EXPECT_NEAR(face_pressures(pressed.loads[0]).maxCoeff(), p, 1e-6 * p);
    }
}

// The plate's edge reaches three times as deep, on a strip that covers a fiftieth of the area
// around the nodes beside it.
TEST(ContactPressure, ASharpEdgeOnASliverDoesNotSetThePeakOfTheBlock) {
  const double p = kStiffness * kDepth, edge = 0.8 * kCell;
  const TemporaryFolder folder;
  Scenario s = under_a_plate_from(edge);
  BoxGeometry box = std::get<BoxGeometry>(s.bodies[1].geometry);
  box.cells.x() *= 2;
  const MeshData plate = bent(box, [&](Vec3 X) {
    if (X.x() < edge + 1e-9) X.z() -= 2 * kDepth;
    return X;
  });
  s.bodies[1] = mesh_body("plate", Body::Kind::Fixed, plate, folder);
  const Pressed pressed(s);
  EXPECT_GT(kStiffness * pressed.summary().max_point_depth, 2.9 * p);
  double largest = 0;
  for (const double value : pressed.at_nodes(0))
    if (value > largest) largest = value;
  EXPECT_GT(largest, 1.1 * p);
  EXPECT_LT(largest, 1.7 * p);
}

// Where less than a quarter of the area around a node is under the plate, the mean is over a
// quarter.
TEST(ContactPressure, FallsToNothingBesideTheEdge) {
  const double p = kStiffness * kDepth;
  int num_between = 0;
  for (const double t : {0.3, 0.4, 0.5}) {
    const Pressed pressed(under_a_plate_from(t * kCell));
    const Collider& block = pressed.collider(0);
    const Eigen::VectorXd areas = group_areas(block, pressed.loads[0]),
                          pressures = group_pressures(block, pressed.loads[0]);
    for (Eigen::Index g = 0; g < areas.size(); ++g) {
      const double share = pressed.loads[0].covered[g] / areas[g];
      if (share < kBlankShare) continue;
      EXPECT_NEAR(pressures[g], std::min(1.0, share / kLeastShare) * p, 1e-6 * p);
      num_between += share < kLeastShare ? 1 : 0;
    }
  }
  EXPECT_GT(num_between, 3);
}

TEST(ContactPressure, AtACreaseIsTheLargestOfWhatIsKnownOfItsSides) {
  const Pressed pressed(under_a_plate_from(0));
  const Collider& collider = pressed.collider(0);
  std::vector<int> sides;  // of the first node that has three
  for (int node = 0; sides.size() < 3; ++node) {
    sides.clear();
    for (int g = 0; g < std::ssize(collider.group_node); ++g)
      if (collider.group_node[static_cast<std::size_t>(g)] == node) sides.push_back(g);
  }
  const int node = collider.group_node[static_cast<std::size_t>(sides[0])];
  const std::array<double, 3> whole{3, 0, 2}, one_blank{-1, 0, 2}, other_blank{2, 0, -1},
      blank{0, -1, 0}, nothing{0, 0, 0};
  const auto pressure_of = [&](const std::array<double, 3>& p) {  // < 0: of a sliver
    PressureLoad load = no_load(pressed.now, collider);
    const Eigen::VectorXd areas = group_areas(collider, load);
    load.covered = areas;
    load.force = 2 * areas;  // 2 Pa around all other nodes
    for (std::size_t i = 0; i < 3; ++i) {
      const int g = sides[i];
      load.covered[g] = (p[i] < 0 ? 0.9 * kBlankShare : 1.1 * kLeastShare) * areas[g];
      load.force[g] = std::abs(p[i]) * load.covered[g];
    }
    return node_pressures(collider, load)[node];
  };
  EXPECT_NEAR(pressure_of(whole), 3, 1e-12);
  EXPECT_NEAR(pressure_of(one_blank), 2, 1e-12);
  EXPECT_NEAR(pressure_of(other_blank), 2, 1e-12);
  EXPECT_TRUE(std::isnan(pressure_of(blank)));
  EXPECT_EQ(pressure_of(nothing), 0);
}

// One node of the block's top has a pressure of its own among others with 1 Pa, and then a row of
// them. What is around the one shares its faces.
TEST(ContactPressure, APeakAroundOneNodeIsBlankAndARidgeIsNot) {
  const Pressed pressed(under_a_plate_from(0));
  const Collider& collider = pressed.collider(0);
  const auto is_in_the_middle = [&](int g) {
    const auto x = collider.X.col(collider.group_node[static_cast<std::size_t>(g)]);
    return (x - Vec3::Zero()).norm() < 1e-9;
  };
  const auto is_in_the_row = [&](int g) {
    const auto x = collider.X.col(collider.group_node[static_cast<std::size_t>(g)]);
    return std::abs(x[0]) + std::abs(x[2]) < 1e-9;
  };
  const auto pressures = [&](double p, double others, const auto& is_loaded) {
    PressureLoad load = no_load(pressed.now, collider);
    load.covered = group_areas(collider, load);
    load.force = others * load.covered;
    for (int g = 0; g < load.force.size(); ++g)
      if (is_loaded(g)) load.force[g] = p * load.covered[g];
    return node_pressures(collider, load);
  };
  for (const double p : {0.9 * kMostPeak, 1.1 * kMostPeak}) {
    const Eigen::VectorXd peak = pressures(p, 1, is_in_the_middle),
                          ridge = pressures(p, 1, is_in_the_row);
    for (const auto& face : collider.surface.faces.colwise()) {
      const bool is_around = std::any_of(face.begin(), face.end(),
                                         [&](int i) { return collider.X.col(i).norm() < 1e-9; });
      for (const int i : face) {
        if (is_around) {
          EXPECT_EQ(std::isnan(peak[i]), p > kMostPeak);
        }
      }
    }
    EXPECT_EQ(peak.array().isNaN().count(), p > kMostPeak ? 9 : 0);
    EXPECT_NEAR(ridge.maxCoeff(), p, 1e-12 * p);
  }
  EXPECT_EQ(pressures(1, 0, is_in_the_middle).array().isNaN().count(), 1);
}

// A thorn of the plate in the middle of the block.
TEST(ContactPressure, OfFacesAroundALonePeakIsNotTheLargest) {
  const double p = kStiffness * kDepth;
  const TemporaryFolder folder;
  Scenario s = under_a_plate_from(-0.5);
  const MeshData plate = bent(std::get<BoxGeometry>(s.bodies[1].geometry), [](Vec3 X) {
    if (X.head<2>().norm() < 1e-9 && X.z() < 0) X.z() -= 20 * kDepth;
    return X;
  });
  s.bodies[1] = mesh_body("plate", Body::Kind::Fixed, plate, folder);
  const Pressed pressed(s);
  EXPECT_GT(pressed.at_nodes(0).array().isNaN().count(), 0);
  EXPECT_GT(face_pressures(pressed.loads[0]).maxCoeff(), kMostPeak * p);
  EXPECT_LT(pressed.summary().max_face_pressure, 1.1 * p);
  EXPECT_GT(pressed.summary().max_face_pressure, 0.99 * p);
}

TEST(ContactPressure, IsNotToldOfAContactThatIsNowhereResolved) {
  Scenario s = under_a_plate_from(0.2 - 0.05 * kCell);
  s.probes = {{"speck", ContactProbe{"block", "plate"}}, {"other", ContactProbe{"plate", "block"}}};
  const ContactSummary sum = Pressed(s).summary();
  EXPECT_GT(sum.normal_force, 0);
  EXPECT_FALSE(sum.is_resolved);
  s.attachments = {attach("block", "wall", {-1, -1, -1}, {1, 1, 1})};
  s.bodies.push_back(stand("wall"));
  std::get<BoxGeometry>(s.bodies[1].geometry).center.z() += 2 * kDepth;
  s.loads = {shift("plate", 1e-3, {0, 0, -2 * kDepth})};
  Simulation run(s, contact_stiffness_of(kStiffness));
  run.advance(1e-3);
  const Probes probes(run);
  for (const std::string name : {"speck", "other"}) {
    EXPECT_GT(std::abs(probes(name + ".force.z [N]")), 0);
    EXPECT_GT(probes(name + ".area [mm^2]"), 0);
    for (const std::string what : {".mean_pressure", ".max_pressure", ".max_face_pressure"})
      EXPECT_TRUE(std::isnan(probes(name + what + " [Pa]"))) << what;
  }
}

}  // namespace articular::sim::contact_pressure_test
