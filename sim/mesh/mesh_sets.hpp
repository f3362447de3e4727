#pragma once

#include <string>
#include <vector>

#include "sim/mesh/mesh_io.hpp"

/// What named sets of a mesh are used for.
namespace articular::sim {

/// nullptr: there is none of this name.
const MeshSet* find_set(const MeshData& mesh, const std::string& name);

/// "; it has `top`, `bottom`" or "; it has none at all: ...", to end a message of a missing set.
std::string known_sets(const MeshData& mesh);

/// An array of the nodes that holds zeros and ones alone: those with 1 are a set. Others are none.
void add_set_of_points(const std::string& name, const std::vector<double>& values, MeshData& mesh);

/// Leaves the elements of these sets alone: tetrahedra, or where they have none, faces. Nodes stay.
/// @throws std::invalid_argument if there is no such set, or it has neither
void keep_parts(MeshData& mesh, const std::vector<std::string>& parts);

/// Renumbers the nodes of sets: node a becomes new_index[a]; those of < 0 are gone.
void renumber_sets(MeshData& mesh, const std::vector<int>& new_index);

}  // namespace articular::sim
