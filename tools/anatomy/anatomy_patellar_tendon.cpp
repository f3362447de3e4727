#include "tools/anatomy/anatomy_patellar_tendon.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "tools/anatomy/anatomy_knee_bones.hpp"
#include "tools/anatomy/anatomy_patella.hpp"

namespace articular::anatomy {

// Width and thickness: scenarios/SOURCES.md. Between the bones it runs straight, seen from the
// side.
FibreBody patellar_tendon() {
  return {.name = "patellar_tendon",
          .rows = {{{-12, -50.5, 30}, {0, -55.5, 30}, {12, -50.5, 30}, 2.0},
                   {{-12, -47.5, 22}, {0, -51.5, 22}, {12, -47.5, 22}, 2.2},
                   {{-12.1, -44.5, 10}, {0.2, -45.8, 10}, {12.5, -44.5, 10}, 2.3},
                   {{-11.6, -36.9, -8}, {0.5, -37.5, -8}, {12.6, -36.9, -8}, 2.3},
                   {{-10.4, -29.5, -23}, {0.8, -30.6, -23}, {12, -29.5, -23}, 2.3},
                   {{-9.5, -25.8, -33}, {1, -27.6, -33}, {11.5, -25.8, -33}, 2.2},
                   {{-9, -24.4, -44}, {1, -26.4, -44}, {11, -24.4, -44}, 2.0}},
          .origin = {"patella", 0.13},
          .insertion = {"tibia", 0.2},
          .seated = 0.3,
          .clear = 0.8};
}

Mesh patellar_tendon_mesh(const Compartment& medial, const Compartment& lateral,
                          double patellar_thickness, double h) {
  if (!(h >= 1.5 && h <= 4))
    throw std::invalid_argument(
        fmt::format("--size with --ligaments: {} mm: expected 1.5 to 4 mm", h));
  const Bones bones = {{"patella", patella_distance(patellar_thickness)},
                       {"tibia", tibia_distance(medial, lateral)}};
  return fibre_body_mesh(patellar_tendon(), bones, h);
}

}  // namespace articular::anatomy
