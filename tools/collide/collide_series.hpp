#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "collision/mesh/surface.hpp"
#include "fem/base/types.hpp"

/// The meshes that `articular collide` looks at.
namespace articular::tools {

/// One body: a mesh, or frames of a mesh with the same connectivity.
struct MeshSeries {
  std::string name;  // as the user gave it
  Tetrahedra tets;
  collision::Surface surface;
  std::vector<std::filesystem::path> files;  // one a frame
  std::vector<Positions> frames;             // [unit of the files]

  bool moves() const { return frames.size() > 1; }
  /// A mesh that stands still is the same in every frame.
  const Positions& frame(std::size_t i) const { return moves() ? frames[i] : frames[0]; }
  const std::filesystem::path& file(std::size_t i) const { return moves() ? files[i] : files[0]; }
};

/// The files behind an argument, one a frame: the file itself; in order of names, all that match a
/// pattern with * ? [ ]; or, in order of time, those of a .pvd, of the body that `FILE.pvd:BODY`
/// names if there are several.
/// @throws sim::InputError when there is none, or a .pvd is not understood
std::vector<std::filesystem::path> series_files(const std::string& argument);

/// @param after_frame  called with the number of frames read and that of all frames
/// @throws sim::InputError naming the file that can't be read, has no tetrahedra, or other ones
/// than
///         the first
MeshSeries read_mesh_series(const std::string& argument,
                            const std::function<void(std::size_t, std::size_t)>& after_frame);

}  // namespace articular::tools
