#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/box_mesh.hpp"

namespace articular::fem {

/// K u = b for the free nodes of a box that is clamped at x = 0 and pulled along z by one newton a
/// node.
struct ClampedBox {
  Positions X;  // of the free nodes
  BlockMatrix K;
  Eigen::VectorXd b;
};

/// The rows and columns of the free nodes. @param free_nodes  ascending
inline BlockMatrix part_of(const BlockMatrix& K, const std::vector<int>& free_nodes) {
  std::vector<int> number(K.num_blocks(), -1), pairs, offsets{0};
  for (std::size_t k = 0; k < free_nodes.size(); ++k) number[free_nodes[k]] = static_cast<int>(k);
  for (const int i : free_nodes) {  // a node with its neighbours behind it, pair by pair
    for (int s = K.row_begin()[i]; s < K.row_begin()[i + 1]; ++s) {
      if (K.column()[s] <= i || number[K.column()[s]] < 0) continue;
      pairs.push_back(number[i]);
      pairs.push_back(number[K.column()[s]]);
      offsets.push_back(static_cast<int>(pairs.size()));
    }
  }
  BlockMatrix part(static_cast<int>(free_nodes.size()), pairs, offsets);
  for (const int i : free_nodes) {
    int to = part.row_begin()[number[i]];
    for (int s = K.row_begin()[i]; s < K.row_begin()[i + 1]; ++s) {
      if (number[K.column()[s]] >= 0) part.block(to++) = K.block(s);
    }
  }
  return part;
}

/// @param materials  at most two; element e has materials[second(e)]
inline ClampedBox clamped_box(const TetMesh& mesh, double nu, double E = 1e6) {
  const Elasticity elasticity(mesh.X, mesh.tets, Linear(E, nu));
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(mesh.X, Tangent::Consistent, 1, K);
  std::vector<int> free_nodes;
  for (int i = 0; i < mesh.X.cols(); ++i) {
    if (mesh.X(0, i) > 0) free_nodes.push_back(i);
  }
  ClampedBox box;
  box.K = part_of(K, free_nodes);
  box.X = mesh.X(Eigen::all, free_nodes);
  box.b = Vec3(0, 0, 1).replicate(static_cast<Eigen::Index>(free_nodes.size()), 1);
  return box;
}

}  // namespace articular::fem
