#include "sim/build/collider.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "sim/build/smoothing_groups.hpp"
#include "sim/gap/contact_patch.hpp"

namespace articular::sim {
namespace {

/// Positive where the tetrahedron a b c d is.
double six_volumes(const Positions& X, const Eigen::Vector4i& t) {
  const Vec3 a = X.col(t[0]);
  return (X.col(t[1]) - a).cross(X.col(t[2]) - a).dot(X.col(t[3]) - a);
}

/// The three tetrahedra of the prism under an outward triangle. The diagonals of its sides start at
/// the lower surface index, so that neighbouring prisms share them.
std::array<Eigen::Vector4i, 3> prism(const Eigen::Vector3i& triangle, int below) {
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return triangle[i] < triangle[j]; });
  const int a = triangle[order[0]], b = triangle[order[1]], c = triangle[order[2]];
  const bool even = (order[1] - order[0] + 3) % 3 == 1;
  std::array<Eigen::Vector4i, 3> tets = {Eigen::Vector4i(a, c, b, c + below),
                                         Eigen::Vector4i(a, c + below, b, b + below),
                                         Eigen::Vector4i(a, c + below, b + below, a + below)};
  if (!even)
    for (auto& t : tets) std::swap(t[1], t[2]);
  return tets;
}

Positions vertex_normals(const Positions& X, const Triangles& triangles) {
  Positions normals = Positions::Zero(3, X.cols());
  for (Eigen::Index f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = X.col(triangles((k + 1) % 3, f)) - X.col(triangles(k, f));
      const Vec3 b = X.col(triangles((k + 2) % 3, f)) - X.col(triangles(k, f));
      const Vec3 cross = a.cross(b);
      const double angle = std::atan2(cross.norm(), a.dot(b));
      if (cross.norm() > 0) normals.col(triangles(k, f)) += angle * cross.normalized();
    }
  for (Eigen::Index i = 0; i < normals.cols(); ++i)
    if (const double length = normals.col(i).norm(); length > 0) normals.col(i) /= length;
  return normals;
}

}  // namespace

namespace {

Tetrahedra prisms_under(const Triangles& triangles, int below) {
  Tetrahedra tets(4, 3 * triangles.cols());
  for (Eigen::Index f = 0; f < triangles.cols(); ++f) {
    const auto three = prism(triangles.col(f), below);
    for (int k = 0; k < 3; ++k) tets.col(3 * f + k) = three[static_cast<std::size_t>(k)];
  }
  return tets;
}

/// Triangles whose prism has a tetrahedron that is turned inside out, or next to flat.
std::vector<char> folded_prisms(const Positions& X, const Triangles& triangles,
                                const Tetrahedra& tets, const Eigen::VectorXd& depth) {
  // Of the volume that the prism would have on a flat surface.
  constexpr double kLeastVolume = 0.02;
  std::vector<char> folded(static_cast<std::size_t>(triangles.cols()), 0);
  for (Eigen::Index t = 0; t < tets.cols(); ++t) {
    const auto face = triangles.col(t / 3);
    const Vec3 area = (X.col(face[1]) - X.col(face[0])).cross(X.col(face[2]) - X.col(face[0]));
    const double least_depth = std::min({depth[face[0]], depth[face[1]], depth[face[2]]});
    if (!(six_volumes(X, tets.col(t)) > kLeastVolume * area.norm() * least_depth))
      folded[static_cast<std::size_t>(t / 3)] = 1;
  }
  return folded;
}

void drop(const std::vector<char>& dropped, Triangles& triangles) {
  std::vector<int> kept;
  for (std::size_t f = 0; f < dropped.size(); ++f)
    if (dropped[f] == 0) kept.push_back(static_cast<int>(f));
  const Triangles rest = triangles(Eigen::all, kept);
  triangles = rest;
}

}  // namespace

Tetrahedra shell_under(Positions& X, Triangles& triangles, double thickness) {
  const auto n = static_cast<int>(X.cols());
  const Positions normals = vertex_normals(X, triangles);
  Eigen::VectorXd depth = Eigen::VectorXd::Constant(n, thickness);
  X.conservativeResize(3, 2 * n);
  // A shell thinner than this part of the thickness would hide a contact from the search.
  constexpr int kMostHalvings = 5;
  for (int round = 0;; ++round) {
    X.rightCols(n) = X.leftCols(n) - normals * depth.asDiagonal();
    Tetrahedra tets = prisms_under(triangles, n);
    const std::vector<char> folded = folded_prisms(X, triangles, tets, depth);
    if (std::find(folded.begin(), folded.end(), 1) == folded.end()) return tets;
    if (round >= kMostHalvings) {
      drop(folded, triangles);
      continue;
    }
    std::vector<char> thinner(static_cast<std::size_t>(n), 0);
    for (std::size_t f = 0; f < folded.size(); ++f)
      if (folded[f] != 0)
        for (const int node : triangles.col(static_cast<Eigen::Index>(f)))
          thinner[static_cast<std::size_t>(node)] = 1;
    for (int i = 0; i < n; ++i)
      if (thinner[static_cast<std::size_t>(i)] != 0) depth[i] *= 0.5;
  }
}

namespace {

/// Keeps the faces whose nodes are all outer ones.
void keep_outer_faces(const std::vector<char>& is_outer, collision::Surface& surface) {
  std::vector<int> kept;
  for (Eigen::Index f = 0; f < surface.faces.cols(); ++f) {
    bool outer = true;
    for (const int node : surface.faces.col(f))
      outer = outer && is_outer[static_cast<std::size_t>(node)] != 0;
    if (outer) kept.push_back(static_cast<int>(f));
  }
  const Eigen::Matrix3Xi faces = surface.faces(Eigen::all, kept);
  surface.faces = faces;
  std::vector<int> face_tet;
  face_tet.reserve(kept.size());
  for (const int f : kept) face_tet.push_back(surface.face_tet[static_cast<std::size_t>(f)]);
  surface.face_tet = std::move(face_tet);
  std::vector<std::vector<int>> by_tet(static_cast<std::size_t>(surface.neighbours.cols()));
  for (std::size_t f = 0; f < surface.face_tet.size(); ++f)
    by_tet[static_cast<std::size_t>(surface.face_tet[f])].push_back(static_cast<int>(f));
  surface.tet_face_begin.assign(1, 0);
  surface.tet_faces.clear();
  for (const auto& list : by_tet) {
    surface.tet_faces.insert(surface.tet_faces.end(), list.begin(), list.end());
    surface.tet_face_begin.push_back(static_cast<int>(surface.tet_faces.size()));
  }
}

}  // namespace

void complete_collider(Collider& collider, const std::vector<char>& is_outer) {
  const auto num_nodes = static_cast<int>(collider.X.cols());
  collider.surface = collision::build_surface(collider.tets, num_nodes);
  if (!is_outer.empty()) keep_outer_faces(is_outer, collider.surface);
  const auto& faces = collider.surface.faces;
  const auto num_faces = static_cast<std::size_t>(faces.cols());
  collider.face_area.resize(num_faces);
  for (std::size_t f = 0; f < num_faces; ++f) {
    const auto face = faces.col(static_cast<Eigen::Index>(f));
    const Vec3 a = collider.X.col(face[0]);
    collider.face_area[f] =
        0.5 * (collider.X.col(face[1]) - a).cross(collider.X.col(face[2]) - a).norm();
  }

  // Faces that are farther from parallel don't face the same one.
  collider.group_node = number_smoothing_groups(collider.X, faces, kFacingNone, collider.groups);
  collider.group_area = areas_of_smoothing_groups(collider.groups, std::ssize(collider.group_node),
                                                  collider.face_area);
  collider.rims = rims_of_smoothing_groups(collider.X, faces, kFacingNone);
  collider.rim_height = heights_over_convex_rims(collider.X, faces, kFacingNone);
  collider.across = faces_across_edges(collider.X, faces, kFacingNone);

  // Mean height of the elements that have a face on the surface, over that face.
  collider.height.setZero(num_nodes);
  Eigen::VectorXd faces_here = Eigen::VectorXd::Zero(num_nodes);
  double height_sum = 0;
  std::vector<std::vector<int>> faces_of_node(static_cast<std::size_t>(num_nodes));
  for (std::size_t f = 0; f < num_faces; ++f) {
    const double volume =
        six_volumes(collider.X, collider.tets.col(collider.surface.face_tet[f])) / 6;
    const double height = 3 * std::abs(volume) / collider.face_area[f];
    height_sum += height;
    for (int k = 0; k < 3; ++k) {
      const int node = faces(k, static_cast<Eigen::Index>(f));
      faces_of_node[static_cast<std::size_t>(node)].push_back(static_cast<int>(f));
      collider.height[node] += height;
      ++faces_here[node];
    }
  }
  collider.size = num_faces > 0 ? height_sum / static_cast<double>(num_faces) : 0;
  for (Eigen::Index i = 0; i < num_nodes; ++i)
    if (faces_here[i] > 0) collider.height[i] /= faces_here[i];

  // Faces that share a node with a tetrahedron; deeper ones inherit from their neighbours.
  const auto num_tets = static_cast<std::size_t>(collider.tets.cols());
  std::vector<std::vector<int>> nearby(num_tets);
  std::vector<int> ring_of(num_tets, -1), ring;
  collider.is_inner.assign(num_tets, 0);
  const auto sort_unique = [&](int t) {
    auto& list = nearby[static_cast<std::size_t>(t)];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  for (std::size_t t = 0; t < num_tets; ++t) {
    for (int k = 0; k < 4; ++k) {
      const int node = collider.tets(k, static_cast<Eigen::Index>(t));
      const auto& faces_here = faces_of_node[static_cast<std::size_t>(node)];
      nearby[t].insert(nearby[t].end(), faces_here.begin(), faces_here.end());
    }
    collider.is_inner[t] = nearby[t].empty() ? 1 : 0;
    if (nearby[t].empty()) continue;
    ring_of[t] = 0;
    ring.push_back(static_cast<int>(t));
    sort_unique(static_cast<int>(t));
  }
  // A face more than this many elements away is not the one through which a triangle came in.
  constexpr int kMostRings = 3;
  for (int depth = 1; depth <= kMostRings && !ring.empty(); ++depth) {
    std::vector<int> next;
    for (const int t : ring)
      for (int k = 0; k < 4; ++k) {
        const int other = collider.surface.neighbours(k, t);
        if (other < 0) continue;
        int& other_ring = ring_of[static_cast<std::size_t>(other)];
        if (other_ring == -1) {
          other_ring = depth;
          next.push_back(other);
        }
        if (other_ring != depth) continue;
        auto& list = nearby[static_cast<std::size_t>(other)];
        const auto& source = nearby[static_cast<std::size_t>(t)];
        list.insert(list.end(), source.begin(), source.end());
      }
    for (const int t : next) sort_unique(t);
    ring = std::move(next);
  }
  collider.nearby_begin.assign(1, 0);
  for (const auto& list : nearby) {
    collider.nearby.insert(collider.nearby.end(), list.begin(), list.end());
    collider.nearby_begin.push_back(static_cast<int>(collider.nearby.size()));
  }
}

double half_thickness(const Collider& collider) {
  const Positions from_middle = collider.X.colwise() - collider.X.rowwise().mean();
  const Mat3 spread = from_middle * from_middle.transpose();
  const Positions along =
      Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().transpose() * from_middle;
  const double extent = (along.rowwise().maxCoeff() - along.rowwise().minCoeff()).minCoeff();

  double volumes = 0;  // six times
  for (const auto& tet : collider.tets.colwise()) volumes += six_volumes(collider.X, tet);
  const double area = std::accumulate(collider.face_area.begin(), collider.face_area.end(), 0.0);
  return std::min(extent / 2, volumes / (2 * area));
}

}  // namespace articular::sim
