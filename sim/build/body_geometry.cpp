#include "sim/build/body_geometry.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/mesh/mesh_continue.hpp"
#include "sim/mesh/shapes.hpp"
#include "sim/mesh/winding_number.hpp"

namespace articular::sim {
namespace {

/// Faces of a contact mesh within 80 degrees of `facing` take part.
const double kFacingLimit = std::cos(80 * std::numbers::pi / 180);

/// @param body  its name, for messages
MeshData load(const MeshFile& file, const std::string& body) {
  MeshData mesh;
  std::error_code error;
  if (!file.made_by.empty() && !std::filesystem::exists(file.path, error))
    throw InputError(file.where, file.path.string() + ": no such mesh file; it is made by `" +
                                     file.made_by + "`");
  try {
    mesh = read_mesh(file.path, file.unit, file.parts);
  } catch (const InputError& error) {
    throw InputError(file.where, fmt::format("{} (mesh of body `{}`)", error.what(), body));
  }
  place(file.placement, mesh.X);
  return mesh;
}

/// Makes the mesh of a body's geometry, placed.
struct MakeMesh {
  const Placement& placement;  // of a built-in one
  const std::string& body;

  MeshData operator()(std::monostate) const { return {}; }
  MeshData operator()(const MeshFile& file) const { return load(file, body); }
  MeshData operator()(const BoxGeometry& box) const { return placed(box_mesh(box)); }
  MeshData operator()(const HexahedronGeometry& block) const {
    return placed(hexahedron_mesh(block));
  }
  MeshData operator()(const SphereGeometry& sphere) const { return placed(sphere_mesh(sphere)); }
  MeshData operator()(const VShapeGeometry& shape) const { return placed(v_shape_mesh(shape)); }

  MeshData placed(MeshData mesh) const {
    place(placement, mesh.X);
    return mesh;
  }
};

void append(const MeshData& part, MeshData& whole) {
  const auto nodes = static_cast<int>(whole.X.cols());
  const auto triangles = whole.triangles.cols();
  whole.X.conservativeResize(3, nodes + part.X.cols());
  whole.X.rightCols(part.X.cols()) = part.X;
  whole.triangles.conservativeResize(3, triangles + part.triangles.cols());
  whole.triangles.rightCols(part.triangles.cols()) = part.triangles.array() + nodes;
}

/// The faces of a surface that face the direction and lie in the box that a contact mesh asks for,
/// with the nodes that they use.
MeshData faces_of(const MeshData& mesh, const MeshFile& file) {
  std::vector<int> kept, new_index(static_cast<std::size_t>(mesh.X.cols()), -1);
  MeshData part;
  part.triangles.resize(3, mesh.triangles.cols());
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < mesh.triangles.cols(); ++f) {
    const Eigen::Vector3i t = mesh.triangles.col(f);
    const Vec3 area =
        (mesh.X.col(t[1]) - mesh.X.col(t[0])).cross(mesh.X.col(t[2]) - mesh.X.col(t[0]));
    if (file.facing && area.dot(*file.facing) <= kFacingLimit * area.norm()) continue;
    if (file.box && !lies_in(*file.box, mesh.X(Eigen::all, t).rowwise().mean())) continue;
    for (int k = 0; k < 3; ++k) {
      int& index = new_index[static_cast<std::size_t>(t[k])];
      if (index < 0) {
        index = static_cast<int>(kept.size());
        kept.push_back(t[k]);
      }
      part.triangles(k, count) = index;
    }
    ++count;
  }
  part.triangles.conservativeResize(3, count);
  part.X = mesh.X(Eigen::all, kept);
  return part;
}

MeshData continued_part(const MeshData& mesh, const MeshFile& file) {
  try {
    return continued(mesh, *file.continued);
  } catch (const std::invalid_argument& error) {
    throw InputError(file.where, error.what());
  }
}

/// Of tetrahedra, if there are any.
void take_surface(MeshData& mesh) {
  if (mesh.tets.cols() == 0) return;
  mesh.triangles = collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols())).faces;
}

/// A scan is a surface: its user is led to the mesher.
[[noreturn]] void refuse_surface_of_tissue(const Body& body) {
  const auto* const file = std::get_if<MeshFile>(&body.geometry);
  const std::string surface = file != nullptr ? file->path.string() : "SURFACE";
  throw InputError(
      mesh_place(body),
      fmt::format(
          "the mesh of tissue `{}`{} has no tetrahedra; expected a tetrahedral mesh ({}); "
          "`articular mesh {} --size \"2 mm\" --out {}.vtu` fills a closed surface with them",
          body.name, mesh_name(body), kTissueEndings, surface,
          std::filesystem::path(surface).stem().string()));
}

/// Of a file: a closed surface of which the outside is within.
void refuse_inside_out(const MeshData& mesh, const MeshFile& file, const std::string& body) {
  if (mesh.tets.cols() > 0 || !is_closed(mesh.triangles)) return;
  if (!(solid_mass_properties(mesh.X, mesh.triangles, 1).mass < 0)) return;
  throw InputError(file.where,
                   fmt::format("the surface {} of `{}` is inside out: its triangles are listed "
                               "clockwise as seen from outside; expected counterclockwise ones "
                               "(turn the normals round)",
                               file.path.string(), body));
}

using Corners = std::array<std::array<double, 3>, 3>;

/// The corners of a triangle, the least first, in their order.
Corners turned_corners(const Positions& X, const Eigen::Vector3i& t) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto x = X.col(t[static_cast<Eigen::Index>(k)]);
    corners[k] = {x[0], x[1], x[2]};
  }
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// A triangle that is there twice encloses twice as much, weighs twice as much and carries half of
/// the force. Their nodes may be others, at the same places.
void refuse_doubled_triangles(const MeshData& surface, const Location& where,
                              const std::string& what) {
  std::vector<Corners> triangles;
  triangles.reserve(static_cast<std::size_t>(surface.triangles.cols()));
  for (const auto& t : surface.triangles.colwise())
    triangles.push_back(turned_corners(surface.X, t));
  std::sort(triangles.begin(), triangles.end());
  const auto twin = std::adjacent_find(triangles.begin(), triangles.end());
  if (twin == triangles.end()) return;
  const auto& corner = twin->front();
  throw InputError(
      where, fmt::format("{} has a triangle twice, with a corner at ({:.6g} {:.6g} {:.6g}) mm; "
                         "expected each face once",
                         what, 1e3 * corner[0], 1e3 * corner[1], 1e3 * corner[2]));
}

[[noreturn]] void refuse_empty_part(const MeshFile& file, const std::string& body) {
  throw InputError(file.where, fmt::format("no triangle of contact mesh {} of `{}` is left by {}",
                                           file.path.string(), body,
                                           !file.box      ? "`facing`"
                                           : !file.facing ? "`box`"
                                                          : "`facing` and `box`"));
}

}  // namespace

bool lies_in(const std::pair<Vec3, Vec3>& box, const Vec3& x) {
  return (x.array() >= box.first.array()).all() && (x.array() <= box.second.array()).all();
}

std::string mesh_name(const Body& body) {
  const auto* file = std::get_if<MeshFile>(&body.geometry);
  return file != nullptr ? " (" + file->path.string() + ")" : "";
}

const Location& mesh_place(const Body& body) {
  const auto* file = std::get_if<MeshFile>(&body.geometry);
  return file != nullptr ? file->where : body.where;
}

BodyGeometry read_geometry(const Body& body) {
  BodyGeometry geometry;
  geometry.mesh = std::visit(MakeMesh{body.placement, body.name}, body.geometry);
  const bool tissue = body.kind == Body::Kind::Tissue;
  if (tissue && geometry.mesh.tets.cols() == 0) refuse_surface_of_tissue(body);
  if (const auto* file = std::get_if<MeshFile>(&body.geometry))
    refuse_inside_out(geometry.mesh, *file, body.name);
  if (!tissue && geometry.mesh.X.cols() > 0) {
    take_surface(geometry.mesh);
    refuse_doubled_triangles(geometry.mesh, mesh_place(body),
                             fmt::format("the surface of `{}`", body.name));
  }
  for (const MeshFile& file : body.contact_meshes) {
    MeshData part = load(file, body.name);
    refuse_inside_out(part, file, body.name);
    take_surface(part);
    if (part.triangles.cols() == 0)
      throw InputError(file.where, fmt::format("contact mesh {} of `{}` has no triangles",
                                               file.path.string(), body.name));
    if (file.facing || file.box || part.tets.cols() > 0) part = faces_of(part, file);
    if (part.triangles.cols() == 0) refuse_empty_part(file, body.name);
    if (file.faces) part = simplified(part, *file.faces);
    if (file.continued) part = continued_part(part, file);
    append(part, geometry.contact);
  }
  refuse_doubled_triangles(
      geometry.contact, body.where,
      fmt::format("what touches of `{}`, its contact meshes together,", body.name));
  return geometry;
}

MassProperties rigid_mass(const Body& body, const MeshData& mesh) {
  MassProperties mass;
  const bool from_mesh = !(body.mass && body.center_of_mass && body.inertia);
  if (from_mesh) {
    if (mesh.triangles.cols() == 0)
      throw InputError(body.where, fmt::format("rigid body `{}` needs a mesh, or mass, "
                                               "center_of_mass and inertia",
                                               body.name));
    if (!is_closed(mesh.triangles))
      throw InputError(body.where,
                       fmt::format("the surface of `{}` has borders, or triangles that face each "
                                   "other, so its volume is not known; expected a closed surface, "
                                   "or mass, center_of_mass and inertia",
                                   body.name));
    mass = solid_mass_properties(mesh.X, mesh.triangles, body.density.value_or(1.0));
    if (!(mass.mass > 0))
      throw InputError(body.where,
                       fmt::format("the surface of `{}` {}; expected a closed surface with "
                                   "outward normals",
                                   body.name,
                                   mass.mass < 0 ? "is inside out: its normals point inwards"
                                                 : "encloses no volume"));
    if (body.mass) {
      mass.inertia *= *body.mass / mass.mass;
    }
  }
  if (body.mass) mass.mass = *body.mass;
  if (body.center_of_mass) mass.center = *body.center_of_mass;
  if (body.inertia) mass.inertia = *body.inertia;
  return mass;
}

}  // namespace articular::sim
