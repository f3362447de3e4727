#include "collision/mesh/surface.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "tests/collision/support/meshes.hpp"

namespace articular::collision::testing::surface_test {

std::set<int> nodes_of(const Eigen::VectorXi& nodes) { return {nodes.begin(), nodes.end()}; }

std::string message_of(const Eigen::Matrix4Xi& tets, int num_nodes) {
  try {
    build_surface(tets, num_nodes);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Surface, NeighboursShareTheFaceAndKnowEachOther) {
  const Mesh mesh = box_mesh(3, 2, 2, 1);
  for (int e = 0; e < mesh.tets.cols(); ++e)
    for (int k = 0; k < 4; ++k) {
      const int other = mesh.surface.neighbours(k, e);
      if (other < 0) continue;
      std::set<int> face = nodes_of(mesh.tets.col(e));
      face.erase(mesh.tets(k, e));
      const std::set<int> others = nodes_of(mesh.tets.col(other));
      EXPECT_TRUE(std::includes(others.begin(), others.end(), face.begin(), face.end()));
      EXPECT_TRUE((mesh.surface.neighbours.col(other).array() == e).any());
    }
}

TEST(Surface, FacesAreThoseWithoutANeighbourAndEachTetrahedronKnowsItsOwn) {
  const Mesh mesh = box_mesh(3, 2, 4, 1);
  const Surface& s = mesh.surface;
  EXPECT_EQ(s.faces.cols(), 2 * 2 * (3 * 2 + 2 * 4 + 4 * 3));  // two triangles a square
  ASSERT_EQ(s.tet_face_begin.size(), static_cast<std::size_t>(mesh.tets.cols()) + 1);
  for (int e = 0; e < mesh.tets.cols(); ++e) {
    const int begin = s.tet_face_begin[static_cast<std::size_t>(e)];
    const int end = s.tet_face_begin[static_cast<std::size_t>(e) + 1];
    EXPECT_EQ(end - begin, (s.neighbours.col(e).array() < 0).count());
    for (int i = begin; i < end; ++i) {
      const int face = s.tet_faces[static_cast<std::size_t>(i)];
      EXPECT_EQ(s.face_tet[static_cast<std::size_t>(face)], e);
      const std::set<int> tet = nodes_of(mesh.tets.col(e)), own = nodes_of(s.faces.col(face));
      EXPECT_TRUE(std::includes(tet.begin(), tet.end(), own.begin(), own.end()));
    }
  }
}

TEST(Surface, IsClosedAndItsFacesTurnCounterClockwiseFromOutside) {
  const Mesh mesh = box_mesh(2, 3, 2, 0.5);
  std::map<std::pair<int, int>, int> directed_edges;
  double volume = 0;  // by the divergence theorem: the sign is that of the orientation
  for (Eigen::Index f = 0; f < mesh.surface.faces.cols(); ++f) {
    const Eigen::Vector3i face = mesh.surface.faces.col(f);
    for (int i = 0; i < 3; ++i) ++directed_edges[{face[i], face[(i + 1) % 3]}];
    volume +=
        mesh.X.col(face[0]).dot(Eigen::Vector3d(mesh.X.col(face[1])).cross(mesh.X.col(face[2])));
  }
  EXPECT_NEAR(volume / 6, 2 * 3 * 2 * 0.125, 1e-12);
  for (const auto& [edge, count] : directed_edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(directed_edges.count({edge.second, edge.first}), 1u);
  }
}

// In box_mesh only faces opposite the first and last node are on the surface.
TEST(Surface, EachOfTheFourFacesOfATetrahedronTurnsCounterClockwiseFromOutside) {
  Eigen::Matrix4Xi tet(4, 1);
  tet << 0, 1, 2, 3;
  Eigen::Matrix<double, 3, 4> X;
  X << Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity();
  const Surface surface = build_surface(tet, 4);
  ASSERT_EQ(surface.faces.cols(), 4);
  for (int f = 0; f < 4; ++f) {
    const Eigen::Vector3d a = X.col(surface.faces(0, f)), b = X.col(surface.faces(1, f)),
                          c = X.col(surface.faces(2, f)), inside = X.rowwise().mean();
    EXPECT_LT((b - a).cross(c - a).dot(inside - a), 0) << "face " << f;
  }
}

TEST(Surface, BadConnectivityIsNamed) {
  Eigen::Matrix4Xi tets(4, 1);
  tets << 0, 1, 2, 4;
  EXPECT_EQ(message_of(tets, 4), "tetrahedron 0: node index 4 is outside [0, 4)");
  tets << 0, 1, -2, 3;
  EXPECT_EQ(message_of(tets, 4), "tetrahedron 0: node index -2 is outside [0, 4)");
  tets << 0, 1, 2, 1;
  EXPECT_EQ(message_of(tets, 4), "tetrahedron 0: node 1 occurs twice");
  Eigen::Matrix4Xi fan(4, 3);  // three tetrahedra on the face 0 1 2
  fan << 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 4, 5;
  EXPECT_EQ(message_of(fan, 6), "face 0 1 2 belongs to more than two tetrahedra (0, 1, 2)");
}

TEST(Surface, AMeshWithoutElementsHasNoFaces) {
  EXPECT_EQ(build_surface(Eigen::Matrix4Xi(4, 0), 3).faces.cols(), 0);
}

}  // namespace articular::collision::testing::surface_test
