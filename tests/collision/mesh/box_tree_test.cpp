#include "collision/mesh/box_tree.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/collision/support/meshes.hpp"

namespace articular::collision::box_tree_test {

std::vector<BodyPair> all_pairs(const std::vector<Aabb>& boxes) {
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = i + 1; k < boxes.size(); ++k)
      if (overlap(boxes[i], boxes[k])) pairs.push_back({static_cast<int>(i), static_cast<int>(k)});
  return pairs;
}

Aabb random_box(std::mt19937& random, double spread) {
  Aabb box;
  box.include(testing::random_vector(random, spread));
  box.include(Eigen::Vector3d(box.min + testing::random_vector(random, 1)));
  return box;
}

TEST(BoxTree, FindsWhatAllPairsFind) {
  std::mt19937 random(1);
  BoxTree tree;
  std::vector<Aabb> boxes(60);
  for (Aabb& box : boxes) box = random_box(random, 2);
  std::size_t found = 0;
  for (int step = 0; step < 200; ++step) {
    for (Aabb& box : boxes) {
      const Eigen::Vector3d way = testing::random_vector(random, 0.05);
      box.min += way;
      box.max += way;
    }
    boxes[random() % boxes.size()] = random_box(random, 4);
    if (step % 50 == 49) std::shuffle(boxes.begin(), boxes.end(), random);
    const std::vector<BodyPair> expected = all_pairs(boxes);
    EXPECT_EQ(tree.overlapping_bodies(boxes), expected);
    found += expected.size();
  }
  EXPECT_GT(found, 1000u);
}

TEST(BoxTree, EmptyBoxesOverlapNothing) {
  std::mt19937 random(2);
  std::vector<Aabb> boxes(10);
  BoxTree tree;
  EXPECT_TRUE(tree.overlapping_bodies(boxes).empty());
  EXPECT_TRUE(tree.overlapping_bodies({}).empty());
  for (std::size_t i = 0; i < boxes.size(); i += 2) boxes[i] = random_box(random, 0.3);
  EXPECT_EQ(tree.overlapping_bodies(boxes), all_pairs(boxes));
  EXPECT_FALSE(tree.overlapping_bodies(boxes).empty());
  boxes[0] = Aabb();
  EXPECT_EQ(tree.overlapping_bodies(boxes), all_pairs(boxes));
}

TEST(BoxTree, TheNumberOfBodiesMayChange) {
  std::mt19937 random(3);
  BoxTree tree;
  std::vector<Aabb> boxes;
  for (const std::size_t num : {5u, 20u, 3u, 0u, 12u}) {
    boxes.resize(num);
    for (Aabb& box : boxes) box = random_box(random, 1);
    EXPECT_EQ(tree.overlapping_bodies(boxes), all_pairs(boxes));
  }
}

TEST(BoxTree, BoxesThatTouchOverlap) {
  std::vector<Aabb> boxes(3);
  for (int i = 0; i < 3; ++i) {
    boxes[static_cast<std::size_t>(i)].include(Eigen::Vector3d(i, 0, 0));
    boxes[static_cast<std::size_t>(i)].include(Eigen::Vector3d(i + 1, 1, 1));
  }
  const std::vector<BodyPair> expected = {{0, 1}, {1, 2}};
  EXPECT_EQ(BoxTree().overlapping_bodies(boxes), expected);
}

TEST(BoxTree, PairsDoNotDependOnWhatWasAskedBefore) {
  std::mt19937 random(4);
  std::vector<Aabb> before(30), boxes(30);
  for (Aabb& box : before) box = random_box(random, 2);
  for (Aabb& box : boxes) box = random_box(random, 2);
  BoxTree used, fresh;
  used.overlapping_bodies(before);
  EXPECT_EQ(used.overlapping_bodies(boxes), fresh.overlapping_bodies(boxes));
}

/// A heap of unit cubes, n along each edge, next to a floor below all of them.
std::vector<Aabb> heap(int n) {
  std::mt19937 random(5);
  std::vector<Aabb> boxes;
  for (int i = 0; i < n * n * n; ++i) {
    Aabb box;
    const int x = i % n, y = i / n % n, z = i / n / n;
    box.include(Eigen::Vector3d(x, y, z) + testing::random_vector(random, 0.2));
    box.include(Eigen::Vector3d(box.min + Eigen::Vector3d::Ones()));
    boxes.push_back(box);
  }
  Aabb floor;
  floor.include(Eigen::Vector3d(-n, -n, -1));
  floor.include(Eigen::Vector3d(2 * n, 2 * n, 0));
  boxes.push_back(floor);
  return boxes;
}

TEST(BoxTree, InAHeapComparesAsManyBoxesForEachBodyHoweverManyThereAre) {
  BoxTree tree;
  std::vector<double> of_each;  // tests by bodies
  for (const int n : {6, 12, 24}) {
    const std::vector<Aabb> boxes = heap(n);
    EXPECT_GE(tree.overlapping_bodies(boxes).size(), boxes.size());
    of_each.push_back(static_cast<double>(tree.num_tests()) / static_cast<double>(boxes.size()));
  }
  // Eight times as many bodies each: with all pairs it would be eight times as many tests, swept
  // along one axis four times. Less of them lie at the heap's surface, and the floor is met by a
  // logarithm of nodes: a third more at most.
  EXPECT_LT(of_each[1], 1.5 * of_each[0]);
  EXPECT_LT(of_each[2], 1.33 * of_each[1]);
}

TEST(BoxTree, BodiesAtTheSamePlaceAreAllPaired) {
  std::vector<Aabb> boxes(20);
  for (Aabb& box : boxes) {
    box.include(Eigen::Vector3d::Zero());
    box.include(Eigen::Vector3d::Ones());
  }
  EXPECT_EQ(BoxTree().overlapping_bodies(boxes), all_pairs(boxes));
}

}  // namespace articular::collision::box_tree_test
