#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace articular::collision {

/// A list of tetrahedra in each triangle, and the list of triangles whose list is not empty
/// (Listing 1.5.11). Pairs are unique: a hash table tells a repetition in constant time also where
/// a large triangle meets hundreds of small tetrahedra. Clearing costs what was inserted, not the
/// number of triangles.
class TriangleLists {
 public:
  struct Pair {
    int face;
    int tetrahedron;
    int next;  // next pair of the same face in pairs(), or -1
  };

  void clear(int num_faces) {
    for (int face : triangles_) first_[static_cast<std::size_t>(face)] = -1;
    triangles_.clear();
    pairs_.clear();
    ++now_;
    if (static_cast<std::size_t>(num_faces) > first_.size())
      first_.resize(static_cast<std::size_t>(num_faces), -1);
  }

  /// @return false if the tetrahedron was in the triangle's list before
  bool insert(int face, int tetrahedron) {
    if (2 * (pairs_.size() + 1) > table_.size()) grow();
    if (!enter(static_cast<int>(pairs_.size()), face, tetrahedron)) return false;
    int& first = first_[static_cast<std::size_t>(face)];
    if (first < 0) triangles_.push_back(face);
    pairs_.push_back({face, tetrahedron, first});
    first = static_cast<int>(pairs_.size()) - 1;
    return true;
  }

  std::span<const Pair> pairs() const { return pairs_; }         // in order of insertion
  std::span<const int> triangles() const { return triangles_; }  // each once

 private:
  struct Slot {
    int pair = 0;             // index into pairs_
    std::uint64_t stamp = 0;  // filled since the clear() that made it `now_`
  };

  /// Finds the pair's slot. @return false if another entry of pairs_ is the same pair
  bool enter(int index, int face, int tetrahedron) {
    const std::size_t mask = table_.size() - 1;
    // Fibonacci hashing: the golden ratio spreads neighbouring indices.
    const std::uint64_t key =
        (static_cast<std::uint64_t>(face) << 32) | static_cast<std::uint32_t>(tetrahedron);
    std::size_t slot = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 20) & mask;
    for (; table_[slot].stamp == now_; slot = (slot + 1) & mask) {
      const Pair& other = pairs_[static_cast<std::size_t>(table_[slot].pair)];
      if (other.face == face && other.tetrahedron == tetrahedron) return false;
    }
    table_[slot] = {index, now_};
    return true;
  }

  void grow() {
    constexpr std::size_t kLeastSlots = 1024;
    table_.assign(std::max(kLeastSlots, 2 * table_.size()), {});
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      enter(static_cast<int>(i), pairs_[i].face, pairs_[i].tetrahedron);
  }

  std::vector<int> first_;      // per face: its last inserted pair, or -1
  std::vector<int> triangles_;  // "intersections" of Listing 1.5.11
  std::vector<Pair> pairs_;     // "collision(A)" of all triangles A, chained
  std::vector<Slot> table_;     // a power of two, at most half full
  std::uint64_t now_ = 1;
};

/// The pairs of one query, surface of one mesh against volume of another.
struct Reports {
  TriangleLists tested;      // pairs with overlapping boxes: each gets one narrow test (erratum 13)
  TriangleLists collisions;  // those that intersect

  void clear(int num_faces) {
    tested.clear(num_faces);
    collisions.clear(num_faces);
  }
};

}  // namespace articular::collision
