#pragma once

#include <vector>

#include "sim/model.hpp"

namespace articular::sim {

/// Numbers the smooth sheets of a surface around its nodes: around each, the faces that come one
/// after the other without a crease. Contact averages depths over a sheet (contact_response.hpp):
/// over all around an edge, a wall just in front of one of its sides would lift the other from what
/// it rests on.
/// @param crease  faces are one sheet where the cosine between their normals is above this
/// @param[out] sheets  one a corner of a face; a node's first has the node's number, the others
///                     come after all nodes
/// @return the node of each
std::vector<int> number_sheets(const Positions& X, const Eigen::Matrix3Xi& faces, double crease,
                               Eigen::Matrix3Xi& sheets);

/// Of each face, bit k: its sheet ends at the edge opposite corner k.
std::vector<unsigned> rims_of_sheets(const Positions& X, const Eigen::Matrix3Xi& faces,
                                     double crease);

/// Of each face, by corner: its height over the edge opposite, where that is a rim and the body is
/// convex there [m]; else 0.
Positions heights_over_convex_rims(const Positions& X, const Eigen::Matrix3Xi& faces,
                                   double crease);

}  // namespace articular::sim
