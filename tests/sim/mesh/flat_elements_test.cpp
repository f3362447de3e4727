// A surface whose valleys are bridged by flat elements.
#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
#include "sim/mesh/flat_elements.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::flat_elements_test {

constexpr int kCells = 4;
constexpr double kSide = 0.1, kElement = kSide / kCells;  // [m]

int top_node(const MeshData& mesh, int i, int j) {
  for (Eigen::Index n = 0; n < mesh.X.cols(); ++n) {
    const Vec3 corner(i * kElement - kSide / 2, j * kElement - kSide / 2, kSide);
    if ((mesh.X.col(n) - corner).norm() < 0.1 * kElement) return static_cast<int>(n);
  }
  return -1;
}

/// A block whose top is uneven by this; with bridges: an element across each valley, which is
/// where a cell's diagonal joins two of its low nodes.
MeshData uneven_block(double height, bool bridges) {
  MeshData mesh =
      box_mesh({Vec3::Constant(kSide), Eigen::Vector3i::Constant(kCells), Vec3(0, 0, kSide / 2)});
  std::vector<Eigen::Vector4i> flat;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j)
      if ((i + j) % 2 == 0)
        flat.push_back({top_node(mesh, i, j), top_node(mesh, i + 1, j), top_node(mesh, i, j + 1),
                        top_node(mesh, i + 1, j + 1)});
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j)
      if ((i + j) % 2 == 1) mesh.X(2, top_node(mesh, i, j)) += height;
  for (Eigen::Vector4i tet : flat) {
    if (!bridges) break;
    if (sextuple_volume(mesh.X, tet) < 0) std::swap(tet[0], tet[1]);
    mesh.tets.conservativeResize(Eigen::NoChange, mesh.tets.cols() + 1);
    mesh.tets.rightCols<1>() = tet;
  }
  return mesh;
}

/// Pressed by a twentieth of its height by a plate.
Scenario pressed(const MeshData& block, const TemporaryFolder& folder) {
  Scenario s = contact_scene(0.1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("floor", Body::Kind::Fixed, {0.2, 0.2, 0.02}, {0, 0, -0.01}),
              mesh_body("block", Body::Kind::Tissue, block, folder),
              box_body("plate", Body::Kind::Fixed, {0.2, 0.2, 0.02}, {0, 0, 1.01 * kSide + 0.01},
                       {3, 3, 1})};
  s.attachments = {attach("block", "floor", {-1, -1, -1e-3}, {1, 1, 1e-3})};
  s.loads = {shift("plate", 0.1, {0, 0, -0.06 * kSide})};
  ContactPair pair;
  pair.a = "block";
  pair.b = "plate";
  s.contacts = {pair};
  return s;
}

TEST(FlatElements, AreCountedAndToldWithThePlace) {
  const TemporaryFolder folder;
  const MeshData flat = uneven_block(0.002 * kElement, true);
  const FlatElements found = flat_elements(flat.X, flat.tets);
  EXPECT_EQ(found.count, kCells * kCells / 2);
  EXPECT_NEAR(found.flattest.z(), kSide, 0.01 * kElement);
  EXPECT_EQ(
      flat_elements(
          flat.X,
          box_mesh({Vec3::Constant(kSide), Eigen::Vector3i::Constant(kCells), Vec3::Zero()}).tets)
          .count,
      0);
  const Model model = build_model(pressed(flat, folder));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("8 of 392 tetrahedra of `block` are flat"), std::string::npos)
      << model.warnings[0];
}

// They bear on their high nodes alone, but the force is that of an even block.
TEST(FlatElements, BearTheSameForce) {
  const TemporaryFolder folder;
  const auto force = [&](const MeshData& block) {
    Simulation run(pressed(block, folder));
    run.advance(0.1);
    EXPECT_GT(least_volume_ratio(run), 0);
    return run.stepper.dynamics().contact_summary(0).force.norm();
  };
  const double even = force(uneven_block(0, false));
  EXPECT_NEAR(force(uneven_block(0.002 * kElement, true)), even, 0.015 * even);
}

}  // namespace articular::sim::flat_elements_test
