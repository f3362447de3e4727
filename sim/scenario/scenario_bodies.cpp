#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <unordered_map>

#include "sim/base/pose.hpp"
#include "sim/scenario/data_path.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

constexpr int kMostCells = 10000;  // along one edge of a built-in geometry
constexpr std::array<std::string_view, 6> kFreedoms = {
    "translation.x", "translation.y", "translation.z", "rotation.x", "rotation.y", "rotation.z"};

double read_length_unit(const Node& node) {
  try {
    return parse_unit(read_text(node), kLength);
  } catch (const std::invalid_argument& error) {
    fail(node, error.what());
  }
}

Continuation read_continuation(const Node& node) {
  const TableReader table(node, "continued", {"at", "direction", "length", "easing"});
  Continuation continuation;
  continuation.at = read_vector(table.at("at"), kLength);
  continuation.direction = read_direction(table.at("direction"));
  continuation.length = read_quantity(table.at("length"), kLength, kPositive);
  table.may("easing", continuation.easing, as_quantity(kLength, kNotNegative));
  return continuation;
}

/// @param is_contact_mesh  allows `facing`, `faces` and `continued`
MeshFile read_mesh(const Node& node, const std::filesystem::path& folder, bool is_contact_mesh) {
  const auto table =
      is_contact_mesh
          ? TableReader(node, "contact mesh",
                        {"file", "unit", "place", "made_by", "facing", "faces", "continued"})
          : TableReader(node, "mesh", {"file", "unit", "place", "made_by"});
  MeshFile mesh;
  mesh.where = table.at("file").where;
  mesh.path = read_path(table.at("file"), folder);
  table.may("unit", mesh.unit, read_length_unit);
  table.may("place", mesh.placement, read_placement);
  table.may("made_by", mesh.made_by, read_text);
  table.may("facing", mesh.facing, read_direction);
  constexpr int kFewestFaces = 20, kMostFaces = 10'000'000;
  table.may("faces", mesh.faces,
            [](const Node& n) { return read_integer(n, kFewestFaces, kMostFaces); });
  table.may("continued", mesh.continued, read_continuation);
  return mesh;
}

template <int N>
Eigen::Matrix<int, N, 1> read_cells(const Node& node) {
  const Node::List& list = read_list(node, fmt::format("{} numbers of cells", N), N);
  Eigen::Matrix<int, N, 1> cells;
  for (int i = 0; i < N; ++i)
    cells[i] = read_integer(list[static_cast<std::size_t>(i)], 1, kMostCells);
  return cells;
}

BoxGeometry read_box(const Node& node) {
  const TableReader table(node, "box", {"size", "cells", "center"});
  BoxGeometry box;
  box.size = read_vector(table.at("size"), kLength);
  if (!(box.size.minCoeff() > 0))
    fail(table.at("size"), "the three edges must be positive, found " + found(table.at("size")));
  box.cells = read_cells<3>(table.at("cells"));
  table.may("center", box.center, as_vector(kLength));
  return box;
}

/// The volume that the corner spans with its three neighbours, by that of the edges' lengths.
double corner_fullness(const Eigen::Matrix<double, 3, 8>& corners, int corner) {
  // Neighbours along x, y, z of each corner, in VTK's order of a hexahedron.
  constexpr int kNeighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                     {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  Mat3 edges;
  for (int e = 0; e < 3; ++e)
    edges.col(e) = corners.col(kNeighbours[corner][e]) - corners.col(corner);
  const double size = edges.col(0).norm() * edges.col(1).norm() * edges.col(2).norm();
  return size > 0 ? edges.determinant() / size : 0;
}

HexahedronGeometry read_hexahedron(const Node& node) {
  constexpr double kFlat = 1e-6;
  const TableReader table(node, "hexahedron", {"corners", "cells"});
  HexahedronGeometry hexahedron;
  const Node& corners = table.at("corners");
  const Node::List& list = read_list(corners, "a list of eight points", 8);
  for (int i = 0; i < 8; ++i)
    hexahedron.corners.col(i) = read_vector(list[static_cast<std::size_t>(i)], kLength);
  for (int i = 0; i < 8; ++i)
    if (corner_fullness(hexahedron.corners, i) < kFlat)
      fail(list[static_cast<std::size_t>(i)],
           "the block is flat or turned inside out at this corner; expected the corners of the "
           "lower face, counterclockwise as seen from above, then those of the upper face above "
           "them");
  hexahedron.cells = read_cells<3>(table.at("cells"));
  return hexahedron;
}

SphereGeometry read_sphere(const Node& node) {
  const TableReader table(node, "sphere", {"radius", "element_size", "center"});
  SphereGeometry sphere;
  sphere.radius = read_quantity(table.at("radius"), kLength, kPositive);
  sphere.element_size = read_quantity(table.at("element_size"), kLength, kPositive);
  if (sphere.element_size > sphere.radius)
    fail(table.at("element_size"),
         "must not exceed the radius, found " + found(table.at("element_size")));
  table.may("center", sphere.center, as_vector(kLength));
  return sphere;
}

VShapeGeometry read_v_shape(const Node& node) {
  static constexpr Range kOpening{0, std::numbers::pi, true, "must lie between 0 and 180 deg"};
  const TableReader table(node, "v_shape", {"leg_length", "width", "angle", "cells"});
  VShapeGeometry shape;
  shape.leg_length = read_quantity(table.at("leg_length"), kLength, kPositive);
  shape.width = read_quantity(table.at("width"), kLength, kPositive);
  shape.angle = read_quantity(table.at("angle"), kAngle, kOpening);
  shape.cells = read_cells<2>(table.at("cells"));
  return shape;
}

void read_geometry(const Node& node, Body& body) {
  const TableReader table(node, "geometry", {"box", "hexahedron", "sphere", "v_shape", "place"});
  table.exactly_one({"box", "hexahedron", "sphere", "v_shape"});
  table.may("box", body.geometry, read_box);
  table.may("hexahedron", body.geometry, read_hexahedron);
  table.may("sphere", body.geometry, read_sphere);
  table.may("v_shape", body.geometry, read_v_shape);
  table.may("place", body.placement, read_placement);
}

Layer read_layer(const Node& node) {
  const TableReader table(node, "layer", {"thickness", "young_modulus", "poisson_ratio"});
  return {read_quantity(table.at("thickness"), kLength, kPositive),
          read_quantity(table.at("young_modulus"), kStress, kPositive),
          read_number(table.at("poisson_ratio"), kPoissonRange)};
}

/// "xx yy zz unit" and, if given, "xy xz yz unit". The tensor must be that of a body: its principal
/// moments are positive and none exceeds the sum of the other two.
Eigen::Matrix3d read_inertia(const Node& node) {
  constexpr double kRoundOff = 1e-9;  // relative; a flat body has a moment equal to the sum
  const Node::List& list =
      read_list(node, "one or two texts such as [\"147 246 297 kg mm^2\", \"0 0 -45 kg mm^2\"]");
  if (list.size() > 2)
    fail(node,
         fmt::format("expected \"xx yy zz unit\" and \"xy xz yz unit\", found {}", found(node)));
  Eigen::Matrix3d inertia = read_vector(list[0], kInertia).asDiagonal();
  if (list.size() == 2) {
    const Vec3 off = read_vector(list[1], kInertia);
    inertia(0, 1) = inertia(1, 0) = off[0];
    inertia(0, 2) = inertia(2, 0) = off[1];
    inertia(1, 2) = inertia(2, 1) = off[2];
  }
  const Vec3 moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(moments[0] > 0) || moments[2] > (moments[0] + moments[1]) * (1 + kRoundOff))
    fail(node,
         fmt::format("not the inertia of a body: its principal moments {:.4g}, {:.4g} and {:.4g} "
                     "kg m^2 must be positive and none larger than the sum of the others",
                     moments[0], moments[1], moments[2]));
  return inertia;
}

/// Velocities along axes that stand in space: rotations about two of them, with the third held, add
/// up to one about the third after all. So one rotation alone is never held.
Hold read_hold(const Node& node) {
  const TableReader table(node, "hold", {"freedoms", "at", "turned"});
  Hold hold;
  const Node& freedoms = table.at("freedoms");
  hold.held = read_freedoms(freedoms);
  if (std::count(hold.held.begin() + 3, hold.held.end(), true) == 1)
    fail(freedoms,
         "one rotation alone cannot be held: hold two, which leaves a hinge, or three; of two "
         "bones that move against each other, one can be the hinge of the other's third rotation");
  if (table.find("at") != nullptr) hold.at = read_vector(table.at("at"), kLength);
  if (const Node* turned = table.find("turned"))
    hold.axes = rotation_matrix(read_vector(*turned, kAngle));
  return hold;
}

std::vector<MeshFile> read_contact_meshes(const Node& node, const std::filesystem::path& folder) {
  std::vector<MeshFile> meshes;
  for (const Node& element : read_list(node, "a list of meshes such as [{ file = \"fossa.vtp\" }]"))
    meshes.push_back(read_mesh(element, folder, true));
  return meshes;
}

/// What is held starts at rest.
void check_held_velocity(const TableReader& table, const Body& body) {
  if (!body.hold) return;
  const auto check = [&](const char* key, const Vec3& velocity, std::size_t first) {
    for (std::size_t i = 0; i < 3; ++i)
      if (body.hold->held[first + i] &&
          std::abs(body.hold->axes.col(static_cast<Eigen::Index>(i)).dot(velocity)) >
              1e-12 * velocity.norm())
        fail(table.at(key), "moves along a freedom that `hold` holds");
  };
  check("velocity", body.velocity, 0);
  check("angular_velocity", body.angular_velocity, 3);
}

/// Which keys go with a kind of body, and which it needs.
void check_kind(const TableReader& table, const Body& body) {
  switch (body.kind) {
    case Body::Kind::Fixed:
      table.refuse({"material"}, "only tissue has a material");
      table.refuse({"hold"}, "a fixed body is held as a whole");
      table.refuse({"mass", "density", "center_of_mass", "inertia"}, "a fixed body has no inertia");
      table.refuse({"velocity", "angular_velocity"},
                   "a fixed body has no velocity; a [[load]] of kind \"motion\" moves it");
      if (!has_surface(body)) table.refuse({"layer"}, "the body has no mesh");
      break;
    case Body::Kind::Rigid:
      table.refuse({"material"}, "only tissue has a material");
      table.exactly_one({"mesh", "geometry"});
      table.exactly_one({"mass", "density"});
      check_held_velocity(table, body);
      break;
    case Body::Kind::Tissue:
      table.refuse({"mass", "center_of_mass", "inertia"}, "tissue has a density instead");
      table.refuse({"contact_meshes", "layer"}, "tissue touches with its own surface");
      table.refuse({"angular_velocity"}, "only a rigid body has an angular velocity");
      table.refuse({"hold"},
                   "only a rigid body has freedoms to hold; tissue is attached, or held by a "
                   "[[support]]");
      table.exactly_one({"mesh", "geometry"});
      table.at("density");
      table.at("material");
      break;
  }
}

Body read_body(const Node& node, const std::filesystem::path& folder) {
  const TableReader table(
      node, label(node, "body"),
      {"name", "kind", "mesh", "geometry", "contact_meshes", "layer", "collides", "mass", "density",
       "center_of_mass", "inertia", "velocity", "angular_velocity", "hold", "material"});
  const auto mesh = [&](const Node& n) { return read_mesh(n, folder, false); };
  const auto contact_meshes = [&](const Node& n) { return read_contact_meshes(n, folder); };
  Body body;
  body.where = node.where;
  body.name = read_name(table.at("name"));
  body.kind = read_choice<Body::Kind>(
      table.at("kind"),
      {{"fixed", Body::Kind::Fixed}, {"rigid", Body::Kind::Rigid}, {"tissue", Body::Kind::Tissue}});
  table.at_most_one({"mesh", "geometry"});
  table.may("mesh", body.geometry, mesh);
  if (const Node* geometry = table.find("geometry")) read_geometry(*geometry, body);
  table.may("contact_meshes", body.contact_meshes, contact_meshes);
  table.may("layer", body.layer, read_layer);
  table.may("collides", body.collides, read_boolean);
  table.may("mass", body.mass, as_quantity(kMass, kPositive));
  table.may("density", body.density, as_quantity(kDensity, kPositive));
  table.may("center_of_mass", body.center_of_mass, as_vector(kLength));
  table.may("inertia", body.inertia, read_inertia);
  table.may("velocity", body.velocity, as_vector(kVelocity));
  table.may("angular_velocity", body.angular_velocity, as_vector(kAngularVelocity));
  table.may("hold", body.hold, read_hold);
  table.may("material", body.material, read_material);
  check_kind(table, body);
  return body;
}

void append_attachments(const Node& node, const Context& context,
                        std::vector<Attachment>& attachments) {
  const TableReader table(node, "[[attach]]", {"body", "to", "region", "mirror"});
  for (const Side side : read_sides(table)) {
    Context here = context;
    here.side = side;
    const Body& body = read_body_reference(table.at("body"), here);
    const Body& rigid = read_body_reference(table.at("to"), here);
    if (body.kind != Body::Kind::Tissue)
      fail(table.at("body"),
           fmt::format("only tissue can be attached, and body `{}` is none", body.name));
    if (rigid.kind == Body::Kind::Tissue)
      fail(table.at("to"),
           fmt::format("expected a fixed or rigid body to attach to, body `{}` is tissue",
                       rigid.name));
    attachments.push_back(
        {body.name, rigid.name, read_region(table.at("region"), here), node.where});
  }
}

}  // namespace

std::string_view freedom_name(std::size_t freedom) { return kFreedoms.at(freedom); }

std::array<bool, 6> read_freedoms(const Node& node) {
  std::array<bool, 6> named{};
  for (const Node& freedom : read_list(node, "a list such as [\"translation.x\"]")) {
    const auto i = read_choice<std::size_t>(freedom, {{kFreedoms[0], 0},
                                                      {kFreedoms[1], 1},
                                                      {kFreedoms[2], 2},
                                                      {kFreedoms[3], 3},
                                                      {kFreedoms[4], 4},
                                                      {kFreedoms[5], 5}});
    named[i] = true;
  }
  return named;
}

std::vector<Body> read_bodies(const TableReader& document, const std::filesystem::path& folder) {
  std::vector<Body> bodies;
  std::unordered_map<std::string, std::size_t> index;
  read_each(entries(document, "body"), [&](const Node& node) {
    Body body = read_body(node, folder);
    const Node& name = *node.find("name");
    const auto [known, is_new] = index.try_emplace(body.name, bodies.size());
    if (!is_new) check_new_name(name, "body", body.name, std::vector{bodies[known->second]});
    // Frames are written as frames/BODY_000000.vtu, and lines_000000.vtp holds muscles and
    // ligaments.
    if (body.name == "lines") fail(name, "a body cannot be called `lines`; results use that name");
    bodies.push_back(std::move(body));
  });
  if (bodies.empty()) throw InputError(document.node().where, "the scenario has no [[body]]");
  return bodies;
}

std::vector<Attachment> read_attachments(const TableReader& document, const Context& context) {
  std::vector<Attachment> attachments;
  read_each(entries(document, "attach"),
            [&](const Node& node) { append_attachments(node, context, attachments); });
  return attachments;
}

}  // namespace articular::sim
