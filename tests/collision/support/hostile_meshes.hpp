#pragma once

#include <string>
#include <vector>

#include "tests/collision/support/meshes.hpp"

/// Meshes and positions that nobody wants but simulations produce.
namespace articular::collision::testing {

struct HostilePair {
  std::string name;
  Mesh a, b;
  Eigen::Matrix3Xd x_a, x_b;  // [m]
  double size;                // of the smaller body [m]; margins are told in it
};

/// Tetrahedra without common nodes, corners anywhere in a cube of the given half-edge [m].
inline Mesh soup(int num_tets, double size, std::mt19937& random) {
  Mesh mesh;
  mesh.X.resize(3, 4 * num_tets);
  mesh.tets.resize(4, num_tets);
  for (int i = 0; i < 4 * num_tets; ++i) {
    mesh.X.col(i) = random_vector(random, size);
    mesh.tets(i % 4, i / 4) = i;
  }
  mesh.surface = build_surface(mesh.tets, 4 * num_tets);
  return mesh;
}

/// Two meshes as components of one.
inline Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh;
  mesh.X.resize(3, a.X.cols() + b.X.cols());
  mesh.X << a.X, b.X;
  mesh.tets.resize(4, a.tets.cols() + b.tets.cols());
  mesh.tets << a.tets, (b.tets.array() + static_cast<int>(a.X.cols())).matrix();
  mesh.surface = build_surface(mesh.tets, static_cast<int>(mesh.X.cols()));
  return mesh;
}

/// Nodes put onto other nodes, one in `every`: tetrahedra become flat, thin as a line, or points.
inline Eigen::Matrix3Xd with_nodes_merged(Eigen::Matrix3Xd x, unsigned every,
                                          std::mt19937& random) {
  for (Eigen::Index a = 0; a < x.cols(); ++a)
    if (random() % every == 0)
      x.col(a) = x.col(static_cast<Eigen::Index>(random() % static_cast<unsigned>(x.cols())));
  return x;
}

/// Coordinates on a grid, so that much touches much exactly.
inline Eigen::Matrix3Xd on_grid(const Eigen::Matrix3Xd& x, double step) {
  return step * (x / step).array().round().matrix();
}

/// One of each kind, different for each state of `random`.
inline std::vector<HostilePair> hostile_pairs(std::mt19937& random) {
  using Eigen::Vector3d;
  const Mesh box = box_mesh(2, 2, 2, 1), bar = box_mesh(4, 1, 2, 0.7);
  const auto loose = [&](const Mesh& mesh, double size) {
    return Eigen::Matrix3Xd(placed(jittered(mesh.X, 0.2, random),
                                   random_vector(random, 1) + Vector3d::Constant(1), random) *
                            size);
  };
  const auto moved = [](Eigen::Matrix3Xd x, double offset) {
    x.colwise() += Vector3d(offset, -offset, 0.7 * offset);
    return x;
  };
  std::vector<HostilePair> all;
  const auto add = [&](const char* name, const Mesh& a, const Mesh& b, const Eigen::Matrix3Xd& x_a,
                       const Eigen::Matrix3Xd& x_b, double size) {
    all.push_back({name, a, b, x_a, x_b, size});
  };

  Eigen::Matrix3Xd flat = loose(box, 1), mirrored = loose(bar, 1);
  flat.row(2).setConstant(0.5);
  mirrored.row(0) *= -1;
  mirrored.row(0).array() += 2;
  add("flat", box, bar, flat, loose(bar, 1), 1);
  add("both flat in one plane", box, box, flat, moved(flat, 0), 1);
  add("inverted", box, bar, loose(box, 1), mirrored, 1);
  add("some inverted", box, bar, jittered(box.X, 1, random), loose(bar, 1), 1);
  add("merged nodes", box, bar, with_nodes_merged(loose(box, 1), 4, random),
      with_nodes_merged(loose(bar, 1), 4, random), 1);
  const Eigen::Matrix3Xd point = Vector3d(1.1, 0.9, 1.2).replicate(1, bar.X.cols());
  add("a point in a body", box, bar, loose(box, 1), point, 1);
  add("a point in a huge body", box, bar, loose(box, 1e140), 1e-6 * point, 1);
  add("a point and a point", bar, bar, point, point, 1);
  add("a point at the origin", box, bar, moved(box.X, -0.3), 0 * point, 1);
  add("on a grid", box, bar, on_grid(loose(box, 1), 0.5), on_grid(loose(bar, 1), 0.5), 1);

  const Mesh with_giant = joined(box, soup(1, 1e6, random));
  add("one tetrahedron a million times larger", with_giant, bar, with_giant.X, loose(bar, 1), 1);
  add("size 1e-9", box, bar, loose(box, 1e-9), loose(bar, 1e-9), 1e-9);
  add("size 1e9", box, bar, loose(box, 1e9), loose(bar, 1e9), 1e9);
  add("size 1e-140", box, bar, loose(box, 1e-140), loose(bar, 1e-140), 1e-140);
  add("size 1e140", box, bar, loose(box, 1e140), loose(bar, 1e140), 1e140);
  add("at 1e9", box, bar, moved(loose(box, 1), 1e9), moved(loose(bar, 1), 1e9), 1);
  add("a few last digits large at 1e9", box, bar, moved(loose(box, 1e-5), 1e9),
      moved(loose(bar, 1e-5), 1e9), 1e-6);
  for (const double ratio : {1e6, 1e12, 1e13, 1e14, 1e20, 1e40, 1e100}) {
    const Eigen::Matrix3Xd huge = moved(ratio * box.X, -0.9 * ratio);
    add("far different scales", box, bar, huge, loose(bar, 1), 1);
    // The small body where two faces of the large one meet.
    const Eigen::Matrix3Xd edge = (ratio * jittered(box.X, 0.2, random)).eval();
    const Vector3d centre = 0.5 * (edge.col(0) + edge.col(1));
    add("a crumb on an edge", box, bar, edge, loose(bar, 1).colwise() + centre, 1);
    add("a crumb on a corner", box, bar, edge.colwise() - edge.col(0), loose(bar, 1), 1);
  }
  add("scales 1e-6 and 1e6", box, bar, moved(1e6 * box.X, -7e5), loose(bar, 1e-6), 1e-6);

  add("coincident", box, box, box.X, box.X, 1);
  const Eigen::Matrix3Xd crooked = loose(box, 1);
  add("coincident and crooked", box, box, crooked, crooked, 1);
  add("apart", box, bar, box.X, moved(bar.X, 50), 1);
  add("touching boxes", box, box, box.X, box.X.colwise() + Vector3d(2, 0.5, 0.25), 1);
  add("nested", box, box, 4 * box.X, box.X.colwise() + Vector3d(3.1, 3.2, 3.3), 1);
  const Mesh twice = joined(box, box);
  add("everything in one place", joined(twice, twice), box, joined(twice, twice).X, box.X, 1);
  Mesh parts = joined(joined(box, bar), soup(5, 1, random));
  add("several components", parts, bar, jittered(parts.X, 0.3, random), loose(bar, 1), 1);
  const Mesh a_soup = soup(40, 1, random);
  add("soup", a_soup, bar, a_soup.X, loose(bar, 1), 1);
  return all;
}

}  // namespace articular::collision::testing
