#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fem/sparse/symmetric_matrix.hpp"

namespace articular::fem {

/// The pattern of a sparse triangular factor by supernodes: columns next to each other that have
/// their rows in common, stored as one dense block.
///
/// Supernode s has the columns first_column[s] .. first_column[s+1] of the ordered matrix and the
/// rows row[row_begin[s] .. row_begin[s+1]), its own columns first. Its block, column-major, is
/// value_begin[s] .. value_begin[s+1] of the values.
struct Supernodes {
  std::vector<int> order, inverse_order;  // ordered -> given, given -> ordered
  std::vector<int> first_column, row_begin, row;
  std::vector<int> of_column;
  std::vector<std::ptrdiff_t> value_begin;

  /// Entry k of the matrix goes to `place` in the block of its supernode; those of supernode s are
  /// entry[entry_begin[s] .. entry_begin[s+1]), column by column of the block.
  struct Entry {
    int k, place;
  };
  std::vector<Entry> entry;
  std::vector<int> entry_begin;

  /// Subtrees of the elimination tree: supernodes [begin, end), whose columns meet no other
  /// subtree's. Which they are depends on the pattern alone.
  struct Subtree {
    int begin, end;
    int first_above;  // where its rows above itself begin among all subtrees'
  };
  std::vector<Subtree> subtrees;  // largest first
  std::vector<int> top;           // supernodes in no subtree, ascending
  /// The same by their distance from the roots, farthest first: those of one level meet no columns
  /// of each other.
  std::vector<std::vector<int>> levels;
  int num_above = 0;
  /// Rows as the forward solution of a subtree writes them: those above the subtree are
  /// size() + first_above + their number, as they are every subtree's own until all are done.
  std::vector<int> forward_row;

  int size() const { return static_cast<int>(order.size()); }
  int count() const { return static_cast<int>(first_column.size()) - 1; }
  int num_columns(int s) const { return first_column[s + 1] - first_column[s]; }
  int num_rows(int s) const { return row_begin[s + 1] - row_begin[s]; }
  /// The supernode whose columns the rows below its own begin with, or -1.
  int parent(int s) const {
    const int below = row_begin[s] + num_columns(s);
    return below < row_begin[s + 1] ? of_column[row[below]] : -1;
  }
};

/// Nested dissection.
/// @param group  of each unknown, ascending from 0: they stay together (the three of a node);
/// empty:
///               each on its own
Supernodes find_supernodes(const SymmetricMatrix& A, std::span<const int> group);

}  // namespace articular::fem
