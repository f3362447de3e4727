#pragma once

#include <limits>
#include <vector>

#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// Memory that a scene takes at least, estimated from its numbers of tetrahedra. [bytes]
struct MemoryNeed {
  double model = 0;     // meshes and what is computed of them once
  double matrices = 0;  // forces and Newton's matrix, where the scheme has one; no factors

  double total() const { return model + matrices; }
};

/// @param num_tets  by body
MemoryNeed memory_need(const Scenario& scenario, const std::vector<double>& num_tets);

/// Of a built-in shape, known before it is made; 0 for what is read from a file.
double num_shape_tetrahedra(const Body& body);

/// @param available  [bytes]
/// @throws InputError when the scene needs more, or indices of a mesh would not be integers
void refuse_more_memory(const Scenario& scenario, const std::vector<double>& num_tets,
                        double available);

}  // namespace articular::sim
