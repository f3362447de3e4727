#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "collision/narrow/brute_force.hpp"

namespace articular::benchmarks {

/// Box in single precision, rounded outward; the fourth lane is empty, so that it is two registers.
struct Box {
  Eigen::Array4f min = Eigen::Array4f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array4f max = Eigen::Array4f::Constant(-std::numeric_limits<float>::infinity());

  void include(const Box& other) {
    min = min.min(other.min);
    max = max.max(other.max);
  }
};

inline bool overlap(const Box& a, const Box& b) {
  bool meet = true;  // without a branch for each comparison
  for (int i = 0; i < 3; ++i) {
    meet &= a.min[i] <= b.max[i];
    meet &= b.min[i] <= a.max[i];
  }
  return meet;
}

/// Boxes of all elements of one body: where every peer's update begins.
struct ElementBoxes {
  std::vector<Box> faces, tets;
  Box bounds;

  void update(const collision::MeshView& mesh) {
    round_nodes(mesh.x);
    bounds = Box();
    for (const Box& node : nodes_) bounds.include(node);
    collect(mesh.surface.faces, faces);
    collect(mesh.tets, tets);
  }

  std::size_t bytes() const {
    return (faces.capacity() + tets.capacity() + nodes_.capacity()) * sizeof(Box);
  }

 private:
  void round_nodes(const Eigen::Matrix3Xd& x) {
    // One step of single precision, or two, and something for what is too small to have steps.
    constexpr float kStep = std::numeric_limits<float>::epsilon();
    constexpr float kLeast = std::numeric_limits<float>::min();
    nodes_.resize(static_cast<std::size_t>(x.cols()));
    for (std::size_t a = 0; a < nodes_.size(); ++a) {
      const double* exact = x.col(static_cast<Eigen::Index>(a)).data();
      const Eigen::Array4f nearest(static_cast<float>(exact[0]), static_cast<float>(exact[1]),
                                   static_cast<float>(exact[2]), 0);
      const Eigen::Array4f outward = nearest.abs() * kStep + kLeast;
      nodes_[a].min = nearest - outward;
      nodes_[a].max = nearest + outward;
    }
  }

  template <class Elements>
  void collect(const Elements& elements, std::vector<Box>& boxes) {
    boxes.resize(static_cast<std::size_t>(elements.cols()));
    for (std::size_t e = 0; e < boxes.size(); ++e) {
      const auto node = [&](Eigen::Index k) -> const Box& {
        return nodes_[static_cast<std::size_t>(elements(k, static_cast<Eigen::Index>(e)))];
      };
      Box box = node(0);
      for (Eigen::Index k = 1; k < Elements::RowsAtCompileTime; ++k) box.include(node(k));
      boxes[e] = box;
    }
  }

  std::vector<Box> nodes_;  // a box rounded outward is the box of points rounded outward
};

}  // namespace articular::benchmarks
