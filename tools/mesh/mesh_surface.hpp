#pragma once

#include <string>
#include <vector>

#include "sim/mesh/mesh_io.hpp"

namespace articular::tools {

/// A connected closed surface, its triangles outward.
struct Shell {
  Positions X;
  Triangles triangles;
  /// Triangles of the file that these are, from 0.
  std::vector<int> face_numbers;
  double volume = 0;  // [m³], > 0
};

/// A connected part of a surface that encloses less than an element.
struct StrayShell {
  int faces = 0;
  int first_face = 0;  // in the file, from 0
};

struct Shells {
  std::vector<Shell> shells;  // in the order of their first triangles in the file
  std::vector<StrayShell> stray;
};

/// Volume of a regular tetrahedron: a shell that holds less is stray.
double element_volume(double edge);

/// The closed surfaces of a file. Points at the same place are one point (formats without shared
/// corners), triangles without area between its corners are left out. Triangles are turned so that
/// all of a shell look outward.
/// @param name  of the file, for messages
/// @param unit  metres per unit of the file, for places in messages
/// @param size  edge of the elements [m]
/// @throws InputError naming points and faces (counted from 1, in the file's order) where a surface
///         is open, more than two faces share an edge, surfaces touch in a point, a surface has one
///         side only, or a shell lies inside another; when there is no shell
Shells closed_shells(const std::string& name, const sim::MeshData& mesh, double unit, double size);

}  // namespace articular::tools
