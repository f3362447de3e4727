#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace articular::tools {

struct CollideOptions {
  std::vector<std::string> meshes;             // one or two: files, patterns, .pvd
  bool self = false;                           // of two bodies, each with itself as well
  std::optional<std::string> narrow;           // sat or gjk
  std::string method = "blocks";               // or article
  std::optional<std::filesystem::path> pairs;  // table to write
  int repeat = 1, threads = 1;
  std::string margin = "0";  // [unit of the meshes]
  bool json = false;
  /// Asked after every frame that is read or searched; true to stop. May be empty.
  std::function<bool()> interrupted;
};

/// Finds surface triangles that meet tetrahedra, prints figures to stdout and writes the pairs.
/// @return 0, or 130 when interrupted: nothing is printed or written then
/// @throws sim::InputError for wrong options or meshes, sim::SystemError when a result can't be
///         written
int collide(const CollideOptions& options);

}  // namespace articular::tools
