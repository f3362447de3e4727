// Parts of one mesh that lie in each other.
#include "sim/mesh/overlapping_parts.hpp"

#include <gtest/gtest.h>

#include "sim/mesh/shapes.hpp"

namespace articular::sim::overlapping_parts_test {

MeshData box(const Vec3& size, const Vec3& center) {
  return box_mesh({size, Eigen::Vector3i(4, 4, 4), center});
}

/// One mesh of two that share no node.
MeshData joined(const MeshData& a, const MeshData& b) {
  MeshData both;
  both.X.resize(3, a.X.cols() + b.X.cols());
  both.X << a.X, b.X;
  both.tets.resize(4, a.tets.cols() + b.tets.cols());
  both.tets << a.tets, (b.tets.array() + static_cast<int>(a.X.cols())).matrix();
  return both;
}

std::optional<DeepestPoint> deepest(const MeshData& mesh, double least = 1e-6) {
  return deepest_in_another_part(mesh.X, mesh.tets, least);
}

TEST(OverlappingParts, AreSeenAsDeepAsTheyLieInEachOther) {
  const MeshData large = box({16, 16, 16}, Vec3::Zero());
  const auto found = deepest(joined(large, box({8, 8, 8}, {2, 2, 9})));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->depth, 3, 1e-12);  // its lower face is at 5, the larger one's upper at 8
  EXPECT_NEAR(found->x.z(), 5, 1e-12);
  EXPECT_TRUE(deepest(joined(box({8, 8, 8}, {2, 2, 9}), large)));  // in any order
  EXPECT_FALSE(deepest(joined(large, box({8, 8, 8}, {2, 2, 9})), 3.01));
}

TEST(OverlappingParts, BesideEachOtherDoNot) {
  const MeshData large = box({16, 16, 16}, Vec3::Zero());
  EXPECT_FALSE(deepest(large));
  EXPECT_FALSE(deepest(joined(large, box({8, 8, 8}, {0, 0, 12.5}))));
  EXPECT_FALSE(deepest(joined(large, box({16, 16, 16}, {0, 0, 16}))));  // face on face
}

TEST(OverlappingParts, AreSeenWhereTheyAreDeepest) {
  const MeshData large = box({16, 16, 16}, Vec3::Zero()), deep = box({8, 8, 8}, {2, 2, 9}),
                 shallow = box({8, 8, 8}, {2, 2, -11});
  for (const MeshData& mesh :
       {joined(joined(large, deep), shallow), joined(joined(shallow, large), deep)}) {
    const auto found = deepest(mesh);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->depth, 3, 1e-12);
  }
}

// Elements of one part, as of a fold, are matters of contact with itself.
TEST(OverlappingParts, ShareNoNode) {
  MeshData mesh = joined(box({16, 16, 16}, Vec3::Zero()), box({8, 8, 8}, {2, 2, 9}));
  mesh.tets(0, mesh.tets.cols() - 1) = mesh.tets(0, 0);
  EXPECT_FALSE(deepest(mesh));
}

}  // namespace articular::sim::overlapping_parts_test
