#pragma once

#include <span>
#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Numbers the smoothing groups of a surface around its nodes: around each, the faces that come one
/// after the other without a crease. Contact averages depths over a group (contact_response.hpp):
/// over all around an edge, a wall just in front of one of its sides would lift the other from what
/// it rests on.
/// @param crease  faces are one group where the cosine between their normals is above this
/// @param[out] groups  one a corner of a face; a node's first has the node's number, the others
///                     come after all nodes
/// @return the node of each
std::vector<int> number_smoothing_groups(const Positions& X, const Eigen::Matrix3Xi& faces,
                                         double crease, Eigen::Matrix3Xi& groups);

/// A third of each face around it [m²], by group.
Eigen::VectorXd areas_of_smoothing_groups(const Eigen::Matrix3Xi& groups, Eigen::Index num_groups,
                                          std::span<const double> face_area);

/// Of each face, bit k: its group ends at the edge opposite corner k.
std::vector<unsigned> rims_of_smoothing_groups(const Positions& X, const Eigen::Matrix3Xi& faces,
                                               double crease);

/// Of each face, by corner: the face of the same group across the edge opposite; -1 at a rim.
Eigen::Matrix3Xi faces_across_edges(const Positions& X, const Eigen::Matrix3Xi& faces,
                                    double crease);

/// Of each face, by corner: its height over the edge opposite, where that is a rim and the body is
/// convex there [m]; else 0.
Positions heights_over_convex_rims(const Positions& X, const Eigen::Matrix3Xi& faces,
                                   double crease);

}  // namespace articular::sim
