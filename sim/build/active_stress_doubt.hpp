#pragma once

#include <optional>
#include <string>

#include "sim/model/model.hpp"
#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// Smoothed elements have distortion on the domains of edges and pressure at nodes. A tension T of
/// fibres that don't feel the volume (see fem::FibreLaw) is balanced there by a pressure of T/3,
/// but not wave by wave. Where T is some times the shear modulus, tissue folds into a checkerboard
/// and pulls with too little force.
/// @return what to say of it; none where the largest active stress at the start is small enough,
///         fibres feel the volume, or elements are plain
std::optional<std::string> active_stress_doubt(const Tissue& tissue, const std::string& body,
                                               const Muscle& muscle);

}  // namespace articular::sim
