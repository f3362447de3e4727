#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/temporary_folder.hpp"

/// Scenes of moving bodies that touch, with everything by default but the step.
namespace articular::sim {

inline Scenario contact_scene(double step,
                              Integrator::Scheme scheme = Integrator::Scheme::ImplicitEuler) {
  Scenario scenario = scene(step, scheme);
  scenario.integrator.position_tolerance.reset();
  scenario.contact = true;
  return scenario;
}

/// A body of a mesh made in code [m], which is read back from a file in the folder.
inline Body mesh_body(const std::string& name, Body::Kind kind, const MeshData& mesh,
                      const TemporaryFolder& folder) {
  const bool solid = mesh.tets.cols() > 0;
  Body body = box_body(name, kind, Vec3::Ones());
  MeshFile file;
  file.path = folder / (name + (solid ? ".vtu" : ".vtp"));
  file.unit = 1;
  write_mesh(file.path, mesh, 1);
  body.geometry = file;
  return body;
}

/// A rigid one.
inline Body ball_body(double density, const SphereGeometry& sphere) {
  Body ball;
  ball.name = "ball";
  ball.kind = Body::Kind::Rigid;
  ball.density = density;
  ball.geometry = sphere;
  return ball;
}

/// The elements of a box whose centres keep() accepts.
template <class Keep>
MeshData carved(const BoxGeometry& box, Keep&& keep) {
  MeshData mesh = box_mesh(box);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
    const Vec3 center = mesh.X(Eigen::all, mesh.tets.col(e)).rowwise().mean();
    if (keep(center)) kept.push_back(e);
  }
  mesh.tets = Tetrahedra(mesh.tets(Eigen::all, kept));
  return mesh;
}

/// A box whose nodes are moved by map(X).
template <class Map>
MeshData bent(const BoxGeometry& box, Map&& map) {
  MeshData mesh = box_mesh(box);
  for (Eigen::Index i = 0; i < mesh.X.cols(); ++i) mesh.X.col(i) = map(Vec3(mesh.X.col(i)));
  return mesh;
}

/// The surface of a box, without the elements.
inline MeshData skin_of(const BoxGeometry& box) {
  const MeshData solid = box_mesh(box);
  MeshData skin;
  skin.X = solid.X;
  skin.triangles = collision::build_surface(solid.tets, static_cast<int>(solid.X.cols())).faces;
  return skin;
}

/// Positions of a tissue's nodes now [m].
inline Positions nodes_of(const Simulation& run, std::size_t tissue) {
  Positions x;
  positions_of(run.now(), run.model.tissues[tissue].nodes, x);
  return x;
}

/// Six times the volume of an element [m³].
inline double sextuple_volume(const Positions& x, const Eigen::Vector4i& tet) {
  const Vec3 a = x.col(tet[0]);
  return (x.col(tet[1]) - a).cross(x.col(tet[2]) - a).dot(x.col(tet[3]) - a);
}

/// The smallest ratio of volume now to volume at the start; ≤ 0: an element is inverted.
inline double least_volume_ratio(const Simulation& run) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < run.model.tissues.size(); ++t) {
    const Tissue& tissue = run.model.tissues[t];
    const Positions x = nodes_of(run, t);
    for (const auto& tet : tissue.elements.tets().colwise())
      least = std::min(least, sextuple_volume(x, tet) / sextuple_volume(tissue.X, tet));
  }
  return least;
}

/// Σ m v of the tissues [kg m/s].
inline Vec3 momentum(const Simulation& run) {
  Vec3 sum = Vec3::Zero();
  for (const Tissue& tissue : run.model.tissues)
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      sum += tissue.lumped_mass[static_cast<Eigen::Index>(i)] * run.now().velocity(tissue.nodes[i]);
  return sum;
}

/// The bone of a body, for Simulation::force_on().
inline int bone_of(const Simulation& run, const std::string& name) {
  const auto body = std::find_if(run.model.bodies.begin(), run.model.bodies.end(),
                                 [&](const BodyModel& b) { return b.name == name; });
  return body->rigid;
}

inline double kinetic_energy(const Simulation& run) { return kinetic_energy(run.stepper.now()); }

}  // namespace articular::sim
