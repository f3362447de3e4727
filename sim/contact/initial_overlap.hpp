#pragma once

#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Two bodies that may touch, and overlap before anything has moved.
struct InitialOverlap {
  ContactId contact = 0;
  int a = 0, b = 0;           // bodies
  double depth = 0;           // [m] of the deepest node of one below the surface of the other
  Vec3 place = Vec3::Zero();  // that node [m]
  int num_nodes = 0;          // of both that lie in the other
};

/// Of every contact pair of two bodies. Nodes that are tied to the other body don't count; of a
/// rigid body that is known by its surface alone, depths end at its shell.
std::vector<InitialOverlap> initial_overlaps(const Model& model);

}  // namespace articular::sim
