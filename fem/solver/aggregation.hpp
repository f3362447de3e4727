#pragma once

#include <span>
#include <vector>

namespace articular::fem {

/// How strongly the nodes of a matrix are coupled: |D_i^-½ A_ij D_j^-½| of its blocks beside the
/// diagonal, symmetric, in compressed rows.
struct CouplingGraph {
  std::span<const int> row_begin, column;
  std::span<const float> weight;

  int num_nodes() const { return static_cast<int>(row_begin.size()) - 1; }
};

struct Aggregation {
  int num_aggregates = 0;
  std::vector<int> aggregate;  // of each node; -1: in none, as hardly coupled to anything
};

/// Groups of strongly coupled neighbours [Vanek 1996, algorithm 2]: a coarser level has one block
/// for each. A node that none takes becomes a group of its own, unless its couplings together are
/// so weak that the smoother alone serves it.
/// @param threshold  weights above it are strong
/// @param alone      1 for a node that shall be a group of its own; empty: none
///
/// [Vanek 1996] Vanek, Mandel, Brezina. Algebraic Multigrid by Smoothed Aggregation for Second and
/// Fourth Order Elliptic Problems. Computing 56.
Aggregation aggregate(const CouplingGraph& graph, float threshold, std::span<const char> alone);

}  // namespace articular::fem
