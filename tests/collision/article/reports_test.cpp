#include "collision/article/reports.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace articular::collision::reports_test {

using PairSet = std::set<std::pair<int, int>>;

PairSet pairs_of(const TriangleLists& lists) {
  PairSet pairs;
  for (const TriangleLists::Pair& pair : lists.pairs()) pairs.insert({pair.face, pair.tetrahedron});
  return pairs;
}

TEST(TriangleLists, Listing_1_5_11_APairIsKeptOnceAndATriangleIsListedOnce) {
  TriangleLists lists;
  lists.clear(10);
  EXPECT_TRUE(lists.insert(3, 7));
  EXPECT_TRUE(lists.insert(3, 8));
  EXPECT_FALSE(lists.insert(3, 7));
  EXPECT_TRUE(lists.insert(9, 7));
  EXPECT_FALSE(lists.insert(3, 8));
  EXPECT_EQ(pairs_of(lists), (PairSet{{3, 7}, {3, 8}, {9, 7}}));
  EXPECT_EQ(lists.pairs().size(), 3u);
  EXPECT_EQ(std::vector<int>(lists.triangles().begin(), lists.triangles().end()),
            (std::vector<int>{3, 9}));
}

TEST(TriangleLists, Listing_1_5_11_ClearingForgetsAllAlsoForAnotherNumberOfTriangles) {
  std::mt19937 random(50);
  TriangleLists lists;
  for (int num_faces : {20, 5, 40, 40, 1}) {
    lists.clear(num_faces);
    EXPECT_TRUE(lists.pairs().empty());
    EXPECT_TRUE(lists.triangles().empty());
    PairSet expected;
    for (int i = 0; i < 200; ++i) {
      const int face = std::uniform_int_distribution(0, num_faces - 1)(random);
      const int tet = std::uniform_int_distribution(0, 9)(random);
      EXPECT_EQ(lists.insert(face, tet), expected.insert({face, tet}).second);
    }
    EXPECT_EQ(pairs_of(lists), expected);
  }
}

}  // namespace articular::collision::reports_test
