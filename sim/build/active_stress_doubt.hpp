#pragma once

#include <optional>
#include <string>

#include "sim/model/model.hpp"
#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// Smoothed elements have fibre tension on the domains of edges and pressure at nodes. Where the
/// tension is much larger than the shear modulus, what both do to small waves of the mesh does not
/// cancel: tissue folds into a checkerboard and pulls with too little force.
/// @return what to say of it; none where the muscle's largest active stress at the start is small
///         enough, or the elements are plain
std::optional<std::string> active_stress_doubt(const Tissue& tissue, const std::string& body,
                                               const Muscle& muscle);

}  // namespace articular::sim
