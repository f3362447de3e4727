#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::fem {

/// A sparse matrix of 3x1 blocks, nodes (or other blocks of unknowns) x pressures: G = ∂b/∂xᵀ [m²].
/// Its pattern is built once, in compressed rows; values are added in a fixed order.
class PressureGradient {
 public:
  PressureGradient() = default;
  /// The pattern of all pairs of a node and a pressure in one stencil. Stencil k has the nodes
  /// nodes[node_begin[k] .. node_begin[k+1]) and the pressures likewise.
  PressureGradient(int num_nodes, int num_pressures, std::span<const int> nodes,
                   std::span<const int> node_begin, std::span<const int> pressures,
                   std::span<const int> pressure_begin);

  int num_nodes() const { return static_cast<int>(row_begin_.size()) - 1; }
  int num_pressures() const { return num_pressures_; }
  std::span<const int> row_begin() const { return row_begin_; }  // num_nodes + 1
  std::span<const int> column() const { return column_; }        // sorted within a row
  /// Slot of block (node, pressure), or -1 where the pattern has none.
  int slot(int node, int pressure) const;
  Vec3& block(int slot) { return values_[slot]; }
  const Vec3& block(int slot) const { return values_[slot]; }
  double* values() { return values_.data()->data(); }  // 3 a slot
  void set_zero();
  /// For a node that cannot move.
  void set_row_zero(int node);

  /// f += scale G p, 3 entries a node
  void add_product(const Eigen::VectorXd& p, double scale, Eigen::VectorXd& f) const;
  /// b = Gᵀ u
  void multiply_transposed(const Eigen::VectorXd& u, Eigen::VectorXd& b) const;

 private:
  int num_pressures_ = 0;
  std::vector<int> row_begin_{0}, column_;
  std::vector<Vec3> values_;
};

}  // namespace articular::fem
