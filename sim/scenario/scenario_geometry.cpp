// The shapes of bodies: meshes of files and built-in geometries.
#include <numbers>
#include <string>

#include "sim/base/pose.hpp"
#include "sim/scenario/data_path.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

constexpr int kMostCells = 10000;  // along one edge of a built-in geometry
constexpr int kFewestFaces = 20, kMostFaces = 10'000'000;

double read_unit_of_length(const Node& node) {
  try {
    return parse_unit(read_text(node), kLength);
  } catch (const std::invalid_argument& error) {
    fail(node, error.what());
  }
}

const KeyTable& continued_keys() {
  static const KeyTable kTable{
      "continued",
      {{"at", {form::Vector{kLength}}, kRequired, "a point of the plane of the cut"},
       {"direction", {form::Direction{}}, kRequired, "across that plane, outwards"},
       {"length", {form::Quantity{kLength, kPositive}}, kRequired, "how far the surface goes on"},
       {"easing",
        {form::Quantity{kLength, kNotNegative}},
        standard("0 m"),
        "way over which the slope at the cut fades"}}};
  return kTable;
}

Continuation read_continuation(const Node& node) {
  const TableReader table(node, continued_keys(), "continued");
  return {table.get<Vec3>("at"), table.get<Vec3>("direction"), table.get<double>("length"),
          table.get<double>("easing")};
}

std::vector<std::string> read_parts(const Node& node) {
  if (node.text() != nullptr) return {read_text(node)};
  std::vector<std::string> parts;
  for (const Node& part : read_list(node, "a name or a list of names"))
    parts.push_back(read_text(part));
  return parts;
}

/// What meshes and contact meshes have.
MeshFile read_file(const TableReader& table, const std::filesystem::path& folder) {
  MeshFile mesh;
  mesh.where = table.at("file").where;
  mesh.path = read_path(table.at("file"), folder);
  table.read("unit", mesh.unit, read_unit_of_length);
  table.read("part", mesh.parts, read_parts);
  table.read("place", mesh.placement, read_placement);
  table.read("made_by", mesh.made_by);
  return mesh;
}

MeshFile read_contact_mesh(const Node& node, const std::filesystem::path& folder) {
  const TableReader table(node, contact_mesh_keys(), "contact mesh");
  MeshFile mesh = read_file(table, folder);
  table.read("facing", mesh.facing);
  table.read("box", mesh.box, read_corners);
  table.read("faces", mesh.faces);
  table.read("continued", mesh.continued, read_continuation);
  return mesh;
}

form::List numbers_of_cells(std::size_t count) {
  return list_of({form::Integer{1, kMostCells}}, count);
}

template <int N>
Eigen::Matrix<int, N, 1> read_cells(const Node& node) {
  const Node::List& list = read_list(node, fmt::format("{} numbers of cells", N), N);
  Eigen::Matrix<int, N, 1> cells;
  for (int i = 0; i < N; ++i)
    cells[i] = read_integer(list[static_cast<std::size_t>(i)], 1, kMostCells);
  return cells;
}

const KeyTable& box_keys() {
  static const KeyTable kTable{
      "box",
      {{"size", {form::Vector{kLength}}, kRequired, "its three edges"},
       {"cells", {numbers_of_cells(3)}, kRequired, "along them; six tetrahedra each"},
       {"center", {form::Vector{kLength}}, standard("0 0 0 m"), "its centre"}}};
  return kTable;
}

BoxGeometry read_box(const Node& node) {
  const TableReader table(node, box_keys(), "box");
  BoxGeometry box;
  box.size = table.get<Vec3>("size");
  if (!(box.size.minCoeff() > 0))
    fail(table.at("size"), "the three edges must be positive, found " + found(table.at("size")));
  box.cells = read_cells<3>(table.at("cells"));
  table.read("center", box.center);
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

const KeyTable& hexahedron_keys() {
  static const KeyTable kTable{
      "hexahedron",
      {{"corners",
        {list_of({form::Vector{kLength}}, 8)},
        kRequired,
        "of the lower face counterclockwise from above, then of the upper face"},
       {"cells", {numbers_of_cells(3)}, kRequired, "along its edges; six tetrahedra each"}}};
  return kTable;
}

HexahedronGeometry read_hexahedron(const Node& node) {
  constexpr double kFlat = 1e-6;
  const TableReader table(node, hexahedron_keys(), "hexahedron");
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

const KeyTable& sphere_keys() {
  static const KeyTable kTable{
      "sphere",
      {{"radius", {form::Quantity{kLength, kPositive}}, kRequired, "its radius"},
       {"element_size",
        {form::Quantity{kLength, kPositive}},
        kRequired,
        "edge of the tetrahedra; at most the radius"},
       {"center", {form::Vector{kLength}}, standard("0 0 0 m"), "its centre"}}};
  return kTable;
}

SphereGeometry read_sphere(const Node& node) {
  const TableReader table(node, sphere_keys(), "sphere");
  SphereGeometry sphere;
  table.read("radius", sphere.radius);
  table.read("element_size", sphere.element_size);
  if (sphere.element_size > sphere.radius)
    fail(table.at("element_size"),
         "must not exceed the radius, found " + found(table.at("element_size")));
  table.read("center", sphere.center);
  return sphere;
}

const KeyTable& v_shape_keys() {
  static constexpr Range kOpening{0, std::numbers::pi, true, "must lie between 0 and 180 deg"};
  static const KeyTable kTable{
      "v_shape",
      {{"leg_length", {form::Quantity{kLength, kPositive}}, kRequired, "of a leg, from the tip"},
       {"width", {form::Quantity{kLength, kPositive}}, kRequired, "side of the square section"},
       {"angle", {form::Quantity{kAngle, kOpening}}, kRequired, "between the legs"},
       {"cells", {numbers_of_cells(2)}, kRequired, "along a leg and across it"}}};
  return kTable;
}

VShapeGeometry read_v_shape(const Node& node) {
  const TableReader table(node, v_shape_keys(), "v_shape");
  VShapeGeometry shape;
  table.read("leg_length", shape.leg_length);
  table.read("width", shape.width);
  table.read("angle", shape.angle);
  shape.cells = read_cells<2>(table.at("cells"));
  return shape;
}

}  // namespace

const KeyTable& mesh_keys() {
  static const KeyTable kTable{
      "mesh",
      {{"file",
        {form::Text{"path"}},
        kRequired,
        "from the scenario's folder; `${NAME}` is an environment variable"},
       {"unit", {form::Text{"length unit"}}, standard("mm"), "length unit of the file"},
       {"part",
        {form::Either{{{form::Text{"name of a set"}}, {list_of({form::Text{"name of a set"}})}}}},
        otherwise("all"),
        "only the elements of this set of the file, or of a list of sets"},
       {"place", {form::Table{place_keys}}, kNone, "moves it"},
       {"made_by",
        {form::Text{"command"}},
        kNone,
        "command that makes the file; shown if it is missing. `articular anatomy` or `mesh` with "
        "`--size`: `run --error-bars` makes it coarser"}}};
  return kTable;
}

const KeyTable& contact_mesh_keys() {
  static const KeyTable kTable = [] {
    KeyTable table{"contact mesh", mesh_keys().keys};
    table.keys.push_back(
        {"facing", {form::Direction{}}, kNone, "keeps faces within 80 degrees of this direction"});
    table.keys.push_back({"box",
                          {list_of({form::Vector{kLength}}, 2)},
                          kNone,
                          "keeps faces whose middles lie in this box, lower corner first"});
    table.keys.push_back({"faces",
                          {form::Integer{kFewestFaces, kMostFaces}},
                          otherwise("all"),
                          "simplifies to about this many triangles"});
    table.keys.push_back(
        {"continued", {form::Table{continued_keys}}, kNone, "extends a sheet that was cut"});
    return table;
  }();
  return kTable;
}

const KeyTable& geometry_keys() {
  static const KeyTable kTable{
      "geometry",
      {{"box", {form::Table{box_keys}}, kNone, "a block along the axes; or one of the next"},
       {"hexahedron", {form::Table{hexahedron_keys}}, kNone, "a block with any eight corners"},
       {"sphere", {form::Table{sphere_keys}}, kNone, "a ball"},
       {"v_shape", {form::Table{v_shape_keys}}, kNone, "two legs that meet at the origin"},
       {"place", {form::Table{place_keys}}, kNone, "moves it"}}};
  return kTable;
}

MeshFile read_mesh_file(const Node& node, const std::filesystem::path& folder) {
  return read_file(TableReader(node, mesh_keys(), "mesh"), folder);
}

void read_geometry(const Node& node, Body& body) {
  const TableReader table(node, geometry_keys(), "geometry");
  table.exactly_one({"box", "hexahedron", "sphere", "v_shape"});
  table.read("box", body.geometry, read_box);
  table.read("hexahedron", body.geometry, read_hexahedron);
  table.read("sphere", body.geometry, read_sphere);
  table.read("v_shape", body.geometry, read_v_shape);
  table.read("place", body.placement, read_placement);
}

std::vector<MeshFile> read_contact_meshes(const Node& node, const std::filesystem::path& folder) {
  std::vector<MeshFile> meshes;
  for (const Node& element : read_list(node, "a list of meshes such as [{ file = \"fossa.vtp\" }]"))
    meshes.push_back(read_contact_mesh(element, folder));
  return meshes;
}

}  // namespace articular::sim
