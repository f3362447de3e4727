#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "collision/article/bucket_tree.hpp"
#include "collision/article/collide.hpp"
#include "collision/mesh/surface.hpp"
#include "collision/narrow/brute_force.hpp"

/// Small meshes for the collision tests.
namespace articular::collision::testing {

struct Mesh {
  Eigen::Matrix4Xi tets;
  Eigen::Matrix3Xd X;  // rest positions [m]
  Surface surface;

  MeshView at(const Eigen::Matrix3Xd& x) const { return {tets, surface, x}; }
};

/// Box of nx × ny × nz cubes with the given edge [m], each cut into six tetrahedra.
inline Mesh box_mesh(int nx, int ny, int nz, double edge) {
  Mesh mesh;
  const auto node = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  mesh.X.resize(3, (nx + 1) * (ny + 1) * (nz + 1));
  mesh.tets.resize(4, 6 * nx * ny * nz);
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) mesh.X.col(node(i, j, k)) = edge * Eigen::Vector3d(i, j, k);
  // One tetrahedron for each order in which the diagonal's way along x, y and z can go; odd orders
  // swap two nodes to stay positive.
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  int e = 0;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        for (int order = 0; order < 6; ++order) {
          Eigen::Vector3i corner(i, j, k);
          Eigen::Vector4i nodes;
          nodes[0] = node(i, j, k);
          for (int step = 0; step < 3; ++step) {
            ++corner[kOrders[order][step]];
            nodes[step + 1] = node(corner[0], corner[1], corner[2]);
          }
          if (order >= 3) std::swap(nodes[1], nodes[2]);
          mesh.tets.col(e++) = nodes;
        }
  mesh.surface = build_surface(mesh.tets, static_cast<int>(mesh.X.cols()));
  return mesh;
}

/// A bar of length cells of the given edge [m], bent in the middle to a V whose legs are `angle`
/// apart [rad]: below about 0.3 they pass through each other.
inline Eigen::Matrix3Xd bend_to_v(const Mesh& bar, double angle) {
  const double length = bar.X.row(0).maxCoeff(), height = bar.X.row(2).maxCoeff();
  const double bend = 0.5 * (std::numbers::pi - angle);  // of each leg
  const double transition = 0.15 * length;               // the bend is spread over this half-length
  Eigen::Matrix3Xd x = bar.X;
  for (Eigen::Index a = 0; a < x.cols(); ++a) {
    // The centre line turns at a constant rate between -transition and transition.
    const double s = bar.X(0, a) - 0.5 * length, h = bar.X(2, a) - 0.5 * height;
    const double c = std::clamp(s, -transition, transition), theta = bend * c / transition;
    const double radius = transition / bend, beyond = s - c;
    x(0, a) = radius * std::sin(theta) + beyond * std::cos(theta) - h * std::sin(theta);
    x(2, a) = radius * (1 - std::cos(theta)) + beyond * std::sin(theta) + h * std::cos(theta);
  }
  return x;
}

/// The elements in random order, and with them the faces.
inline Mesh shuffled(Mesh mesh, std::mt19937& random) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(mesh.tets.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  const Eigen::Matrix4Xi tets = mesh.tets;
  for (std::size_t e = 0; e < order.size(); ++e)
    mesh.tets.col(static_cast<Eigen::Index>(e)) = tets.col(order[e]);
  mesh.surface = build_surface(mesh.tets, static_cast<int>(mesh.X.cols()));
  return mesh;
}

inline Eigen::Vector3d random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return {uniform(random), uniform(random), uniform(random)};
}

/// Every node moved by up to `size` [m] along each axis.
inline Eigen::Matrix3Xd jittered(Eigen::Matrix3Xd x, double size, std::mt19937& random) {
  for (Eigen::Index a = 0; a < x.cols(); ++a) x.col(a) += random_vector(random, size);
  return x;
}

/// x turned by a random rotation about its centre, which then goes to `centre`.
inline Eigen::Matrix3Xd placed(const Eigen::Matrix3Xd& x, const Eigen::Vector3d& centre,
                               std::mt19937& random) {
  const Eigen::Vector3d axis = random_vector(random, 1).normalized();
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(std::uniform_real_distribution<double>(0, 3)(random), axis).matrix();
  const Eigen::Vector3d middle = x.rowwise().mean();
  return (R * (x.colwise() - middle)).colwise() + centre;
}

/// Both directions of one query.
struct Pairs {
  std::vector<Penetration> a_in_b, b_in_a;
  friend bool operator==(const Pairs&, const Pairs&) = default;
};

inline Pairs query(const BucketTree& A, const BucketTree& B) {
  Pairs pairs;
  QueryCounts counts;
  collide(A, B, pairs.a_in_b, pairs.b_in_a, counts);
  return pairs;
}

inline Pairs brute_force(const MeshView& A, const MeshView& B, double margin = 0) {
  return {brute_force_collide(A, B, margin), brute_force_collide(B, A, margin)};
}

inline std::vector<Penetration> query_self(const BucketTree& tree) {
  std::vector<Penetration> pairs;
  QueryCounts counts;
  self_intersections(tree, pairs, counts);
  return pairs;
}

}  // namespace articular::collision::testing

/// GoogleTest prints pairs with this.
namespace articular::collision {
inline void PrintTo(const Penetration& pair, std::ostream* out) {
  *out << "(face " << pair.face << ", tetrahedron " << pair.tetrahedron << ")";
}
}  // namespace articular::collision
