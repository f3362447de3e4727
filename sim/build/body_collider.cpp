#include "sim/build/body_collider.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

#include "sim/build/collider.hpp"
#include "sim/mesh/winding_number.hpp"
#include "sim/model/mass_properties.hpp"
#include "sim/model/tissue.hpp"
#include "sim/scenario/name_pattern.hpp"

namespace articular::sim {
namespace {

/// How far in front of a face a triangle's depth counts in the averages, in heights of the elements
/// at its surface; from half of it on it fades. More than a facet's sagitta under a round bone. The
/// larger, the more a dragged sphere's force ripples; the smaller, the stiffer coarse surfaces are
/// (RESULTS.md).
constexpr double kOpenDepth = 0.12;
/// A tissue's face counts as crossed up to this part of an element's height. Contact keeps depths
/// far below it; what lies deeper is seen from beyond an edge, and was not entered through that
/// face.
constexpr double kTissueReach = 0.5;
/// A rigid body's face counts as crossed up to this part of half its thickness, so that the faces
/// of its other side are not.
constexpr double kBoneReach = 0.9;
/// Cortical bone, where a bone meets a bone without a layer between: E [Pa], nu.
constexpr double kBoneModulus = 15e9, kBonePoisson = 0.3;

/// The names of bodies that [[contact]] has, and the patterns.
struct NamedInContacts {
  std::unordered_set<std::string> names;
  std::vector<std::string> patterns;

  explicit NamedInContacts(const Scenario& scenario) {
    for (const ContactPair& pair : scenario.contacts)
      for (const std::string& name : {pair.a, pair.b})
        if (is_pattern(name))
          patterns.push_back(name);
        else
          names.insert(name);
    if (scenario.contacts.empty() && scenario.bodies.size() > 1) patterns.emplace_back("*");
  }
  bool has(const std::string& name) const {
    return names.contains(name) ||
           std::any_of(patterns.begin(), patterns.end(),
                       [&](const std::string& pattern) { return fits(pattern, name); });
  }
};

Collider tissue_collider(const Model& model, std::size_t b) {
  const Tissue& tissue = model.tissues[static_cast<std::size_t>(model.bodies[b].tissue)];
  Collider collider;
  collider.X = tissue.X;
  collider.tets = tissue.elements.tets();
  collider.nodes = tissue.nodes;
  complete_collider(collider, {});
  collider.compliance = collider.height / constrained_modulus(tissue);
  collider.mean_compliance = collider.size / constrained_modulus(tissue);
  collider.reach = kTissueReach * collider.size;
  collider.open_depth = kOpenDepth * collider.size;
  return collider;
}

/// Of a surface's triangles [m].
double mean_edge(const MeshData& surface) {
  double sum = 0;
  for (const auto& triangle : surface.triangles.colwise())
    for (int k = 0; k < 3; ++k)
      sum += (surface.X.col(triangle[(k + 1) % 3]) - surface.X.col(triangle[k])).norm();
  return sum / (3 * static_cast<double>(surface.triangles.cols()));
}

double area_of(const Positions& X, const Triangles& triangles) {
  double sum = 0;
  for (const auto& t : triangles.colwise())
    sum += 0.5 * (X.col(t[1]) - X.col(t[0])).cross(X.col(t[2]) - X.col(t[0])).norm();
  return sum;
}

/// Of the collision elements under a surface [m]: as deep as faces are long, and not beyond the
/// middle of a closed surface that is thinner: there the shell would come out on the other side. A
/// plate's thickness is twice its volume by its area.
double shell_depth(const MeshData& surface) {
  const double edge = mean_edge(surface);
  if (!is_closed(surface.triangles)) return edge;
  const double volume = solid_mass_properties(surface.X, surface.triangles, 1).mass;
  return volume > 0 ? std::min(edge, volume / area_of(surface.X, surface.triangles)) : edge;
}

/// Creases and slivers of a scanned surface that can't take part in contact: many are an error. A
/// few are told where their area counts; else the faces around them carry what presses there.
void report_dropped(const Body& body, const MeshData& surface, const Triangles& kept,
                    Model& model) {
  constexpr double kMostDropped = 0.03, kLittleArea = 0.01;
  const Eigen::Index given = surface.triangles.cols(), dropped = given - kept.cols();
  if (dropped == 0) return;
  const std::string what =
      fmt::format("{} of {} faces of the contact surface of `{}` are slivers or lie in creases",
                  dropped, given, body.name);
  if (static_cast<double>(dropped) > kMostDropped * static_cast<double>(given))
    throw InputError(what + "; expected a smooth surface with outward normals");
  const double part = 1 - area_of(surface.X, kept) / area_of(surface.X, surface.triangles);
  if (part < kLittleArea) return;
  model.warnings.push_back(
      prefix(body.where) + what +
      fmt::format(" and are left out of contact, {:.1f} % of its area", 100 * part));
}

Collider rigid_collider(const Body& body, const BodyGeometry& geometry, std::size_t b,
                        Model& model) {
  const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(model.bodies[b].rigid)];
  const bool shell = geometry.contact.X.cols() > 0 || geometry.mesh.tets.cols() == 0;
  Collider collider;
  std::vector<char> is_outer;
  double depth = 0;
  if (shell) {
    const MeshData& surface = geometry.contact.X.cols() > 0 ? geometry.contact : geometry.mesh;
    if (surface.triangles.cols() == 0) throw InputError("its mesh has no triangles");
    depth = shell_depth(surface);
    collider.X = surface.X;
    Triangles triangles = surface.triangles;
    collider.tets = shell_under(collider.X, triangles, depth);
    report_dropped(body, surface, triangles, model);
    is_outer.assign(static_cast<std::size_t>(collider.X.cols()), 0);
    std::fill_n(is_outer.begin(), surface.X.cols(), 1);
  } else {
    collider.X = geometry.mesh.X;
    collider.tets = geometry.mesh.tets;
  }
  complete_collider(collider, is_outer);
  if (!shell) depth = 2 * collider.size;
  collider.reach = shell ? depth : std::min(depth, kBoneReach * half_thickness(collider));
  for (Eigen::Index i = 0; i < collider.X.cols(); ++i)
    collider.nodes.push_back(
        {rigid.block, model.bodies[b].rigid, collider.X.col(i) - rigid.rest.p});
  collider.open_depth = kOpenDepth * depth;
  collider.mean_compliance = depth / constrained_modulus(kBoneModulus, kBonePoisson);
  if (body.layer) {
    collider.layer_thickness = body.layer->thickness;
    collider.layer_compliance =
        body.layer->thickness /
        constrained_modulus(body.layer->young_modulus, body.layer->poisson_ratio);
    collider.layer_stiffens = body.layer->law == Layer::Law::Logarithmic;
  }
  collider.compliance.setConstant(collider.X.cols(), collider.mean_compliance);
  return collider;
}

}  // namespace

void make_colliders(const Scenario& scenario, const std::vector<BodyGeometry>& geometry,
                    Model& model) {
  if (!scenario.contact) return;
  const NamedInContacts named(scenario);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = scenario.bodies[b];
    if (!body.collides || !named.has(body.name)) continue;
    try {
      if (model.bodies[b].tissue >= 0)
        model.bodies[b].collider = tissue_collider(model, b);
      else if (geometry[b].mesh.X.cols() > 0 || geometry[b].contact.X.cols() > 0)
        model.bodies[b].collider = rigid_collider(body, geometry[b], b, model);
    } catch (const std::exception& error) {
      throw InputError(mesh_place(body), fmt::format("body `{}`: {}", body.name, error.what()));
    }
  }
}

}  // namespace articular::sim
