#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sim/mesh/mesh_io.hpp"

/// Closed surfaces of triangles, outward, for tests of `articular mesh`.
namespace articular {

inline sim::MeshData cuboid(const Vec3& lower, const Vec3& upper) {
  sim::MeshData mesh;
  mesh.X.resize(3, 8);
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) mesh.X(i, a) = (a >> i) % 2 == 1 ? upper(i) : lower(i);
  mesh.triangles.resize(3, 12);
  mesh.triangles << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      3, 2, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,                //
      1, 3, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return mesh;
}

/// An icosahedron whose triangles are cut in four, `cuts` times, and put on the sphere.
inline sim::MeshData ball(const Vec3& center, double radius, int cuts) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> X = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<Eigen::Vector3i> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, is_new] = middles.emplace(std::minmax({a, b}), static_cast<int>(X.size()));
      if (is_new) X.push_back(X[static_cast<std::size_t>(a)] + X[static_cast<std::size_t>(b)]);
      return entry->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& f : faces) {
      const int ab = middle(f(0), f(1)), bc = middle(f(1), f(2)), ca = middle(f(2), f(0));
      finer.insert(finer.end(), {{f(0), ab, ca}, {f(1), bc, ab}, {f(2), ca, bc}, {ab, bc, ca}});
    }
    faces = finer;
    for (Vec3& x : X) x.normalize();
  }
  sim::MeshData mesh;
  mesh.X.resize(3, static_cast<Eigen::Index>(X.size()));
  for (std::size_t a = 0; a < X.size(); ++a)
    mesh.X.col(static_cast<Eigen::Index>(a)) = center + radius * X[a].normalized();
  mesh.triangles.resize(3, static_cast<Eigen::Index>(faces.size()));
  for (std::size_t f = 0; f < faces.size(); ++f)
    mesh.triangles.col(static_cast<Eigen::Index>(f)) = faces[f];
  return mesh;
}

inline sim::MeshData joined(const sim::MeshData& a, const sim::MeshData& b) {
  sim::MeshData both;
  both.X.resize(3, a.X.cols() + b.X.cols());
  both.X << a.X, b.X;
  both.triangles.resize(3, a.triangles.cols() + b.triangles.cols());
  both.triangles << a.triangles, (b.triangles.array() + static_cast<int>(a.X.cols())).matrix();
  return both;
}

inline sim::MeshData inside_out(sim::MeshData mesh) {
  mesh.triangles.row(0).swap(mesh.triangles.row(1));
  return mesh;
}

}  // namespace articular
