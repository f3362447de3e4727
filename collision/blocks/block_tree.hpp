#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "collision/blocks/block_kernels.hpp"
#include "collision/mesh/aabb.hpp"
#include "collision/mesh/surface.hpp"

namespace articular::collision {

/// The BucketTree whose buckets move with the tissue.
///
/// A bucket is a block of sixteen neighbouring tetrahedra, or of sixteen surface faces, chosen once
/// from the rest shape; sixteen blocks make a node of the next level, and so on. As elements never
/// change their bucket, an update maps nothing: it copies positions and fits boxes. Every pair of
/// elements has one pair of blocks, so that none is reported twice, and in a block sixteen
/// elements are tested at once.
///
/// Boxes are single-precision numbers in the tree's frame (origin and scale follow the mesh),
/// rounded outward. The positions of the last update are kept in double precision.
class BlockTree {
 public:
  /// @param tets    4 x M node indices
  /// @param X_rest  rest positions [m], one node a column
  /// @throws std::invalid_argument for an index out of range or (naming the node) a position that
  /// is
  ///         not finite
  BlockTree(const Eigen::Matrix4Xi& tets, const Surface& surface, const Eigen::Matrix3Xd& X_rest);

  /// Follows the mesh to positions x [m]; boxes are inflated by margin/2 [m] on each side.
  /// @throws std::invalid_argument for a wrong number of nodes, a bad margin, or (naming the node)
  /// a
  ///         position that is not finite; the tree is then as before
  void update(const Eigen::Matrix3Xd& x, double margin = 0);

  /// The two halves of update(), for a body that may turn out to touch nobody. move() follows
  /// positions and bounds() alone, a third of the work; fit() makes the boxes that queries need,
  /// if they are not made yet.
  void move(const Eigen::Matrix3Xd& x, double margin = 0);
  void fit();
  bool is_fitted() const { return is_fitted_; }

  int num_tets() const { return num_tets_; }
  int num_faces() const { return num_faces_; }
  int num_updates() const { return num_updates_; }
  double margin() const { return margin_; }
  /// Box of all element boxes [m]. Empty before the first update.
  const Aabb& bounds() const { return bounds_; }
  /// Bytes held.
  std::size_t memory() const;

  // For the queries. Node indices are the tree's own, in the order of the blocks.
  int num_tet_blocks() const { return static_cast<int>(tet_block_nodes_begin_.size()) - 1; }
  int num_face_blocks() const { return (num_faces_ + kBlockSize - 1) / kBlockSize; }
  /// Sixteen blocks, or sixteen groups of the level below, a group. The last level has one group.
  const std::vector<std::vector<BoxGroup>>& tet_levels() const { return tet_levels_; }
  const std::vector<BoxGroup>& face_boxes() const { return face_boxes_; }     // one a face block
  const Eigen::Vector3d& origin() const { return origin_; }                   // of the boxes [m]
  double scale() const { return scale_; }                                     // of the boxes [m]
  const double* face_corner_lanes() const { return face_corners_.data(); }    // [block][3][3][16]
  const std::int32_t* face_node_lanes() const { return face_nodes_.data(); }  // [block][3][16]
  /// The face or tetrahedron of the user's numbering in a slot: 16 x block + lane.
  int face_in(int slot) const { return face_order_[static_cast<std::size_t>(slot)]; }
  int tet_in(int slot) const { return tet_order_[static_cast<std::size_t>(slot)]; }
  /// The user's numbers of the nodes at positions(). Nodes of no element are left out.
  /// Four numbers a node of node_order(), the last is 0 [m].
  const double* positions() const { return positions_.data(); }
  const std::vector<int>& node_order() const { return node_order_; }
  Eigen::Index num_user_nodes() const { return num_user_nodes_; }
  /// Fills in the first part of the query.
  void describe_block(int block, BlockQuery& query) const;
  Eigen::Matrix3d face_corners(int slot) const;
  Eigen::Matrix<double, 3, 4> tet_corners(int slot) const;

 private:
  Eigen::Map<const Eigen::Vector3d> node_position(int node) const {
    return Eigen::Map<const Eigen::Vector3d>(&positions_[4 * static_cast<std::size_t>(node)]);
  }
  void order_nodes(const Eigen::Matrix4Xi& tets, const Surface& surface);
  void copy_positions(const Eigen::Matrix3Xd& x);
  void fit_boxes();

  // Fixed.
  int num_tets_, num_faces_;
  Eigen::Index num_user_nodes_;
  std::vector<int> tet_order_, face_order_;  // by slot; the last block is filled up with its last
  std::vector<int> node_order_;              // the user's node, by the tree's
  std::vector<int> tet_block_nodes_begin_, tet_block_nodes_;  // nodes of a block, each once
  std::vector<std::uint8_t> tet_corners_;  // [block][4][16] indices into the block's nodes
  std::vector<std::int32_t> face_nodes_;   // [block][3][16]

  // Of the last update.
  int num_updates_ = 0;
  bool is_fitted_ = true;          // an empty tree is
  double margin_ = 0, scale_ = 1;  // [m]
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Aabb bounds_;
  std::vector<double> positions_;  // four a node, the last is 0
  std::vector<std::vector<BoxGroup>> tet_levels_;
  std::vector<double> face_corners_;  // [block][corner][axis][16]
  std::vector<BoxGroup> face_boxes_;
};

}  // namespace articular::collision
