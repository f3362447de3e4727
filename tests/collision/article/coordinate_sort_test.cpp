#include "collision/article/coordinate_sort.hpp"

#include <gtest/gtest.h>

#include "tests/collision/support/meshes.hpp"

namespace articular::collision::testing::coordinate_sort_test {

/// Small boxes spread over the unit cube.
std::vector<Aabb> random_boxes(std::size_t count, std::mt19937& random) {
  std::vector<Aabb> boxes(count);
  for (Aabb& box : boxes) {
    const Eigen::Vector3d centre = Eigen::Vector3d::Constant(0.5) + random_vector(random, 0.48);
    box.include(centre);
    box.inflate(std::uniform_real_distribution<double>(0, 0.02)(random));
  }
  return boxes;
}

IntervalLists unit_cube_intervals(int num_buckets) {
  IntervalLists lists;
  for (std::vector<double>& list : lists)
    for (int i = 0; i <= num_buckets; ++i) list.push_back(static_cast<double>(i) / num_buckets);
  return lists;
}

void expect_indices_of_the_direct_mapping(const CoordinateSort& sort,
                                          const std::vector<Aabb>& boxes, int num_buckets) {
  std::vector<BucketInterval> intervals(boxes.size());
  sort.update_bucket_indices(unit_cube_intervals(num_buckets), intervals);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (unsigned axis = 0; axis < 3; ++axis) {
      const auto place = [&](double p) {
        return std::clamp(static_cast<int>(std::floor(num_buckets * p)), 0, num_buckets - 1);
      };
      EXPECT_EQ(intervals[i].min[axis], place(boxes[i].min[axis]));
      EXPECT_EQ(intervals[i].max[axis], place(boxes[i].max[axis]));
    }
}

TEST(CoordinateSort, Listing_1_5_7_GivesTheIndicesOfEquation_1_5_7) {
  std::mt19937 random(20);
  for (int num_buckets : {1, 2, 8, 64}) {
    std::vector<Aabb> boxes = random_boxes(500, random);
    CoordinateSort sort;
    for (int step = 0; step < 5; ++step) {
      sort.sort(boxes);
      expect_indices_of_the_direct_mapping(sort, boxes, num_buckets);
      for (Aabb& box : boxes) {
        const Eigen::Vector3d motion = random_vector(random, 1e-4);
        box.min += motion;
        box.max += motion;
      }
    }
  }
}

TEST(CoordinateSort, Erratum11_AnEndOnABoundBelongsToTheBucketAboveAndTheLastBoundToTheLast) {
  std::vector<Aabb> boxes(5);
  for (int i = 0; i < 5; ++i)
    boxes[static_cast<std::size_t>(i)].include(Eigen::Vector3d::Constant(0.25 * i));
  CoordinateSort sort;
  sort.sort(boxes);
  std::vector<BucketInterval> intervals(boxes.size());
  sort.update_bucket_indices(unit_cube_intervals(4), intervals);
  const int expected[] = {0, 1, 2, 3, 3};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(intervals[i].min[0], expected[i]);
}

TEST(CoordinateSort, Erratum11_EmptyBucketsAreSteppedOver) {
  std::vector<Aabb> boxes(2);
  boxes[0].include(Eigen::Vector3d::Constant(0.01));
  boxes[1].include(Eigen::Vector3d::Constant(0.99));
  CoordinateSort sort;
  sort.sort(boxes);
  expect_indices_of_the_direct_mapping(sort, boxes, 64);
}

TEST(CoordinateSort, Equation_1_5_9_BoundsAreTheFirstAndLastEntries) {
  std::mt19937 random(21);
  const std::vector<Aabb> boxes = random_boxes(300, random);
  Aabb expected;
  for (const Aabb& box : boxes) expected.include(box);
  CoordinateSort sort;
  sort.sort(boxes);
  EXPECT_EQ(sort.bounds().min, expected.min);
  EXPECT_EQ(sort.bounds().max, expected.max);
}

TEST(CoordinateSort, AnOrderThatDoesNotChangeCostsNoMove) {
  std::mt19937 random(22);
  std::vector<Aabb> boxes = random_boxes(2000, random);
  CoordinateSort sort;
  sort.sort(boxes);
  const std::int64_t moves = sort.num_moves(), fallbacks = sort.num_fallbacks();
  for (Aabb& box : boxes) {  // stretched and shifted
    box.min = 3 * box.min.array() + 1;
    box.max = 3 * box.max.array() + 1;
  }
  sort.sort(boxes);
  EXPECT_EQ(sort.num_moves(), moves);
  EXPECT_EQ(sort.num_fallbacks(), fallbacks);
}

// Erratum 14: insertion sort of a list in random order takes a quarter of the square of its length.
TEST(CoordinateSort, Erratum14_ADisorderedListDoesNotCostTheSquareOfItsLength) {
  std::mt19937 random(23);
  for (std::size_t count : {1000u, 4000u, 16000u}) {
    const std::vector<Aabb> boxes = random_boxes(count, random),
                            others = random_boxes(count, random);
    CoordinateSort sort;
    sort.sort(boxes);
    EXPECT_EQ(sort.num_fallbacks(), 3);  // the first list has no order yet
    sort.sort(others);
    EXPECT_EQ(sort.num_fallbacks(), 6);
    const auto num_ends = static_cast<std::int64_t>(2 * count);
    EXPECT_LE(sort.num_moves(), 6 * CoordinateSort::kMaxMovesPerEnd * num_ends);
    expect_indices_of_the_direct_mapping(sort, others, 16);
  }
}

TEST(CoordinateSort, Erratum14_MovesAtAGivenMotionGrowWithTheSquareOfTheSize) {
  std::mt19937 random(24);
  std::vector<double> moves_per_end;
  for (std::size_t count : {1000u, 2000u, 4000u}) {
    std::vector<Aabb> boxes = random_boxes(count, random);
    CoordinateSort sort;
    sort.sort(boxes);
    const std::int64_t before = sort.num_moves();
    for (Aabb& box : boxes) {
      const Eigen::Vector3d motion = random_vector(random, 5e-4);
      box.min += motion;
      box.max += motion;
    }
    sort.sort(boxes);
    EXPECT_EQ(sort.num_fallbacks(), 3);
    moves_per_end.push_back(static_cast<double>(sort.num_moves() - before) /
                            static_cast<double>(2 * count));
  }
  EXPECT_NEAR(moves_per_end[1] / moves_per_end[0], 2, 0.3);
  EXPECT_NEAR(moves_per_end[2] / moves_per_end[1], 2, 0.3);
}

}  // namespace articular::collision::testing::coordinate_sort_test
