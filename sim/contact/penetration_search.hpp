#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "collision/mesh/aabb.hpp"
#include "collision/mesh/penetrations.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

using Penetrations = std::vector<collision::Penetration>;

/// What a search took, accumulated.
struct PenetrationCost {
  std::int64_t narrow_tests = 0;
  std::int64_t pairs = 0;  // reported
  double narrow_seconds = 0;
};

/// Positions of bodies in, sorted pairs out: which surface triangles enter which tetrahedra, by one
/// of the trees of the collision module. The pairs are the same with either.
///
/// move() and fit() are the halves of an update of blocks: a body whose box overlaps no other needs
/// the first alone. Buckets are filled by move().
class PenetrationSearch {
 public:
  virtual ~PenetrationSearch() = default;
  /// The body is at x [m] now. What is nearer than the margin [m], the same for all, counts as
  /// entering.
  virtual void move(std::size_t body, const Positions& x, double margin) = 0;
  /// Makes a body ready for queries. @return false: it was, where it is now
  virtual bool fit(std::size_t body) = 0;
  /// A body's box where it is now, with its part of the margin.
  virtual const collision::Aabb& bounds(std::size_t body) const = 0;
  /// Of two bodies that are fit, sorted by triangle, then tetrahedron.
  virtual void between(std::size_t a, std::size_t b, Penetrations& a_in_b, Penetrations& b_in_a,
                       PenetrationCost& cost) = 0;
  /// Of a body that is fit with itself, without pairs that share a node.
  virtual void within(std::size_t body, Penetrations& found, PenetrationCost& cost) = 0;
};

/// @param bodies  colliders, which stay where they are
std::unique_ptr<PenetrationSearch> make_penetration_search(
    const std::vector<const Collider*>& bodies, Detection::Tree tree,
    std::shared_ptr<ThreadPool> pool);

}  // namespace articular::sim
