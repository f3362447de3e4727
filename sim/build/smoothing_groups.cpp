#include "sim/build/smoothing_groups.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>

namespace articular::sim {
namespace {

Positions unit_normals(const Positions& X, const Eigen::Matrix3Xi& faces) {
  Positions normals(3, faces.cols());
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    const Vec3 a = X.col(faces(0, f));
    normals.col(f) = (X.col(faces(1, f)) - a).cross(X.col(faces(2, f)) - a).normalized();
  }
  return normals;
}

/// An edge of a face from its corner to the next one.
struct FaceEdge {
  int low, high;  // nodes
  int face, corner;
  int opposite() const { return (corner + 2) % 3; }
};

std::vector<FaceEdge> sorted_edges(const Eigen::Matrix3Xi& faces) {
  std::vector<FaceEdge> edges;
  for (int f = 0; f < faces.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({faces(k, f), faces((k + 1) % 3, f)});
      edges.push_back({low, high, f, k});
    }
  std::sort(edges.begin(), edges.end(), [](const FaceEdge& p, const FaceEdge& q) {
    return std::array{p.low, p.high, p.face} < std::array{q.low, q.high, q.face};
  });
  return edges;
}

/// The two sides of an edge; of more faces there, of each that follows another.
using EdgeSides = std::array<FaceEdge, 2>;
struct SharedEdges {
  std::vector<EdgeSides> smooth, creases;
};

SharedEdges shared_edges(const Positions& normals, const Eigen::Matrix3Xi& faces, double crease) {
  const std::vector<FaceEdge> edges = sorted_edges(faces);
  SharedEdges shared;
  for (std::size_t e = 1; e < edges.size(); ++e) {
    const FaceEdge &p = edges[e - 1], &q = edges[e];
    if (p.low != q.low || p.high != q.high) continue;
    const bool is_smooth = normals.col(p.face).dot(normals.col(q.face)) > crease;
    (is_smooth ? shared.smooth : shared.creases).push_back({p, q});
  }
  return shared;
}

/// Sets of corners that grow together; each is known by its least one.
class Sets {
 public:
  explicit Sets(Eigen::Index n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) i = parent_[static_cast<std::size_t>(i)];
    return i;
  }
  void join(int i, int j) {
    const auto [low, high] = std::minmax({find(i), find(j)});
    parent_[static_cast<std::size_t>(high)] = low;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace

std::vector<int> number_smoothing_groups(const Positions& X, const Eigen::Matrix3Xi& faces,
                                         double crease, Eigen::Matrix3Xi& groups) {
  Sets corners(3 * faces.cols());
  for (const auto& [p, q] : shared_edges(unit_normals(X, faces), faces, crease).smooth)
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const int of_p = (p.corner + i) % 3, of_q = (q.corner + j) % 3;
        if (faces(of_p, p.face) == faces(of_q, q.face))
          corners.join(3 * p.face + of_p, 3 * q.face + of_q);
      }
  std::vector<int> node_of(static_cast<std::size_t>(X.cols()));
  std::iota(node_of.begin(), node_of.end(), 0);
  std::vector<char> has_first(node_of.size(), 0);
  groups.resize(3, faces.cols());
  for (int corner = 0; corner < groups.size(); ++corner) {
    const int least = corners.find(corner), node = faces.reshaped()[corner];
    int& group = groups.reshaped()[corner];
    if (least != corner) {
      group = groups.reshaped()[least];
    } else if (has_first[static_cast<std::size_t>(node)] == 0) {
      has_first[static_cast<std::size_t>(node)] = 1;
      group = node;
    } else {
      group = static_cast<int>(node_of.size());
      node_of.push_back(node);
    }
  }
  return node_of;
}

Eigen::VectorXd areas_of_smoothing_groups(const Eigen::Matrix3Xi& groups, Eigen::Index num_groups,
                                          std::span<const double> face_area) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(num_groups);
  for (Eigen::Index f = 0; f < groups.cols(); ++f)
    for (const int group : groups.col(f))
      areas[group] += face_area[static_cast<std::size_t>(f)] / 3;
  return areas;
}

std::vector<unsigned> rims_of_smoothing_groups(const Positions& X, const Eigen::Matrix3Xi& faces,
                                               double crease) {
  std::vector<unsigned> rims(static_cast<std::size_t>(faces.cols()), 7);
  for (const EdgeSides& sides : shared_edges(unit_normals(X, faces), faces, crease).smooth)
    for (const FaceEdge& side : sides)
      rims[static_cast<std::size_t>(side.face)] &= ~(1U << side.opposite());
  return rims;
}

Eigen::Matrix3Xi faces_across_edges(const Positions& X, const Eigen::Matrix3Xi& faces,
                                    double crease) {
  Eigen::Matrix3Xi across = Eigen::Matrix3Xi::Constant(3, faces.cols(), -1);
  for (const auto& [p, q] : shared_edges(unit_normals(X, faces), faces, crease).smooth) {
    across(p.opposite(), p.face) = q.face;
    across(q.opposite(), q.face) = p.face;
  }
  return across;
}

Positions heights_over_convex_rims(const Positions& X, const Eigen::Matrix3Xi& faces,
                                   double crease) {
  Positions heights = Positions::Zero(3, faces.cols());
  const Positions normals = unit_normals(X, faces);
  for (const auto& [p, q] : shared_edges(normals, faces, crease).creases) {
    const Vec3 a = X.col(p.low), along = (X.col(p.high) - a).normalized();
    const auto up = [&](const FaceEdge& side) {
      return Vec3(X.col(faces(side.opposite(), side.face)) - a);
    };
    if (!(up(q).dot(normals.col(p.face)) < 0)) continue;
    for (const FaceEdge& side : {p, q})
      heights(side.opposite(), side.face) = along.cross(up(side)).norm();
  }
  return heights;
}

}  // namespace articular::sim
