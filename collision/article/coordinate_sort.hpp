#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/mesh/aabb.hpp"

namespace articular::collision {

/// Bounds of the buckets along x, y and z: 2^(l-1) + 1 values each, ascending (Listing 1.5.6).
/// Every node of the octree finds its box here.
using IntervalLists = std::array<std::vector<double>, 3>;

/// Triplets T_min and T_max of Eq. 1.5.8, both included. A byte holds an index up to 2^(l-1) - 1.
struct BucketInterval {
  std::array<std::uint8_t, 3> min;
  std::array<std::uint8_t, 3> max;
};

/// "The Coordinate Sorting Strategy": the ends of all boxes in one list an axis, kept sorted from
/// step to step by insertion sort, so that one sweep along the list and the bucket bounds gives the
/// bucket indices without a multiplication (Listing 1.5.7).
///
/// Insertion sort costs as many moves as ends have passed each other. That is linear while the
/// order hardly changes and quadratic for a disordered list; beyond kMaxMovesPerEnd the list is
/// handed to a general sort instead and the fallback is counted.
class CoordinateSort {
 public:
  // A general sort of 10 000 to 1 000 000 ends costs about this many moves an end: log2 of the
  // count.
  static constexpr int kMaxMovesPerEnd = 16;

  /// Takes over the ends of the boxes (their number may not change after the first call) and sorts.
  void sort(std::span<const Aabb> boxes);

  /// Box of all boxes, from the first and last entries (Eq. 1.5.9-1.5.10).
  Aabb bounds() const;

  /// Listing 1.5.7 for each axis. All ends must lie between the first and last bound.
  void update_bucket_indices(const IntervalLists& bounds,
                             std::span<BucketInterval> intervals) const;

  std::int64_t num_moves() const { return num_moves_; }          // places that ends were moved by
  std::int64_t num_fallbacks() const { return num_fallbacks_; }  // lists given to the general sort

 private:
  struct End {
    double value;   // [m]
    int box;        // index of the box
    bool is_upper;  // upper or lower end of it
  };

  void sort_axis(std::vector<End>& ends);

  std::array<std::vector<End>, 3> axes_;
  std::int64_t num_moves_ = 0;
  std::int64_t num_fallbacks_ = 0;
};

}  // namespace articular::collision
