#include "fem/sparse/supernodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace articular::fem::supernodes_test {

/// The pattern of n x n x n nodes with three unknowns, each with its neighbours along the edges.
SymmetricMatrix grid(int n) {
  SymmetricMatrix A;
  for (int node = 0; node < n * n * n; ++node) {
    for (int p = 0; p < 3; ++p) {
      for (const int distance : {n * n, n, 1}) {
        if (node < distance || (distance == 1 && node % n == 0)) continue;
        for (int q = 0; q < 3; ++q) A.row.push_back(3 * (node - distance) + q);
      }
      for (int q = 0; q <= p; ++q) A.row.push_back(3 * node + q);
      A.end_column();
    }
  }
  A.value.resize(A.row.size());
  return A;
}

std::vector<int> rows_of(const Supernodes& nodes, int s) {
  return {nodes.row.begin() + nodes.row_begin[s], nodes.row.begin() + nodes.row_begin[s + 1]};
}

struct SupernodesTest : testing::Test {
  const int n = 7;
  const SymmetricMatrix A = grid(n);
  const std::vector<int> group = groups_of_three(n * n * n);
  const Supernodes nodes = find_supernodes(A, group);
};

TEST_F(SupernodesTest, UnknownsOfANodeStayTogether) {
  std::vector<int> sorted = nodes.order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> all(sorted.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
  for (int i = 0; i < nodes.size(); i += 3)
    for (int q = 1; q < 3; ++q) EXPECT_EQ(nodes.order[i + q], nodes.order[i] + q);
  for (int i = 0; i < nodes.size(); ++i) EXPECT_EQ(nodes.inverse_order[nodes.order[i]], i);
}

// Symbolic elimination by sets: column j gets its rows in A and those of the columns whose first
// row below the diagonal it is. Supernodes may hold more.
TEST_F(SupernodesTest, HoldTheFillOfElimination) {
  std::vector<std::set<int>> rows(static_cast<std::size_t>(nodes.size()));
  for (int j = 0; j < A.size(); ++j) {
    for (int k = A.begin[j]; k < A.begin[j + 1]; ++k) {
      const auto [low, high] = std::minmax({nodes.inverse_order[j], nodes.inverse_order[A.row[k]]});
      rows[static_cast<std::size_t>(low)].insert(high);
    }
  }
  std::size_t fill = 0;
  for (int j = 0; j < nodes.size(); ++j) {
    std::set<int>& own = rows[static_cast<std::size_t>(j)];
    fill += own.size();
    const std::vector<int> stored = rows_of(nodes, nodes.of_column[j]);
    EXPECT_TRUE(std::includes(stored.begin(), stored.end(), own.begin(), own.end())) << j;
    own.erase(j);
    if (!own.empty()) rows[static_cast<std::size_t>(*own.begin())].insert(own.begin(), own.end());
  }
  EXPECT_LT(nodes.value_begin.back(), 2 * static_cast<std::ptrdiff_t>(fill));
}

TEST_F(SupernodesTest, EachEntryHasItsPlace) {
  std::vector<int> column_of(A.row.size());
  for (int j = 0; j < A.size(); ++j)
    std::fill(column_of.begin() + A.begin[j], column_of.begin() + A.begin[j + 1], j);
  std::set<int> seen;
  for (int s = 0; s < nodes.count(); ++s) {
    const std::vector<int> rows = rows_of(nodes, s);
    int last = -1;
    for (int e = nodes.entry_begin[s]; e < nodes.entry_begin[s + 1]; ++e) {
      const auto [k, place] = nodes.entry[static_cast<std::size_t>(e)];
      const int column = nodes.order[nodes.first_column[s] + place / nodes.num_rows(s)];
      const int row = nodes.order[rows[static_cast<std::size_t>(place % nodes.num_rows(s))]];
      const auto k_u = static_cast<std::size_t>(k);
      EXPECT_EQ(std::minmax(column, row), std::minmax(column_of[k_u], A.row[k_u]));
      EXPECT_LE(last / nodes.num_rows(s), place / nodes.num_rows(s));
      last = place;
      seen.insert(k);
    }
  }
  EXPECT_EQ(seen.size(), A.row.size());
}

// What is computed side by side: a subtree writes its own columns, and rows above it in a place
// that is its own.
TEST_F(SupernodesTest, SubtreesMeetOnlyAbove) {
  EXPECT_GT(nodes.subtrees.size(), 4u);
  std::set<int> in_subtrees, own_places;
  for (const auto& [begin, end, first_above] : nodes.subtrees) {
    const int first = nodes.first_column[begin], last = nodes.first_column[end];
    std::set<int> above;
    for (int s = begin; s < end; ++s) {
      EXPECT_TRUE(in_subtrees.insert(s).second);
      for (int k = nodes.row_begin[s]; k < nodes.row_begin[s + 1]; ++k) {
        const int row = nodes.row[k], place = nodes.forward_row[k];
        EXPECT_GE(row, first);
        if (row < last) {
          EXPECT_EQ(place, row);
          continue;
        }
        EXPECT_TRUE(std::binary_search(nodes.top.begin(), nodes.top.end(), nodes.of_column[row]));
        const std::vector<int> of_root = rows_of(nodes, end - 1);
        EXPECT_EQ(row, of_root[static_cast<std::size_t>(nodes.num_columns(end - 1) + place -
                                                        nodes.size() - first_above)]);
        above.insert(place);
      }
    }
    for (const int place : above) EXPECT_TRUE(own_places.insert(place).second);
  }
  EXPECT_EQ(static_cast<int>(in_subtrees.size() + nodes.top.size()), nodes.count());
  EXPECT_EQ(static_cast<int>(own_places.size()), nodes.num_above);
}

// What is above the subtrees is factored level by level, those of one level side by side.
TEST_F(SupernodesTest, LevelsComeBeforeWhatTheyChange) {
  std::vector<int> level_of(static_cast<std::size_t>(nodes.count()), -1);
  int num_side_by_side = 0;
  for (std::size_t level = 0; level < nodes.levels.size(); ++level)
    for (const int s : nodes.levels[level]) {
      EXPECT_EQ(std::exchange(level_of[static_cast<std::size_t>(s)], static_cast<int>(level)), -1);
      num_side_by_side += nodes.levels[level].size() > 1;
    }
  EXPECT_GT(num_side_by_side, 0);
  for (int s = 0; s < nodes.count(); ++s) {
    const bool above = std::binary_search(nodes.top.begin(), nodes.top.end(), s);
    const int level = level_of[static_cast<std::size_t>(s)];
    EXPECT_EQ(level >= 0, above);
    for (const int row : rows_of(nodes, s)) {
      const int other = nodes.of_column[row];
      if (!above || other == s) continue;
      EXPECT_GT(level_of[static_cast<std::size_t>(other)], level);
    }
  }
}

TEST(Supernodes, AreThereForOneUnknownAndForUnknownsThatDoNotMeet) {
  SymmetricMatrix diagonal;
  for (int j = 0; j < 5; ++j) {
    diagonal.row.push_back(j);
    diagonal.end_column();
    const Supernodes nodes = find_supernodes(diagonal, {});
    EXPECT_EQ(nodes.size(), j + 1);
    EXPECT_EQ(nodes.num_above, 0);
    EXPECT_EQ(nodes.entry.size(), static_cast<std::size_t>(j + 1));
  }
}

}  // namespace articular::fem::supernodes_test
