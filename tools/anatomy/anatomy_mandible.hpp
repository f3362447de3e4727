#pragma once

#include "tools/anatomy/anatomy_joint.hpp"
#include "tools/anatomy/anatomy_tables.hpp"
#include "tools/anatomy/anatomy_teeth.hpp"

/// The jaw as the scenarios read it: meshes by file name, muscle attachments and landmarks. mm.
namespace articular::anatomy {

/// @param disc_edge  element size of the discs
/// @param slope_deg  of the eminence's posterior face
/// @param guidance_deg  of the inner faces of the upper incisors
/// @throws std::invalid_argument for disc_edge outside [0.3, 2.5] mm; see fossa_profile(),
///         upper_guiding_teeth()
Anatomy mandible_anatomy(double disc_edge, double slope_deg = kSlopeDeg,
                         double guidance_deg = kGuidanceDeg);

/// Adds the muscles of both sides that are tissue, and the parts of the bones that they touch.
/// @param element_size  of the muscles
/// @throws std::invalid_argument for element_size outside [3, 6] mm
void add_muscle_bodies(double element_size, Anatomy& anatomy);

/// Left and right muscles, attached to the surfaces of mandible_anatomy.
std::vector<MuscleRow> mandible_muscles();

}  // namespace articular::anatomy
