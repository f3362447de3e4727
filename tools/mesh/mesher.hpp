#pragma once

#include <functional>

#include "tools/mesh/mesh_surface.hpp"

namespace articular::tools {

struct MesherSettings {
  double size = 0;             // mean edge of the tetrahedra [m]
  double distance = 0;         // bound of the surface's distance, where one facet stands for it [m]
  double sharp_edges_deg = 0;  // edges where the surface turns by more are kept; 0: none
  bool crossings = false;      // faces may intersect: inside is what a ray leaves an odd number of
                               // times
};

struct TetMesh {
  Positions X;  // [m]
  Tetrahedra tets;
};

/// Thrown when the user asked to stop.
struct MeshingInterrupted {};

/// Fills a shell with tetrahedra: starts `articular-mesher`, which lies beside this program or,
/// where this is installed, in ../libexec/articular, and ends it on an error or interruption.
/// Meshes of the same shell differ in a few tetrahedra of a thousand from one time to the next.
/// @param name         of the file, for messages
/// @param unit         metres per unit of the file, likewise
/// @param interrupted  asked several times a second
/// @throws InputError when faces intersect (with their numbers and the place) or nothing of this
///         size fits in; SystemError when the mesher is missing or ends without a mesh;
///         MeshingInterrupted
TetMesh mesh_shell(const std::string& name, const Shell& shell, double unit,
                   const MesherSettings& settings, const std::function<bool()>& interrupted);

}  // namespace articular::tools
