#pragma once

#include <span>
#include <vector>

#include "fem/base/types.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// How the neighbourhood of each node has turned: the rotation R next to Σ_j (x_j − x_i)(X_j −
/// X_i)ᵀ over the neighbours j of node i in a graph, by the iteration of [Müller 2016] from the
/// rotation given. A node without neighbours keeps it.
/// @param row_begin, column  the graph; indices from num_nodes on are not nodes and are left out
/// @param[in,out] R          one a node
///
/// [Müller 2016] Müller, Bender, Chentanez, Macklin. A Robust Method to Extract the Rotational Part
/// of Deformations. Motion in Games.
void update_nodal_rotations(std::span<const int> row_begin, std::span<const int> column,
                            const Positions& X, const Positions& x, std::vector<Mat3>& R,
                            ThreadPool& pool);

}  // namespace articular::fem
