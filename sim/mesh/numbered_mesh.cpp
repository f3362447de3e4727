#include "sim/mesh/numbered_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/base/message_text.hpp"

namespace articular::sim {

void NumberedMesh::add_node(std::int64_t number, const Eigen::Vector3d& x, int line) {
  if (!index_.emplace(number, static_cast<int>(index_.size())).second)
    throw InputError({file_, line}, fmt::format("node {} is there twice", number));
  coordinates_.insert(coordinates_.end(), {x.x(), x.y(), x.z()});
}

std::size_t NumberedMesh::add_cell(CellShape shape, std::span<const std::int64_t> nodes, int line) {
  cells_.push_back({shape, line, cell_nodes_.size()});
  cell_nodes_.insert(cell_nodes_.end(), nodes.begin(), nodes.end());
  return cells_.size() - 1;
}

void NumberedMesh::add_cell_to_set(std::string_view set, std::size_t cell) {
  set_called(set).cells.push_back(cell);
}

void NumberedMesh::add_node_to_set(std::string_view set, std::int64_t number, int line) {
  set_called(set).nodes.emplace_back(number, line);
}

void NumberedMesh::set_cell_vector(const std::string& name, std::size_t cell,
                                   const Eigen::Vector3d& vector) {
  auto found = std::find_if(cell_vectors_.begin(), cell_vectors_.end(),
                            [&](const auto& field) { return field.first == name; });
  if (found == cell_vectors_.end()) found = cell_vectors_.insert(found, {name, {}});
  found->second.emplace_back(cell, vector);
}

MeshData NumberedMesh::mesh() const {
  MeshData mesh;
  mesh.X = Eigen::Map<const Positions>(coordinates_.data(), 3,
                                       static_cast<Eigen::Index>(coordinates_.size() / 3));
  std::vector<int> tets, triangles, first_tet;
  for (const Cell& cell : cells_) {
    first_tet.push_back(static_cast<int>(tets.size() / 4));
    const std::vector<int> nodes = nodes_of(cell);
    if (is_solid(cell.shape))
      for (const auto& tet : tetrahedra_of(cell.shape, nodes))
        tets.insert(tets.end(), tet.begin(), tet.end());
    else if (nodes.size() > 2)
      for (const auto& triangle : triangles_of(nodes))
        triangles.insert(triangles.end(), triangle.begin(), triangle.end());
  }
  first_tet.push_back(static_cast<int>(tets.size() / 4));
  if (!tets.empty()) triangles.clear();
  mesh.tets =
      Eigen::Map<const Tetrahedra>(tets.data(), 4, static_cast<Eigen::Index>(tets.size() / 4));
  mesh.triangles = Eigen::Map<const Triangles>(triangles.data(), 3,
                                               static_cast<Eigen::Index>(triangles.size() / 3));
  for (const Set& set : sets_) mesh.sets.push_back(mesh_set(set, first_tet));
  for (const auto& [name, values] : cell_vectors_) {
    Eigen::Matrix3Xd field = Eigen::Matrix3Xd::Zero(3, mesh.tets.cols());
    for (const auto& [cell, vector] : values)
      for (int t = first_tet[cell]; t < first_tet[cell + 1]; ++t) field.col(t) = vector;
    mesh.cell_vectors.emplace_back(name, std::move(field));
  }
  return mesh;
}

NumberedMesh::Set& NumberedMesh::set_called(std::string_view name) {
  const auto [place, is_new] = set_place_.emplace(std::string(name), sets_.size());
  if (is_new) sets_.push_back({std::string(name), {}, {}});
  return sets_[place->second];
}

int NumberedMesh::index_of(std::int64_t number, int line) const {
  const auto node = index_.find(number);
  if (node == index_.end()) throw InputError({file_, line}, fmt::format("unknown node {}", number));
  return node->second;
}

std::vector<int> NumberedMesh::nodes_of(const Cell& cell) const {
  std::vector<int> nodes;
  const auto first = cell_nodes_.begin() + static_cast<std::ptrdiff_t>(cell.first);
  for (auto number = first; number != first + num_corners(cell.shape); ++number)
    nodes.push_back(index_of(*number, cell.line));
  return nodes;
}

MeshSet NumberedMesh::mesh_set(const Set& set, const std::vector<int>& first_tet) const {
  MeshSet made{set.name, {}, {}, {}};
  for (const auto& [number, line] : set.nodes) made.nodes.push_back(index_of(number, line));
  std::vector<int> of_faces, of_others;
  for (const std::size_t c : set.cells) {
    const Cell& cell = cells_[c];
    const std::vector<int> nodes = nodes_of(cell);
    const bool is_face =
        cell.shape == CellShape::Triangle || cell.shape == CellShape::Quadrilateral;
    std::vector<int>& kept = is_face ? of_faces : of_others;
    kept.insert(kept.end(), nodes.begin(), nodes.end());
    if (is_face)
      for (const auto& triangle : triangles_of(nodes)) made.faces.push_back(triangle);
    for (int t = first_tet[c]; t < first_tet[c + 1]; ++t) made.tets.push_back(t);
  }
  if (made.nodes.empty()) made.nodes = of_faces.empty() ? of_others : of_faces;
  std::sort(made.nodes.begin(), made.nodes.end());
  made.nodes.erase(std::unique(made.nodes.begin(), made.nodes.end()), made.nodes.end());
  return made;
}

void refuse_second_order(const Location& where, std::string_view kind) {
  throw InputError(where, fmt::format("elements of kind `{}` have nodes between their corners; "
                                      "expected elements of first order (tetrahedra of 4 nodes, "
                                      "pyramids, wedges or hexahedra): write the mesh so",
                                      one_line(kind)));
}

}  // namespace articular::sim
