#include "collision/mesh/surface.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace articular::collision {

template <>
const char EigenHeapAlignment<EIGEN_DEFAULT_ALIGN_BYTES>::kOfTheLibrary = 0;

namespace {

// Nodes of the face opposite node k, counter-clockwise from outside for a positive tetrahedron.
constexpr int kFaceNodes[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// One of the four faces of a tetrahedron, found again by its three nodes in ascending order.
struct HalfFace {
  std::array<int, 3> nodes;
  int tet;
  int opposite;  // node 0..3 that the face does not have
  friend auto operator<=>(const HalfFace&, const HalfFace&) = default;
};

void check(const Eigen::Matrix4Xi& tets, int num_nodes) {
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const std::string name = "tetrahedron " + std::to_string(e);
    for (int k = 0; k < 4; ++k) {
      if (tets(k, e) < 0 || tets(k, e) >= num_nodes)
        throw std::invalid_argument(name + ": node index " + std::to_string(tets(k, e)) +
                                    " is outside [0, " + std::to_string(num_nodes) + ")");
      for (int j = 0; j < k; ++j)
        if (tets(j, e) == tets(k, e))
          throw std::invalid_argument(name + ": node " + std::to_string(tets(k, e)) +
                                      " occurs twice");
    }
  }
}

std::vector<HalfFace> sorted_half_faces(const Eigen::Matrix4Xi& tets) {
  std::vector<HalfFace> half_faces;
  half_faces.reserve(4 * static_cast<std::size_t>(tets.cols()));
  for (int e = 0; e < tets.cols(); ++e)
    for (int k = 0; k < 4; ++k) {
      const int* local = kFaceNodes[k];
      HalfFace half{{tets(local[0], e), tets(local[1], e), tets(local[2], e)}, e, k};
      std::sort(half.nodes.begin(), half.nodes.end());
      half_faces.push_back(half);
    }
  std::sort(half_faces.begin(), half_faces.end());
  return half_faces;
}

/// The two sides of a face are next to each other in the sorted list.
Eigen::Matrix4Xi find_neighbours(const Eigen::Matrix4Xi& tets) {
  const std::vector<HalfFace> sides = sorted_half_faces(tets);
  Eigen::Matrix4Xi neighbours = Eigen::Matrix4Xi::Constant(4, tets.cols(), -1);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    if (sides[i].nodes != sides[i + 1].nodes) continue;
    if (i + 2 < sides.size() && sides[i].nodes == sides[i + 2].nodes) {
      const auto& [a, b, c] = sides[i].nodes;
      throw std::invalid_argument(
          "face " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) +
          " belongs to more than two tetrahedra (" + std::to_string(sides[i].tet) + ", " +
          std::to_string(sides[i + 1].tet) + ", " + std::to_string(sides[i + 2].tet) + ")");
    }
    neighbours(sides[i].opposite, sides[i].tet) = sides[i + 1].tet;
    neighbours(sides[i + 1].opposite, sides[i + 1].tet) = sides[i].tet;
  }
  return neighbours;
}

}  // namespace

Surface build_surface(const Eigen::Matrix4Xi& tets, int num_nodes) {
  check(tets, num_nodes);
  Surface surface;
  surface.neighbours = find_neighbours(tets);
  const Eigen::Index num_faces = (surface.neighbours.array() < 0).count();
  surface.faces.resize(3, num_faces);
  surface.face_tet.reserve(static_cast<std::size_t>(num_faces));
  surface.tet_faces.reserve(static_cast<std::size_t>(num_faces));
  surface.tet_face_begin.reserve(static_cast<std::size_t>(tets.cols()) + 1);
  int face = 0;
  for (int e = 0; e < tets.cols(); ++e) {
    surface.tet_face_begin.push_back(face);
    for (int k = 0; k < 4; ++k) {
      if (surface.neighbours(k, e) >= 0) continue;
      for (int j = 0; j < 3; ++j) surface.faces(j, face) = tets(kFaceNodes[k][j], e);
      surface.face_tet.push_back(e);
      surface.tet_faces.push_back(face);
      ++face;
    }
  }
  surface.tet_face_begin.push_back(face);
  return surface;
}

}  // namespace articular::collision
