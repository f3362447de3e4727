#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/clamped_box.hpp"
#include "tests/fem/support/random_matrices.hpp"

/// Systems on which multigrid may do badly: uneven meshes, jumps of stiffness, contact, bones.
namespace articular::fem {

/// Stiffness of a mesh whose elements have E of their own: every element with E(centre) [Pa].
inline BlockMatrix uneven_stiffness(const TetMesh& mesh, double nu,
                                    const std::vector<double>& levels,
                                    const std::function<int(const Vec3&)>& level_of) {
  BlockMatrix sum = Elasticity(mesh.X, mesh.tets, Linear(1, nu)).make_matrix();
  for (std::size_t level = 0; level < levels.size(); ++level) {
    std::vector<int> elements;
    for (int e = 0; e < mesh.tets.cols(); ++e) {
      Vec3 center = Vec3::Zero();
      for (int a = 0; a < 4; ++a) center += 0.25 * mesh.X.col(mesh.tets(a, e));
      if (level_of(center) == static_cast<int>(level)) elements.push_back(e);
    }
    const Elasticity part(mesh.X, mesh.tets(Eigen::all, elements), Linear(levels[level], nu));
    BlockMatrix K = part.make_matrix();
    part.add_stiffness(mesh.X, Tangent::Consistent, 1, K);
    for (int i = 0; i < K.num_blocks(); ++i) {
      for (int s = K.row_begin()[i]; s < K.row_begin()[i + 1]; ++s) {
        sum.block(sum.slot(i, K.column()[s])) += K.block(s);
      }
    }
  }
  return sum;
}

/// stiffness (Σ_k w_k n·u_k)²/2, as a contact adds it. [N/m]
struct Spring {
  std::vector<int> blocks;
  std::vector<Vec3> arms;  // w_k n
  double stiffness = 0;
};

/// K with springs, on `num_blocks` blocks or those of K.
inline BlockMatrix with_springs(const BlockMatrix& K, const std::vector<Spring>& springs,
                                int num_blocks) {
  std::vector<int> stencils, offsets{0};
  for (int i = 0; i < K.num_blocks(); ++i) {
    for (int s = K.row_begin()[i]; s < K.row_begin()[i + 1]; ++s) {
      if (K.column()[s] <= i) continue;
      stencils.push_back(i);
      stencils.push_back(K.column()[s]);
      offsets.push_back(static_cast<int>(stencils.size()));
    }
  }
  for (const Spring& spring : springs) {
    stencils.insert(stencils.end(), spring.blocks.begin(), spring.blocks.end());
    offsets.push_back(static_cast<int>(stencils.size()));
  }
  BlockMatrix A(num_blocks, stencils, offsets);
  for (int i = 0; i < K.num_blocks(); ++i) {
    for (int s = K.row_begin()[i]; s < K.row_begin()[i + 1]; ++s) {
      A.block(A.slot(i, K.column()[s])) += K.block(s);
    }
  }
  for (const Spring& spring : springs) {
    for (std::size_t p = 0; p < spring.blocks.size(); ++p) {
      for (std::size_t q = 0; q < spring.blocks.size(); ++q) {
        A.block(A.slot(spring.blocks[p], spring.blocks[q])) +=
            spring.stiffness * spring.arms[p] * spring.arms[q].transpose();
      }
    }
  }
  return A;
}

struct HostileSystem {
  const char* name;
  int most_iterations;  // for 1e-8; measured plus about a third
  std::function<ClampedBox()> make;
};

inline ClampedBox deformed_box(const std::array<int, 3>& cells, double jitter,
                               const std::function<Vec3(const Vec3&)>& map) {
  TetMesh mesh = box_mesh(cells, Vec3::Ones(), jitter);
  for (auto column : mesh.X.colwise()) column = map(column);
  return clamped_box(mesh, 0.3);
}

inline ClampedBox uneven_box(int cells, double inside) {
  const TetMesh mesh = box_mesh({cells, cells, cells}, Vec3::Ones());
  const auto level_of = [](const Vec3& x) {
    return (x - Vec3::Constant(0.5)).lpNorm<Eigen::Infinity>() < 0.25 ? 1 : 0;
  };
  ClampedBox box = clamped_box(mesh, 0.3);
  std::vector<int> free_nodes;
  for (int i = 0; i < mesh.X.cols(); ++i) {
    if (mesh.X(0, i) > 0) free_nodes.push_back(i);
  }
  box.K = part_of(uneven_stiffness(mesh, 0.3, {1e6, inside}, level_of), free_nodes);
  return box;
}

/// Springs a thousand times as stiff as an edge of K, across, between random nodes: four each, as a
/// node in a face.
inline std::vector<Spring> random_contacts(const BlockMatrix& K, int num_contacts) {
  Random random;
  std::vector<Spring> springs(static_cast<std::size_t>(num_contacts));
  for (Spring& spring : springs) {
    spring.stiffness = 1e3 * K.block(0)(0, 0);
    const Vec3 normal = random.rotation().col(0);
    for (const double weight : {1.0, -0.5, -0.3, -0.2}) {
      spring.blocks.push_back(static_cast<int>(random.uniform(0, 0.999) * K.num_blocks()));
      spring.arms.push_back(weight * normal);
    }
  }
  return springs;
}

inline ClampedBox box_with_contacts(int cells, int num_contacts) {
  ClampedBox box = clamped_box(box_mesh({cells, cells, cells}, Vec3::Ones(), 0.2), 0.3);
  box.K = with_springs(box.K, random_contacts(box.K, num_contacts), box.K.num_blocks());
  return box;
}

/// A box whose face x = 1 is fastened by springs to a bone: two more blocks, translation and
/// rotation about the centre of the face [m].
inline ClampedBox box_with_bone(int cells) {
  ClampedBox box = clamped_box(box_mesh({cells, cells, cells}, Vec3::Ones(), 0.1), 0.3);
  const int n = box.K.num_blocks();
  std::vector<Spring> springs;
  for (int i = 0; i < n; ++i) {
    if (box.X(0, i) < 1 - 1e-9) continue;
    const Vec3 arm = box.X.col(i) - Vec3(1, 0.5, 0.5);
    for (int c = 0; c < 3; ++c) {  // u_i − (t + ω × arm) = 0 along axis c
      const Vec3 axis = Vec3::Unit(c);
      springs.push_back({{i, n, n + 1}, {axis, -axis, -arm.cross(axis)}, 1e7});
    }
  }
  box.K = with_springs(box.K, springs, n + 2);
  box.b.conservativeResizeLike(Eigen::VectorXd::Ones(3 * (n + 2)));
  return box;
}

/// A free body: M + K with so little mass that the rigid motions are nearly singular.
inline ClampedBox floating_box(int cells, double mass) {
  const TetMesh mesh = box_mesh({cells, cells, cells}, Vec3::Ones(), 0.1);
  const Elasticity elasticity(mesh.X, mesh.tets, Linear(1e6, 0.3));
  ClampedBox box{mesh.X, elasticity.make_matrix(), {}};
  elasticity.add_stiffness(mesh.X, Tangent::Consistent, 1, box.K);
  const double shift = mass * box.K.block(0)(0, 0);
  for (int i = 0; i < box.K.num_blocks(); ++i) {
    box.K.block(box.K.slot(i, i)) += shift * Mat3::Identity();
  }
  box.b = Random().matrix<Eigen::VectorXd>(3 * mesh.X.cols(), 1);
  return box;
}

/// Nodes that are held by rows of the identity, and two nodes that nothing is fastened to.
inline ClampedBox box_with_identities(int cells) {
  ClampedBox box = clamped_box(box_mesh({cells, cells, cells}, Vec3::Ones(), 0.1), 0.3);
  for (int i = 0; i < box.K.num_blocks(); ++i) {
    for (int s = box.K.row_begin()[i]; s < box.K.row_begin()[i + 1]; ++s) {
      const int j = box.K.column()[s];
      const bool held = box.X(2, i) == 0 || box.X(2, j) == 0 || i < 2 || j < 2;
      if (held) box.K.block(s) = i == j ? Mat3(Mat3::Identity()) : Mat3(Mat3::Zero());
    }
  }
  return box;
}

inline std::vector<HostileSystem> hostile_systems() {
  const auto flat = [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.1 * x.z()); };
  const auto graded = [](const Vec3& x) {
    return Vec3(x.x() * x.x() + 0.01 * x.x(), std::pow(x.y(), 3) + 0.01 * x.y(), x.z());
  };
  // Every other layer of nodes moves next to the one before: elements of a twentieth of the height.
  const auto slivers = [](const Vec3& x) {
    const int layer = static_cast<int>(std::lround(12 * x.z()));
    return Vec3(x.x(), x.y(), layer % 2 == 0 ? x.z() : x.z() - 0.95 / 12);
  };
  const auto same = [](const Vec3& x) { return x; };
  std::vector<HostileSystem> systems;
  systems.push_back({"Jittered", 15, [=] { return deformed_box({12, 12, 12}, 0.2, same); }});
  systems.push_back({"Flat", 95, [=] { return deformed_box({12, 12, 12}, 0, flat); }});
  systems.push_back({"Graded", 20, [=] { return deformed_box({12, 12, 12}, 0, graded); }});
  systems.push_back({"Slivers", 25, [=] { return deformed_box({12, 12, 12}, 0, slivers); }});
  systems.push_back({"SoftInclusion", 15, [=] { return uneven_box(12, 1e3); }});
  systems.push_back({"StiffInclusion", 15, [=] { return uneven_box(12, 1e9); }});
  systems.push_back({"Contacts", 100, [=] { return box_with_contacts(12, 200); }});
  systems.push_back({"Bone", 26, [=] { return box_with_bone(12); }});
  systems.push_back({"Floating", 15, [=] { return floating_box(12, 1e-6); }});
  systems.push_back({"Identities", 15, [=] { return box_with_identities(12); }});
  return systems;
}

}  // namespace articular::fem
