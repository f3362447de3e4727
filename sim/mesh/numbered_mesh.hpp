#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/base/error.hpp"
#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/solid_cells.hpp"

namespace articular::sim {

/// A mesh as files name it: nodes by numbers that may have gaps, cells of any shape in any order,
/// before or after their nodes, and named sets of both. mesh() makes indices of the numbers,
/// tetrahedra of the solids and MeshSets of the sets.
class NumberedMesh {
 public:
  /// @param file  for messages
  explicit NumberedMesh(std::string file) : file_(std::move(file)) {}

  /// @throws InputError if the number was there before
  void add_node(std::int64_t number, const Eigen::Vector3d& x, int line);

  /// @param nodes  numbers, as many as the shape has corners
  /// @return its place, for add_cell_to_set()
  std::size_t add_cell(CellShape shape, std::span<const std::int64_t> nodes, int line);

  void add_cell_to_set(std::string_view set, std::size_t cell);
  void add_node_to_set(std::string_view set, std::int64_t number, int line);

  /// Of a cell whose tetrahedra have it in MeshData::cell_vectors; of others it is 0.
  void set_cell_vector(const std::string& name, std::size_t cell, const Eigen::Vector3d& vector);

  /// Triangles are those of the file where it has no solids; else they are in sets alone.
  /// @throws InputError with the line for a node that is not there
  MeshData mesh() const;

  std::size_t num_nodes() const { return index_.size(); }

 private:
  struct Cell {
    CellShape shape;
    int line;
    std::size_t first;  // of its nodes
  };
  struct Set {
    std::string name;
    std::vector<std::pair<std::int64_t, int>> nodes;  // number, line
    std::vector<std::size_t> cells;
  };

  Set& set_called(std::string_view name);
  int index_of(std::int64_t number, int line) const;
  std::vector<int> nodes_of(const Cell& cell) const;
  MeshSet mesh_set(const Set& set, const std::vector<int>& first_tet) const;

  std::string file_;
  std::unordered_map<std::int64_t, int> index_;  // of a node by its number
  std::vector<double> coordinates_;              // x0 y0 z0 x1 ...
  std::vector<Cell> cells_;
  std::vector<std::int64_t> cell_nodes_;
  std::vector<Set> sets_;
  std::unordered_map<std::string, std::size_t> set_place_;
  std::vector<std::pair<std::string, std::vector<std::pair<std::size_t, Eigen::Vector3d>>>>
      cell_vectors_;
};

/// Names the kind of a cell that only tetrahedra of first order may stand for.
/// @param kind  the file's own word, such as "C3D10"
[[noreturn]] void refuse_second_order(const Location& where, std::string_view kind);

}  // namespace articular::sim
