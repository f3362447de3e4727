#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <numeric>

#include "sim/mesh/mesh_io.hpp"
#include "tests/collision/support/meshes.hpp"
#include "tools/collide/collide_frames.hpp"

/// Meshes for `articular collide`, and what it has to find in them.
namespace articular {

using collision::testing::Mesh;

/// Bars bent to a V, jittered so that nothing just touches.
struct VShapes {
  Mesh bar = collision::testing::box_mesh(10, 2, 2, 1);
  std::mt19937 random{7};

  Positions upright(double angle) {
    return collision::testing::jittered(collision::testing::bend_to_v(bar, angle), 0.05, random);
  }
  /// Through an upright one; the way moves it out.
  Positions across(double way) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).matrix();
    Positions x = collision::testing::jittered(turn * upright(1), 0.05, random);
    return x.colwise() + Eigen::Vector3d(0.3, 0.2, 1 + way);
  }
};

inline void write_vtu(const std::filesystem::path& file, const Tetrahedra& tets,
                      const Positions& x) {
  sim::write_mesh(file, {x, tets, Triangles(3, 0)}, 1);
}

/// Legacy format, as text. NaN is written as `nan`.
inline void write_vtk(const std::filesystem::path& file, const Tetrahedra& tets,
                      const Positions& x) {
  std::ofstream out(file);
  out << "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << x.cols()
      << " double\n";
  for (const double value : x.reshaped()) out << fmt::format("{} ", value);
  out << "\nCELLS " << tets.cols() << ' ' << 5 * tets.cols() << '\n';
  for (const auto& nodes : tets.colwise()) out << "4 " << nodes.transpose() << '\n';
  out << "CELL_TYPES " << tets.cols() << '\n';
  for (Eigen::Index e = 0; e < tets.cols(); ++e) out << "10\n";
}

/// What brute force finds, in the terms of the table.
inline std::vector<tools::PairRow> rows_of(const std::vector<collision::Penetration>& pairs,
                                           int frame, int f, const Mesh& F, int w) {
  std::vector<tools::PairRow> rows;
  for (const collision::Penetration& pair : pairs) {
    const int tet = F.surface.face_tet[static_cast<std::size_t>(pair.face)];
    const int others = F.tets.col(tet).sum() - F.surface.faces.col(pair.face).sum();
    int local = 0;  // the node of the tetrahedron that is not in the face
    while (F.tets(local, tet) != others) ++local;
    rows.push_back({frame, f, tet, local, w, pair.tetrahedron});
  }
  return rows;
}

inline std::vector<tools::PairRow> brute_force_two(const Mesh& mesh, int frame, const Positions& a,
                                                   const Positions& b, double margin = 0) {
  const collision::testing::Pairs pairs =
      collision::testing::brute_force(mesh.at(a), mesh.at(b), margin);
  std::vector<tools::PairRow> rows = rows_of(pairs.a_in_b, frame, 0, mesh, 1);
  const std::vector<tools::PairRow> reverse = rows_of(pairs.b_in_a, frame, 1, mesh, 0);
  rows.insert(rows.end(), reverse.begin(), reverse.end());
  return rows;
}

inline std::vector<tools::PairRow> brute_force_self(const Mesh& mesh, int frame, int body,
                                                    const Positions& x) {
  return rows_of(collision::brute_force_self_intersections(mesh.at(x)), frame, body, mesh, body);
}

inline std::string csv_of(std::vector<tools::PairRow> rows) {
  std::sort(rows.begin(), rows.end());
  std::string text = "frame,triangle_body,triangle_tet,triangle_face,tet_body,tet\n";
  for (const tools::PairRow& row : rows)
    text += fmt::format("{},{},{},{},{},{}\n", row.frame, row.triangle_body, row.triangle_tet,
                        row.triangle_face, row.tet_body, row.tet);
  return text;
}

}  // namespace articular
