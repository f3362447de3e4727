#pragma once

#include <string>
#include <vector>

#include "sim/mesh/numbered_mesh.hpp"
#include "sim/mesh/xml_tree.hpp"

namespace articular::sim {

/// The mesh in a FEBio model of version 2.5 (in <Geometry>), 3.0 or 4.0 (in <Mesh>).
/// @param file   for messages
/// @param model  its element <febio_spec>
/// @throws InputError with the line for what is no such mesh, or names another file
MeshData febio_mesh(const std::string& file, const XmlElement& model);

/// The set of the elements in the section <Elements> that is this one in the file (from 1): its
/// name, or "part 2".
std::string febio_part_name(const XmlElement& elements, int number);

/// The numbers of a list such as "1, 2, 3" or "1:3" (also "1:9:2"), which may be empty.
/// @throws InputError for anything else, and for more numbers than `most`
std::vector<std::int64_t> febio_numbers(const Location& where, std::string_view text,
                                        std::size_t most);

/// The three numbers of "1.0, 2.0, 3.0". @throws InputError
Eigen::Vector3d febio_vector(const Location& where, std::string_view text);

}  // namespace articular::sim
