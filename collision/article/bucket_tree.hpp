#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "collision/article/coordinate_sort.hpp"
#include "collision/mesh/aabb.hpp"
#include "collision/mesh/surface.hpp"

namespace articular::collision {

/// How the buckets of an element are found.
enum class Mapping {
  Direct,             // Eq. 1.5.7-1.5.8
  CoordinateSorting,  // Listings 1.5.6-1.5.7
};

struct BucketTreeOptions {
  // n of Eq. 1.5.6: bucket edge / mean tetrahedron diameter. The floor leaves buckets of n to 2n
  // diameters. Smaller ones cost more pairs of buckets, larger ones more box tests.
  double bucket_ratio = 2;
  std::optional<Aabb> fixed_root;  // size of the root [m]; without one it is refitted every update
  Mapping mapping = Mapping::Direct;
};

/// l of Eq. 1.5.6: 1 + log2(root_edge / (2 mean_radius n)), at least 1 and at most kMaxLevels.
int choose_num_levels(double root_edge, double mean_radius, double bucket_ratio);

/// Radius of the sphere with the mean volume of the tetrahedra (Eq. 1.5.4-1.5.5) [m].
/// @throws std::invalid_argument naming an inverted or flat element
double mean_tetrahedron_radius(const Eigen::Matrix4Xi& tets, const Eigen::Matrix3Xd& X_rest);

/// Octree of cubic buckets over the tetrahedra of one deforming mesh.
///
/// Level 1 is the root, level l the buckets, a grid of 2^(l-1) cells along each axis. Nodes are
/// stored level by level and never cleared: a node belongs to the last update if its stamp says
/// so. A tree that was never updated is empty. The tree copies what it is built from and the
/// positions of the last update, so that it stays valid by itself; copies are independent.
class BucketTree {
 public:
  // 8^6 = 262 144 buckets, about 6 MB a tree; each further level takes eight times as much. Enough
  // for compact meshes of a few million elements; buckets of larger meshes are just fuller.
  static constexpr int kMaxLevels = 7;

  /// A node by level (1..num_levels) and place in the grid of that level.
  struct Node {
    std::uint8_t level;
    std::array<std::uint8_t, 3> place;
  };

  /// @param tets    4 x M node indices
  /// @param X_rest  rest positions [m], one node a column; every rest volume must be positive
  /// @throws std::invalid_argument for a bad element, bucket ratio or fixed root
  BucketTree(const Eigen::Matrix4Xi& tets, const Surface& surface, const Eigen::Matrix3Xd& X_rest,
             BucketTreeOptions options = {});

  /// Remaps every tetrahedron (Listing 1.5.4) at positions x [m], boxes inflated by margin/2 [m] on
  /// each side. The root is refitted, or, if it is fixed and the mesh has left it, moved and, where
  /// needed, enlarged for this update.
  /// @throws std::invalid_argument for a wrong number of nodes, a bad margin, or (naming the node)
  /// a
  ///         position that is not finite; the tree is then as before
  void update(const Eigen::Matrix3Xd& x, double margin = 0);

  /// The same, and on_add(Q, earlier) for every tetrahedron Q that enters a bucket, where earlier
  /// (std::span<const int>) are the tetrahedra that the bucket already has: the place of
  /// selfIntersection(Q, T) in Listing 1.5.2.
  template <class OnAdd>
  void update(const Eigen::Matrix3Xd& x, double margin, OnAdd&& on_add) {
    begin_remap(x, margin);
    for (int Q = 0; Q < num_tets(); ++Q) add_to_buckets(Q, on_add);
    update_flags();
  }

  int num_updates() const { return now_; }
  int num_levels() const { return num_levels_; }
  /// Updates at which the mesh had left its fixed root.
  int num_root_refits() const { return num_root_refits_; }
  double margin() const { return margin_; }
  const Aabb& root() const { return root_; }      // cube
  const Aabb& bounds() const { return bounds_; }  // box of all element boxes

  const Eigen::Matrix4Xi& tets() const { return tets_; }
  const Surface& surface() const { return surface_; }
  const Eigen::Matrix3Xd& positions() const { return x_; }  // of the last update
  int num_tets() const { return static_cast<int>(tets_.cols()); }
  int num_faces() const { return static_cast<int>(surface_.faces.cols()); }
  std::span<const int> faces_of(int tet) const {
    const std::size_t e = static_cast<std::size_t>(tet);
    const int begin = surface_.tet_face_begin[e], end = surface_.tet_face_begin[e + 1];
    return std::span(surface_.tet_faces)
        .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
  }
  const Aabb& tet_box(int tet) const { return tet_boxes_[static_cast<std::size_t>(tet)]; }
  const Aabb& face_box(int face) const { return face_boxes_[static_cast<std::size_t>(face)]; }

  // Nodes.
  static Node root_node() { return {1, {0, 0, 0}}; }
  static Node child(Node node, int octant) {
    Node c{static_cast<std::uint8_t>(node.level + 1), {}};
    for (unsigned axis = 0; axis < 3; ++axis)
      c.place[axis] = static_cast<std::uint8_t>(2 * node.place[axis] + ((octant >> axis) & 1));
    return c;
  }
  bool is_bucket(Node node) const { return node.level == num_levels_; }
  /// Has the last update put a tetrahedron into or below this node?
  bool is_current(Node node) const { return flags(node).stamp == now_; }
  /// Is there a tetrahedron with a surface face? Only meaningful for a current node.
  bool has_surface(Node node) const { return flags(node).surface; }
  double edge(Node node) const { return root_edge_ / (1 << (node.level - 1)); }
  /// Box of a node, larger by the round-off of the mapping so that it contains what is mapped to
  /// it.
  Aabb box(Node node) const;
  /// Tetrahedra of a current bucket in the order in which they were added.
  std::span<const int> tets_in(Node bucket) const { return contents(index(bucket)); }
  /// Contents of the i-th non-empty bucket (the list B of Listing 1.5.4).
  std::span<const int> non_empty_bucket(int i) const {
    return contents(non_empty_[static_cast<std::size_t>(i)]);
  }
  int num_non_empty_buckets() const { return static_cast<int>(non_empty_.size()); }

  /// Work of the coordinate sorting, or nothing with the direct mapping.
  const std::optional<CoordinateSort>& coordinate_sort() const { return sort_; }

 private:
  struct Flags {
    int stamp = 0;  // update that this node was last touched by; they count from 1
    bool surface = false;
  };

  std::size_t level_begin(int level) const {
    return ((std::size_t{1} << (3 * (level - 1))) - 1) / 7;  // 8^0 + ... + 8^(level-2)
  }
  std::size_t index_in_level(Node node) const {
    const int bits = node.level - 1;
    return ((std::size_t{node.place[2]} << bits | node.place[1]) << bits) | node.place[0];
  }
  std::size_t index(Node bucket) const { return index_in_level(bucket); }
  Flags& flags(Node node) { return flags_[level_begin(node.level) + index_in_level(node)]; }
  const Flags& flags(Node node) const {
    return flags_[level_begin(node.level) + index_in_level(node)];
  }
  std::span<const int> contents(std::size_t bucket) const {
    return std::span(entries_).subspan(begin_[bucket], static_cast<std::size_t>(count_[bucket]));
  }

  void begin_remap(const Eigen::Matrix3Xd& x, double margin);
  void update_boxes();
  void update_root();
  void update_interval_lists();
  void map_directly();
  void count_in_buckets();
  void update_flags();

  /// Calls visit(bucket) for the buckets of Eq. 1.5.8, bounds included (erratum 5).
  template <class Visit>
  void for_each_bucket(int Q, Visit&& visit) const {
    const BucketInterval& T = intervals_[static_cast<std::size_t>(Q)];
    const int bits = num_levels_ - 1;
    for (std::size_t z = T.min[2]; z <= T.max[2]; ++z)
      for (std::size_t y = T.min[1]; y <= T.max[1]; ++y)
        for (std::size_t x = T.min[0]; x <= T.max[0]; ++x) visit(((z << bits | y) << bits) | x);
  }

  /// Listing 1.5.2. Stamp, surface flag and room were seen to by count_in_buckets().
  template <class OnAdd>
  void add_to_buckets(int Q, OnAdd&& on_add) {
    for_each_bucket(Q, [&](std::size_t bucket) {
      on_add(Q, contents(bucket));
      entries_[begin_[bucket] + static_cast<std::size_t>(count_[bucket]++)] = Q;
    });
  }

  // Fixed.
  Eigen::Matrix4Xi tets_;
  Surface surface_;
  BucketTreeOptions options_;
  int num_levels_ = 1;
  double smallest_root_edge_ = 0;  // with buckets of edge s n (Eq. 1.5.2) [m]

  // Of the last update.
  int now_ = 0;
  int num_root_refits_ = 0;
  double margin_ = 0;     // [m]
  double root_edge_ = 0;  // [m]
  double round_off_ = 0;  // of mapped coordinates and bucket bounds [m]
  Eigen::Matrix3Xd x_;    // [m]
  Aabb bounds_, root_;
  std::vector<Aabb> tet_boxes_, face_boxes_;
  std::optional<CoordinateSort> sort_;
  IntervalLists interval_lists_;
  std::vector<BucketInterval> intervals_;  // per tetrahedron

  std::vector<Flags> flags_;            // per node, level by level
  std::vector<std::size_t> begin_;      // per bucket: its first entry
  std::vector<int> count_;              // per bucket: number of its entries
  std::vector<int> entries_;            // tetrahedra, bucket by bucket
  std::vector<std::size_t> non_empty_;  // buckets of the last update: the list B
};

}  // namespace articular::collision
