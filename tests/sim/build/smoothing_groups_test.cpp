#include "sim/build/smoothing_groups.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::smoothing_groups_test {

constexpr double kCrease = 0.5;

struct Groups {
  explicit Groups(const MeshData& mesh)
      : faces(collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols())).faces),
        node_of(number_smoothing_groups(mesh.X, faces, kCrease, groups)) {
    for (const int group : groups.reshaped())
      at_node[node_of[static_cast<std::size_t>(group)]].insert(group);
  }
  Eigen::Matrix3Xi faces, groups;
  std::vector<int> node_of;
  std::map<int, std::set<int>> at_node;  // of the surface
};

TEST(SmoothingGroups, AreasAroundNodesOfABoxAreThoseOfTheirCells) {
  const double cell = 0.01;
  const MeshData box = box_mesh({{3 * cell, 3 * cell, 3 * cell}, {3, 3, 3}, Vec3::Zero()});
  const Groups s(box);
  const std::vector<double> face_area(static_cast<std::size_t>(s.faces.cols()), cell * cell / 2);
  const Eigen::VectorXd areas =
      areas_of_smoothing_groups(s.groups, std::ssize(s.node_of), face_area);
  EXPECT_NEAR(areas.sum(), 6 * 9 * cell * cell, 1e-15);
  for (const auto& [node, groups] : s.at_node) {
    if (groups.size() > 1) continue;  // not at an edge: a sixth of a cell for each of its faces
    const auto faces_around = (s.faces.array() == node).count();
    EXPECT_NEAR(areas[node], static_cast<double>(faces_around) * cell * cell / 6, 1e-18);
  }
}

TEST(SmoothingGroups, ABoxHasThreeAtACornerTwoAtAnEdgeAndOneElsewhere) {
  const MeshData box = box_mesh({{0.03, 0.03, 0.03}, {3, 3, 3}, Vec3::Zero()});
  const Groups s(box);
  std::map<std::size_t, int> nodes_with;
  for (const auto& [node, groups] : s.at_node) {
    ++nodes_with[groups.size()];
    EXPECT_EQ(*groups.begin(), node);  // the first
  }
  const std::map<std::size_t, int> expected = {{3, 8}, {2, 12 * 2}, {1, 6 * 4}};
  EXPECT_EQ(nodes_with, expected);
  for (Eigen::Index i = 0; i < s.faces.size(); ++i)
    EXPECT_EQ(s.node_of[static_cast<std::size_t>(s.groups.reshaped()[i])], s.faces.reshaped()[i]);
  // Faces of one group look the same way.
  std::map<int, Vec3> normal_of;
  for (Eigen::Index f = 0; f < s.faces.cols(); ++f) {
    const Vec3 a = box.X.col(s.faces(0, f));
    const Vec3 n = (box.X.col(s.faces(1, f)) - a).cross(box.X.col(s.faces(2, f)) - a).normalized();
    for (const int group : s.groups.col(f))
      EXPECT_LT((normal_of.try_emplace(group, n).first->second - n).norm(), 1e-12);
  }
}

TEST(SmoothingGroups, ABoxEndsItsSheetsAtItsEdges) {
  const MeshData box = box_mesh({{0.03, 0.03, 0.03}, {3, 3, 3}, Vec3::Zero()});
  const Groups s(box);
  const std::vector<unsigned> rims = rims_of_smoothing_groups(box.X, s.faces, kCrease);
  int count = 0;
  for (Eigen::Index f = 0; f < s.faces.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = box.X.col(s.faces((k + 1) % 3, f)), b = box.X.col(s.faces((k + 2) % 3, f));
      const Vec3 middle = 0.5 * (a + b);
      const bool on_edge = (middle.array().abs() > 0.015 - 1e-9).count() == 2;
      const bool is_rim = (rims[static_cast<std::size_t>(f)] >> k & 1) != 0;
      EXPECT_EQ(is_rim, on_edge);
      count += is_rim ? 1 : 0;
    }
  EXPECT_EQ(count, 12 * 3 * 2);
}

// A box of which a quarter is cut out: along the inner edge the body is not convex.
TEST(SmoothingGroups, HeightsOverRimsAreThoseOfTheFacesButAtInnerEdges) {
  const MeshData angle = carved({{0.04, 0.04, 0.02}, {4, 4, 2}, Vec3::Zero()},
                                [](const Vec3& X) { return X.x() < 0 || X.y() < 0; });
  const Groups s(angle);
  const std::vector<unsigned> rims = rims_of_smoothing_groups(angle.X, s.faces, kCrease);
  const Positions heights = heights_over_convex_rims(angle.X, s.faces, kCrease);
  int inner = 0, outer = 0;
  for (Eigen::Index f = 0; f < s.faces.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = angle.X.col(s.faces((k + 1) % 3, f)), b = angle.X.col(s.faces((k + 2) % 3, f));
      if ((rims[static_cast<std::size_t>(f)] >> k & 1) == 0) {
        EXPECT_EQ(heights(k, f), 0);
      } else if ((0.5 * (a + b)).head<2>().isZero(1e-9)) {
        ++inner;
        EXPECT_EQ(heights(k, f), 0);
      } else {
        ++outer;
        EXPECT_NEAR(heights(k, f), 0.01, 1e-12);  // of half a cell's square
      }
    }
  EXPECT_EQ(inner, 2 * 2);
  EXPECT_EQ(outer, 2 * (16 + 16 + 5 * 2));
}

// Of an angle with an inner edge too, each side has one face across, unless it is a rim.
TEST(SmoothingGroups, TheFaceAcrossAnEdgeSharesItsNodesAndIsNoneAtARim) {
  const MeshData angle = carved({{0.04, 0.04, 0.02}, {4, 4, 2}, Vec3::Zero()},
                                [](const Vec3& X) { return X.x() < 0 || X.y() < 0; });
  const Groups s(angle);
  const std::vector<unsigned> rims = rims_of_smoothing_groups(angle.X, s.faces, kCrease);
  const Eigen::Matrix3Xi across = faces_across_edges(angle.X, s.faces, kCrease);
  ASSERT_EQ(across.cols(), s.faces.cols());
  for (int f = 0; f < s.faces.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int other = across(k, f);
      ASSERT_EQ(other < 0, (rims[static_cast<std::size_t>(f)] >> k & 1) != 0);
      if (other < 0) continue;
      EXPECT_NE(other, f);
      for (const int node : {s.faces((k + 1) % 3, f), s.faces((k + 2) % 3, f)})
        EXPECT_TRUE((s.faces.col(other).array() == node).any());
    }
}

TEST(SmoothingGroups, ABallHasNoCreases) {
  const Groups s(sphere_mesh({0.01, 4e-3, Vec3::Zero()}));
  for (const auto& [node, groups] : s.at_node) EXPECT_EQ(groups.size(), 1U);
}

// Two elements that have but a node in common.
TEST(SmoothingGroups, PartsThatMeetAtANodeOnlyAreApart) {
  MeshData mesh;
  mesh.X.resize(3, 7);
  mesh.X << 0, 1, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, -1;
  mesh.tets.resize(4, 2);
  mesh.tets << 0, 0, 1, 5, 2, 4, 3, 6;
  EXPECT_EQ(Groups(mesh).at_node.at(0).size(), 6U);  // three faces of each, at right angles
}

/// Pressures where a block without lateral contraction is pressed onto the floor of a tray.
/// @param gap  between its sides and the walls
Eigen::VectorXd pressures_in_tray(double gap, const TemporaryFolder& folder) {
  constexpr double kSide = 0.02, kWall = 5e-3;
  const double inner = kSide + 2 * gap, outer = inner + 2 * kWall;
  MeshData tray = box_mesh({{outer, outer, 0.02}, {8, 8, 4}, Vec3::Zero()});
  // Its grid has lines at the walls.
  for (double& x : tray.X.topRows(2).reshaped())
    x *= std::abs(x) > 0.49 * outer ? 1 : 0.5 * inner / (0.375 * outer);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index e = 0; e < tray.tets.cols(); ++e) {
    const Vec3 c = tray.X(Eigen::all, tray.tets.col(e)).rowwise().mean();
    if (c.z() < 0 || c.head<2>().cwiseAbs().maxCoeff() > inner / 2) kept.push_back(e);
  }
  tray.tets = Tetrahedra(tray.tets(Eigen::all, kept));
  Scenario s = contact_scene(0.1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {
      mesh_body("tray", Body::Kind::Fixed, tray, folder),
      box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), {0, 0, kSide / 2}, {4, 4, 4}),
      stand("press")};
  s.bodies[1].material = linear(20e3, 0);
  s.attachments = {attach("block", "press", {-1, -1, kSide - 1e-6}, {1, 1, 1})};
  s.contacts = {{"block", "tray", {}}};
  s.loads = {shift("press", 0.1, {0, 0, -kSide / 100})};
  Simulation run(s);
  run.advance(0.1);
  const auto surfaces = surface_contacts(run.model, run.stepper.now().contact, run.now());
  std::vector<double> below;
  for (Eigen::Index i = 0; i < surfaces[1].node_pressure.size(); ++i)
    if (run.model.bodies[1].collider->X(2, i) < 1e-9) below.push_back(surfaces[1].node_pressure[i]);
  return Eigen::Map<Eigen::VectorXd>(below.data(), std::ssize(below));
}

// Over all around an edge, the means of what lies on the floor would have the gaps to the wall in
// them, and the edges carry nothing.
TEST(SmoothingGroups, AWallInFrontOfABlocksSidesDoesNotLiftItsEdges) {
  const TemporaryFolder folder;
  const Eigen::VectorXd free = pressures_in_tray(4e-3, folder),
                        between = pressures_in_tray(2e-4, folder);
  ASSERT_EQ(free.size(), 25);
  EXPECT_NEAR(free.minCoeff(), 200, 1);  // [Pa]
  EXPECT_LT((between - free).cwiseAbs().maxCoeff(), 1e-6 * free.maxCoeff());
}

}  // namespace articular::sim::smoothing_groups_test
