#include "tools/anatomy/anatomy_ligaments.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "tools/anatomy/anatomy_knee_bones.hpp"

namespace articular::anatomy {

// Widths and thicknesses: scenarios/SOURCES.md. A frictionless band runs straight, seen from the
// side: on bone it may turn only where it presses on it.
FibreBody medial_collateral() {
  return {.name = "mcl",
          .rows = {{{40.6, 1.7, 30.5}, {40.6, 6.7, 30.5}, {40.6, 11.7, 30.5}, 2.1},
                   {{40.4, 0.6, 22}, {40.4, 5.6, 22}, {40.4, 10.6, 22}, 1.8},
                   {{40.8, -1.3, 10}, {40.8, 3.7, 10}, {40.8, 8.7, 10}, 1.2},
                   {{41.5, -3.3, -3}, {41.5, 1.7, -3}, {41.5, 6.7, -3}, 1.15},
                   {{41.4, -4.8, -13}, {41.4, 0.2, -13}, {41.4, 5.2, -13}, 1.15},
                   {{34.2, -7.4, -29}, {34.2, -2.4, -29}, {34.2, 2.6, -29}, 1.15},
                   {{27.2, -9.4, -43}, {27.2, -4.4, -43}, {27.2, 0.6, -43}, 1.15},
                   {{22.2, -10.9, -54}, {22.2, -5.9, -54}, {22.2, -0.9, -54}, 1.15},
                   {{19, -11.8, -65}, {19, -6.8, -65}, {19, -1.8, -65}, 1.15}},
          .origin = {"femur", 0.1},
          .insertion = {"tibia", 0.12},
          .seated = 0.3,
          .clear = 0.8};
}

FibreBody anterior_cruciate() {
  return {.name = "acl",
          .rows = {{{-6.2, 5.6, 30.9}, {-6.2, 9.6, 28}, {-6.2, 13.6, 25.1}, 2.2},
                   {{-6, 1.6, 25.4}, {-6, 5.6, 22.5}, {-6, 9.6, 19.6}, 2.2},
                   {{-2.8, -7, 14}, {-3.3, -2.2, 11.7}, {-3.8, 2.6, 9.4}, 2.2},
                   {{0.6, -15, 0.8}, {-0.5, -10, 0.9}, {-1.6, -5, 1.2}, 2.2}},
          .origin = {"femur", 0.2},
          .insertion = {"tibia"},
          .seated = 0.3,
          .clear = 0.8};
}

Mesh ligament_mesh(const FibreBody& ligament, const Compartment& medial, const Compartment& lateral,
                   double h) {
  if (!(h >= 1.5 && h <= 4))
    throw std::invalid_argument(
        fmt::format("--size with --ligaments: {} mm: expected 1.5 to 4 mm", h));
  const Bones bones = {{"femur", femur_distance(medial, lateral)},
                       {"tibia", tibia_distance(medial, lateral)}};
  return fibre_body_mesh(ligament, bones, h);
}

Mesh femoral_side_sheet(double h, const Compartment& medial, const Compartment& lateral) {
  return part_of(femur_surface(h, medial, lateral), [](const Vec3& p, const Vec3& normal) {
    return normal.x() > 0.7 && p.x() > 36 && p.z() > 7 && p.z() < 36;
  });
}

Mesh tibial_side_sheet(double h, const Compartment& medial, const Compartment& lateral) {
  return part_of(tibia_surface(h, medial, lateral), [](const Vec3& p, const Vec3& normal) {
    return normal.x() > 0.3 && p.x() > 8 && p.y() > -22 && p.y() < 16 && p.z() > -75 &&
           p.z() < -3.5;
  });
}

Mesh notch_sheet(double h, const Compartment& medial, const Compartment& lateral) {
  return part_of(femur_surface(h, medial, lateral), [](const Vec3& p, const Vec3& /*normal*/) {
    return std::abs(p.x()) < 9 && p.y() > -16 && p.y() < 18 && p.z() > 12 && p.z() < 34;
  });
}

Mesh eminence_sheet(double h, const Compartment& medial, const Compartment& lateral) {
  return part_of(tibia_surface(h, medial, lateral), [](const Vec3& p, const Vec3& normal) {
    return normal.z() > 0.2 && std::abs(p.x()) < 6 && p.y() > -21 && p.y() < -1 && p.z() > -4;
  });
}

}  // namespace articular::anatomy
