#pragma once

#include <span>
#include <vector>

namespace articular::collision {

/// A list of tetrahedra in each triangle, and the list of triangles whose list is not empty
/// (Listing 1.5.11). Pairs are unique. Clearing costs what was inserted, not the number of
/// triangles.
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
    if (static_cast<std::size_t>(num_faces) > first_.size())
      first_.resize(static_cast<std::size_t>(num_faces), -1);
  }

  /// @return false if the tetrahedron was in the triangle's list before
  bool insert(int face, int tetrahedron) {
    int& first = first_[static_cast<std::size_t>(face)];
    for (int i = first; i >= 0; i = pairs_[static_cast<std::size_t>(i)].next)
      if (pairs_[static_cast<std::size_t>(i)].tetrahedron == tetrahedron) return false;
    if (first < 0) triangles_.push_back(face);
    pairs_.push_back({face, tetrahedron, first});
    first = static_cast<int>(pairs_.size()) - 1;
    return true;
  }

  std::span<const Pair> pairs() const { return pairs_; }         // in order of insertion
  std::span<const int> triangles() const { return triangles_; }  // each once

 private:
  std::vector<int> first_;      // per face: its last inserted pair, or -1
  std::vector<int> triangles_;  // "intersections" of Listing 1.5.11
  std::vector<Pair> pairs_;     // "collision(A)" of all triangles A, chained
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
