#include <fstream>

#include "sim/base/error.hpp"
#include "sim/mesh/mesh_readers.hpp"

namespace articular::sim {
namespace {

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> parts;
  for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
    const std::size_t length = std::min(line.find_first_of(" \t"), line.size());
    parts.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
  return parts;
}

/// A word for a message. Before its first vertex a file may be anything, and nothing of it is
/// shown.
std::string found(std::string_view word, const std::vector<double>& coordinates) {
  return coordinates.size() < 3 ? "a word" : "`" + one_line(word) + "`";
}

/// The vertex of a corner `7`, `7/1`, `7//3` or `-1` (the last vertex so far), counted from 0.
int corner(std::string_view text, const std::vector<double>& coordinates, const Location& where) {
  const int num_vertices = static_cast<int>(coordinates.size() / 3);
  const std::optional<int> number = parse_integer(text.substr(0, text.find('/')));
  if (!number) throw InputError(where, found(text, coordinates) + " is not a corner of a face");
  const int index = *number > 0 ? *number - 1 : num_vertices + *number;
  if (*number == 0 || index < 0)
    throw InputError(where, "unknown vertex " + std::to_string(*number));
  return index;
}

}  // namespace

MeshData read_obj(const std::filesystem::path& file) {
  std::ifstream in(file);
  Location where{file.string()};
  std::vector<double> coordinates;
  std::vector<int> corners;
  int last_vertex = -1;      // the largest vertex named by a face,
  int last_vertex_line = 0;  // which may stand before its vertices
  for (std::string line; std::getline(in, line);) {
    ++where.line;
    const std::vector<std::string_view> parts = words(line);
    if (parts.empty()) continue;
    if (parts[0] == "v") {
      if (parts.size() < 4) throw InputError(where, "a vertex needs 3 coordinates");
      for (std::size_t i = 1; i < 4; ++i) {
        const std::optional<double> value = parse_number(parts[i]);
        if (!value)
          throw InputError(where, found(parts[i], coordinates) + " is not a finite number");
        coordinates.push_back(*value);
      }
    } else if (parts[0] == "f") {
      if (parts.size() < 4) throw InputError(where, "a face needs 3 corners or more");
      std::vector<int> polygon;
      for (std::size_t i = 1; i < parts.size(); ++i) {
        polygon.push_back(corner(parts[i], coordinates, where));
        if (polygon.back() > last_vertex) {
          last_vertex = polygon.back();
          last_vertex_line = where.line;
        }
      }
      for (std::size_t i = 2; i < polygon.size(); ++i)
        corners.insert(corners.end(), {polygon[0], polygon[i - 1], polygon[i]});
    }
  }
  MeshData mesh;
  mesh.X = Eigen::Map<const Positions>(coordinates.data(), 3,
                                       static_cast<Eigen::Index>(coordinates.size() / 3));
  if (last_vertex >= mesh.X.cols())
    throw InputError({where.file, last_vertex_line},
                     "unknown vertex " + std::to_string(last_vertex + 1));
  mesh.triangles =
      Eigen::Map<const Triangles>(corners.data(), 3, static_cast<Eigen::Index>(corners.size() / 3));
  return mesh;
}

}  // namespace articular::sim
