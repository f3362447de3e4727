#include "collision/mesh/sweep.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/collision/support/meshes.hpp"

namespace articular::collision::sweep_test {

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

TEST(BodySweep, FindsWhatAllPairsFindWhileBodiesMoveAndJump) {
  std::mt19937 random(1);
  BodySweep sweep;
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
    EXPECT_EQ(sweep.overlapping_bodies(boxes), expected);
    found += expected.size();
  }
  EXPECT_GT(found, 1000u);
}

TEST(BodySweep, EmptyBoxesOverlapNothing) {
  std::mt19937 random(2);
  std::vector<Aabb> boxes(10);
  BodySweep sweep;
  EXPECT_TRUE(sweep.overlapping_bodies(boxes).empty());
  EXPECT_TRUE(sweep.overlapping_bodies({}).empty());
  for (std::size_t i = 0; i < boxes.size(); i += 2) boxes[i] = random_box(random, 0.3);
  EXPECT_EQ(sweep.overlapping_bodies(boxes), all_pairs(boxes));
  EXPECT_FALSE(sweep.overlapping_bodies(boxes).empty());
  boxes[0] = Aabb();
  EXPECT_EQ(sweep.overlapping_bodies(boxes), all_pairs(boxes));
}

TEST(BodySweep, TheNumberOfBodiesMayChange) {
  std::mt19937 random(3);
  BodySweep sweep;
  std::vector<Aabb> boxes;
  for (const std::size_t num : {5u, 20u, 3u, 0u, 12u}) {
    boxes.resize(num);
    for (Aabb& box : boxes) box = random_box(random, 1);
    EXPECT_EQ(sweep.overlapping_bodies(boxes), all_pairs(boxes));
  }
}

TEST(BodySweep, BoxesThatTouchOverlap) {
  std::vector<Aabb> boxes(3);
  for (int i = 0; i < 3; ++i) {
    boxes[static_cast<std::size_t>(i)].include(Eigen::Vector3d(i, 0, 0));
    boxes[static_cast<std::size_t>(i)].include(Eigen::Vector3d(i + 1, 1, 1));
  }
  const std::vector<BodyPair> expected = {{0, 1}, {1, 2}};
  EXPECT_EQ(BodySweep().overlapping_bodies(boxes), expected);
}

TEST(BodySweep, PairsDoNotDependOnWhatWasAskedBefore) {
  std::mt19937 random(4);
  std::vector<Aabb> before(30), boxes(30);
  for (Aabb& box : before) box = random_box(random, 2);
  for (Aabb& box : boxes) box = random_box(random, 2);
  BodySweep used, fresh;
  used.overlapping_bodies(before);
  EXPECT_EQ(used.overlapping_bodies(boxes), fresh.overlapping_bodies(boxes));
}

}  // namespace articular::collision::sweep_test
