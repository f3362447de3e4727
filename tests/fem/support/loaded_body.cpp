#include "tests/fem/support/loaded_body.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "fem/mesh/tetrahedron.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem {
namespace {

constexpr double kOnPlane = 1e-9;  // [-] of lengths between 1 and 100

/// The unit cube in cells[0] x cells[1] x cells[2] cells.
TetMesh unit_mesh(const std::array<int, 3>& cells, MeshKind kind) {
  TetMesh mesh = box_mesh(cells, Vec3::Ones());
  if (kind == MeshKind::FiveTetrahedra) {
    const std::array<int, 3> stride{1, cells[0] + 1, (cells[0] + 1) * (cells[1] + 1)};
    mesh.tets.resize(4, 5 * cells[0] * cells[1] * cells[2]);
    Eigen::Index element = 0;
    for (int k = 0; k < cells[2]; ++k) {
      for (int j = 0; j < cells[1]; ++j) {
        for (int i = 0; i < cells[0]; ++i) {
          const bool mirrored = (i + j + k) % 2 == 1;
          const auto corner = [&](int x, int y, int z) {
            return i + (mirrored ? 1 - x : x) + stride[1] * (j + y) + stride[2] * (k + z);
          };
          const auto add = [&](int a, int b, int c, int d) {
            if (mirrored) std::swap(c, d);
            mesh.tets.col(element++) << a, b, c, d;
          };
          add(corner(0, 0, 0), corner(1, 0, 0), corner(0, 1, 0), corner(0, 0, 1));
          add(corner(1, 1, 0), corner(0, 1, 0), corner(1, 0, 0), corner(1, 1, 1));
          add(corner(1, 0, 1), corner(0, 0, 1), corner(1, 1, 1), corner(1, 0, 0));
          add(corner(0, 1, 1), corner(1, 1, 1), corner(0, 0, 1), corner(0, 1, 0));
          add(corner(1, 0, 0), corner(0, 1, 0), corner(0, 0, 1), corner(1, 1, 1));
        }
      }
    }
  }
  if (kind == MeshKind::Kuhn) return mesh;
  // A node of a face moves within it, one of an edge along it: the shape of the body stays.
  // Movements that turn a tetrahedron over or flatten it are halved.
  Random random;
  Positions shift(3, mesh.X.cols());
  for (Eigen::Index a = 0; a < mesh.X.cols(); ++a) {
    for (int i = 0; i < 3; ++i) {
      const bool inner = mesh.X(i, a) > kOnPlane && mesh.X(i, a) < 1 - kOnPlane;
      // Where the load ends inside a face, its border stays as well.
      const bool middle = std::abs(mesh.X(i, a) - 0.5) < kOnPlane;
      shift(i, a) = inner && !middle ? random.uniform(-0.25, 0.25) / cells[i] : 0.0;
    }
  }
  const double cell_volume = 1.0 / (cells[0] * cells[1] * cells[2]);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& tet : mesh.tets.colwise()) {
      Mat34 x;
      for (int a = 0; a < 4; ++a) x.col(a) = mesh.X.col(tet[a]) + shift.col(tet[a]);
      if (edge_matrix(x).determinant() / 6 > 0.02 * cell_volume) continue;
      for (const int a : tet) shift.col(a) *= 0.5;
      changed = true;
    }
  }
  mesh.X += shift;
  return mesh;
}

/// Adds the dead traction on the boundary triangles whose corners all satisfy `on_face`.
void add_traction(const TetMesh& mesh, const std::function<bool(const Vec3&)>& on_face,
                  const Vec3& traction, Positions& f) {
  for (const auto& tet : mesh.tets.colwise()) {
    for (int omitted = 0; omitted < 4; ++omitted) {
      const std::array<int, 3> face{tet[(omitted + 1) % 4], tet[(omitted + 2) % 4],
                                    tet[(omitted + 3) % 4]};
      const std::array<Vec3, 3> X{mesh.X.col(face[0]), mesh.X.col(face[1]), mesh.X.col(face[2])};
      if (!on_face(X[0]) || !on_face(X[1]) || !on_face(X[2])) continue;
      const double area = (X[1] - X[0]).cross(X[2] - X[0]).norm() / 2;
      for (const int a : face) f.col(a) += area / 3 * traction;
    }
  }
}

int nearest_node(const TetMesh& mesh, const Vec3& point) {
  Eigen::Index nearest = 0;
  (mesh.X.colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

}  // namespace

LoadedBody::LoadedBody(TetMesh m) : mesh(std::move(m)) {
  fixed.setConstant(3, mesh.X.cols(), false);
  f_ext = Positions::Zero(3, mesh.X.cols());
}

Vec3 cook_point(int n, const Vec3& unit) {
  const double s = unit[0], t = unit[1];
  return {48 * s, 44 * s * (1 - t) + (44 + 16 * s) * t, 48.0 / n * unit[2]};
}

LoadedBody cook_membrane(int n, MeshKind kind) {
  TetMesh mesh = unit_mesh({n, n, 1}, kind);
  for (auto X : mesh.X.colwise()) X = cook_point(n, X);
  return cook_membrane(std::move(mesh));
}

LoadedBody cook_membrane(TetMesh mesh) {
  LoadedBody body(std::move(mesh));
  body.fixed.row(2).setConstant(true);
  for (Eigen::Index a = 0; a < body.mesh.X.cols(); ++a) {
    if (body.mesh.X(0, a) < kOnPlane) body.fixed.col(a).setConstant(true);
  }
  add_traction(
      body.mesh, [](const Vec3& X) { return X.x() > 48 - kOnPlane; }, Vec3(0, 6.25, 0), body.f_ext);
  body.probe = nearest_node(body.mesh, Vec3(48, 60, 0));
  body.axis = 1;
  return body;
}

LoadedBody block_compression(int n, MeshKind kind) {
  return block_compression(unit_mesh({n, n, n}, kind));
}

LoadedBody block_compression(TetMesh mesh) {
  LoadedBody body(std::move(mesh));
  for (Eigen::Index a = 0; a < body.mesh.X.cols(); ++a) {
    for (int i = 0; i < 3; ++i) {
      if (body.mesh.X(i, a) < kOnPlane) body.fixed(i, a) = true;
    }
    if (body.mesh.X(2, a) > 1 - kOnPlane) body.fixed(0, a) = body.fixed(1, a) = true;
  }
  add_traction(
      body.mesh,
      [](const Vec3& X) {
        return X.z() > 1 - kOnPlane && X.x() < 0.5 + kOnPlane && X.y() < 0.5 + kOnPlane;
      },
      Vec3(0, 0, -100), body.f_ext);
  body.probe = nearest_node(body.mesh, Vec3(0, 0, 1));
  body.axis = 2;
  return body;
}

LoadedBody bent_beam(int n, double force, MeshKind kind) {
  TetMesh mesh = unit_mesh({40 * n, 2 * n, 2 * n}, kind);
  mesh.X.row(0) *= 10;
  LoadedBody body(std::move(mesh));
  for (Eigen::Index a = 0; a < body.mesh.X.cols(); ++a) {
    if (body.mesh.X(0, a) < kOnPlane) body.fixed.col(a).setConstant(true);
  }
  add_traction(
      body.mesh, [](const Vec3& X) { return X.x() > 10 - kOnPlane; }, Vec3(0, force, 0),
      body.f_ext);
  body.probe = nearest_node(body.mesh, Vec3(10, 0.5, 0.5));
  body.axis = 1;
  return body;
}

void fix_components(const Eigen::Array<bool, 3, Eigen::Dynamic>& fixed, double diagonal,
                    BlockMatrix& K) {
  for (int i = 0; i < K.num_blocks(); ++i) {
    for (int s = K.row_begin()[i]; s < K.row_begin()[i + 1]; ++s) {
      const int j = K.column()[s];
      for (int p = 0; p < 3; ++p) {
        for (int q = 0; q < 3; ++q) {
          if (!fixed(p, i) && !fixed(q, j)) continue;
          K.block(s)(p, q) = i == j && p == q ? diagonal : 0.0;
        }
      }
    }
  }
}

void fix_components(const Eigen::Array<bool, 3, Eigen::Dynamic>& fixed, PressureGradient& G) {
  for (int i = 0; i < G.num_nodes(); ++i) {
    for (int s = G.row_begin()[i]; s < G.row_begin()[i + 1]; ++s) {
      for (int p = 0; p < 3; ++p) {
        if (fixed(p, i)) G.block(s)[p] = 0;
      }
    }
  }
}

}  // namespace articular::fem
