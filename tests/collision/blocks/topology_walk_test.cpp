#include "collision/blocks/topology_walk.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/collision/support/hostile_meshes.hpp"
#include "tests/collision/support/rule_oracle.hpp"

namespace articular::collision::testing::topology_walk_test {

TEST(FaceNeighbours, OfABoxShareAnEdgeAndAreMutual) {
  const Mesh mesh = box_mesh(3, 2, 4, 1);
  const Eigen::Matrix3Xi neighbours = face_neighbours(mesh.surface);
  for (int face = 0; face < neighbours.cols(); ++face)
    for (int k = 0; k < 3; ++k) {
      const int other = neighbours(k, face);
      ASSERT_GE(other, 0);
      EXPECT_NE(other, face);
      EXPECT_TRUE((neighbours.col(other).array() == face).any());
      const Eigen::Vector3i nodes = mesh.surface.faces.col(other);
      EXPECT_TRUE((nodes.array() == mesh.surface.faces(k, face)).any());
      EXPECT_TRUE((nodes.array() == mesh.surface.faces((k + 1) % 3, face)).any());
    }
}

// Two tetrahedra with nothing but an edge in common: four faces there, in one ring.
TEST(FaceNeighbours, AtAnEdgeOfFourFacesFormARing) {
  Mesh mesh;
  mesh.tets.resize(4, 2);
  mesh.tets << 0, 0, 1, 1, 2, 4, 3, 5;
  const Surface surface = build_surface(mesh.tets, 6);
  const Eigen::Matrix3Xi neighbours = face_neighbours(surface);
  std::map<int, int> next;
  for (int face = 0; face < 8; ++face)
    for (int k = 0; k < 3; ++k) {
      const int a = surface.faces(k, face), b = surface.faces((k + 1) % 3, face);
      if (a + b == 1) next[face] = neighbours(k, face);
    }
  ASSERT_EQ(next.size(), 4u);
  std::set<int> ring;
  for (int face = next.begin()->first; ring.insert(face).second;) face = next.at(face);
  EXPECT_EQ(ring.size(), 4u);
}

/// A mesh with what a walk needs.
struct Walked {
  Mesh mesh;
  Eigen::Matrix3Xd x;
  Eigen::Matrix3Xi neighbours = face_neighbours(mesh.surface);
  WalkedMesh view() const { return {mesh.at(x), neighbours}; }
};

std::vector<Penetration> walked(const Walked& F, const Walked& W,
                                std::span<const Penetration> seeds) {
  std::vector<Penetration> pairs;
  WalkScratch scratch;
  WalkCounts counts;
  if (&F == &W)
    walk_own_body(F.view(), seeds, pairs, scratch, counts);
  else
    walk(F.view(), W.view(), seeds, pairs, scratch, counts);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<Penetration> by_tree(const Walked& F, const Walked& W) {
  const BlockTree own = tree_of(F.mesh, F.x), other = tree_of(W.mesh, W.x);
  return faces_in(own, &F == &W ? own : other).pairs;
}

/// One seed for each region: as long as there are pairs that the walk has not come to, the first.
/// @return number of regions, all of which together are to be exactly what the tree finds
std::size_t expect_what_the_tree_finds(const Walked& F, const Walked& W) {
  const std::vector<Penetration> expected = by_tree(F, W);
  std::vector<Penetration> seeds, left = expected;
  while (!left.empty()) {
    seeds.push_back(left[seeds.size() % left.size()]);
    const auto found = walked(F, W, std::span(&seeds.back(), 1));
    std::vector<Penetration> rest;
    std::set_difference(left.begin(), left.end(), found.begin(), found.end(),
                        std::back_inserter(rest));
    EXPECT_LT(rest.size(), left.size());
    if (!(rest.size() < left.size())) break;
    left = rest;
  }
  EXPECT_EQ(walked(F, W, seeds), expected);
  EXPECT_EQ(walked(F, W, expected), expected);
  return seeds.size();
}

TEST(TopologyWalk, OneSeedFindsTheContactOfTwoBoxes) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 10; ++trial) {
    const Mesh a = box_mesh(6, 5, 4, 1), b = box_mesh(5, 5, 5, 0.9);
    const Walked A{a, jittered(a.X, 0.05, random)},
        B{b, jittered(b.X, 0.05, random).colwise() + Eigen::Vector3d(3.3, 2.7, 2.1)};
    ASSERT_GT(by_tree(A, B).size(), 50u);
    EXPECT_EQ(expect_what_the_tree_finds(A, B), 1u);
    EXPECT_EQ(expect_what_the_tree_finds(B, A), 1u);
  }
}

// The surface of the first enters the second in two places, and is found from two seeds.
TEST(TopologyWalk, ARegionWithoutASeedIsLost) {
  std::mt19937 random(2);
  const Mesh a = box_mesh(12, 2, 2, 1), b = box_mesh(3, 3, 3, 1);
  const Mesh two = joined(b, b);
  Eigen::Matrix3Xd x = jittered(two.X, 0.05, random);
  x.leftCols(b.X.cols()).colwise() += Eigen::Vector3d(-1.7, 0.7, 0.8);
  x.rightCols(b.X.cols()).colwise() += Eigen::Vector3d(10.7, 0.7, 0.8);
  const Walked A{a, jittered(a.X, 0.05, random)}, B{two, x};
  EXPECT_EQ(expect_what_the_tree_finds(A, B), 2u);
  const std::vector<Penetration> all = by_tree(A, B);
  const std::vector<Penetration> found = walked(A, B, std::span(all).first(1));
  EXPECT_LT(found.size(), all.size());
  EXPECT_GT(found.size(), all.size() / 4);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), found.begin(), found.end()));
  EXPECT_TRUE(walked(A, B, {}).empty());
}

TEST(TopologyWalk, FollowsCrookedVShapes) {
  std::mt19937 random(3);
  const Mesh bar = box_mesh(24, 3, 3, 1);
  for (int trial = 0; trial < 5; ++trial) {
    const Walked A{bar, jittered(bend_to_v(bar, 1), 0.15, random)};
    Eigen::Matrix3Xd x = placed(A.x, Eigen::Vector3d(0.5, 0.5, 4), random);
    const Walked B{bar, x};
    EXPECT_LE(expect_what_the_tree_finds(A, B), 6u);
    EXPECT_LE(expect_what_the_tree_finds(B, A), 6u);
  }
}

TEST(TopologyWalk, FollowsAFoldedBody) {
  std::mt19937 random(4);
  const Mesh bar = box_mesh(24, 3, 3, 1);
  for (const double angle : {-0.6, -0.3}) {
    const Walked folded{bar, jittered(bend_to_v(bar, angle), 0.1, random)};
    ASSERT_GT(by_tree(folded, folded).size(), 10u);
    EXPECT_LE(expect_what_the_tree_finds(folded, folded), 6u);
  }
}

TEST(TopologyWalk, SeedsOfTheLastFrameFindTheNext) {
  std::mt19937 random(5);
  const Mesh a = box_mesh(6, 6, 6, 1);
  const Eigen::Matrix3Xd x_a = jittered(a.X, 0.05, random), x_b = jittered(a.X, 0.05, random);
  const Walked A{a, x_a};
  std::vector<Penetration> seeds;
  for (int frame = 0; frame < 20; ++frame) {
    const Eigen::Vector3d shift(5.5 - 0.11 * frame, 4.3, 3.9 + 0.07 * frame);
    const Walked B{a, x_b.colwise() + shift};
    const std::vector<Penetration> expected = by_tree(A, B);
    if (frame > 0) {
      EXPECT_EQ(walked(A, B, seeds), expected) << frame;
    }
    seeds = expected;
  }
  EXPECT_GT(seeds.size(), 50u);
}

// On shapes that touch, are flat, inverted, or far off in size: with a seed in each region, the
// walk finds what the tree finds.
TEST(TopologyWalk, OnHostileShapesASeedInEachRegionFindsAll) {
  std::mt19937 random(6);
  for (const HostilePair& p : hostile_pairs(random)) {
    SCOPED_TRACE(p.name);
    const Walked A{p.a, p.x_a}, B{p.b, p.x_b};
    expect_what_the_tree_finds(A, B);
    expect_what_the_tree_finds(B, A);
    expect_what_the_tree_finds(A, A);
  }
}

}  // namespace articular::collision::testing::topology_walk_test
