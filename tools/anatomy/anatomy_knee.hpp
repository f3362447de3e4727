#pragma once

#include "tools/anatomy/anatomy_knee_tissue.hpp"
#include "tools/anatomy/anatomy_tables.hpp"

namespace articular::anatomy {

/// A right knee in extension: bones, cartilage of both condyles and plateaus, menisci, and the
/// points that scenarios refer to. Nothing overlaps.
/// @throws std::invalid_argument see check_resolution
Anatomy knee_anatomy(const KneeResolution& resolution);

}  // namespace articular::anatomy
