#pragma once

#include "tools/anatomy/anatomy_knee_tissue.hpp"
#include "tools/anatomy/anatomy_tables.hpp"

namespace articular::anatomy {

/// How a knee differs from the usual one.
struct KneeShape {
  double scale = 1;      // of everything but the thickness of cartilage
  double cartilage = 1;  // factor of the mean thickness of each cartilage
  bool patella =
      false;  // adds the patella, the trochlea, their cartilage, and a femur with a groove
  bool ligaments = false;  // adds ACL and superficial MCL as tissue, and the bone that they touch;
                           // with patella its tendon
};

/// A right knee in extension: bones, cartilage of both condyles and plateaus, menisci, and the
/// points that scenarios refer to. Nothing overlaps. A larger knee has larger elements, not more.
/// @throws std::invalid_argument see check_resolution, scale; for `cartilage` outside [0.6, 1.5]
Anatomy knee_anatomy(const KneeResolution& resolution, const KneeShape& shape = {});

}  // namespace articular::anatomy
