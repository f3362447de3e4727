#pragma once

#include "tools/mesh/mesher.hpp"

namespace articular::tools {

/// What a mesh of a shell is like.
struct MeshQuality {
  double mean_edge = 0;  // [m]
  double least_dihedral_deg = 0;
  double median_dihedral_deg = 0;      // of the least one of each tetrahedron
  Eigen::Index tets_below_10_deg = 0;  // by their least dihedral angle
  Eigen::Index inner_nodes = 0;        // not on the surface
  int parts = 0;                       // of tetrahedra joined by faces
  double volume = 0;                   // [m³]
  double largest_distance = 0;         // [m] from nodes and face centres of the mesh's surface to
                                       // the shell and from the shell's points to the former
};

/// Least angle between two faces of a tetrahedron [deg]: 71 of a regular one.
double least_dihedral_deg(const Positions& X, const Eigen::Ref<const Eigen::Vector4i>& tet);

MeshQuality mesh_quality(const TetMesh& mesh, const Shell& shell);

}  // namespace articular::tools
